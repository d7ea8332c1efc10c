"""The table of the corpus within limits: none wrong, nearly all of class c cuspidal."""

from __future__ import annotations

from pathlib import Path

import pytest
from limits_table import Row, show, table


@pytest.mark.slow
def test_six_joint_arms_within_their_limits(corpus: Path) -> None:
    """No noncuspidal arm is turned, every CUSPIDAL verifies within the limits."""
    names = ("fanuc_crx10ia_l", "motoman_hc10", "ufactory_xarm6", "agilex_piper")
    rows = list(table(corpus, timeout=60, names=(*names, "ur_ur5e", "abb_irb120_3_58")))
    print(show(rows))
    assert len(rows) == len(names) + 2
    assert [row for row in rows if row.is_wrong] == []
    assert all(row.within == "cuspidal" for row in rows if row.arm in names)
    assert all(row.slack is not None for row in rows if row.arm in names)
    assert all(row.kind == "monotony" for row in rows if row.arm not in names)


def test_a_contradiction_is_wrong() -> None:
    """A noncuspidal arm that limits make cuspidal, or a CUSPIDAL without proof."""
    row = Row("arm", "c", "cuspidal", "cuspidal", "cusp", 0.1, True, 1.0, 0.1, "")
    assert not row.is_wrong
    for fault in ({"free": "noncuspidal"}, {"is_certified": False}):
        assert Row(**{**vars(row), **fault}).is_wrong
    assert "class c: 1 cuspidal (cusp)" in show([row])
