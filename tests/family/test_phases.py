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


def test_a_picture_says_what_is_held_and_in_what_unit(swept: Path) -> None:
    """The title has the values held, the axes the unit of length; a page no title."""
    shown = phases_of(swept, fixed={"d5": "1/10"})
    assert shown.title == "ur-pattern, d5 = 0.1"
    assert shown.labels == ("a2 (m)", "a3 (m)")
    drawn = (shown.rows, shown.x, shown.y, shown.colour, "svg")
    words = ("ur-pattern, d5 = 0.1", "a2 (m)", "a3 (m)")
    picture = draw_phases(*drawn, shown.title, shown.labels).decode()
    assert all(f"<!-- {text} -->" in picture for text in words)
    assert "<!-- ur-pattern" not in draw_phases(*drawn).decode()


def test_an_angle_is_in_rad_and_a_lone_value_is_held(tmp_path: Path) -> None:
    """An angle's axis says rad, one inside an expression nothing; one value is held."""
    file = tmp_path / "family.yaml"
    file.write_text(
        "family: turned\nrobot:\n  convention: standard\n  units: mm\n"
        "  task: position\n  joints:\n"
        "    - {type: revolute, a: 2*r, alpha: twist, d: 0}\n"
        "    - {type: revolute, a: 2, alpha: -pi/2, d: d2}\n"
        "    - {type: revolute, a: 3/2, alpha: 0, d: 0}\n"
        "parameters:\n  r: {values: [1/2, 1]}\n"
        "  twist: {values: [pi/2, -pi/2]}\n  d2: {values: [1]}\n"
    )
    sweep(file, tmp_path / "out", 1)
    shown = phases_of(tmp_path / "out")
    assert shown.labels == ("r", "twist (rad)")
    assert shown.title == "turned, d2 = 1"


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
