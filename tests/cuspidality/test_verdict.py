from __future__ import annotations

import pytest

from cuspaudit.cuspidality.verdict import Verdict


@pytest.mark.parametrize("verdict", Verdict)
def test_a_verdict_is_neither_true_nor_false(verdict: Verdict) -> None:
    """Three answers have no truth value."""
    with pytest.raises(TypeError, match="one of three"):
        bool(verdict)


def test_a_verdict_is_its_word() -> None:
    """The words of the audit's JSON."""
    assert [v.value for v in Verdict] == ["cuspidal", "noncuspidal", "undecided"]
    assert Verdict("cuspidal") is Verdict.CUSPIDAL
