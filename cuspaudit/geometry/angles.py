"""Maps into circles: angles among the components of R.

An angle is a pair (c, s) with c^2 + s^2 = 1 on V, the direction of a revolute actuator
or of a tool. Its differential is c ds - s dc (``geometry.crit``), and two points have
one value when c and s agree; V is not cut anywhere.

The values are sampled in a chart, t = tan of half the angle. **Lemma.** Let V' be V
without the points with c = -1, with t as one more coordinate. A point in every cell of
the complement of the atypical values of R' = (r_1, .., r_k, t) on V' meets every
component of the complement of the atypical values of R. *Proof.* The chart omits a
hypersurface of values, so every component of the complement of this and of the atypical
values, an open set, is a union of such cells, a null set aside. QED

So, as in the paper, R is cuspidal if and only if two points over one of the sample
values lie in one component of V - {Delta = 0}: couples move along with a value as
long as it stays in a cell. Components are those of V, by the routing; the roadmap would
have to be glued over the values that the chart omits.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import InvalidSystemError
from cuspaudit.geometry.fibers.pullback import vanishes_on

__all__ = ["check_angles", "rolled", "unrolled"]


def check_angles(variety: PolynomialSystem, mapping: PolynomialMap) -> None:
    """Return when c^2 + s^2 = 1 on V for every angle.

    Raises:
        InvalidSystemError: it does not hold for one.
    """
    for c, s in mapping.angles:
        if not vanishes_on(variety, c * c + s * s - 1):
            raise InvalidSystemError(
                file="map",
                found=f"angle [{c}, {s}]",
                expected="c^2 + s^2 = 1 must follow from the equations; add it",
            )


def unrolled(
    variety: PolynomialSystem, mapping: PolynomialMap
) -> tuple[PolynomialSystem, PolynomialMap]:
    """(V', R') of the lemma; (V, R) when there is no angle.

    c (1 + t^2) = 1 - t^2 and s (1 + t^2) = 2 t have no solution with c = -1, and one
    t = s / (1 + c) for every other point.
    """
    if not mapping.angles:
        return variety, mapping
    own = variety.ring
    names = [f"t{i + 1}" for i, _ in enumerate(mapping.angles)]
    while set(names) & set(own.variables):
        names = [f"{name}_" for name in names]
    ring = Ring([*own.variables, *names], own.radicand)
    equations = [ring.from_other(f, own) for f in variety.equations]
    for name, pair in zip(names, mapping.angles, strict=True):
        t = ring.gen(name)
        c, s = (ring.from_other(p, own) for p in pair)
        equations += [c * (1 + t * t) - (1 - t * t), s * (1 + t * t) - 2 * t]
    components = [ring.from_other(r, own) for r in mapping.components]
    components += [ring.gen(name) for name in names]
    return PolynomialSystem(ring, tuple(equations)), PolynomialMap(
        ring, tuple(components)
    )


def rolled(mapping: PolynomialMap, value: Sequence[fmpq]) -> tuple[fmpq, ...]:
    """The value of R with this value of R'; c and s in place of every t."""
    flat = len(mapping.components)
    found = list(value[:flat])
    for t in value[flat:]:
        found += [(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)]
    return tuple(found)
