from __future__ import annotations

from fractions import Fraction

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.algebra.ring import Polynomial, Ring, rational

RADICANDS = (None, 2, 3)
coefficients = st.integers(-5, 5)
exponents = st.tuples(*[st.integers(0, 2)] * 2)


@st.composite
def polynomials(draw: st.DrawFn, ring: Ring) -> Polynomial:
    """A polynomial of K[x, y], reduced."""
    total = ring.constant(0)
    x, y = ring.gens
    for i, j in draw(st.lists(exponents, max_size=4)):
        scalar = ring.constant(draw(coefficients))
        if ring.radicand:
            scalar += draw(coefficients) * ring.surd
        total += scalar * x**i * y**j
    return ring.reduce(total)


def ring_of(radicand: int | None) -> Ring:
    """K[x, y]."""
    return Ring(["x", "y"], radicand)


def test_rational_keeps_the_number() -> None:
    """Fractions, integers and FLINT's rationals become the same number."""
    assert rational(Fraction(-3, 7)) == fmpq(-3, 7)
    assert rational(4) == rational(fmpq(4)) == 4


def test_a_ring_says_its_name() -> None:
    """The field is part of the name."""
    assert repr(Ring(["x", "y"])) == "Q[x, y]"
    assert repr(Ring(["x"], 3)) == "Q(sqrt3)[x]"
    assert repr(Ring([])) == "Q[]"


def test_rings_of_one_shape_mix() -> None:
    """Two rings with the same variables and field share their polynomials."""
    assert Ring(["x", "y"], 2).gen("x") + Ring(["x", "y"], 2).gen("y") != 0


def test_the_surd_is_a_root() -> None:
    """The square of sqrt m is m after reduction, in any power."""
    ring = ring_of(3)
    assert ring.reduce(ring.surd**2) == 3
    assert ring.reduce(ring.surd**5) == 9 * ring.surd
    assert ring.gens == (ring.gen("x"), ring.gen("y"))


@pytest.mark.parametrize("radicand", RADICANDS)
@given(data=st.data())
def test_conjugation_is_an_involution_and_multiplies(
    radicand: int | None, data: st.DataObject
) -> None:
    """Conjugating twice is nothing; the conjugate of a product is the product."""
    ring = ring_of(radicand)
    p, q = data.draw(polynomials(ring)), data.draw(polynomials(ring))
    assert ring.conjugate(ring.conjugate(p)) == p
    product = ring.conjugate(ring.reduce(p * q))
    assert product == ring.reduce(ring.conjugate(p) * ring.conjugate(q))


@pytest.mark.parametrize("radicand", RADICANDS)
@given(data=st.data())
def test_the_norm_is_rational_and_multiplies(
    radicand: int | None, data: st.DataObject
) -> None:
    """The norm has no sqrt m, and the norm of a product is the product of norms."""
    ring = ring_of(radicand)
    p, q = data.draw(polynomials(ring)), data.draw(polynomials(ring))
    assert ring.parts(ring.norm(p))[1] == 0
    assert ring.norm(ring.reduce(p * q)) == ring.norm(p) * ring.norm(q)


@pytest.mark.parametrize("radicand", RADICANDS)
@given(data=st.data())
def test_parts_make_the_whole(radicand: int | None, data: st.DataObject) -> None:
    """A polynomial is A + sqrt(m) B with A and B over Q."""
    ring = ring_of(radicand)
    p = data.draw(polynomials(ring))
    plain, surd = ring.parts(p)
    assert plain + (ring.surd * surd if radicand else surd) == p


@pytest.mark.parametrize("radicand", RADICANDS)
@given(data=st.data())
def test_coefficients_make_the_polynomial(
    radicand: int | None, data: st.DataObject
) -> None:
    """The coefficients in some variables put together again are the polynomial."""
    ring = ring_of(radicand)
    p, x = data.draw(polynomials(ring)), ring.gen("x")
    parts = ring.coefficients(p, ["x"])
    assert ring.total(c * x**i for (i,), c in parts.items()) == p
    assert all(c.derivative("x") == 0 for c in parts.values())


@pytest.mark.parametrize("radicand", RADICANDS)
@given(data=st.data(), x=coefficients, y=coefficients)
def test_evaluation_encloses_the_substituted_value(
    radicand: int | None, data: st.DataObject, x: int, y: int
) -> None:
    """Evaluating at balls contains the exact value at their rational centers."""
    ring = ring_of(radicand)
    p = data.draw(polynomials(ring))
    exact = ring.substitute(p, {"x": x, "y": fmpq(y, 3)})
    plain, surd = (ring.evaluate(part, {}) for part in ring.parts(exact))
    value = plain + surd * arb(radicand or 0).sqrt()
    wide = {"x": arb(x, 1e-3), "y": arb(fmpq(y, 3)) + arb(0, 1e-3)}
    assert ring.evaluate(p, wide).overlaps(value)
    assert ring.evaluate(p, wide).is_finite()


def test_a_power_of_a_ball_that_meets_zero_is_finite() -> None:
    """python-flint's own power is nan there; ours is a product."""
    ring = ring_of(None)
    value = ring.evaluate(ring.gen("x") ** 3, {"x": arb(0, 1e-5)})
    assert value.contains(0)
    assert value.rad() < 1e-14


def test_evaluation_follows_the_precision() -> None:
    """With more bits the enclosure narrows."""
    ring, saved = ring_of(2), ctx.prec
    radii = []
    for ctx.prec in (53, 500):
        radii.append(ring.evaluate(ring.surd * ring.gen("x"), {"x": arb(1)}).rad())
    ctx.prec = saved
    assert radii[1] < radii[0] * 1e-100


def test_moving_to_a_ring_with_other_variables() -> None:
    """Variables are matched by name; one that is missing is a bug of the caller."""
    small, large = Ring(["x"], 2), Ring(["z", "x"], 2)
    p = small.gen("x") ** 2 * small.surd - 3
    moved = large.from_other(p, small)
    assert moved == large.gen("x") ** 2 * large.surd - 3
    assert small.from_other(moved, large) == p
    with pytest.raises(AssertionError):
        small.from_other(large.gen("z"), large)
