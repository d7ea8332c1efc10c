from __future__ import annotations

import re
from pathlib import Path

import pytest
import small_families as families

from cuspaudit.errors import InvalidInputError
from cuspaudit.family.phases import phases_of
from cuspaudit.family.sweep import sweep
from cuspaudit.robot.formats.dh.read import read_dh
from cuspaudit.viz.plot.phase import draw_phases, phase_page


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small sweep in three parameters, one of them with two values."""
    folder = tmp_path_factory.mktemp("sweep")
    file = folder / "family.yaml"
    file.write_text(
        families.UR_PATTERN + "parameters: {a2: {range: [0.2, 0.6], steps: 3}, "
        "a3: {range: [0.3, 0.6], steps: 3}, d5: {values: [0.09, 0.1]}}\n"
    )
    sweep(file, folder / "out", 2)
    return folder / "out"


def test_a_plane_is_cut_out(swept: Path, tmp_path: Path) -> None:
    """The members at the fixed value, each with a robot file that reads back."""
    shown = phases_of(swept, fixed={"d5": "1/10"})
    assert (shown.x, shown.y, len(shown.rows)) == ("a2", "a3", 9)
    assert {row["d5_exact"] for row in shown.rows} == {"0.1"}
    member = tmp_path / "member.yaml"
    member.write_text(shown.files[shown.rows[4]["index"]])
    assert read_dh(member).name == f"ur-pattern-{shown.rows[4]['index']}"


def test_every_member_has_its_title(swept: Path) -> None:
    """SVG and page name every member under the pointer; PNG is a picture."""
    shown = phases_of(swept, fixed={"d5": "0.1"})
    drawn = (shown.rows, shown.x, shown.y, shown.colour)
    svg = draw_phases(*drawn, "svg")
    titles = re.findall(r"<title>(member [^<]*)</title>", svg.decode())
    assert len(titles) == 9
    assert titles[0] == "member 1, a2 = 0.2, a3 = 0.3, verdict: noncuspidal"
    page = phase_page(svg, shown.title, shown.files, {1: "out/1.html"}, "plot out")
    assert page.count("<title>member") == 9
    assert "ur-pattern-1" in page
    assert '"1": "out/1.html"' in page
    assert "http://www.w3.org" in page
    assert " src=" not in page
    assert draw_phases(*drawn, "png").startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({}, "--fix d5=0.09"),
        ({"fixed": {"d5": "7"}}, "no member there"),
        ({"x": "b"}, "choose two of"),
        ({"colour": "clearance", "fixed": {"d5": "0.1"}}, "choose one of"),
    ],
)
def test_what_cannot_be_drawn_is_one_line(
    swept: Path, options: dict[str, object], words: str
) -> None:
    """A parameter left free, or an unknown name, is refused with what to write."""
    with pytest.raises(InvalidInputError, match=words):
        phases_of(swept, **options)  # type: ignore[arg-type]


def test_another_folder_is_refused(tmp_path: Path) -> None:
    """A folder that is no sweep is refused."""
    with pytest.raises(InvalidInputError, match="not a folder of a sweep"):
        phases_of(tmp_path)
