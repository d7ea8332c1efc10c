"""The points of V over a wall between two cells, counted exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations

from flint import arb, ctx, fmpq_poly

from cuspaudit.algebra.evaluation import Evaluator
from cuspaudit.algebra.matrix import determinant, jacobian
from cuspaudit.algebra.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.algebra.univariate import PRECISIONS
from cuspaudit.algebra.zero_dimensional import solve_zero_dimensional
from cuspaudit.errors import NotZeroDimensionalError, PrecisionError, UnableError
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.generic_fiber import GenericFiber
from cuspaudit.geometry.open_cells import Contact

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

        It is also the number over almost every other point of the same wall: checked
        is that V has no real singular point over the contact, when d > 1
        (``geometry.sheet_roadmap``, proof of the theorem).

        Raises:
            UnableError: V is singular there, or a system is too large.
        """
        ring = self.fiber.variety.ring
        system = self._over(contact)
        if len(self.fiber.values) > 1:
            self._check_smooth(contact, system)
        minors = crit(self.fiber.variety, self.fiber.mapping)
        delta = minors[0]
        if len(minors) > 1:
            delta = ring.total(minor * minor for minor in minors)
        return self._count(contact, self._solve(system, delta))

    def _check_smooth(self, contact: Contact, system: PolynomialSystem) -> None:
        variety = self.fiber.variety
        size = len(variety.ring.variables) - len(self.fiber.values)
        singular = _minors(variety.ring, variety.equations, size)
        if any(p.is_constant() for p in singular):
            return
        try:
            larger = PolynomialSystem(variety.ring, (*system.equations, *singular))
            found = self._count(contact, self._solve(larger, None))
        except NotZeroDimensionalError:
            found = 1
        if found:
            raise UnableError("roadmap", "V is singular over a wall of atypical values")

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
        self, system: PolynomialSystem, nonzero: Polynomial | None
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


def _minors(ring: Ring, equations: Sequence[Polynomial], size: int) -> list[Polynomial]:
    """All minors of this size of the Jacobian matrix; [1] for size 0."""
    if size == 0:
        return [ring.constant(1)]
    matrix = jacobian(ring, equations)
    columns = list(combinations(range(len(ring.variables)), size))
    minors = [
        determinant(ring, [[row[j] for j in chosen] for row in rows])
        for rows in combinations(matrix, size)
        for chosen in columns
    ]
    return [p for p in minors if p != 0]
