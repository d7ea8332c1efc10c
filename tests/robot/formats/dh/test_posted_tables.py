from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Translation
from cuspaudit.robot.formats.dh.cells import plain_cell, variable_in
from cuspaudit.robot.formats.dh.headers import header_from_text, stated_by
from cuspaudit.robot.formats.dh.read import read_dh
from cuspaudit.robot.frames import frames
from cuspaudit.robot.place import Place
from cuspaudit.robot.robot import Robot

Reader = Callable[..., Robot]

MARKDOWN = r"""
# A Puma in Markdown, convention=standard

| Joint | $\theta_i$ | $d_i$ (mm) | $a_i$ (mm) | $\alpha_i$ [°] |
|:-----:|------------|-----------:|------------|----------------|
| 1 | θ₁ | 400 | 25 | -90° |
| 2 | $\theta_2 - \frac{\pi}{2}$ | 0 | 455 | 0 |
| 3 | θ₃ | 0 | 35 | -90 |

Masses follow in another table:

| link | mass |
|------|------|
| 1    | 3    |
"""
BOX = """\
convention=standard lengths=mm
┌─────┬───────┬──────┬────────┐
│ θⱼ  │  dⱼ   │  aⱼ  │  ⍺ⱼ    │
├─────┼───────┼──────┼────────┤
│ q1  │ 400.0 │ 25.0 │ -90.0° │
│ q2 - 90° │ 0.0 │ 455.0 │ 0.0° │
│ q3  │   0.0 │ 35.0 │ -90.0° │
└─────┴───────┴──────┴────────┘
"""
LATEX = r"""
% convention=standard lengths=mm
\begin{tabular}{c|cccc}
\hline
$i$ & $\theta_i$ & $d_i$ & $a_i$ & $\alpha_i$ \\ \hline
1 & $\theta_1$ & 400 & 25 & $-\frac{\pi}{2}$ \\
2 & $\theta_2 - 90^\circ$ & 0 & 455 & 0 \\[2pt]
3 & $\theta_3$ & 0 & 35 & $-90^{\circ}$ \\ \hline
\end{tabular}
"""
SEMICOLONS = """\
i;theta [deg];d [mm];a [mm];alpha [deg];convention
0;q0;400,0;25;-90;standard
1;q1 - 90;0;455;0;standard
2;q2;0;35,0;-90;standard
"""
BLANKS = """\
# convention=standard lengths=mm angles=deg
i  offset  d    a    alpha
1  0       400  25   -90
2  -90     0    455  0
3  0       0    35   -90
"""
PLAIN = """\
convention: standard
units: {length: mm, angle: deg}
joints:
  - {type: revolute, theta: 0, d: 400, a: 25, alpha: -90}
  - {type: revolute, theta: -90, d: 0, a: 455, alpha: 0}
  - {type: revolute, theta: 0, d: 0, a: 35, alpha: -90}
"""


@pytest.fixture
def read(tmp_path: Path) -> Reader:
    """A reader of the table in a text."""

    def reader(text: str, name: str = "arm.yaml", **options: str) -> Robot:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return read_dh(path, **options)

    return reader


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("arm.md", MARKDOWN),
        ("arm.csv", MARKDOWN),
        ("arm.txt", BOX),
        ("arm.tex", LATEX),
        ("arm.csv", SEMICOLONS),
        ("arm.txt", BLANKS),
    ],
)
def test_one_table_in_every_dress_is_one_chain(
    read: Reader, name: str, text: str
) -> None:
    """Markdown, a printed box, LaTeX, semicolons and blanks give the chain of YAML."""
    plain, dressed = read(PLAIN).chain, read(text, name).chain
    assert dressed.joints == plain.joints
    assert (dressed.tool, dressed.unit) == (plain.tool, "mm")


def test_rows_without_a_type_are_revolute_and_say_so(read: Reader) -> None:
    """A row without type turns, one whose d alone varies slides; each with a note."""
    untyped = read(PLAIN.replace("type: revolute, ", ""))
    assert untyped.chain.joints == read(PLAIN).chain.joints
    assert "no row states a type: all joints are read as revolute" in untyped.notes
    text = "theta,d,a,alpha\nq1,0,1,0\n0,d2 + 0.3,1,0\nq3,0,1,0\n"
    mixed = read(text, "arm.csv", convention="standard", length_unit="m")
    assert mixed.chain.kinds == ("revolute", "prismatic", "revolute")
    said = '"joint_2" states no type: read as prismatic, as d is what varies'
    assert said in mixed.notes
    typed = "type,theta,d,a,alpha\nR,0,0,1,0\nP,0,0.3,1,0\nR,0,0,1,0\n"
    same = read(typed, "arm.csv", convention="standard", length_unit="m").chain
    assert mixed.chain.joints == same.joints


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_a_negated_symbol_turns_the_other_way(read: Reader, convention: str) -> None:
    """``90 deg - q2`` is the joint with sign -1 and zero 90 deg."""
    text = "theta,d,a,alpha\nq1,0,1,pi/2\n90 deg - q2,1,2,-pi/2\nq3,0,1,0\n"
    plain = "theta,d,a,alpha,sign\n0,0,1,pi/2,1\n90 deg,1,2,-pi/2,-1\n0,0,1,0,1\n"
    first = read(text, "a.csv", convention=convention, length_unit="m").chain
    second = read(plain, "b.csv", convention=convention, length_unit="m").chain
    assert first.joints == second.joints
    at = [0.3, 0.7, -0.2]
    assert frames(first, at) == pytest.approx(frames(second, at))


def test_an_offset_is_the_zero_of_its_joint(read: Reader) -> None:
    """``offset`` beside d is what theta is; of a slide it is what d is."""
    text = PLAIN.replace("theta: -90", "theta: q2, offset: -90")
    assert read(text).chain.joints == read(PLAIN).chain.joints
    slide = "type,theta,offset,a,alpha\nR,q1,0,0,0\nP,0,0.3,1,0\nR,q3,0,1,0\n"
    with pytest.raises(InvalidRobotError, match="row 1 offset: an offset in a row wit"):
        read(slide, "arm.csv", convention="standard")
    slide = slide.replace("offset,a", "offset,d,a").replace(",0,0,0", ",0,0,0,0")
    slide = slide.replace("0.3,1", "0.3,,1").replace("q3,0,", "q3,0,0,")
    moved = read(slide, "arm.csv", convention="modified").chain
    assert Translation((Fraction(0), Fraction(0), Fraction(3, 10))) in (
        moved.joints[2].before
    )


def test_what_is_missing_is_asked_for_in_one_message(read: Reader) -> None:
    """Convention and both units are asked for at once; following it, the table reads.

    The convention that an index states, and a unit in a name, are not asked for.
    """
    text = "theta,d,a,alpha\nq1,0,1,90\nq2,1,2,-90\nq3,0,1,0\n"
    with pytest.raises(InvalidRobotError) as caught:
        read(text, "arm.csv")
    said = str(caught.value)
    assert said.count("\n") == 0
    for option in (
        "--convention standard|modified",
        "--angle-unit deg|rad",
        "--length-unit m|mm",
    ):
        assert option in said
    given = {"convention": "modified", "angle_unit": "deg", "length_unit": "mm"}
    assert read(text, "arm.csv", **given).chain.unit == "mm"
    stated = text.replace("a,alpha", "a_{i-1},alpha_{i-1} [deg]")
    robot = read(stated, "arm.csv")
    assert any("modified convention" in note for note in robot.notes)
    assert robot.chain.joints == read(text, "arm.csv", **given).chain.joints


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("theta,d,a,alpha\nq1,0,1,0\nq3,0,1,0\nq3,0,1,0\n", "row 2: the symbol of jo"),
        ("theta,d,a,alpha\nq1+q2,0,1,0\n", "is not a number"),
        ("theta,d,a,alpha\nq1,d1,1,0\n", 'row 1 d: "d1" in a row of a revolute joint'),
        ("theta,d,a,alpha\nq1,0,a1,0\n", 'row 1 a: "a1" is not a number'),
        ("type,theta,d,a,alpha\nP,q1,0,1,0\n", 'theta: "q1" in a row of a prismatic'),
        ("theta,offset,d,a,alpha\npi/2,pi/2,0,1,0\n", "both theta and offset state"),
        ("theta,θ_i,d,a,alpha\n0,0,0,1,0\n", "two columns mean theta"),
        ("theta,d,a_{i-1},alpha\n0,0,1,0\n", "are those before the joint"),
        ("theta,d [mm],a [m],alpha\n0,0,1,0\n", "two units of length: m, mm"),
        ("theta,d [deg],a,alpha\n0,0,1,0\n", "a unit of length that is none: deg"),
        ("theta,d,r,alpha\n0,0,1,0\n", 'the column name "r" is unknown'),
        ("theta;d;a;alpha\n0;1,140;0;0\n", "U.002C COMMA; write a decimal point"),
        ("theta,d,a,alpha\nexec(q1),0,1,0\n", 'theta: "exec.q1." is not a number'),
    ],
)
def test_what_is_not_clear_is_refused(read: Reader, text: str, said: str) -> None:
    """A sum of joints, a symbolic length, two zeros, two units: named, not guessed."""
    given = {"convention": "standard", "angle_unit": "deg", "length_unit": "m"}
    if "[" in text:
        del given["length_unit"]
    with pytest.raises(InvalidRobotError, match=said):
        read(text, "arm.csv", **given)


def test_of_two_tables_none_is_chosen(read: Reader) -> None:
    """Two D-H tables in one text are refused by their number."""
    twice = MARKDOWN + "\n" + MARKDOWN
    with pytest.raises(InvalidRobotError, match="2 D-H tables; leave one"):
        read(twice, "arm.md")


@pytest.mark.parametrize(
    ("text", "column", "unit", "is_before"),
    [
        ("α_{i-1}", "alpha", None, True),
        (r"$\alpha_{i-1}$ (rad)", "alpha", "rad", True),
        ("a(i-1)", "a", None, True),
        ("Link Twist [deg]", "alpha", "deg", False),
        ("link offset / mm", "d", "mm", False),
        ("theta_offset", "offset", None, False),
        ("q⁻", "qmin", None, False),
        ("Joint No.", "joint", None, False),
        ("offset", "offset", None, False),
        ("angle", "", None, False),
        ("a_2", "", None, False),
    ],
)
def test_names_of_columns(
    text: str, column: str, unit: str | None, is_before: bool
) -> None:
    """A name gives its column, its unit and whether it is of the link before."""
    header = header_from_text(text)
    found = (header.column, header.unit, header.is_before)
    assert found == (column, unit, is_before)


def test_only_both_indices_state_a_convention() -> None:
    """a_{i-1} with alpha_{i-1} is the modified convention; indices i state none."""
    place = Place("arm.csv")
    both = [header_from_text(t) for t in ("a_{i-1}", "alpha_{i-1}", "d_i", "theta_i")]
    assert stated_by(both, place) == {"convention": "modified"}
    same = [header_from_text(t) for t in ("a_i", "alpha_i", "d_i", "theta_i")]
    assert stated_by(same, place) == {}


def test_cells_without_markup() -> None:
    """A cell loses its markup and keeps its value; code stays text that is refused."""
    assert plain_cell(r"$\frac{3\pi}{4}$") == "3pi/4"
    assert plain_cell(r"`q\_2`") == "q_2"
    assert variable_in("theta2+90 deg", "theta").rest == "90 deg"
    assert variable_in("-q_{2}".translate({123: None, 125: None}), "theta").sign == -1
    assert variable_in("q2*2", "theta") is None
    assert variable_in("exec(q2)", "theta") is None
