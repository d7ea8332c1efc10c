"""Values and derivatives of polynomials at one point, in balls or in doubles.

The monomials of all polynomials are computed once, each from a smaller one by one
multiplication; the same plan serves FLINT's balls and Python's floats.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from flint import arb, ctx
from numpy.typing import NDArray

from cuspaudit.algebra.matrix import jacobian
from cuspaudit.algebra.ring import Polynomial, Ring

__all__ = ["Differentiable", "Evaluator", "Jets", "Table"]

#: doubles, or balls as objects: the same formulas serve both
Table = NDArray[Any]

_Exponents = tuple[int, ...]
_MANY = 400
"""Terms from which on arrays are quicker than a loop."""


class Evaluator:
    """A list of polynomials of K[x_1..x_n], to be evaluated together.

    Powers are products: python-flint's power of a ball that meets 0 is nan.
    """

    def __init__(self, ring: Ring, polynomials: Sequence[Polynomial]) -> None:
        self.radicand = ring.radicand
        self._index: dict[_Exponents, int] = {(0,) * len(ring.context.names()): 0}
        self._steps: list[tuple[int, int]] = []
        terms = [ring.reduce(p).to_dict() for p in polynomials]
        self._terms = [
            [(c, self._place(tuple(map(int, e)))) for e, c in t.items()] for t in terms
        ]
        self._floats = [
            [(int(c.p) / int(c.q), k) for c, k in row] for row in self._terms
        ]
        self._count = sum(map(len, self._terms))
        self._balls: dict[int, list[list[tuple[arb, int]]]] = {}

    def balls(self, point: Sequence[arb]) -> list[arb]:
        """Enclosures of the values at a box, at the current precision."""
        values = [*point, *self._surd_ball()]
        monomials = [arb(1)]
        for parent, variable in self._steps:
            monomials.append(monomials[parent] * values[variable])
        zero = arb(0)
        return [
            sum([c * monomials[k] for c, k in row], zero) for row in self._ball_terms()
        ]

    def floats(self, point: Iterable[float]) -> list[float]:
        """The values at a point, in doubles."""
        surd = [math.sqrt(self.radicand)] if self.radicand else []
        values = [*map(float, point), *surd]
        if self._count > _MANY:
            return self._layers.values(values)
        monomials = [1.0]
        for parent, variable in self._steps:
            monomials.append(monomials[parent] * values[variable])
        return [sum([c * monomials[k] for c, k in row]) for row in self._floats]

    @cached_property
    def _layers(self) -> _Layers:
        return _Layers(self._steps, self._floats)

    def _place(self, exponents: _Exponents) -> int:
        """The number of a monomial, entered after the one it is computed from."""
        if exponents in self._index:
            return self._index[exponents]
        last = max(i for i, exponent in enumerate(exponents) if exponent)
        smaller = tuple(e - (i == last) for i, e in enumerate(exponents))
        self._steps.append((self._place(smaller), last))
        self._index[exponents] = len(self._steps)
        return len(self._steps)

    def _surd_ball(self) -> list[arb]:
        return [arb(self.radicand).sqrt()] if self.radicand else []

    def _ball_terms(self) -> list[list[tuple[arb, int]]]:
        if ctx.prec not in self._balls:
            self._balls[ctx.prec] = [
                [(arb(c), k) for c, k in row] for row in self._terms
            ]
        return self._balls[ctx.prec]


class _Layers:
    """The plan in arrays: all monomials of one degree at once.

    Attributes:
        order: for each degree the monomials, those they are computed from, and the
            variable of each.
        coefficients: of all terms, one polynomial after the other.
        places: of their monomials.
        starts: where the terms of each polynomial begin; of those that have any.
        filled: the numbers of the latter.
    """

    def __init__(
        self, steps: list[tuple[int, int]], rows: list[list[tuple[float, int]]]
    ) -> None:
        degree = [0]
        for parent, _ in steps:
            degree.append(degree[parent] + 1)
        own = np.array(degree)
        parents, variables = (np.array([0, *part]) for part in zip(*steps, strict=True))
        self.order = [
            (chosen, parents[chosen], variables[chosen])
            for chosen in (np.flatnonzero(own == d) for d in range(1, own.max() + 1))
        ]
        terms = [term for row in rows for term in row]
        self.coefficients = np.array([c for c, _ in terms])
        self.places = np.array([k for _, k in terms])
        sizes = np.array([len(row) for row in rows])
        self.filled = np.flatnonzero(sizes)
        self.starts = (np.cumsum(sizes) - sizes)[self.filled]
        self.size = len(rows)
        self.monomials = len(degree)

    def values(self, point: Sequence[float]) -> list[float]:
        at = np.array(point)
        monomials = np.ones(self.monomials)
        for chosen, parents, variables in self.order:
            monomials[chosen] = monomials[parents] * at[variables]
        found = np.zeros(self.size)
        products = self.coefficients * monomials[self.places]
        found[self.filled] = np.add.reduceat(products, self.starts)
        values: list[float] = found.tolist()
        return values


class Differentiable:
    """Polynomials p_1..p_k with their first derivatives."""

    def __init__(self, ring: Ring, polynomials: Sequence[Polynomial]) -> None:
        self.size = len(polynomials)
        self._width = len(ring.variables)
        self._values = Evaluator(ring, polynomials)
        entries = [e for row in jacobian(ring, polynomials) for e in row]
        self._entries = Evaluator(ring, entries)

    def values(self, box: Sequence[arb]) -> list[arb]:
        """Enclosures of p_1..p_k over ``box``."""
        return self._values.balls(box)

    def jacobian(self, box: Sequence[arb]) -> list[list[arb]]:
        """Enclosures of d p_i / d x_j over ``box``, rows in order."""
        entries, width = self._entries.balls(box), self._width
        return [entries[i * width : (i + 1) * width] for i in range(self.size)]

    def floats(self, point: Iterable[float]) -> tuple[Table, Table]:
        """Values (k,) and derivatives (k, n) at a point, in doubles."""
        at = list(point)
        entries = np.array(self._entries.floats(at))
        shape = (self.size, self._width)
        return np.array(self._values.floats(at)), entries.reshape(shape)


class Jets:
    """Polynomials p_1..p_k with their first and second derivatives."""

    def __init__(self, ring: Ring, polynomials: Sequence[Polynomial]) -> None:
        self.size, self.width = len(polynomials), len(ring.variables)
        self._values = Evaluator(ring, polynomials)
        first = [e for row in jacobian(ring, polynomials) for e in row]
        second = [e for row in jacobian(ring, first) for e in row]
        self._all = Evaluator(ring, [*polynomials, *first, *second])

    def values(self, box: Sequence[arb]) -> list[arb]:
        """Enclosures of p_1..p_k over ``box``."""
        return self._values.balls(box)

    def balls(self, box: Sequence[arb]) -> tuple[Table, Table, Table]:
        """Enclosures of values (k), gradients (k, n) and Hessians (k, n, n)."""
        return self._split(np.array(self._all.balls(box), dtype=object))

    def floats(self, point: Iterable[float]) -> tuple[Table, Table, Table]:
        """The same at a point, in doubles."""
        return self._split(np.array(self._all.floats(point), dtype=np.float64))

    def _split(self, entries: Table) -> tuple[Table, Table, Table]:
        k, n = self.size, self.width
        return (
            entries[:k],
            entries[k : k + k * n].reshape(k, n),
            entries[k + k * n :].reshape(k, n, n),
        )
