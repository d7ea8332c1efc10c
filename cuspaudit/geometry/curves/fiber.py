"""The points of a curve over a critical value v0 of mu, with the branches at each.

Points with omega_u = 0 are listed by a zero-dimensional system of their own. Any other
point over v0 is rho / omega_u at a simple root of omega(.; v0); it is regular and one
branch passes through it. A real root of omega(.; v0) with no branch on either side and
no real listed point is the common image of complex points.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from flint import fmpq, fmpq_poly

from cuspaudit.algebra.points.parametrization import RealPoint
from cuspaudit.algebra.univariate import RealRoot
from cuspaudit.errors import CrossCheckError, UnableError
from cuspaudit.geometry.curves.branch_ends import Ruler, ruler, window
from cuspaudit.geometry.curves.parametrization import Curve
from cuspaudit.geometry.fibers.generic_fiber import function_equation

__all__ = ["CurveFiber", "Place", "Rulers", "curve_fiber"]

#: the interval between the marks of lambda, and the one of the second form (or 0)
Place = tuple[int, int]


@dataclass(frozen=True, eq=False)
class CurveFiber:
    """The real points of a curve over mu = v0.

    Attributes:
        value: v0.
        rulers: by lambda, and by a second form if lambda does not tell all apart.
        listed: the points with omega_u = 0, by place.
        left: the place where each branch over values just below v0 ends, by lambda.
        right: likewise above.
    """

    value: RealRoot
    rulers: tuple[Ruler, ...]
    listed: dict[Place, RealPoint]
    left: tuple[Place, ...]
    right: tuple[Place, ...]

    @cached_property
    def places(self) -> dict[Place, int]:
        """The number of half-branches at each real point, by place.

        Raises:
            CrossCheckError: a branch ends where no point was found.
        """
        below, above = Counter(self.left), Counter(self.right)
        for place in {*below, *above} - set(self.listed):
            if (below[place], above[place]) != (1, 1):
                raise CrossCheckError("a branch of a curve ends at no listed point")
        return {
            place: below[place] + above[place]
            for place in sorted({*below, *above, *self.listed})
        }

    def place(self, point: RealPoint) -> Place:
        """The place of a real point of the curve with mu = v0."""
        return _place(self.rulers, {p[0] for p in self.listed}, point)


class Rulers:
    """Rulers of a curve at its critical values; equations of forms are kept.

    Attributes:
        curve: the curve.
    """

    def __init__(self, curve: Curve) -> None:
        self.curve = curve
        first = curve.parametrization
        self._equations = {first.forms[0]: first.omega}

    def first(self, value: RealRoot) -> Ruler:
        """The ruler of lambda at v0."""
        form = self.curve.parametrization.forms[0]
        found = self._ruler(form, value)
        if found is None:
            raise CrossCheckError("a monic polynomial that is zero")
        return found

    def others(self, value: RealRoot) -> Iterator[Ruler]:
        """Rulers of other forms at v0: of the coordinates."""
        size = len(self.curve.system.ring.variables)
        for i in range(size):
            found = self._ruler(tuple(fmpq(int(i == j)) for j in range(size)), value)
            if found is not None:
                yield found

    def _ruler(self, form: tuple[fmpq, ...], value: RealRoot) -> Ruler | None:
        if form not in self._equations:
            function = self.curve.line(form)
            self._equations[form] = function_equation(self.curve.fiber, function)
        ring = self.curve.parametrization.ring
        return ruler(ring, self._equations[form], form, value)


def curve_fiber(
    rulers: Rulers, value: RealRoot, points: Sequence[RealPoint], low: fmpq, high: fmpq
) -> CurveFiber:
    """The real points of the curve over v0.

    Args:
        rulers: of the curve.
        value: v0.
        points: all real points with mu = v0 and omega_u = 0.
        low: below v0; no value from here to v0 is critical.
        high: likewise above.

    Raises:
        UnableError: no coordinate tells two points with equal lambda apart.
        CrossCheckError: branches and points do not fit.
    """
    chosen = _separating(rulers, value, points)
    intervals = {chosen[0].place(p) for p in points}
    listed = {_place(chosen, intervals, p): p for p in points}
    barrier = fmpq_poly([1])
    for each in chosen:
        barrier *= each.barrier
    left, right = (
        tuple(_place(chosen, intervals, p) for p in over.real_points())
        for v in window(value, barrier, low, high)
        for over in [rulers.curve.parametrization.over(v)]
    )
    return CurveFiber(value, chosen, listed, left, right)


def _separating(
    rulers: Rulers, value: RealRoot, points: Sequence[RealPoint]
) -> tuple[Ruler, ...]:
    """Rulers that give all the listed points different places."""
    first = rulers.first(value)
    intervals = [first.place(p) for p in points]
    if len(set(intervals)) == len(points):
        return (first,)
    for second in rulers.others(value):
        pairs = zip(intervals, map(second.place, points), strict=True)
        if len(set(pairs)) == len(points):
            return first, second
    raise UnableError("graph_isotop", "no coordinate separates the points of a fiber")


def _place(chosen: Sequence[Ruler], listed: set[int], point: RealPoint) -> Place:
    interval = chosen[0].place(point)
    if len(chosen) == 1 or interval not in listed:
        return interval, 0
    return interval, chosen[1].place(point)
