from __future__ import annotations

import pytest
from slides_table import arms, show, table


@pytest.mark.slow
def test_no_verdict_on_slides_is_refuted() -> None:
    """A line between two postures of a pose is met for no arm called noncuspidal."""
    rows = list(table(16, seed=1, timeout=2.0))
    print(show(rows))
    assert [row for row in rows if row.is_wrong] == []
    assert {"noncuspidal", "cuspidal"} <= {row.verdict for row in rows}


def test_the_arms_are_of_every_kind() -> None:
    """One to three slides, special and general, the same for the same seed."""
    drawn = list(arms(20, seed=0))
    assert {kinds.count("P") for kinds, _, _ in drawn} == {1, 2, 3}
    assert {special for _, special, _ in drawn} == {True, False}
    assert drawn == list(arms(20, seed=0))
