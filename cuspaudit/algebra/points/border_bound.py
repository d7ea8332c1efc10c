"""Elements of an ideal of Q[x], degree by degree, that bound its solutions.

Let L be the polynomials of degree at most D and V a subspace of I in L, of generators
of I at first. Replace V by V + x_1 V' + ... + x_n V', V' its members of degree below D,
until nothing is new. All of it stays in I. **The monomials that no leading monomial of
V divides span Q[x]/I**, as the remainder by V is made of them [Cox, Little, O'Shea,
*Ideals, Varieties, and Algorithms*, 2.3]: their number bounds dim Q[x]/I, which counts
the solutions with multiplicities. And the zero set has no larger dimension than the
largest number of variables in which alone no leading monomial is [the same, 9.3], as
more leading monomials leave fewer. No Groebner basis is claimed. In comparison
with the multiples of the generators (``algebra.points.macaulay``), D is the largest
degree of what is multiplied, not of the whole product: mostly much smaller.

A run modulo a small prime, in doubles, finds D and the few products that are new; these
are then reduced over Q, by products and solutions of matrices. Of the prime nothing is
assumed: a leading monomial counts when it is one over Q.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import comb

import numpy as np
from flint import fmpz, fmpz_mat
from numpy.typing import NDArray

from cuspaudit.algebra.points.ideal import (
    Exponents,
    as_exponents,
    degree_reverse_key,
    free_variables,
)
from cuspaudit.algebra.points.macaulay import monomials, times
from cuspaudit.algebra.rational_echelon import rational_echelon
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import primitive
from cuspaudit.runtime.clock import check_time

__all__ = ["border_bound", "is_dimension_below"]

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

_PRIME = 4_194_301
"""Below 2^22: sums of 512 products of residues are exact in doubles."""
_TERMS = 512
_MOST_COLUMNS = 1000
_LATER = 2
"""Degrees above that of the generators that are tried."""

Row = dict[Exponents, int]
Product = tuple[int, int]
"""The number of a row of the last block, and of the variable that multiplies it."""


def border_bound(ring: Ring, polynomials: Sequence[Polynomial], points: int) -> bool:
    """Whether dim Q[x]/<f> <= ``points`` was proved by elements of bounded degree.

    Args:
        ring: Q[x_1..x_n].
        polynomials: elements of the ideal, nonzero.
        points: the number of solutions known.

    Returns:
        False when it was not proved with degrees and sizes that are tried.
    """

    def met(space: _Space, leading: Sequence[int]) -> bool:
        found = space.staircase(leading)
        return found is not None and found <= points

    return _proves(ring, polynomials, met)


def is_dimension_below(
    ring: Ring, polynomials: Sequence[Polynomial], dimension: int
) -> bool:
    """Whether the zero set in C^n was proved to have a dimension below that given.

    Args:
        ring: Q[x_1..x_n].
        polynomials: elements of the ideal, nonzero.
        dimension: at least 0.

    Returns:
        False when it was not proved with degrees and sizes that are tried.
    """
    n = len(ring.variables)

    def met(space: _Space, leading: Sequence[int]) -> bool:
        return free_variables(n, [space.columns[i] for i in leading]) < dimension

    return _proves(ring, polynomials, met)


def _proves(ring: Ring, polynomials: Sequence[Polynomial], met: Goal) -> bool:
    """Whether elements of bounded degree have leading monomials that meet a goal."""
    n = len(ring.variables)
    rows = [_row(ring, p) for p in polynomials]
    lowest = max((sum(e) for row in rows for e in row), default=0)
    for degree in range(lowest, lowest + _LATER + 1):
        if comb(n + degree, n) > _MOST_COLUMNS:
            return False
        space = _Space(n, degree)
        given = [space.vector(row) for row in rows]
        plan = _plan(space, given, met)
        if plan is not None:
            return _is_exact(space, given, plan)
    return False


Goal = Callable[["_Space", Sequence[int]], bool]
"""Whether leading monomials, by their places, are enough."""


class _Space:
    """The monomials of degree at most D, downwards in the degree reverse order.

    Attributes:
        columns: the exponents.
        moved: (n, m) the place of x_j times each monomial; -1 above the degree.
    """

    def __init__(self, n: int, degree: int) -> None:
        every = monomials(n, degree)
        self.columns = sorted(every, key=degree_reverse_key, reverse=True)
        self._place = {e: i for i, e in enumerate(self.columns)}
        self.moved: Whole = np.array(
            [[self._place.get(times(e, j), -1) for e in self.columns] for j in range(n)]
        )

    def vector(self, row: Row) -> list[int]:
        """A polynomial of degree at most D as a list of its coefficients."""
        found = [0] * len(self.columns)
        for exponents, value in row.items():
            found[self._place[exponents]] = value
        return found

    def staircase(self, leading: Sequence[int]) -> int | None:
        """How many monomials no leading one divides; None for infinitely many."""
        free = np.ones(len(self.columns), dtype=bool)
        free[list(leading)] = False
        for i in range(len(free) - 1, -1, -1):
            if not free[i]:
                multiples = self.moved[:, i]
                free[multiples[multiples >= 0]] = False
        if free[self.moved[0] < 0].any():
            return None  # of the largest degree
        return int(free.sum())


@dataclass(frozen=True)
class _Round:
    """The products of a round that are new, and the leading monomials they come to."""

    products: list[Product]
    pivots: list[int]


def _plan(
    space: _Space, given: Sequence[Sequence[int]], met: Goal
) -> list[_Round] | None:
    """What is new modulo the prime, round by round; None if the goal is not met."""
    rows = np.array([[v % _PRIME for v in row] for row in given], dtype=float)
    products: list[Product] = [(i, -1) for i in range(len(rows))]
    blocks: list[tuple[list[int], Array]] = []
    rounds: list[_Round] = []
    while len(rows):
        check_time("solve_zero_dimensional")
        for pivots, block in blocks:
            rows = _less(rows, rows[:, pivots], block)
        chosen, block, pivots = _echelon(rows)
        if not chosen:
            return None
        blocks.append((pivots, block))
        rounds.append(_Round([products[i] for i in chosen], pivots))
        if met(space, [p for step in rounds for p in step.pivots]):
            return rounds
        products = _products(space, pivots)
        rows = np.array([_moved(space, block[i], j) for i, j in products])
    return None


def _products(space: _Space, pivots: Sequence[int]) -> list[Product]:
    """The rows of degree below D, times every variable."""
    low = [i for i, pivot in enumerate(pivots) if space.moved[0, pivot] >= 0]
    return [(i, j) for i in low for j in range(len(space.moved))]


def _moved(space: _Space, row: Array, variable: int) -> Array:
    found = np.zeros(len(row), dtype=row.dtype)
    own = np.flatnonzero(row)
    found[space.moved[variable, own]] = row[own]
    return found


def _less(rows: Array, factors: Array, block: Array) -> Array:
    """Rows - factors block, modulo the prime."""
    for k in range(0, len(block), _TERMS):
        part = factors[:, k : k + _TERMS] @ block[k : k + _TERMS]
        rows = (rows - part % _PRIME) % _PRIME
    return rows


def _echelon(rows: Array) -> tuple[list[int], Array, list[int]]:
    """Which rows are independent, their reduced echelon form and its pivots."""
    rest, chosen, pivots = rows.copy(), list[int](), list[int]()
    left = np.ones(len(rows), dtype=bool)
    for column in np.flatnonzero(rest.any(axis=0)).tolist():
        able = np.flatnonzero((rest[:, column] != 0) & left)
        if not len(able):
            continue
        i = int(able[0])
        rest[i] = rest[i] * pow(int(rest[i, column]), -1, _PRIME) % _PRIME
        factors = rest[:, column].copy()
        factors[i] = 0
        hit = np.flatnonzero(factors)
        rest[hit] = (rest[hit] - np.outer(factors[hit], rest[i]) % _PRIME) % _PRIME
        left[i] = False
        chosen.append(i)
        pivots.append(column)
    return chosen, rest[chosen], pivots


def _is_exact(
    space: _Space,
    given: Sequence[Sequence[int]],
    plan: Sequence[_Round],
) -> bool:
    """Whether the products of the plan, reduced over Q, have these leading monomials.

    A block is kept as integers over one denominator, 0 at the pivots of those before.
    """
    blocks: list[tuple[list[int], fmpz_mat, fmpz]] = []
    last: list[list[fmpz]] = [[fmpz(v) for v in row] for row in given]
    number = 0
    for step in plan:
        check_time("solve_zero_dimensional")
        rows = [_moved_exactly(space, last[i], j) for i, j in step.products]
        for pivots, block, below in blocks:
            factors = fmpz_mat([[row[k] for k in pivots] for row in rows])
            product = (factors * block).tolist()
            rows = [
                _primitive([below * a - b for a, b in zip(row, less, strict=True)])
                for row, less in zip(rows, product, strict=True)
            ]
        form = rational_echelon(rows, step.pivots, number)
        if form is None:
            return False
        reduced, below, number = form
        last = [list(row) for row in reduced.tolist()]
        leading = [next(i for i, v in enumerate(row) if v) for row in last]
        if leading != step.pivots:
            return False
        blocks.append((step.pivots, reduced, below))
        last = [_primitive(row) for row in last]
    return True


def _moved_exactly(space: _Space, row: list[fmpz], variable: int) -> list[fmpz]:
    if variable < 0:
        return row
    found = [fmpz(0)] * len(row)
    for place, value in zip(space.moved[variable].tolist(), row, strict=True):
        if value:
            found[place] = value
    return found


def _primitive(row: list[fmpz]) -> list[fmpz]:
    common = fmpz(0)
    for value in row:
        common = common.gcd(value)
    return [value // common for value in row] if common > 1 else row


def _row(ring: Ring, polynomial: Polynomial) -> Row:
    integral = primitive(ring, polynomial).to_dict()
    return {as_exponents(e): int(c.p) for e, c in integral.items()}
