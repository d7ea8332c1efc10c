from __future__ import annotations

from flint import arb, ctx, fmpq

from cuspaudit.algebra.rationals import rationals_between


def test_gap_of_two_close_balls_is_found_at_any_precision() -> None:
    """Rationals between balls made at 256 bits lie between them at 53 bits too."""
    saved, ctx.prec = ctx.prec, 256
    try:
        low = arb(1) / 3
        high = low + arb(2) ** -120
    finally:
        ctx.prec = saved
    for value in rationals_between(low, high):
        ctx.prec, found = 256, fmpq(value)
        try:
            assert low < arb(found) < high
        finally:
            ctx.prec = saved
