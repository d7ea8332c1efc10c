from __future__ import annotations

from math import prod
from typing import Any

import pytest
import sympy
from flint import arb, ctx, fmpq, fmpq_poly, fmpz_poly
from hypothesis import assume, given
from hypothesis import strategies as st

from cuspaudit.algebra import univariate
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.univariate import (
    RealRoot,
    Univariate,
    disjoint_balls,
    real_root_balls,
    real_roots,
)
from cuspaudit.errors import PrecisionError

small = st.lists(st.integers(-6, 6), min_size=1, max_size=6)
X = sympy.Symbol("x")


def over_q(*coefficients: int | fmpq) -> Univariate:
    """The polynomial over Q with these coefficients, constant first."""
    return Univariate(fmpq_poly(list(coefficients)), fmpq_poly([0]), None)


def over_k(plain: list[int], surd: list[int], radicand: int) -> Univariate:
    """The polynomial plain + sqrt(radicand) surd."""
    return Univariate(fmpq_poly(plain), fmpq_poly(surd), radicand)


def root_of(*coefficients: int, index: int = 0) -> RealRoot:
    """The index-th real root of an irreducible polynomial, constant first."""
    return RealRoot(fmpz_poly(list(coefficients)), index)


def as_sympy(polynomial: Univariate) -> Any:
    """The same polynomial in sympy."""
    root = sympy.sqrt(polynomial.radicand or 0)
    total = sympy.Integer(0)
    for part, factor in ((polynomial.rational, 1), (polynomial.surd, root)):
        for power, c in enumerate(part.coeffs()):
            total += factor * sympy.Rational(int(c.p), int(c.q)) * X**power
    return sympy.expand(total)


@given(small)
def test_real_roots_are_as_many_as_sturm_counts(coefficients: list[int]) -> None:
    """Isolation finds as many distinct real roots as Sturm's theorem counts."""
    polynomial = over_q(*coefficients)
    assume(polynomial.degree > 0)
    found = real_roots(polynomial)
    assert len(found) == sympy.Poly(as_sympy(polynomial), X).count_roots()
    values = [float(root) for root in found]
    assert values == sorted(values)
    assert all(polynomial.sign_at(root) == 0 for root in found)


@given(st.lists(small, min_size=1, max_size=3))
def test_real_roots_of_several_are_those_of_their_product(
    lists: list[list[int]],
) -> None:
    """Common roots come once, and the order is that of the line."""
    polynomials = [over_q(*coefficients) for coefficients in lists]
    assume(all(not p.is_zero for p in polynomials))
    product = prod((p.rational for p in polynomials), start=fmpq_poly([1]))
    assert real_roots(*polynomials) == real_roots(over_q(*product.coeffs()))


@given(small, small, st.sampled_from((2, 3)))
def test_real_roots_over_a_quadratic_field(
    plain: list[int], surd: list[int], radicand: int
) -> None:
    """Over Q(sqrt m) as many roots as the signs at points between them tell."""
    polynomial = over_k(plain, surd, radicand)
    assume(not polynomial.is_zero)
    found = real_roots(polynomial)
    numeric = sympy.Poly(as_sympy(polynomial), X).nroots(n=40, maxsteps=400)
    real = [z for z in numeric if abs(sympy.im(z)) < sympy.Float("1e-12")]
    distinct: list[Any] = []
    for z in real:
        if all(abs(z - other) > sympy.Float("1e-9") for other in distinct):
            distinct.append(z)
    assert len(found) == len(distinct)


@given(small, st.integers(-6, 6), st.integers(1, 5))
def test_sign_at_a_rational_point(coefficients: list[int], p: int, q: int) -> None:
    """The sign at a rational is that of the exact value."""
    polynomial, point = over_q(*coefficients), fmpq(p, q)
    value = polynomial.rational(point)
    assert polynomial.sign(point) == (value > 0) - (value < 0)


@given(small, small, st.sampled_from((2, 3)), st.sampled_from((2, 3, 5)))
def test_sign_at_an_algebraic_number(
    plain: list[int], surd: list[int], radicand: int, square: int
) -> None:
    """The sign at sqrt(square) is that of the value to 60 digits, zero included."""
    polynomial = over_k(plain, surd, radicand)
    for index, sign in ((0, -1), (1, 1)):
        root = root_of(-square, 0, 1, index=index)
        value = sympy.N(as_sympy(polynomial).subs(X, sign * sympy.sqrt(square)), 60)
        exact = sympy.simplify(as_sympy(polynomial).subs(X, sign * sympy.sqrt(square)))
        wanted = 0 if exact == 0 else (1 if value > 0 else -1)
        assert polynomial.sign_at(root) == wanted


def test_exact_zeros_over_the_field() -> None:
    """The polynomial x - sqrt 2 vanishes at sqrt 2, not at -sqrt 2; x^2 - 2 at both."""
    low, high = (root_of(-2, 0, 1, index=i) for i in (0, 1))
    linear = over_k([0, 1], [-1], 2)
    assert linear.sign_at(high) == 0
    assert linear.sign_at(low) == -1
    assert over_k([-2, 0, 1], [0], 2).sign_at(low) == 0
    assert real_roots(linear) == [high]
    # 2 x - sqrt(2) x^2 = x (2 - sqrt 2 x): zero at sqrt 2
    assert over_k([0, 2], [0, 0, -1], 2).sign_at(high) == 0
    assert over_k([-2, 0, 1], [1], 2).sign_at(high) == 1
    assert over_k([1], [-2, 0, 1], 2).sign_at(high) == 1


def test_multiplicities() -> None:
    """Multiplicities over Q and Q(sqrt 2), where x^2 - 2 splits."""
    high = root_of(-2, 0, 1, index=1)
    low = root_of(-2, 0, 1, index=0)
    square = over_q(-2, 0, 1)
    assert square.multiplicity(high) == 1
    cubed = over_q(*(fmpq_poly([-2, 0, 1]) ** 3 * fmpq_poly([1, 1])).coeffs())
    assert cubed.multiplicity(high) == 3
    assert cubed.multiplicity(root_of(1, 1)) == 1
    assert cubed.multiplicity(root_of(-1, 1)) == 0
    # (x - sqrt 2)^2 (x + sqrt 2) = (x^2 - 2)(x - sqrt 2)
    mixed = over_k([0, -2, 0, 1], [2, 0, -1], 2)
    assert mixed.multiplicity(high) == 2
    assert mixed.multiplicity(low) == 1


def test_a_polynomial_is_read_from_a_ring() -> None:
    """The parts over Q and the surd, the degree, the norm, and the zero polynomial."""
    ring = Ring(["t", "u"], 3)
    t, surd = ring.gen("t"), ring.surd
    polynomial = Univariate.from_polynomial(ring, t**2 + surd * t * 2 + 1, "t")
    assert polynomial.degree == 2
    assert polynomial.rational == fmpq_poly([1, 0, 1])
    assert polynomial.surd == fmpq_poly([0, 2])
    assert polynomial.norm == fmpq_poly([1, 0, 1]) ** 2 - 12 * fmpq_poly([0, 0, 1])
    zero = Univariate.from_polynomial(ring, ring.constant(0), "t")
    assert zero.is_zero
    assert zero.degree == -1
    assert polynomial(fmpq(1)).overlaps(2 + 2 * arb(3).sqrt())


def test_close_roots_are_told_apart() -> None:
    """Roots 1e-30 apart are two roots in order, exactly."""
    gap = 10**30
    first, second = root_of(-gap, gap), root_of(-gap - 1, gap)
    balls = disjoint_balls([second, first])
    assert balls[1] < balls[0]
    product = over_q(*(fmpq_poly([-gap, gap]) * fmpq_poly([-gap - 1, gap])).coeffs())
    assert len(real_roots(product)) == 2
    assert over_q(-gap, gap).sign_at(root_of(-gap - 1, gap)) == 1


def test_equal_numbers_are_equal_roots() -> None:
    """A root is its irreducible polynomial and its place; equal ones hash alike."""
    roots = real_roots(over_q(-2, 0, 1)) + real_roots(over_q(4, 0, -4, 0, 1))
    assert len(roots) == 4
    assert len(set(roots)) == 2


def test_balls_of_a_product() -> None:
    """Roots of several polynomials come in one increasing list of disjoint balls."""
    balls = real_root_balls([over_q(-2, 0, 1), over_q(0, 1), over_q(3)])
    assert [round(float(ball.mid()), 6) for ball in balls] == [-1.414214, 0, 1.414214]
    conjugates = real_root_balls([over_k([0, 1], [-1], 2), over_k([0, 1], [-1], 2)])
    assert len(conjugates) == 2


def test_what_cannot_be_separated_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """A common zero, or too few bits, is a PrecisionError that names the question."""
    monkeypatch.setattr(univariate, "PRECISIONS", (64,))
    with pytest.raises(PrecisionError, match="product"):
        real_root_balls([over_q(-1, 1), over_q(-1, 0, 1)])
    near = root_of(-(10**40), 10**40 + 1)
    with pytest.raises(PrecisionError, match="order"):
        disjoint_balls([near, root_of(-1, 1)])
    with pytest.raises(PrecisionError, match="algebraic"):
        over_q(-1, 1).sign_at(near)


def test_precision_is_put_back() -> None:
    """No question leaves the working precision changed."""
    before = ctx.prec
    root = root_of(-2, 0, 1, index=1)
    root.enclosure(300)
    over_q(-1, 1).sign_at(root)
    real_root_balls([over_q(-2, 0, 1)])
    assert ctx.prec == before
    assert abs(float(root) - 2**0.5) < 1e-15


def test_values_that_a_factor_divides_by_chance_prove_nothing() -> None:
    """X + 1 divides no x^2 + 11, whose value at 2 it does divide; twice (x + 1)^2 x."""
    (root,) = real_roots(Univariate(fmpq_poly([1, 1]), fmpq_poly([0])))
    for coefficients, expected in (([11, 0, 1], 0), ([0, 1, 2, 1], 2), ([2, 2], 1)):
        polynomial = Univariate(fmpq_poly(coefficients), fmpq_poly([0]))
        assert polynomial.multiplicity(root) == expected
