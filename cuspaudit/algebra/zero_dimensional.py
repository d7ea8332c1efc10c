"""Complete solving of polynomial systems with finitely many complex solutions.

Two routes, the cheaper first; each result names the ground of its completeness.

- An exact Groebner basis by FLINT, within limits: the quotient algebra is known, and
  linear algebra in it gives the points, multiple ones included.
- msolve, whose answer is probabilistic. That its points are solutions is proved by
  substitution modulo omega; that none is missing, by a bound on the dimension of the
  quotient algebra: the leading monomials of the exact basis, or the rank of a matrix
  of multiples of the equations modulo a prime (`algebra.macaulay`).
"""

from __future__ import annotations

from dataclasses import replace

from cuspaudit.algebra.finite_algebra import (
    FiniteAlgebra,
    parametrization_of,
    quotient_algebra,
    staircase,
)
from cuspaudit.algebra.ideal import groebner_basis
from cuspaudit.algebra.msolve_points import msolve_points
from cuspaudit.algebra.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem

__all__ = ["solve_zero_dimensional"]

GROUND = "exact Groebner basis"
_INVERSE = "inverse_of_nonzero"
_SMALL = 30


def solve_zero_dimensional(
    system: PolynomialSystem,
    *,
    nonzero: Polynomial | None = None,
    timeout: float = 60,
    seed: int = 1,
) -> ZeroDimensionalParametrization:
    """All the points of C^n where the system vanishes and ``nonzero`` does not.

    Where ``nonzero`` = h is given, the system solved is f = 0, v h = 1 in one more
    variable v; its points are those asked for with v = 1/h added.

    Args:
        system: f in Q[x_1..x_n], any number of equations.
        nonzero: h in the same ring.
        timeout: of msolve, in s; the exact route has limits of its own.
        seed: of the linear forms.

    Returns:
        The points, each once, complete on the grounds it names; omega = 1 when there
        is none.

    Raises:
        NotZeroDimensionalError: there are infinitely many.
        UnableError: completeness was not proved, or the system is too large.
    """
    ring, equations = _saturated(system, nonzero)
    variables = system.ring.variables
    basis = groebner_basis(ring, equations)
    bound = len(staircase(basis))
    if bound > _SMALL:
        found = msolve_points(ring, equations, variables, timeout, seed)
        if found.degree == bound:
            return replace(found, grounds=(GROUND,))
    return parametrization_of(
        _kept(quotient_algebra(basis), variables), (GROUND,), seed
    )


def _kept(algebra: FiniteAlgebra, variables: tuple[str, ...]) -> FiniteAlgebra:
    """The same algebra without the names and matrices of other variables."""
    own = dict(zip(algebra.variables, algebra.matrices, strict=True))
    matrices = tuple(own[name] for name in variables)
    return FiniteAlgebra(variables, matrices, algebra.one)


def _saturated(
    system: PolynomialSystem, nonzero: Polynomial | None
) -> tuple[Ring, list[Polynomial]]:
    """The system in Q[v, x_1..x_n] with v h = 1 added; itself without h."""
    ring = system.ring
    equations = [p for p in system.equations if p != 0]
    if nonzero is None:
        return ring, equations
    larger = Ring([_INVERSE, *ring.variables], ring.radicand)
    lifted = [larger.from_other(p, ring) for p in (*equations, nonzero)]
    return larger, [*lifted[:-1], larger.gen(_INVERSE) * lifted[-1] - 1]
