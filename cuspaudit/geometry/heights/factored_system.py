"""The critical points of a height whose polynomial is a product, in more unknowns.

Let P = c P_1^m_1 ... P_r^m_r on R^n and G = m log|P| - k log W. With u_j = 1 / P_j and
w = 1 / W,

    dG/dx_i = m sum_j m_j u_j dP_j/dx_i - k w dW/dx_i,

so the critical points with P != 0 are the zeros of these n polynomials, of u_j P_j = 1
and of w W = 1: of degree 2 to 4 where the numerators over one denominator have twice
that of P, and without the points of P = 0, where several P_j vanish together.

A factor that depends on x_i alone needs no unknown: equation i is multiplied by the
product q of those; it then reads q A + B = 0, B = m sum_j m_j q_j' q / q_j, and B has
no zero in common with q, as the q_j are irreducible and distinct. So q != 0 at its
zeros.
"""

from __future__ import annotations

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.heights.height import Height

__all__ = ["factored_system"]

Power = tuple[Polynomial, int]
"""An irreducible factor and its multiplicity; 0 marks the weight."""


def factored_system(height: Height) -> PolynomialSystem | None:
    """The critical points of ``height`` on R^n with P != 0, each once.

    Returns:
        The system, in the variables of R^n and more; None where P has one factor, or
        coefficients that are not in Q.
    """
    ring = height.ring
    if ring.radicand is not None:
        return None
    factors = [(p, int(m)) for p, m in height.base.factor()[1]]
    if len(factors) < 2:
        return None
    alone: dict[str, list[Power]] = {name: [] for name in ring.variables}
    joint: list[Power] = []
    for p, m in factors:
        names = [name for name in ring.variables if p.derivative(name) != 0]
        (alone[names[0]] if len(names) == 1 else joint).append((p, m))
    unknowns = [f"u{j}" for j, _ in enumerate(joint)]
    if height.decay:
        joint.append((height.weight, 0))
        unknowns.append("w")
    larger = Ring([*ring.variables, *_free(unknowns, ring)])
    return _system(height, larger, alone, joint)


def _system(
    height: Height,
    larger: Ring,
    alone: dict[str, list[Power]],
    joint: list[Power],
) -> PolynomialSystem:
    ring = height.ring
    inverses = larger.gens[len(ring.variables) :]
    equations = []
    for name in ring.variables:
        terms = []
        for (p, m), u in zip(joint, inverses, strict=True):
            factor = height.power * m if m else -height.decay
            terms.append(factor * u * larger.from_other(p.derivative(name), ring))
        rest = larger.total(terms)
        own = [(larger.from_other(q, ring), m) for q, m in alone[name]]
        product = larger.constant(1)
        slope = larger.constant(0)
        for q, m in own:
            slope = slope * q + height.power * m * product * q.derivative(name)
            product *= q
        equations.append(product * rest + slope)
    for (p, _), u in zip(joint, inverses, strict=True):
        equations.append(u * larger.from_other(p, ring) - 1)
    return PolynomialSystem(larger, tuple(equations))


def _free(names: list[str], ring: Ring) -> list[str]:
    """The names, made longer where the ring has them."""
    found = []
    for name in names:
        while name in ring.variables:
            name += "_"
        found.append(name)
    return found
