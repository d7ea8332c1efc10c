from __future__ import annotations

from typing import Any

import pytest
from flint import acb, acb_poly, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.points.interpolated_points import proposed_numerators
from cuspaudit.errors import PrecisionError

OMEGA = fmpq_poly([fmpq(-3, 7), 1, 0, fmpq(2, 5), 0, 1])
COORDINATES = (fmpq_poly([1, fmpq(1, 3)]), fmpq_poly([0, fmpq(5, 11), 0, 0, 2]))


def proposed(bits: int) -> list[fmpq_poly]:
    """The numerators of ``COORDINATES`` from balls at the roots of ``OMEGA``."""
    with ctx.workprec(bits):
        found: Any = OMEGA.numer().complex_roots()
        roots = [root for root, _ in found]
        values: list[list[acb]] = [
            [acb_poly(x)(root) for x in COORDINATES] for root in roots
        ]
        return proposed_numerators(OMEGA, roots, values)


def test_rational_numerators_come_back() -> None:
    """Rho = x omega' modulo omega, exactly, from balls of 256 bits."""
    wanted = [x * OMEGA.derivative() % OMEGA for x in COORDINATES]
    assert proposed(256) == wanted


def test_wide_balls_are_refused() -> None:
    """Balls of 30 bits tell no numerator."""
    with pytest.raises(PrecisionError):
        proposed(30)
