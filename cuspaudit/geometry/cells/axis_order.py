"""The order in which coordinates are projected away: a matter of work, not of truth.

A hypersurface can have a projection of small degree along one axis and a huge one along
another: that of G(x^2 + y^2, z) along y has the factors G(x^2, z) and one in z alone.
The degrees are compared on planes, where a projection is one of bivariate polynomials.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from flint import fmpq

from cuspaudit.algebra.elimination import square_free_factors
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.geometry.sample_points_rational import project

__all__ = ["axis_order"]


def axis_order(
    ring: Ring, polynomials: Sequence[Polynomial], variables: Sequence[str]
) -> tuple[int, ...]:
    """The places of ``variables`` in an order for `open_cells`.

    Returns:
        A permutation: last the axis along which the projection has the least degree,
        before it the one along which that projection has, and so on. It is a choice of
        convenience; nothing rests on it.
    """
    places = tuple(range(len(variables)))
    if len(places) < 2:
        return places
    factors = square_free_factors(ring, polynomials)
    best = min(
        reversed(places), key=lambda i: _projected_degree(ring, factors, variables, i)
    )
    rest = tuple(i for i in places if i != best)
    if len(rest) > 1:
        projected = [p for p in project(ring, factors, variables[best]) if p != 0]
        below = axis_order(ring, projected, [variables[i] for i in rest])
        rest = tuple(rest[i] for i in below)
    return (*rest, best)


def _projected_degree(
    ring: Ring, factors: Sequence[Polynomial], variables: Sequence[str], last: int
) -> float:
    """The degree of the projection along one axis, on one plane for every other."""
    total = 0.0
    others = [name for i, name in enumerate(variables) if i != last]
    for free in others:
        fixed = {w: fmpq(7 + 4 * j, 11) for j, w in enumerate(others) if w != free}
        plane = [ring.substitute(p, fixed) for p in factors]
        projected = project(ring, plane, variables[last])
        if any(p == 0 for p in projected):
            return inf
        parts = square_free_factors(ring, projected)
        total += sum(int(p.total_degree()) for p in parts)
    return total
