"""A couple found before anything is listed completely.

R is cuspidal as soon as two points of V over one value are joined by a path on which
Delta != 0. Neither the atypical values nor the cells of their complement, nor all
components of V - {Delta = 0}, are needed for that:

1. values near those of random points of V, as simple fractions;
2. the fiber over each, exactly;
3. of its points with the same sign of every factor of Delta, two from which the height
   is climbed to the same maximum, or to maxima joined over saddles: in floating point;
4. the path so guessed, proved in ball arithmetic.

**Proposition.** Let V be given by n - d equations, or satisfy assumption (A) of the
paper. A couple found here is one. *Proof.* The points are two roots of one
parametrization, solutions by exact substitution, so they are different and over one
value. Where Delta != 0 jac(f, R) has rank n, so V is smooth of dimension d there and R
a local diffeomorphism; and the path proved is one of such points. QED

Nothing follows when no couple is found.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import combinations

import numpy as np
from flint import fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.evaluation import Evaluator
from cuspaudit.algebra.msolve_points import msolve_points
from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
)
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import NotZeroDimensionalError, PrecisionError, UnableError
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.geometry.heights.critical_points import box_of
from cuspaudit.geometry.heights.guessed_ways import GuessedWays, random_points
from cuspaudit.geometry.heights.height import heights
from cuspaudit.geometry.heights.morse import middle
from cuspaudit.geometry.heights.proved_path import prove_path
from cuspaudit.geometry.idle_circles import Essential

__all__ = ["Couple", "Found", "Value", "find_couple", "more_fibers"]

Value = tuple[fmpq, ...]
Array = NDArray[np.float64]

_FIBERS = 8
_MORE = 24
_MOST_FIBERS = 60
_CANDIDATES = 400
_LARGEST_DENOMINATOR = 12
_BITS = 212


@dataclass(frozen=True, eq=False)
class Couple:
    """Two points of V over one value, in one component of V - {Delta = 0}.

    Attributes:
        value: q in Q^d; c and s of every angle.
        points: the two points, exactly.
        sign: of Delta at both; 1 when there are several minors.
        path: (m, n) way points on V from the first to the second, in floating point.
    """

    value: Value
    points: tuple[RealPoint, RealPoint]
    sign: int
    path: Array


@dataclass(eq=False)
class Found:
    """What a search for a couple met.

    Attributes:
        fibers: value -> its fiber.
        couple: proved, or None.
    """

    fibers: dict[Value, ZeroDimensionalParametrization] = field(default_factory=dict)
    couple: Couple | None = None


def find_couple(
    essential: Essential,
    mapping: PolynomialMap,
    minors: Sequence[Polynomial],
    left: Callable[[], float],
    seed: int = 1,
) -> Found:
    """Some fibers of R, and a couple in one of them if one is found and proved.

    Args:
        essential: V = {f = 0} over Q, by n - d equations or under assumption (A).
        mapping: R: V -> R^d.
        minors: those of ``crit``, not all zero on V.
        left: the seconds left; given to every solver.
        seed: of every random choice.

    Guarantee: deterministic as long as no solver meets its time limit.
    """
    found = Found()
    if essential.whole.ring.radicand is not None:
        return found
    search = _Search(essential, mapping, minors, seed)
    for value in search.values():
        fiber = _fiber(essential.whole, mapping, value, min(left() / 4, 10.0), seed)
        if fiber is not None:
            found.fibers[value] = fiber
            found.couple = next(search.couples(value, fiber), None)
        if found.couple is not None or left() <= 0:
            return found
        if len(found.fibers) >= (_MORE if search.is_hopeless else _FIBERS):
            break
    search.join()
    for value, fiber in found.fibers.items():
        found.couple = next(search.couples(value, fiber), None)
        if found.couple is not None or left() <= 0:
            break
    return found


def more_fibers(
    essential: Essential,
    mapping: PolynomialMap,
    minors: Sequence[Polynomial],
    left: Callable[[], float],
    seed: int = 1,
) -> dict[Value, ZeroDimensionalParametrization]:
    """Fibers over sixty values, fewer when the time is over."""
    found: dict[Value, ZeroDimensionalParametrization] = {}
    for value in _Search(essential, mapping, minors, seed).values():
        fiber = _fiber(essential.whole, mapping, value, min(left(), 10.0), seed)
        if fiber is not None:
            found[value] = fiber
        if len(found) == _MOST_FIBERS or left() <= 0:
            break
    return found


class _Search:
    """The fibers' points, and the ways between them.

    Attributes:
        is_hopeless: whether all fibers so far had points of different signs only.
    """

    def __init__(
        self,
        essential: Essential,
        mapping: PolynomialMap,
        minors: Sequence[Polynomial],
        seed: int,
    ) -> None:
        self.is_hopeless = True
        self._essential, self._minors = essential, tuple(minors)
        self._ring = essential.whole.ring
        own = essential.variety
        height = next(heights(own, essential.minors, seed))
        self._ways = GuessedWays(ChartedHeight(own, essential.dimension, height), seed)
        self._flat = len(mapping.components)
        self._values = Evaluator(self._ring, mapping.functions)
        self._points = random_points(own, seed)
        self._everywhere = random_points(essential.whole, seed)
        self._nearby = random_points(essential.whole, seed, minors)
        self._factors = (
            [f for f, _ in minors[0].factor()[1]] if len(minors) == 1 else []
        )

    def values(self) -> Iterator[Value]:
        """Simple values near those of random points, each once.

        From the ninth on every second is one near a critical value, where points of a
        fiber are born and die.
        """
        seen = set[Value]()
        for number in range(_CANDIDATES):
            near = len(seen) >= _FIBERS and number % 2
            point = next(self._nearby if near else self._everywhere, None)
            if point is None:
                continue
            value = self._near(self._values.floats(point))
            if value not in seen:
                seen.add(value)
                yield value

    def _near(self, values: Sequence[float]) -> Value:
        """A value of small fractions; points of circles by their half-angles."""
        flat, round_ = values[: self._flat], values[self._flat :]
        found = list(map(_simple, flat))
        for c, s in zip(round_[::2], round_[1::2], strict=True):
            t = _simple(s / (1 + c) if c > -0.999 else 1000.0)
            found += [(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)]
        return tuple(found)

    def couples(
        self, value: Value, fiber: ZeroDimensionalParametrization
    ) -> Iterator[Couple]:
        """Couples of a fiber, proved."""
        for points in self._alike(fiber):
            self.is_hopeless = False
            climbed = [self._ways.climbed(self._middle(p)) for p in points]
            pairs = combinations(zip(points, climbed, strict=True), 2)
            for (a, first), (b, second) in pairs:
                if first is None or second is None:
                    continue
                between = self._ways.between(first[0], second[0])
                if between is None:
                    continue
                path = np.concatenate([first[1], between, second[1][::-1]])
                if self._is_proved(a, path, b):
                    yield Couple(value, (a, b), self._sign(a), self._lifted(a, path, b))

    def join(self) -> None:
        """Look for saddles between the maxima met."""
        if not self.is_hopeless:
            self._ways.join(self._points)

    def _alike(self, fiber: ZeroDimensionalParametrization) -> list[list[RealPoint]]:
        """The regular real points, together where all factors have one sign."""
        ring, alike = self._ring, defaultdict(list)
        for point in fiber.real_points():
            if any(point.sign(minor, ring) != 0 for minor in self._minors):
                signs = tuple(point.sign(f, ring) for f in self._factors)
                alike[signs].append(point)
        return [points for points in alike.values() if len(points) > 1]

    def _sign(self, point: RealPoint) -> int:
        return 1 if len(self._minors) > 1 else point.sign(self._minors[0], self._ring)

    def _is_proved(self, first: RealPoint, places: Array, last: RealPoint) -> bool:
        own, dimension = self._essential.variety, self._essential.dimension
        ends = [box_of(own.ring, point, _BITS) for point in (first, last)]
        try:
            boxes = prove_path(
                own, dimension, self._essential.minors, ends[0], places, ends[1]
            )
        except PrecisionError:
            return False
        return boxes is not None

    def _middle(self, point: RealPoint) -> Array:
        """The point of V' in doubles."""
        return middle(box_of(self._essential.variety.ring, point, 64))

    def _lifted(self, first: RealPoint, path: Array, last: RealPoint) -> Array:
        ends = [middle(box_of(self._ring, point, 64)) for point in (first, last)]
        return self._essential.lifted(path, *ends)


def _simple(number: float) -> fmpq:
    near = Fraction(number).limit_denominator(_LARGEST_DENOMINATOR)
    return fmpq(near.numerator, near.denominator)


def _fiber(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    value: Value,
    timeout: float,
    seed: int,
) -> ZeroDimensionalParametrization | None:
    """The fiber over a value, or points of it; None if it is infinite or too large."""
    system = (*variety.equations, *mapping.over(value))
    ring = variety.ring
    try:
        return solve_zero_dimensional(
            PolynomialSystem(ring, system), timeout=timeout, seed=seed
        )
    except NotZeroDimensionalError:
        return None
    except UnableError:
        pass
    try:
        return msolve_points(ring, system, ring.variables, timeout, seed)
    except UnableError:
        return None
