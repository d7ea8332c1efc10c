"""A real curve cut at its critical values: the planes on which its topology rests.

Critical values of mu are the real zeros of the discriminant of omega in u, of the
resultants of omega with the numerators of the conditions h_j, and the values at query
points. Between two of them omega(.; v) has as many real roots everywhere, all simple,
and h_j has one sign on each branch.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from flint import arb, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.algebraic_roots import common_divisor_over, real_roots_over
from cuspaudit.algebra.elimination import discriminant, resultant
from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
)
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.rationals import rationals_between
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.algebra.univariate import (
    PRECISIONS,
    RealRoot,
    Univariate,
    disjoint_balls,
    real_roots,
)
from cuspaudit.errors import PrecisionError
from cuspaudit.geometry.curves.branch_ends import coefficients_of
from cuspaudit.geometry.curves.fiber import CurveFiber, Place, Rulers, curve_fiber
from cuspaudit.geometry.curves.parametrization import Curve

__all__ = ["CurveSections", "curve_sections"]


@dataclass(frozen=True, eq=False)
class CurveSections:
    """The real points of a curve over critical values and between them.

    Attributes:
        curve: {f = 0}.
        conditions: h_1..h_t.
        queries: the query points, with parameter mu.
        values: the critical values, increasing.
        fibers: the points over each.
        samples: the points over a rational value below, between and above them.
        grounds: what completeness of the points with omega_u = 0 rests on.
    """

    curve: Curve
    conditions: tuple[Polynomial, ...]
    queries: ZeroDimensionalParametrization
    values: tuple[RealRoot, ...]
    fibers: tuple[CurveFiber, ...]
    samples: tuple[tuple[RealPoint, ...], ...]
    grounds: tuple[str, ...]

    def is_inside(self, point: RealPoint) -> bool:
        """Whether all h_j are positive at a point, exactly."""
        ring = self.curve.system.ring
        return all(point.sign(h, ring) > 0 for h in self.conditions)

    def touches(self, fiber: CurveFiber, place: Place) -> bool:
        """Whether some h_j is 0 at a point with omega_u != 0, exactly.

        There h_j = 0 at a root common to omega(.; v0) and the numerator.
        """
        own, first = self.curve.parametrization, fiber.rulers[0]
        omega = coefficients_of(own.ring, own.omega)
        for h in self.conditions:
            above = coefficients_of(own.ring, own.numerator(self.curve.system.ring, h))
            common = common_divisor_over(omega, above, fiber.value)
            for zero in real_roots_over([common], fiber.value):
                interval = first.interval(zero)
                if interval is None:
                    raise PrecisionError("zero of a condition", PRECISIONS[1])
                if interval == place[0]:
                    return True
        return False


def curve_sections(
    curve: Curve,
    conditions: tuple[Polynomial, ...],
    queries: ZeroDimensionalParametrization,
    timeout: float,
) -> CurveSections:
    """The sections of a curve.

    Args:
        curve: {f = 0}.
        conditions: h_1..h_t.
        queries: points on the curve, with parameter mu.
        timeout: of the system for the points with omega_u = 0, in s.

    Raises:
        UnableError: the points with omega_u = 0 are not listed completely, or not
            told apart.
    """
    values = real_roots(Univariate(_critical(curve, conditions, queries), _ZERO))
    gaps = _in_the_gaps(values)
    listed, grounds = _points_without_slope(curve, timeout)
    over: dict[RealRoot, list[RealPoint]] = {value: [] for value in values}
    for point in listed:
        over[_value_of(curve, values, point)].append(point)
    rulers, sides = Rulers(curve), pairwise(gaps)
    fibers = [
        curve_fiber(rulers, value, over[value], low, high)
        for value, (low, high) in zip(values, sides, strict=True)
    ]
    samples = (curve.parametrization.over(v).real_points() for v in gaps)
    return CurveSections(
        *(curve, conditions, queries, tuple(values)),
        *(tuple(fibers), tuple(samples), grounds),
    )


_ZERO = fmpq_poly([0])


def _critical(
    curve: Curve,
    conditions: Sequence[Polynomial],
    queries: ZeroDimensionalParametrization,
) -> fmpq_poly:
    """A polynomial whose real zeros are the critical values."""
    own = curve.parametrization
    u = own.ring.variables[0]
    found = [discriminant(own.ring, own.omega, u)]
    for h in conditions:
        above = own.numerator(curve.system.ring, h)
        if above != 0:
            rest = own.omega / own.omega.gcd(above)
            found.append(resultant(own.ring, rest, above, u))
    product = queries.omega
    for p in found:
        (constant,) = coefficients_of(own.ring, p)
        product *= constant
    return product


def _in_the_gaps(values: Sequence[RealRoot]) -> list[fmpq]:
    """A rational below the values, one between each two, one above."""
    if not values:
        return [fmpq(0)]
    ends: list[arb | None] = [None, *disjoint_balls(values), None]
    return [next(rationals_between(a, b)) for a, b in pairwise(ends)]


def _points_without_slope(
    curve: Curve, timeout: float
) -> tuple[tuple[RealPoint, ...], tuple[str, ...]]:
    """The real points of {f = 0} with omega_u = 0, and the grounds."""
    own, ring = curve.parametrization, curve.system.ring
    at = [curve.line(form) for form in own.forms]
    slope = own.slope.compose(*at, ctx=ring.context)
    system = PolynomialSystem(ring, (*curve.system.equations, slope))
    found = solve_zero_dimensional(system, timeout=timeout)
    return found.real_points(), found.grounds


def _value_of(curve: Curve, values: Sequence[RealRoot], point: RealPoint) -> RealRoot:
    """Mu at a point where it is critical."""
    for bits in PRECISIONS:
        with ctx.workprec(2 * bits):
            v = _linear(curve.parametrization.forms[1], point.ball(bits).values())
            near = [r for r in values if r.enclosure(bits).overlaps(v)]
        if len(near) == 1:
            return near[0]
    raise PrecisionError("critical value of a point", PRECISIONS[-1])


def _linear(form: Sequence[fmpq], point: Iterable[arb]) -> arb:
    return sum((c * x for c, x in zip(form, point, strict=True)), arb(0))
