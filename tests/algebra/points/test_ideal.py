from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.algebra.points import ideal
from cuspaudit.algebra.points.ideal import (
    degree_reverse_context,
    dimension_bound,
    groebner_basis,
    normal_form,
)
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import TimeLimitError, UnableError
from cuspaudit.runtime.clock import time_limit

RING = Ring(["x", "y", "z"])
X, Y, Z = RING.gens
TWISTED = [Y - X**2, Z - X**3]

monomials = st.tuples(*(st.integers(0, 2),) * 3)
polynomials = st.dictionaries(monomials, st.integers(-3, 3), max_size=4).map(
    RING.context.from_dict
)


@given(polynomials, polynomials, polynomials)
def test_multiples_belong_and_reduce_to_zero(
    a: Polynomial, b: Polynomial, c: Polynomial
) -> None:
    """Multiples a f + b g are in <f, g>; c and its normal form differ by a member."""
    basis = groebner_basis(RING, TWISTED)
    assert basis.contains(a * TWISTED[0] + b * TWISTED[1])
    rest = basis.normal_form(c)
    assert basis.contains(c - rest)
    assert basis.normal_form(rest) == rest


@given(polynomials)
def test_membership_on_the_twisted_cubic_is_vanishing(p: Polynomial) -> None:
    """The ideal of (t, t^2, t^3) is prime: members are what vanishes on the curve."""
    on_curve = p.compose(X, X**2, X**3, ctx=RING.context)
    assert groebner_basis(RING, TWISTED).contains(p) == (on_curve == 0)


@pytest.mark.parametrize(
    ("equations", "dimension"),
    [
        ([], 3),
        ([X], 2),
        ([X * Y], 2),
        (TWISTED, 1),
        ([X * Y, X * Z], 2),
        ([X * Y - 1, X * Z, Y * Z - Z], 1),
        ([X**2, Y**2 - X, Z - 1], 0),
        ([X, X - 1], -1),
        ([X**2 + Y**2 - 1, 2 * X**2 + 2 * Y**2 - 3], -1),
    ],
)
def test_dimension(equations: list[Polynomial], dimension: int) -> None:
    """The dimension of hand-made zero sets; -1 when there is no point."""
    assert groebner_basis(RING, equations).dimension == dimension


def test_a_remainder_by_fewer_elements_proves_membership_only() -> None:
    """The generators alone do not reduce their member x z - y^2 to 0."""
    context = degree_reverse_context(RING)
    divisors = [context.from_dict(p.to_dict()) for p in TWISTED]
    member = X * Z - Y**2
    assert normal_form(RING, member, divisors) != 0
    assert groebner_basis(RING, TWISTED).contains(member)


def test_limits_end_in_an_error() -> None:
    """A basis that grows past a limit is not returned."""
    with pytest.raises(UnableError, match="over 3 elements"):
        groebner_basis(RING, [X**3 - Y * Z, Y**3 - X, Z**3 - X * Y], (3, 2000, 4000))


def test_only_rational_coefficients() -> None:
    """Q(sqrt 2) is refused by name."""
    ring = Ring(["x"], radicand=2)
    with pytest.raises(UnableError, match="sqrt2"):
        groebner_basis(ring, [ring.gens[0] - ring.surd])


def test_the_dimension_is_bounded_by_any_elements() -> None:
    """Stopped at three elements, the bound is at least the dimension, and says so."""
    equations = [X**3 - Y * Z, Y**3 - X, Z**3 - X * Y]
    bound, complete = dimension_bound(RING, equations, (3, 2000, 4000))
    assert not complete and bound >= groebner_basis(RING, equations).dimension == 0
    assert dimension_bound(RING, TWISTED) == (1, True)


def test_free_sets_of_the_circle_cylinder() -> None:
    """On {x^2 + y^2 = 1} the leading monomial is x^2: the pair without x is free."""
    assert groebner_basis(RING, [X**2 + Y**2 - 1]).free_sets() == [("y", "z")]


CYCLIC = Ring(["a", "b", "c", "d", "e", "f"])


def cyclic() -> list[Polynomial]:
    """The six equations of the cyclic roots: Buchberger takes long."""
    gens = CYCLIC.gens
    found = []
    for k in range(1, 6):
        terms = CYCLIC.constant(0)
        for i in range(6):
            term = CYCLIC.constant(1)
            for j in range(k):
                term *= gens[(i + j) % 6]
            terms += term
        found.append(terms)
    a, b, c, d, e, f = gens
    return [*found, a * b * c * d * e * f - 1]


def test_a_long_basis_stops_at_the_time_limit() -> None:
    """What is not done at once is ended from outside when the time is up."""
    begun = time.perf_counter()
    with (
        pytest.raises(TimeLimitError, match="groebner_basis"),
        time_limit(0.5),
    ):
        groebner_basis(CYCLIC, cyclic(), (10**6, 10**6, 10**6))
    assert time.perf_counter() - begun < 2


def test_another_process_finds_the_same_elements(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Limited in time or not, the basis is one."""
    plain = groebner_basis(RING, TWISTED)
    monkeypatch.setattr(ideal, "_AT_ONCE", (1, 1, 1))
    with time_limit(30):
        assert groebner_basis(RING, TWISTED).elements == plain.elements
