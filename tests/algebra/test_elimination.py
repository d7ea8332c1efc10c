from __future__ import annotations

import pytest
import sympy
from hypothesis import assume, given
from hypothesis import strategies as st
from sympy.polys.subresultants_qq_zz import sylvester

from cuspaudit.algebra.elimination import (
    discriminant,
    exact_quotient,
    leading_coefficient,
    primitive_part,
    rational_factors,
    resultant,
    square_free_factors,
)
from cuspaudit.algebra.ring import Polynomial, Ring

NAMES = ("x", "y")
SYMBOLS = sympy.symbols("x y")
monomials = st.tuples(st.integers(0, 2), st.integers(0, 2))
terms = st.dictionaries(
    monomials, st.integers(-4, 4).filter(bool), min_size=1, max_size=4
)


def both(
    ring: Ring, given_terms: dict[tuple[int, int], int]
) -> tuple[Polynomial, object]:
    """The polynomial in the ring and in sympy."""
    x, y = ring.gens
    p = ring.total(c * x**i * y**j for (i, j), c in given_terms.items())
    X, Y = SYMBOLS
    return p, sum(c * X**i * Y**j for (i, j), c in given_terms.items())


def as_sympy(p: Polynomial, radicand: int = 0) -> object:
    """A polynomial of K[x, y] in sympy."""
    values = (*SYMBOLS, sympy.sqrt(radicand))
    total = sympy.Integer(0)
    for exponents, c in p.to_dict().items():
        term = sympy.Rational(int(c.p), int(c.q))
        for value, exponent in zip(values, exponents, strict=False):
            term *= value ** int(exponent)
        total += term
    return sympy.expand(total)


@given(terms, terms)
def test_resultants_are_sympy_s(
    first: dict[tuple[int, int], int], second: dict[tuple[int, int], int]
) -> None:
    """The resultant is the determinant of Sylvester's matrix."""
    ring = Ring(NAMES)
    (p, P), (q, Q) = both(ring, first), both(ring, second)
    assume(p.derivative("x") != 0 and q.derivative("x") != 0)
    wanted = sylvester(P, Q, SYMBOLS[0]).det()
    assert sympy.expand(as_sympy(resultant(ring, p, q, "x")) - wanted) == 0


@given(terms)
def test_discriminants_are_sympy_s_up_to_a_positive_factor(
    given_terms: dict[tuple[int, int], int],
) -> None:
    """The discriminant is right up to a positive constant."""
    ring = Ring(NAMES)
    p, P = both(ring, given_terms)
    assume(p.derivative("x") != 0)
    found = as_sympy(discriminant(ring, p / 3, "x"))
    wanted = sympy.expand(sympy.discriminant(P, SYMBOLS[0]))
    if wanted == 0:
        assert found == 0
    else:
        factor = sympy.simplify(found / wanted)
        assert factor.is_Rational
        assert factor > 0


@pytest.mark.parametrize("radicand", [2, 3])
def test_elimination_over_the_field(radicand: int) -> None:
    """Over Q(sqrt m) resultants and discriminants are those of the real polynomials."""
    ring = Ring(NAMES, radicand)
    x, y = ring.gens
    p, q = x**2 + ring.surd * x * y + 1, x * y - ring.surd
    P, Q = as_sympy(p, radicand), as_sympy(q, radicand)
    wanted = sylvester(P, Q, SYMBOLS[0]).det()
    found = as_sympy(resultant(ring, p, q, "x"), radicand)
    assert sympy.simplify(found - wanted) == 0
    found = as_sympy(discriminant(ring, p, "x"), radicand)
    assert sympy.simplify(found - (radicand * SYMBOLS[1] ** 2 - 4)) == 0


def test_the_leading_coefficient() -> None:
    """The coefficient of the highest power of one variable."""
    ring = Ring(NAMES)
    x, y = ring.gens
    assert leading_coefficient(ring, x**2 * (y - 1) + x**2 + 5, "x") == y


@pytest.mark.parametrize("radicand", [None, 2])
def test_the_primitive_part_loses_what_stays_put(radicand: int | None) -> None:
    """A factor in x alone is removed, times a constant at most."""
    ring = Ring(NAMES, radicand)
    x, y = ring.gens
    root = ring.surd if radicand else ring.constant(3)
    moving, still = y**2 * x + root, (x - root) ** 2 * (x**2 + 1)
    found = primitive_part(ring, ring.reduce(moving * still), "x", ["y"])
    quotient = exact_quotient(ring, found, moving)
    assert quotient.total_degree() <= (1 if radicand else 0)
    assert all(quotient.derivative(name) == 0 for name in NAMES)


@pytest.mark.parametrize("radicand", [None, 3])
def test_exact_quotients(radicand: int | None) -> None:
    """Dividing a product by a factor gives the other factor."""
    ring = Ring(NAMES, radicand)
    x, y = ring.gens
    root = ring.surd if radicand else ring.constant(2)
    p, q = x**2 + root * y, x * root - y + 1
    assert exact_quotient(ring, ring.reduce(p * q), q) == p


def test_square_free_factors_over_q() -> None:
    """Factors come once, constants never."""
    ring = Ring(NAMES)
    x, y = ring.gens
    found = square_free_factors(ring, [x**2 * y, ring.constant(5), 3 * x, (x - y) ** 3])
    assert sorted(map(str, found)) == ["x", "x - y", "y"]


def test_square_free_factors_over_the_field_are_left_alone() -> None:
    """Over Q(sqrt m) only constants and repetitions go."""
    ring = Ring(NAMES, 2)
    x, y = ring.gens
    found = square_free_factors(ring, [x * y, x * y, ring.constant(2), x - ring.surd])
    assert found == [x * y, x - ring.surd]


def test_rational_factors_contain_the_conjugates() -> None:
    """The zeros of x - sqrt 2 lie among those of the factor x^2 - 2."""
    ring = Ring(NAMES, 2)
    x, y = ring.gens
    found = rational_factors(ring, [x - ring.surd, (x + ring.surd) * y, y])
    assert sorted(map(str, found)) == ["x^2 - 2", "y"]
