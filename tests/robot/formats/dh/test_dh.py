from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Angle, Translation
from cuspaudit.robot.formats.dh.read import read_dh
from cuspaudit.robot.frames import frames
from cuspaudit.robot.robot import Robot

ARM = """\
name: arm
convention: {convention}
units: {units}
joints:
  - {{type: revolute, a: 1, alpha: pi/2, d: 0.0892}}
  - {{type: R, a: 2, alpha: -pi/2, d: 1, theta: 90 deg, limits: [-170 deg, pi]}}
  - {{type: prismatic, a: 3/2, alpha: 0, theta: pi/3, d: 0.1, limits: [0, 1/2]}}
"""
HEADER = "joint,type,theta,d,a,alpha\n"

Reader = Callable[..., Robot]


@pytest.fixture
def read(tmp_path: Path) -> Reader:
    """A reader of the table in a text."""

    def reader(text: str, name: str = "arm.yaml", **options: str) -> Robot:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return read_dh(path, **options)

    return reader


def arm(convention: str = "standard", units: str = "m") -> str:
    """The text of a table of three joints."""
    return ARM.format(convention=convention, units=units)


def test_forward_kinematics_of_real_tables(corpus: Path) -> None:
    """Nine published tables, both conventions, agree with the Robotics Toolbox."""
    oracle = json.loads((corpus / "dh" / "FK_ORACLE.json").read_text())["robots"]
    for name, entry in oracle.items():
        chain = read_dh(corpus / "dh" / f"{name}.csv").chain
        for sample in entry["samples"]:
            error = frames(chain, sample["q"])[-1] - np.array(sample["T"])
            assert np.abs(error).max() <= 1e-12, name


def homogeneous(axis: int, angle: float = 0.0, shift: float = 0.0) -> np.ndarray:
    """A screw motion about x (axis 0) or z (axis 2), written by hand."""
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.eye(4)
    i, j = ((1, 2), (0, 1))[axis == 2]
    matrix[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    matrix[axis, 3] = shift
    return matrix


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_conventions_are_the_textbook_products(read: Reader, convention: str) -> None:
    """Standard is Rz Tz Tx Rx, modified Rx Tx Rz Tz, the row's own numbers in each."""
    rows = [(0.3, 0.0892, 1, np.pi / 2), (0.7 + np.pi / 2, 1, 2, -np.pi / 2)]
    rows += [(np.pi / 3, 0.1 + 0.25, 1.5, 0)]
    expected = np.eye(4)
    for theta, d, a, alpha in rows:
        z, x = homogeneous(2, theta, d), homogeneous(0, alpha, a)
        expected = expected @ (z @ x if convention == "standard" else x @ z)
    chain = read(arm(convention)).chain
    assert frames(chain, [0.3, 0.7, 0.25])[-1] == pytest.approx(expected, abs=1e-14)


def test_numbers_are_those_of_the_text(read: Reader) -> None:
    """Lengths, offsets and limits are exact; the unit is kept."""
    chain = read(arm(units="mm")).chain
    assert chain.unit == "mm"
    assert chain.kinds == ("revolute", "revolute", "prismatic")
    lengths = [m.vector for m in chain.joints[1].before if hasattr(m, "vector")]
    assert lengths[0] == (0, 0, Fraction(223, 2500))
    assert chain.joints[1].limits == (Angle(Fraction(-17, 18)), Angle(Fraction(1)))
    assert chain.joints[2].limits == (0, Fraction(1, 2))


def test_csv_yaml_and_json_are_one_robot(read: Reader) -> None:
    """The same rows through three doors are the same chain."""
    rows = [("0", "0", "1", "-pi/2"), ("0", "1", "0.1", "pi/2"), ("0", "0", "1.5", "0")]
    text = HEADER + "".join(f"{k},R,{','.join(r)}\n" for k, r in enumerate(rows, 1))
    columns = ("theta", "d", "a", "alpha")
    joints = [{"type": "R", **dict(zip(columns, r, strict=True))} for r in rows]
    entries = {"convention": "standard", "name": "arm", "joints": joints}
    first = read("# convention=standard\n" + text, "arm.csv").chain
    assert first == read(text, "arm.csv", convention="standard").chain
    assert first == read(json.dumps(entries), "arm.json").chain
    assert first == read(json.dumps(entries), "arm.yaml").chain


def test_a_negated_joint_turns_backwards(read: Reader) -> None:
    """With sign -1 the joint's variable enters negated, its offset does not."""
    table = HEADER.replace("\n", ",sign\n") + "1,R,{t},0,1,0,{s}\n2,R,0,0,1,0,1\n"
    options = {"convention": "standard", "angle_unit": "rad"}
    forward = read(table.format(t="0.5", s="1"), "a.csv", **options).chain
    backward = read(table.format(t="0.5", s="-1"), "a.csv", **options).chain
    assert frames(backward, [0.3, 0.2])[-1] == pytest.approx(
        frames(forward, [-0.3, 0.2])[-1], abs=1e-15
    )


def test_motions_and_axes_stand_beside_the_numbers(read: Reader) -> None:
    """A row may begin with motions or give its axis; a file may end with motions."""
    text = (
        "convention: standard\ntool: [move 0 0 1/4]\njoints:\n"
        "  - {type: R, a: 1, alpha: 0, d: 0, before: [turn pi/2 about 0 1 0]}\n"
        "  - {type: P, before: [move 0 1 0, turn 30 deg about 1 0 0], axis: 1 2 0}\n"
    )
    chain = read(text).chain
    first, second = chain.joints
    assert [type(m).__name__ for m in first.before] == ["Rotation"]
    assert [type(m).__name__ for m in second.before] == [
        *("Translation", "Translation", "Rotation")
    ]
    assert second.axis == (1, 2, 0)
    assert chain.tool == (Translation((Fraction(0), Fraction(0), Fraction(1, 4))),)


def test_expectations_are_read(read: Reader) -> None:
    """The recorded verdict and counts are typed; null stays None."""
    text = arm() + "expect: {verdict: cuspidal, cusps: 4, nodes: null}\n"
    assert read(text).expect == {"verdict": "cuspidal", "cusps": 4, "nodes": None}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("convention: standard\n", ""), "no convention; state --convention standard"),
        (("standard", "classic"), "is unknown"),
        (("a: 2", "a: 2, a: 3"), "the key .a. twice"),
        (("a: 2", "beta: 2"), "row 2: unknown name .beta."),
        (("a: 2, ", ""), "row 2 a: no value"),
        (("a: 2", "a: [2]"), "row 2 a: a list or mapping"),
        (("alpha: -pi/2", "alpha: -90"), "no unit of angles .row 2 alpha is .-90"),
        (("type: R,", "type: X,"), "row 2 type: the type .X."),
        (("limits: [0, 1/2]", "limits: [1, 1/2]"), "exchange them"),
        (("limits: [0, 1/2]", "limits: 1"), "not a pair"),
        (("units: m\n", "units: inch\n"), "write m or mm"),
        (("name: arm", "name: &x arm"), "an anchor or alias"),
        (("name: arm", "nome: arm"), "unknown name"),
        (("name: arm", "name: {a: 1}"), "a list or mapping"),
        (("joints:", "expect: {verdict: maybe}\njoints:"), "expect verdict: .maybe."),
        (("joints:", "expect: {cusps: many}\njoints:"), "not a count"),
        (("joints:", "tool: move 0 0 1\njoints:"), "tool: no list of motions"),
        (("joints:", "tool: [fly 0 0 1]\njoints:"), "tool 1: .fly 0 0 1. is no motion"),
        (("joints:", "tool: [move 0 1]\njoints:"), "2 numbers in"),
        (("joints:", "tool: [turn 1 about 0 0 1]\njoints:"), "has no unit"),
        (("joints:", "tool: [turn pi about 0 0 0]\njoints:"), "the zero vector"),
        (("a: 2", "axis: 0 0 1, a: 2"), "row 2 axis: a beside axis|theta beside axis"),
        (("a: 2", "before: [[move]], a: 2"), "row 2 before 1: a list or mapping"),
        (("joints:", "task: dance\njoints:"), "the task .dance. is unknown"),
        (("joints:", "title: " + 30 * "[" + "\njoints:"), "too many levels"),
    ],
)
def test_what_is_wrong_is_said_with_its_row(
    read: Reader, change: tuple[str, str], said: str
) -> None:
    """Each mistake in a table is refused on one line that names its cell."""
    assert change[0] in arm()
    with pytest.raises(InvalidRobotError, match=said) as caught:
        read(arm().replace(*change))
    assert "\n" not in str(caught.value)
