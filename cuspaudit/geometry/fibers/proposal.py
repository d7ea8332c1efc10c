"""Proposals for the generic fiber of a map, by elimination; nothing here is proved.

For a linear form lambda, omega comes from the equation of t = lambda(x) over Q(y). With
a dual number e (e^2 = 0), the element lambda(x) + e x_i of a fiber satisfies equations
a(t) + e b(t) = 0, where a = m omega; comparing coefficients, m omega' x_i = -b.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from flint import fmpq

from cuspaudit.algebra.matrix import determinant
from cuspaudit.algebra.points.elimination_basis import propose_elimination
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import UnableError
from cuspaudit.runtime.clock import time_left

__all__ = ["FiberProposer", "Form"]

#: the integer coefficients of a linear form
Form = tuple[int, ...]

_LARGEST_DEGREE = 12


@dataclass(frozen=True)
class FiberProposer:
    """Eliminations for the fibers of R on V, within the time limit in force.

    Attributes:
        variety: V.
        mapping: R.
        ring: Q[t, y_1..y_d]; none of its names is a variable of V.
        seed: of msolve's random choices.
    """

    variety: PolynomialSystem
    mapping: PolynomialMap
    ring: Ring
    seed: int

    def forms(self) -> Iterator[Form]:
        """Forms with as many values on one fiber as a form of no special kind.

        Coordinates first, those with the smallest equation before the others.
        """
        size = len(self.variety.ring.variables)
        generic = tuple(3 + (7 * j * j + 5 * j) % 11 for j in range(size))
        most = self._values_of(generic)
        units = (tuple(int(i == j) for j in range(size)) for i in range(size))
        good = [form for form in units if self._values_of(form) == most]
        yield from sorted(good, key=lambda form: len(self._omega(form)))
        for form in itertools.chain(_pairs(size), [generic]):
            if self._values_of(form) == most:
                yield form

    def parametrized(
        self, form: Form
    ) -> tuple[Polynomial, tuple[Polynomial, ...]] | None:
        """(omega, rho), or None when it cannot be read from the elimination.

        Raises:
            UnableError: the time is over, or msolve fails.
        """
        pairs = []
        omega = self._omega(form)
        for i in range(len(form)):
            found = self._eliminated(self._line(form), i)
            a, b = min(found, key=lambda pair: self._size(pair[0]))
            pair = self._cleared(omega, a, b)
            if pair is None:
                return None
            pairs.append(pair)
        for other, _ in pairs:
            omega = omega * other / omega.gcd(other)
        if self._degree(omega.gcd(omega.derivative(self.ring.variables[0]))):
            return None
        return omega, tuple(-b * (omega / a) for a, b in pairs)

    def _cleared(
        self, omega: Polynomial, a: Polynomial, b: Polynomial
    ) -> tuple[Polynomial, Polynomial] | None:
        """(h omega, b') with h in Q[y] from a = m omega.

        Where m depends on t it is inverted modulo omega: with M the matrix of the
        multiplication by m, z the first column of its adjugate, m z = det M. Where that
        is 0, m and omega have a common zero.
        """
        if self._degree(a) == self._degree(omega):
            return a, b
        m, rest = divmod(a, omega)
        size = self._degree(omega)
        if rest != 0 or size > _LARGEST_DEGREE or not self._is_monic(omega):
            return None
        t = self.ring.gens[0]
        columns = [self._row(divmod(m * t**k, omega)[1], size) for k in range(size)]
        z = self.ring.constant(0)
        for k in range(size):
            minor = [c[1:] for i, c in enumerate(columns) if i != k]
            z += (-1) ** k * determinant(self.ring, minor) * t**k
        h = determinant(self.ring, columns)
        if h == 0:
            return None
        numerator = divmod(b * z, omega)[1]
        common = h.gcd(numerator)
        return omega * (h / common), numerator / common

    def _row(self, polynomial: Polynomial, size: int) -> list[Polynomial]:
        parts = self.ring.coefficients(polynomial, self.ring.variables[:1])
        return [parts.get((k,), self.ring.constant(0)) for k in range(size)]

    def _is_monic(self, omega: Polynomial) -> bool:
        return bool(self._row(omega, self._degree(omega) + 1)[-1].is_constant())

    def equation(self, function: Polynomial) -> Polynomial:
        """An equation of the least degree for t = h(x), h the ``function``."""
        found = (a for a, _ in self._eliminated(function, None))
        return min(found, key=self._size)

    def _omega(self, form: Form) -> Polynomial:
        return self.equation(self._line(form))

    def _line(self, form: Form) -> Polynomial:
        """The linear form lambda."""
        ring = self.variety.ring
        return ring.total(c * g for c, g in zip(form, ring.gens, strict=True))

    def _values_of(self, form: Form) -> int:
        """How many values lambda has on the fiber over one rational value."""
        value = [fmpq(7**j + 1, 2 * j + 1) for j in range(1, len(self.ring.variables))]
        found = self._eliminated(self._line(form), None, value)
        return max((self._degree(a) for a, _ in found), default=0)

    def _degree(self, omega: Polynomial) -> int:
        return int(omega.degrees()[0])

    def _size(self, omega: Polynomial) -> tuple[int, int]:
        return self._degree(omega), int(omega.total_degree())

    def _eliminated(
        self, function: Polynomial, dual: int | None, value: Sequence[fmpq] = ()
    ) -> list[tuple[Polynomial, Polynomial]]:
        """All (a, b) with a + e b in a basis without x, for t = h(x) + e x_i."""
        source = self.variety.ring
        dual_name = max((*source.variables, *self.ring.variables), key=len) + "e"
        big = Ring([*source.variables, *self.ring.variables, dual_name])
        x = [big.gen(name) for name in source.variables]
        t, *y = (big.gen(name) for name in self.ring.variables)
        e = big.gen(dual_name)
        values = zip(y, self.mapping.components, strict=True)
        system = [
            *(big.from_other(p, source) for p in self.variety.equations),
            *(y - big.from_other(r, source) for y, r in values),
            t - big.from_other(function, source) - (0 if dual is None else e * x[dual]),
            e if dual is None else e * e,
            *(a - b for a, b in zip(y, value, strict=False)),
        ]
        left = time_left("atypical_values")
        basis = propose_elimination(big, system, len(x), left, self.seed)
        found = []
        for p in basis:
            parts = big.coefficients(p, [dual_name])
            a, b = (parts.get((k,), big.constant(0)) for k in (0, 1))
            found.append((self.ring.from_other(a, big), self.ring.from_other(b, big)))
        found = [(a, b) for a, b in found if a != 0]
        if not value and any(self._degree(a) == 0 for a, _ in found):
            raise UnableError("atypical_values", "the values seem to fill no open set")
        return found


def _pairs(size: int) -> Iterator[Form]:
    """Sums of two coordinates with small weights."""
    for i, j in itertools.combinations(range(size), 2):
        for a, b in ((1, 2), (2, -1)):
            yield tuple(a * (k == i) + b * (k == j) for k in range(size))
