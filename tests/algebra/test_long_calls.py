"""Long calls of a kernel end with the time limit, and give what they give without."""

from __future__ import annotations

import time

import pytest

from cuspaudit.algebra import elimination
from cuspaudit.algebra.long_calls import in_time
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import TimeLimitError
from cuspaudit.runtime.clock import time_limit

RING = Ring(["x", "y", "z"], 2)
X, Y, Z = RING.gens
P = X**3 - RING.surd * X * Y + Z / 3
Q = X**2 * Z - Y + 5


def eliminants() -> list[Polynomial]:
    """A resultant, a discriminant and factors."""
    return [
        elimination.resultant(RING, P, Q, "x"),
        elimination.discriminant(RING, P, "x"),
        *elimination.rational_factors(RING, [P * Q]),
    ]


def test_another_process_gives_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fractions and the surd come back as they were."""
    plain = eliminants()
    for name in ("_LONG_RESULTANT", "_LONG_DISCRIMINANT", "_LONG_FACTORS"):
        monkeypatch.setattr(elimination, name, 0)
    with time_limit(60):
        assert eliminants() == plain


def test_a_long_call_ends_with_the_limit() -> None:
    """What sleeps for a minute is ended after a fifth of a second, by its name."""

    def work() -> list[Polynomial]:
        time.sleep(60)
        return []

    begun = time.perf_counter()
    with pytest.raises(TimeLimitError, match="resultant"), time_limit(0.2):
        in_time(RING, work, True, "resultant")
    assert time.perf_counter() - begun < 5


def test_short_calls_stay_here() -> None:
    """No process is made without a limit, or for what promises to be short."""
    here: list[int] = []

    def work() -> list[Polynomial]:
        here.append(1)
        return [P]

    assert in_time(RING, work, True, "resultant") == [P]
    with time_limit(60):
        assert in_time(RING, work, False, "resultant") == [P]
    assert len(here) == 2
