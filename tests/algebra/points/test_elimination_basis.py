from __future__ import annotations

import pytest

from cuspaudit.algebra.points.elimination_basis import parse_basis, propose_elimination
from cuspaudit.algebra.ring import Ring
from cuspaudit.errors import UnableError


def test_eliminating_a_parameter_gives_the_curve() -> None:
    """The curve x = s^2, y = s^3 has the equation y^2 = x^3."""
    ring = Ring(["s", "x", "y"])
    s, x, y = ring.gens
    (found,) = propose_elimination(ring, [x - s**2, y - s**3], 1)
    assert found in (x**3 - y**2, y**2 - x**3)


def test_fractions_and_signs_are_read() -> None:
    """Every kind of term that msolve prints is read."""
    ring = Ring(["t", "u1"])
    t, u1 = ring.gens
    assert parse_basis(ring, "[-t^2*u1+1/2*t-3,\nu1]:\n") == [
        -(t**2) * u1 + t / 2 - 3,
        u1,
    ]


@pytest.mark.parametrize("answer", ["", "[1", "[x]:", "[t^]:", "error"])
def test_anything_else_is_refused(answer: str) -> None:
    """An answer that is no list of polynomials in the ring is an error."""
    with pytest.raises(UnableError, match="unreadable"):
        parse_basis(Ring(["t"]), answer)
