from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from cuspaudit.errors import InvalidInputError
from cuspaudit.toolpath.asked import asked_pose
from cuspaudit.toolpath.reach import first_unreachable
from cuspaudit.toolpath.reading import closed_path, read_path
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from tests.toolpath.traced_arms import crx, mirror, places, table_arm

POSE = "x,y,z,qw,qx,qy,qz\n"


def write(folder: Path, text: str, name: str = "path.csv") -> Path:
    """The text in a file."""
    file = folder / name
    file.write_text(text)
    return file


def test_lengths_are_exact_and_may_carry_a_unit(tmp_path: Path) -> None:
    """A bare number is in the robot's unit; mm and m are converted exactly."""
    file = write(tmp_path, "x,y,z\n0.1,250 mm,1/3\n0.2m,0,0\n")
    path = read_path(file, mirror())
    assert path.poses[0].position == (Fraction(1, 10), Fraction(1, 4), Fraction(1, 3))
    assert path.poses[1].position == (Fraction(1, 5), 0, 0)


def test_json_and_csv_are_the_same_path(tmp_path: Path) -> None:
    """Numbers of JSON are read from their text, as those of CSV are."""
    table = write(tmp_path, POSE + "0.1,0.2,0.3,1,0,0,0\n0.4,0.2,0.3,0,1,0,0\n")
    turned = "0.4,0.2,0.3,0.6,0.8,0,0"
    table.write_text(POSE + f"0.1,0.2,0.3,1,0,0,0\n{turned}\n")
    text = (
        '[{"position": [0.1, 0.2, 0.3], "quaternion": [1, 0, 0, 0]},'
        '{"position": [0.4, 0.2, 0.3], "quaternion": [0.6, 0.8, 0, 0]}]'
    )
    other = write(tmp_path, text, "path.json")
    assert read_path(table, crx()).poses == read_path(other, crx()).poses


def test_a_quaternion_and_its_negative_are_one_orientation(tmp_path: Path) -> None:
    """A path that ends in -q where it began in q is closed."""
    text = POSE + "0,0,1,1,0,0,0\n0,0.1,1,1,0,0,0\n0,0,1,-1,0,0,0\n"
    assert read_path(write(tmp_path, text), crx()).is_closed


def test_joint_vectors_make_a_tool_path(tmp_path: Path) -> None:
    """The columns are the joints' names; right angles give rational poses, exactly."""
    text = "j3,j1,j2\n0 deg,90 deg,0\n0.1 rad,0,0\n"
    path = read_path(write(tmp_path, text), mirror())
    assert path.joints is not None and path.joints[0] == pytest.approx(
        (1.5707963, 0, 0)
    )
    x, y, z = path.poses[0].position
    assert x.denominator <= 2 and y.denominator <= 2 and z.denominator <= 2


def test_closing_adds_the_first_waypoint_once(tmp_path: Path) -> None:
    """A path that is closed already stays as it is."""
    path = read_path(write(tmp_path, "x,y,z\n1,0,0\n2,0,0\n"), mirror())
    once = closed_path(path, mirror())
    assert once.is_closed and len(once.poses) == 3
    assert closed_path(once, mirror()) == once


@pytest.mark.parametrize(
    ("arm", "text", "words"),
    [
        (mirror, "x,y,z\n1,0,0\n", "one waypoint"),
        (mirror, "x,y,z\n", "no waypoint"),
        (mirror, "", "no rows"),
        (mirror, "x,y,z\n1,0,nan\n2,0,0\n", "row 1 z"),
        (mirror, "x,y,z\n1,0,inf\n2,0,0\n", "row 1 z"),
        (mirror, "x,y,z\n1,0,0\n2,0\n", "row 2: 2 cells for 3 columns"),
        (mirror, "x,y\n1,0\n2,0\n", "a header of"),
        (mirror, "x,y,z\n1,0,__import__('os')\n2,0,0\n", "row 1 z"),
        (mirror, "x,y,z\n1,0,3 furlong\n2,0,0\n", "row 1 z"),
        (mirror, "j1,j2,j3\n0.1,0.2,0.3\n0,0,0\n", "row 1 j1"),
        (mirror, '[{"position": [1, 0, NaN]}]', "NaN"),
        (mirror, '[{"position": [1, 0]}]', "row 1 position"),
        (mirror, '[{"place": [1, 0, 0]}]', "row 1"),
        (mirror, '{"position": [1, 0, 0]}', "not a list"),
        (mirror, "[1, 2", "line 1"),
        (crx, "x,y,z\n1,0,0\n2,0,0\n", "row 1: no orientation"),
        (crx, POSE + "0,0,1,1,0,0,0.1\n0,0,1,1,0,0,0\n", "length 1.00499"),
        (crx, POSE + "0,0,1,1,0,0,0\n0,0,1,0,1,0,0\n", "row 2: the leg"),
    ],
)
def test_bad_paths_are_refused_in_one_line(
    tmp_path: Path, arm: object, text: str, words: str
) -> None:
    """The message names the file and the row, and is one line."""
    assert callable(arm)
    own = arm()
    assert isinstance(own, TracedArm)
    with pytest.raises(InvalidInputError) as met:
        read_path(write(tmp_path, text), own)
    message = str(met.value)
    assert "path.csv" in message and words in message and "\n" not in message


def test_a_missing_file_is_one_line(tmp_path: Path) -> None:
    """So is a folder, or a file that is no text."""
    for file in (tmp_path / "none.csv", tmp_path):
        with pytest.raises(InvalidInputError, match="cannot be read"):
            read_path(file, mirror())
    raw = tmp_path / "raw.csv"
    raw.write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(InvalidInputError, match="not a text file"):
        read_path(raw, mirror())


@pytest.mark.parametrize("mark", [";", "\t"])
def test_what_spreadsheets_copy_is_read(tmp_path: Path, mark: str) -> None:
    """Semicolons and tabs between cells are as good as commas."""
    file = tmp_path / "path.csv"
    file.write_text(f"x{mark}y{mark}z\n2{mark}0{mark}0.5\n1.9{mark}0{mark}0.5\n")
    path = read_path(file, mirror())
    assert [float(x) for x in path.poses[1].position] == [1.9, 0, 0.5]


def test_lengths_beyond_reason_are_refused(tmp_path: Path) -> None:
    """1e300 overflows doubles: it is named with its row; 1e9 is only out of reach."""
    file = tmp_path / "path.csv"
    file.write_text("x,y,z\n2,0,0\n1e300,0,0\n")
    with pytest.raises(InvalidInputError, match="row 2 x: a length above 1e10"):
        read_path(file, mirror())
    with pytest.raises(InvalidInputError, match="above 1e10"):
        asked_pose(mirror(), None, "1e300,0,0", None, None)
    file.write_text("x,y,z\n2,0,0\n1e9,0,0\n")
    missed = first_unreachable(trace_path(mirror(), read_path(file, mirror())))
    assert missed is not None and missed.distance == pytest.approx(1e9)


def test_an_orientation_that_no_task_asks_for_is_refused() -> None:
    """It would be passed over in silence."""
    for option, given in (
        ("--rpy", (None, "0,0,0")),
        ("--quaternion", ("1,0,0,0", None)),
    ):
        with pytest.raises(InvalidInputError, match=f"leave out {option}"):
            asked_pose(mirror(), None, "2,0,0", *given)


def test_a_waypoint_of_whole_curves_is_not_out_of_reach() -> None:
    """On the first axis of an elbow joint 1 is free: no posture is listed, many are."""
    arm = traced_arm(table_arm([0, 1, 1], [0, 0, 0], ["1/2", "0", "0"]))
    trace = trace_path(arm, places(["0", "0", "1.2"], ["0.5", "0", "1"]))
    assert trace.first.whole_curves and not trace.runs
    assert first_unreachable(trace) is None
    assert any("infinitely many" in remark for remark in trace.remarks)
