"""Factors of a polynomial on a product of circles.

In Q[c, s] / (c^2 + s^2 - 1) factorisation is not unique: s^2 = (1 - c)(1 + c). With
C = cos(theta/2) and S = sin(theta/2), so c = C^2 - S^2, s = 2 S C, 1 = C^2 + S^2, a
polynomial in c, s of degree d becomes a form of degree 2 d in (S, C), and forms do
factor uniquely. A factor of even degree in every pair (S_i, C_i) is a function on the
circles again. A factor of odd degree changes sign with theta -> theta + 2 pi; such
factors only count together. Forms are kept with t = S/C, and their degrees beside
them: the form C is the polynomial 1 of degree 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import gcd, lcm

from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import CrossCheckError

__all__ = ["factor_on_circles", "half_angles", "primitive", "reduce_on_circles"]

Circle = tuple[str, str]


@dataclass
class _Form:
    """A polynomial in t_1..t_k (named by the sines) that stands for a form.

    Attributes:
        polynomial: in the ring of the input, t_i written as s_i, no c_i.
        degrees: degree of the form in each (S_i, C_i).
        count: multiplicity that is still to be used.
    """

    polynomial: Polynomial
    degrees: tuple[int, ...]
    count: int = 1

    @property
    def odd(self) -> tuple[int, ...]:
        """The circles in which the form changes sign with one turn."""
        return tuple(i for i, degree in enumerate(self.degrees) if degree % 2)

    def times(self, other: _Form, count: int = 1) -> _Form:
        """The product of the two forms."""
        degrees = zip(self.degrees, other.degrees, strict=True)
        product = self.polynomial * other.polynomial
        return _Form(product, tuple(a + b for a, b in degrees), count)


def factor_on_circles(
    ring: Ring, circles: Sequence[Circle], polynomial: Polynomial
) -> list[tuple[Polynomial, int]]:
    """Factors of ``polynomial`` as a function on the circles, with multiplicities.

    Args:
        ring: K[x_1..x_n].
        circles: (c_i, s_i), pairs of variables of ``ring``.
        polynomial: any polynomial of ``ring``.

    Returns:
        Factors that are not constant, primitive over Z, degree at most 1 in each c_i,
        first coefficient positive; simplest first. Over K = Q each comes from an
        irreducible form, or from several of odd degree left together (opposite ones,
        F(theta) and F(theta + pi), are joined first, then equal ones). Over
        Q(sqrt m) only factors seen while sqrt m is an indeterminate are found. The
        zero polynomial is returned as it is.

    Raises:
        CrossCheckError: the product is not ``polynomial`` on the circles.

    >>> ring = Ring(["c", "s"])
    >>> c, s = ring.gens
    >>> factor_on_circles(ring, [("c", "s")], 3 * s * c**2 - 3 * s)
    [(s, 3)]
    """
    given = reduce_on_circles(ring, circles, polynomial)
    if given == 0:
        return [(given, 1)]
    result: dict[str, tuple[Polynomial, int]] = {}
    for form in _joined(ring, circles, _forms(ring, circles, given)):
        factor = primitive(ring, _on_circles(ring, circles, form))
        if any(factor.degrees()[: len(ring.variables)]):
            before = result.get(str(factor), (factor, 0))[1]
            result[str(factor)] = (factor, before + form.count)
    factors = sorted(result.values(), key=_simplicity)
    _check_product(ring, circles, factors, given)
    return factors


def reduce_on_circles(
    ring: Ring, circles: Sequence[Circle], polynomial: Polynomial
) -> Polynomial:
    """The same function on the circles, of degree at most 1 in each c_i."""
    for c, s in circles:
        circle = ring.gen(c) ** 2 + ring.gen(s) ** 2 - 1
        polynomial = divmod(polynomial, circle)[1]
    return ring.reduce(polynomial)


def primitive(ring: Ring, polynomial: Polynomial) -> Polynomial:
    """The rational multiple with coprime integers, the first of them positive."""
    values = list(polynomial.to_dict().values())
    if not values:
        return polynomial
    below = lcm(*(int(value.q) for value in values))
    above = gcd(*(int(value.p) * (below // int(value.q)) for value in values))
    sign = 1 if polynomial.leading_coefficient() > 0 else -1
    return polynomial * fmpq(sign * below, above)


def _forms(
    ring: Ring, circles: Sequence[Circle], polynomial: Polynomial
) -> list[_Form]:
    """The irreducible forms of ``polynomial``, without constants and C^2 + S^2."""
    numerator, degrees = half_angles(ring, circles, polynomial)
    forms = []
    for factor, count in numerator.factor()[1]:
        own = tuple(_degree(factor, s) for _, s in circles)
        forms.append(_Form(factor, own, int(count)))
    for i, (_, s) in enumerate(circles):
        infinite = degrees[i] - _degree(numerator, s)
        if infinite:
            forms.append(_Form(ring.constant(1), _unit(i, len(circles)), infinite))
    ones = [primitive(ring, 1 + ring.gen(s) ** 2) for _, s in circles]
    return [f for f in forms if primitive(ring, f.polynomial) not in ones]


def half_angles(
    ring: Ring, circles: Sequence[Circle], polynomial: Polynomial
) -> tuple[Polynomial, tuple[int, ...]]:
    """The numerator in t_i, written as s_i, and the degrees of its form."""
    degrees = []
    for c, s in circles:
        t = ring.gen(s)
        parts = ring.coefficients(polynomial, [c, s])
        most = max(a + b for a, b in parts)
        polynomial = ring.total(
            rest * (1 - t**2) ** a * (2 * t) ** b * (1 + t**2) ** (most - a - b)
            for (a, b), rest in parts.items()
        )
        degrees.append(2 * most)
    return polynomial, tuple(degrees)


def _joined(
    ring: Ring, circles: Sequence[Circle], forms: list[_Form]
) -> Iterable[_Form]:
    """The same product in forms of even degrees: opposite pairs, equal pairs, rest."""
    yield from (form for form in forms if not form.odd)
    odd = [form for form in forms if form.odd]
    for k, form in enumerate(odd):
        opposite = primitive(ring, _opposite(ring, circles, form))
        for other in odd[k + 1 :]:
            count = min(form.count, other.count)
            equal = form.degrees == other.degrees
            if count and equal and primitive(ring, other.polynomial) == opposite:
                form.count, other.count = form.count - count, other.count - count
                yield form.times(other, count)
    rest = None
    for form in odd:
        if form.count > 1:
            yield form.times(form, form.count // 2)
        if form.count % 2:
            rest = form.times(rest) if rest else form.times(_one(ring, circles))
    if rest:
        yield rest


def _opposite(ring: Ring, circles: Sequence[Circle], form: _Form) -> Polynomial:
    """The form at theta_i + pi in its odd circles: (S, C) becomes (C, -S)."""
    polynomial = form.polynomial
    for i in form.odd:
        t, degree = ring.gen(circles[i][1]), form.degrees[i]
        parts = ring.coefficients(polynomial, [circles[i][1]])
        polynomial = ring.total(
            rest * (-1) ** (degree - k) * t ** (degree - k)
            for (k,), rest in parts.items()
        )
    return polynomial


def _on_circles(ring: Ring, circles: Sequence[Circle], form: _Form) -> Polynomial:
    """A form of even degrees in c_i, s_i: S^2 = (1 - c)/2, C^2 = (1 + c)/2."""
    polynomial = form.polynomial
    for (c_name, s_name), degree in zip(circles, form.degrees, strict=True):
        c, s = ring.gen(c_name), ring.gen(s_name)
        parts = ring.coefficients(polynomial, [s_name])
        polynomial = ring.total(
            rest * (1 - c) ** (k // 2) * (1 + c) ** ((degree - k) // 2) * s ** (k % 2)
            for (k,), rest in parts.items()
        )
    return reduce_on_circles(ring, circles, polynomial)


def _check_product(
    ring: Ring,
    circles: Sequence[Circle],
    factors: Sequence[tuple[Polynomial, int]],
    given: Polynomial,
) -> None:
    """Check that the product is ``given`` times a constant of K."""
    product = ring.constant(1)
    for factor, count in factors:
        for _ in range(count):
            product = reduce_on_circles(ring, circles, product * factor)
    first, second = (_leading(ring, p) for p in (given, product))
    if ring.reduce(product * first - given * second) != 0:
        raise CrossCheckError(f"the factors found do not multiply to {given}")


def _leading(ring: Ring, polynomial: Polynomial) -> Polynomial:
    """The coefficient in K of the first monomial in the variables of the ring."""
    parts = ring.coefficients(polynomial, ring.variables)
    return parts[max(parts)]


def _simplicity(pair: tuple[Polynomial, int]) -> tuple[int, str]:
    return len(pair[0]), str(pair[0])


def _one(ring: Ring, circles: Sequence[Circle]) -> _Form:
    return _Form(ring.constant(1), (0,) * len(circles))


def _unit(i: int, size: int) -> tuple[int, ...]:
    return tuple(int(i == j) for j in range(size))


def _degree(polynomial: Polynomial, name: str) -> int:
    index = polynomial.context().variable_to_index(name)
    return int(polynomial.degrees()[index])
