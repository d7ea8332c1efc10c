from __future__ import annotations

from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import cuspaudit
from cuspaudit.algebra import trigonometric
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import (
    factor_on_circles,
    primitive,
    reduce_on_circles,
)
from cuspaudit.errors import CrossCheckError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.formats.read_robot import read_robot

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
CIRCLES = [("c2", "s2"), ("c3", "s3")]
RING = Ring(["c2", "s2", "c3", "s3"])
C2, S2, C3, S3 = RING.gens


def texts(ring: Ring, circles: list[tuple[str, str]], p: Polynomial) -> set[str]:
    """The factors of ``p`` as texts."""
    factors = factor_on_circles(ring, circles, p)
    return {f"({f})^{k}" if k > 1 else str(f) for f, k in factors}


def determinant_factors(name: str) -> set[str]:
    """The factors of det J of a robot of the library."""
    model = exact_model(read_robot(ROBOTS / f"{name}.yaml").chain)
    return texts(model.ring, model.circles, jacobian_determinant(model))


def test_the_issac_arm_has_the_printed_factors() -> None:
    """The mirror of the ISSAC 2022 arm has the two factors printed in the paper."""
    assert determinant_factors("chablat-2022-3r-mirror") == {
        "3*c3 + 4",
        "c2*c3 - 2*c2*s3 - s3",
    }


def test_the_ur5_has_three_factors() -> None:
    """The UR5 has s3, s5 and a2 c2 + a3 c23 + d5 s234 with its own numbers."""
    a2, a3, d5 = 8500, 7845, 1893
    circles = [(f"c{i}", f"s{i}") for i in range(1, 7)]
    ring = Ring([name for pair in circles for name in pair])
    c2, s2, c3, s3, c4, s4 = ring.gens[2:8]
    c23, s23 = c2 * c3 - s2 * s3, s2 * c3 + c2 * s3
    E = a2 * c2 + a3 * c23 - d5 * (s23 * c4 + c23 * s4)
    assert determinant_factors("ur5") == {"s3", "s5", str(primitive(ring, E))}


def test_the_crx_is_irreducible() -> None:
    """The det J of the FANUC CRX-10iA/L is one factor of eight terms."""
    (factor,) = determinant_factors("fanuc-crx-10ia-l")
    assert factor.count("*s5") + factor.count("*c5") == 8


@pytest.mark.parametrize(
    ("p", "expected"),
    [
        (S2**2 * C3, {"(s2)^2", "c3"}),
        (1 - C2**2, {"(s2)^2"}),
        ((1 - C2) ** 2, {"(c2 - 1)^2"}),
        (1 - C2, {"c2 - 1"}),
        (C2 * (3 * C2 + 4 * S2), {"c2", "3*c2 + 4*s2"}),
        (C2 * C3 - S2 * S3, {"c2*c3 - s2*s3"}),
        (S2 * C3 + C2 * S3 + S2 * C2 - S2 * C2, {"c2*s3 + s2*c3"}),
        (RING.constant(7), set()),
        (C2**2 + S2**2, set()),
        (RING.constant(0), {"0"}),
        (fmpq(2, 3) * S2 * (C2**2 + S2**2), {"s2"}),
    ],
    ids=lambda value: str(value) if not isinstance(value, set) else "",
)
def test_small_products(p: Polynomial, expected: set[str]) -> None:
    """Factors of functions small enough to factor by hand."""
    assert texts(RING, CIRCLES, p) == expected


def test_a_slide_is_a_variable_like_any_other() -> None:
    """A variable without a circle stays in its factor."""
    ring = Ring(["c", "s", "q"])
    c, s, q = ring.gens
    assert texts(ring, [("c", "s")], s * q**2 * (q * c + s)) == {
        "s",
        "(q)^2",
        "c*q + s",
    }


def test_rational_factors_are_found_over_a_quadratic_field() -> None:
    """Over Q(sqrt 2) a factor over Q is taken out and sqrt 2 itself is a constant."""
    ring = Ring(["c", "s"], radicand=2)
    c, s = ring.gens
    p = ring.reduce(ring.surd * s * (c + 3) * (c + 2 * ring.surd))
    assert texts(ring, [("c", "s")], p) == {"s", "c + 3", "c*sqrt2 + 4"}


small = st.integers(-3, 3)
factors = st.lists(
    st.tuples(small, small, small, small, small).filter(any), min_size=1, max_size=3
)


@settings(max_examples=40, deadline=None)
@given(factors)
def test_the_product_of_the_factors_is_the_polynomial(
    rows: list[tuple[int, ...]],
) -> None:
    """On the circles, whatever was multiplied, up to a constant."""
    parts = [a + b * C2 + c * S2 + d * C3 + e * C2 * S3 for a, b, c, d, e in rows]
    product = RING.constant(1)
    for part in parts:
        product *= part
    found = RING.constant(1)
    for factor, count in factor_on_circles(RING, CIRCLES, product):
        found = reduce_on_circles(RING, CIRCLES, found * factor**count)
    reduced = reduce_on_circles(RING, CIRCLES, product)
    assert primitive(RING, found) == primitive(RING, reduced)


def test_a_lost_factor_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """With one form dropped the product no longer agrees, and that is an error."""
    whole = trigonometric._forms
    monkeypatch.setattr(trigonometric, "_forms", lambda *args: whole(*args)[1:])
    with pytest.raises(CrossCheckError, match="do not multiply"):
        factor_on_circles(RING, CIRCLES, C2 * C3 * (3 * C3 + 4))
