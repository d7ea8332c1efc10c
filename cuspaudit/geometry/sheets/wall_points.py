"""The points of V over a wall between two cells, counted exactly."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from flint import arb, ctx, fmpq_poly

from cuspaudit.algebra.elimination import square_free_factors
from cuspaudit.algebra.evaluation import Evaluator
from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.algebra.univariate import PRECISIONS, Univariate
from cuspaudit.errors import PrecisionError, UnableError
from cuspaudit.geometry.cells.open_cells import Contact
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.fibers.generic_fiber import GenericFiber, function_equation

__all__ = ["WallPoints"]


@dataclass(frozen=True, eq=False)
class WallPoints:
    """Counts of the points of V over contacts.

    Attributes:
        fiber: the map.
        timeout: for every system, in s.
        seed: of the solver's random choices.
        grounds: what the counts rest on, filled as they are made.
    """

    fiber: GenericFiber
    timeout: float
    seed: int
    grounds: set[str] = field(default_factory=set)

    def regular(self, contact: Contact) -> int:
        """The number of real points of V with Delta != 0 over ``contact``.

        It is checked that it is the largest number over a point of the same wall, when
        d > 1. Let mu in Q[y][t] be an equation of Delta over Q(y), c_0, c_1, ... its
        coefficients, g the irreducible polynomial of the wall, k the first index with
        g not dividing c_k. Where c_k is not 0 on the wall, exactly k of the values of
        Delta tend to 0. So there, a sheet along which Delta tends to 0 does so along
        the wall, and none is regular elsewhere only.

        Raises:
            UnableError: c_k = 0 over the contact, or a system is too large.
        """
        if len(self.fiber.values) > 1 and not self._is_generic(contact):
            raise UnableError("roadmap", "an unlucky point of a wall was chosen")
        return self._count(contact, self._solve(self._over(contact), self._delta))

    @cached_property
    def _delta(self) -> Polynomial:
        """Delta, or the sum of the squares of several minors: the same real zeros."""
        ring = self.fiber.variety.ring
        minors = crit(self.fiber.variety, self.fiber.mapping)
        return minors[0] if len(minors) == 1 else ring.total(m * m for m in minors)

    @cached_property
    def _coefficients(self) -> list[Polynomial]:
        """Those of mu, lowest first."""
        ring = self.fiber.ring
        mu = function_equation(self.fiber, self._delta, self.timeout, self.seed)
        parts = ring.coefficients(mu, ring.variables[:1])
        zero = ring.constant(0)
        return [parts.get((k,), zero) for k in range(max(parts)[0] + 1)]

    def _is_generic(self, contact: Contact) -> bool:
        wall = next(
            g
            for g in square_free_factors(
                self.fiber.ring, [self.fiber.leading, self.fiber.discriminant]
            )
            if self._is_zero(g, contact)
        )
        lowest = next(c for c in self._coefficients if divmod(c, wall)[1] != 0)
        return not self._is_zero(lowest, contact)

    def _is_zero(self, polynomial: Polynomial, contact: Contact) -> bool:
        """Whether a polynomial of Q[y] vanishes on the contact, exactly."""
        ring, names = self.fiber.ring, self.fiber.values
        name = names[contact.axis]
        at = dict(zip(names, contact.ends[0], strict=True))
        del at[name]
        special = ring.substitute(polynomial, at)
        along = Univariate.from_polynomial(ring, special, name).rational
        return bool(along % fmpq_poly(contact.root.polynomial) == 0)

    def _over(self, contact: Contact) -> PolynomialSystem:
        """The points of V over the contact, or over a conjugate of its root."""
        ring, axis = self.fiber.variety.ring, contact.axis
        equations = list(self.fiber.variety.equations)
        for k, r in enumerate(self.fiber.mapping.components):
            if k != axis:
                equations.append(r - contact.ends[0][k])
                continue
            total = ring.constant(0)
            for c in reversed(fmpq_poly(contact.root.polynomial).coeffs()):
                total = total * r + c
            equations.append(total)
        return PolynomialSystem(ring, tuple(equations))

    def _solve(
        self, system: PolynomialSystem, nonzero: Polynomial
    ) -> ZeroDimensionalParametrization:
        points = solve_zero_dimensional(
            system, nonzero=nonzero, timeout=self.timeout, seed=self.seed
        )
        self.grounds.update(points.grounds)
        return points

    def _count(self, contact: Contact, points: ZeroDimensionalParametrization) -> int:
        """How many real points lie over the root itself."""
        ring = self.fiber.variety.ring
        value = Evaluator(ring, [self.fiber.mapping.components[contact.axis]])
        low, high = (arb(end[contact.axis]) for end in contact.ends)
        total = 0
        for point in points.real_points():
            for bits in PRECISIONS:
                with ctx.workprec(bits):
                    ball = point.ball(bits)
                    (y,) = value.balls([ball[name] for name in ring.variables])
                    if not (y.overlaps(low) or y.overlaps(high)):
                        total += bool(low < y < high)
                        break
            else:
                raise PrecisionError("a point over a wall", PRECISIONS[-1])
        return total
