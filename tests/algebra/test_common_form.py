from __future__ import annotations

import pytest
from flint import fmpq

from cuspaudit.algebra.common_form import common_forms
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import UnableError

RING = Ring(["c1", "s1", "c2", "s2"])
C1, S1, C2, S2 = RING.gens
CIRCLES = [("c1", "s1"), ("c2", "s2")]


def found(p: Polynomial, q: Polynomial) -> list[tuple[str, tuple[int, ...], bool]]:
    """The forms in short."""
    forms = common_forms(RING, CIRCLES, p, q)
    return [(str(f.polynomial), f.used, f.is_infinite) for f in forms]


def test_coprime_functions_have_no_common_form() -> None:
    """Cosine and sine, and a plane curve and a line, share no form."""
    assert found(C1, S1) == []
    assert found(C1 * C2 + fmpq(1, 3), S1 + C2) == []


def test_a_factor_that_is_no_function_on_the_circle_is_found() -> None:
    """1 + c = 2 C^2 and s = 2 S C share C, which vanishes at theta = pi only."""
    assert found(1 + C1, S1) == [("1", (0,), True)]
    assert found(1 - C1, S1) == [("s1", (0,), False)]


def test_the_sine_is_two_forms() -> None:
    """s1 P and s1 Q share S and C, the zeros 0 and pi of the sine."""
    assert found(S1 * C2, S1 * S2) == [("1", (0,), True), ("s1", (0,), False)]


def test_the_circle_itself_is_left_out() -> None:
    """Degrees that differ between the two functions make no common form."""
    assert found(C1**2, C1 * S1) == found(C1, C1)
    assert found(C1 * C1 + S1 * S1, S2) == []


def test_a_zero_function_leaves_the_forms_of_the_other() -> None:
    """The common zeros of 0 and q are those of q."""
    assert found(C1 * 0, S2) == found(S2, S2)


def test_a_form_of_two_circles_is_told() -> None:
    """cos(theta1 - theta2), common to both, is a form of both circles."""
    both = C1 * C2 + S1 * S2
    assert {used for _, used, _ in found(both * C1, both * S2)} == {(0, 1)}


def test_norms_prove_coprimality_over_a_quadratic_field() -> None:
    """Over Q(sqrt 2) coprime norms suffice; conjugate quotients are not settled."""
    ring = Ring(["c", "s"], 2)
    c, s = ring.gens
    r = ring.surd
    assert common_forms(ring, [("c", "s")], c + r * s, s) == []
    with pytest.raises(UnableError, match="not settled"):
        common_forms(ring, [("c", "s")], s + r * c, s - r * c)
