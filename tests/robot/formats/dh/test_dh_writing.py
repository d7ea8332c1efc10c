from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from axis_structure import structure

from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Rotation,
    Translation,
)
from cuspaudit.robot.formats.dh.read import Convention, read_dh
from cuspaudit.robot.formats.dh.step import dh_step
from cuspaudit.robot.formats.dh.write import table_text
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.frames import transform
from cuspaudit.robot.snapping import snap

Back = Callable[[Chain], Chain]
CONVENTIONS: tuple[Convention, ...] = ("standard", "modified")


@pytest.fixture(params=CONVENTIONS)
def back(tmp_path: Path, request: pytest.FixtureRequest) -> Back:
    """The chain that the robot file of a chain is read as, in either convention."""
    convention: Convention = request.param

    def read(chain: Chain) -> Chain:
        path = tmp_path / "arm.yaml"
        text = table_text(chain, convention=convention)
        assert f"convention: {convention}" in text
        path.write_text(text, encoding="utf-8")
        return read_dh(path).chain

    return read


def tips(chain: Chain, postures: np.ndarray) -> np.ndarray:
    """The (n, 4, 4) tip frames at n postures."""
    placed = np.broadcast_to(np.eye(4), (len(postures), 4, 4))
    for joint, values in zip(chain.joints, postures.T, strict=True):
        placed = placed @ transform(joint.before)
        axis = np.array([float(x) for x in joint.axis])
        x, y, z = axis / math.hypot(*axis)
        motion = np.broadcast_to(np.eye(4), (len(values), 4, 4)).copy()
        if joint.kind == "revolute":
            cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            s, k = np.sin(values)[:, None, None], 1 - np.cos(values)[:, None, None]
            motion[:, :3, :3] += s * cross + k * (cross @ cross)
        else:
            motion[:, :3, 3] = values[:, None] * np.array([x, y, z])
        placed = placed @ motion
    return placed @ transform(chain.tool)


def corpus_chains(corpus: Path) -> Iterator[Chain]:
    """The 79 arms of the corpus, with the numbers of their files."""
    oracle = json.loads((corpus / "urdf" / "FK_ORACLE.json").read_text())["robots"]
    for name, entry in oracle.items():
        path = corpus / "urdf" / f"{name}.urdf"
        yield read_urdf(path, base=entry["root"], tip=entry["tip"]).chain


def same_words(first: Chain, second: Chain) -> bool:
    """Whether names, kinds, limits, task and unit agree."""

    def words(chain: Chain) -> Chain:
        joints = [replace(joint, before=(), axis=Z_AXIS) for joint in chain.joints]
        return replace(chain, joints=tuple(joints), tool=())

    return words(first) == words(second)


@pytest.mark.slow
def test_every_arm_comes_back(corpus: Path, back: Back) -> None:
    """79 arms, literal and snapped, come back with equal tips at 100 postures."""
    rng = np.random.default_rng(0)
    worst = 0.0
    for literal in corpus_chains(corpus):
        for chain in (literal, snap(literal)[0]):
            found = back(chain)
            assert same_words(found, chain), chain.name
            postures = rng.uniform(-math.pi, math.pi, (100, len(chain.joints)))
            error = np.abs(tips(found, postures) - tips(chain, postures)).max()
            worst = max(worst, float(error))
    assert worst <= 1e-14


def test_snapping_an_arm_that_came_back_changes_as_little(
    corpus: Path, back: Back
) -> None:
    """A literal file snaps to the model that its URDF snaps to, within the rounding."""
    rng = np.random.default_rng(1)
    for literal in corpus_chains(corpus):
        postures = rng.uniform(-math.pi, math.pi, (5, len(literal.joints)))
        first, record = snap(literal)
        second, again = snap(back(literal))
        error = np.abs(tips(first, postures) - tips(second, postures)).max()
        rounding = sum(entry.error or 0.0 for entry in record)
        assert error <= 1e-5 + rounding, literal.name
        if len(literal.joints) == 6:
            assert structure(second) == structure(first), literal.name
        if all(entry.error is None for entry in record):
            assert len(again) <= len(record)


def test_tables_come_back_as_tables(corpus: Path, back: Back) -> None:
    """A published D-H table is written without a single extra motion."""
    rng = np.random.default_rng(2)
    for path in sorted((corpus / "dh").glob("*.csv")):
        chain = read_robot(path).chain
        for convention in CONVENTIONS:
            text = table_text(snap(chain)[0], convention=convention)
            assert "before" not in text and "axis" not in text, path.name
        postures = rng.uniform(-1, 1, (20, len(chain.joints)))
        error = tips(back(chain), postures) - tips(chain, postures)
        assert np.abs(error).max() <= 1e-14


def test_a_ur_is_the_table_of_its_data_sheet(corpus: Path) -> None:
    """The snapped URDF of a UR5e gives the lengths and twists everybody knows."""
    chain = snap(next(c for c in corpus_chains(corpus) if c.name == "ur5e"))[0]
    rows = [line for line in table_text(chain).splitlines() if "type:" in line]
    found = [(cell(row, "a"), cell(row, "alpha"), cell(row, "d")) for row in rows]
    lengths = [0, 0.1625, 0.425, 0.3922, 0.1333, 0.0997, 0.0996]
    assert {round(abs(float(v)), 4) for a, _, d in found for v in (a, d)} == {*lengths}
    twists = [alpha.lstrip("-") for _, alpha, _ in found]
    assert twists == ["pi/2", "0", "0", "pi/2", "pi/2", "0"]


def test_the_same_numbers_stand_a_row_later_in_the_modified_convention(
    corpus: Path,
) -> None:
    """A twist and its length are in the row after them; theta and d stay."""
    chain = snap(next(c for c in corpus_chains(corpus) if c.name == "ur5e"))[0]
    standard, modified = (
        [row for row in table_text(chain, "", "", c).splitlines() if "type:" in row]
        for c in CONVENTIONS
    )
    for column in ("a", "alpha"):
        first = [cell(row, column) for row in standard]
        second = [cell(row, column) for row in modified]
        assert second == ["0", *first[:-1]]
    assert [cell(r, "d") for r in standard] == [cell(r, "d") for r in modified]


def test_the_base_and_the_tool_of_a_modified_table(back: Back) -> None:
    """What a convention cannot say in its rows stands in before and tool."""
    base = (
        Translation((Fraction(0), Fraction(0), Fraction(1))),
        Translation((Fraction(2), Fraction(0), Fraction(0))),
        Rotation(X_AXIS, Angle(Fraction(1, 2))),
        Rotation(Z_AXIS, Angle(radians=Fraction(1, 10))),
    )
    chain = Chain("arm", (Joint("j", "revolute", base),), base)
    rng = np.random.default_rng(3)
    postures = rng.uniform(-3, 3, (10, 1))
    error = tips(back(chain), postures) - tips(chain, postures)
    assert np.abs(error).max() <= 1e-14


def cell(row: str, column: str) -> str:
    """The text of a column in a row."""
    return row.split(f" {column}: ")[1].split(",")[0].rstrip("}")


def test_nearly_parallel_axes_keep_their_numbers() -> None:
    """A twist of 1e-9 rad between offset axes is no step: lengths would blow up."""
    twist = Rotation(X_AXIS, Angle(radians=Fraction(1, 10**9)))
    aside = Translation((Fraction(1), Fraction(1, 1000), Fraction(0)))
    assert dh_step((aside, twist)) is None
    along = Translation((Fraction(1), Fraction(0), Fraction(2)))
    step = dh_step((along, twist))
    assert step is not None
    assert (step.a, step.d, step.alpha) == (1, 2, twist.angle)


@pytest.mark.parametrize("text", ["null_", "a b", 'x"y', "é: {1}", "# no", "a\tb\x7f"])
def test_names_are_only_names(text: str, back: Back) -> None:
    """What a robot, link or joint is called comes back as it was."""
    joint = Joint(text, "revolute", (), (Fraction(1), Fraction(1), Fraction(0)))
    chain = Chain(text, (joint,), base=text, tip=text)
    assert back(chain) == chain
