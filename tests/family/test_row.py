"""Members of a six-joint family: a theorem or a witness decides each."""

from pathlib import Path

import pytest
from small_families import UR_PATTERN

from cuspaudit.family.family_file import read_family
from cuspaudit.family.row import decide_member


@pytest.mark.slow
def test_an_offset_wrist_needs_a_witness(tmp_path: Path) -> None:
    """With a5 = 0 the UR pattern decides; with a5 = 0.1 a certified witness does."""
    path = tmp_path / "offset.yaml"
    text = UR_PATTERN.replace("{type: revolute, a: 0,    alpha: -pi/2, d: d5}", "FIFTH")
    fifth = "{type: revolute, a: a5,   alpha: -pi/2, d: 0.09}"
    values = "parameters: {a2: {values: [0.42]}, a3: {values: [0.39]}, "
    path.write_text(
        text.replace("FIFTH", fifth)
        + values
        + "a5: {values: [0, 0.1]}}\nrecord: [clearance]\n"
    )
    rows = [decide_member(read_family(path), index) for index in (0, 1)]
    assert [row["verdict"] for row in rows] == ["noncuspidal", "cuspidal"]
    assert [row["proof"] for row in rows] == ["reduction", "witness"]
    assert rows[0]["clearance"] is None
    assert 0 < rows[1]["clearance"] < 1
