"""All critical points of a height, each proved to be nondegenerate.

The critical equations are solved completely (``algebra.points.zero_dimensional``); the
index of each real solution is proved in ball arithmetic, with more bits where needed. A
degenerate point is never proved to be one: the caller takes another height.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from flint import arb, ctx, fmpq

from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
)
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import UnableError
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.heights.factored_system import factored_system
from cuspaudit.geometry.heights.height import critical_system
from cuspaudit.geometry.heights.morse import CriticalPoint, critical_point
from cuspaudit.geometry.lifts.lifting import Box

__all__ = ["Point", "box_of", "critical_points"]

Point = RealPoint | Sequence[fmpq | int]

_PRECISIONS = (106, 212, 424, 848)


def critical_points(
    landscape: ChartedHeight, timeout: float, seed: int
) -> tuple[list[CriticalPoint] | None, tuple[str, ...]]:
    """All critical points of G on V with P != 0, and what their completeness rests on.

    Over Q(sqrt m), sqrt m is one more unknown; the points with -sqrt m are dropped.

    Args:
        landscape: V and G.
        timeout: of the solver, in s.
        seed: of the solver's linear forms.

    Returns:
        None in place of the points if one is not proved to be nondegenerate.

    Raises:
        NotZeroDimensionalError: there are infinitely many complex ones.
        UnableError: they cannot be listed completely.
    """
    ring, height = landscape.variety.ring, landscape.height
    system = critical_system(landscape.variety, landscape.dimension, height)
    if ring.radicand is not None:
        minimal = ring.surd * ring.surd - ring.radicand
        names = tuple(ring.context.names())
        system = PolynomialSystem(Ring(names), (*system.equations, minimal))
    found = _by_factors(landscape, timeout, seed) or solve_zero_dimensional(
        system, nonzero=height.base, timeout=timeout, seed=seed
    )
    points = []
    for point in found.real_points():
        if ring.radicand is not None and not point.ball(64)[names[-1]] > 0:
            continue
        classified = _classified(landscape, point)
        if classified is None:
            return None, found.grounds
        points.append(classified)
    return points, found.grounds


def _by_factors(
    landscape: ChartedHeight, timeout: float, seed: int
) -> ZeroDimensionalParametrization | None:
    """The critical points where P is a product on R^n, n > 2; None where that fails.

    In the plane resultants are quicker.

    Raises:
        NotZeroDimensionalError: there are infinitely many complex ones.
    """
    names = landscape.variety.ring.variables
    if landscape.variety.equations or len(names) < 3:
        return None
    system = factored_system(landscape.height)
    if system is None:
        return None
    with suppress(UnableError):
        return solve_zero_dimensional(
            system, variables=names, timeout=timeout / 2, seed=seed
        )
    return None


def box_of(ring: Ring, point: Point, bits: int) -> Box:
    """A point of R^n as balls in the order of the ring."""
    with ctx.workprec(bits):
        if isinstance(point, RealPoint):
            balls = point.ball(bits)
            return tuple(balls[name] for name in ring.variables)
        return tuple(arb(x) for x in point)


def _classified(landscape: ChartedHeight, point: RealPoint) -> CriticalPoint | None:
    for bits in _PRECISIONS:
        with ctx.workprec(bits):
            ball = box_of(landscape.variety.ring, point, bits)
            found = critical_point(landscape, ball)
        if found is not None:
            return found
    return None
