from __future__ import annotations

import json
import math
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reexport import reexported
from short_tables import arm, degrees

from cuspaudit.robot.canonical_arm.canonical import canonical
from cuspaudit.robot.canonical_arm.invariants import Invariants, invariants
from cuspaudit.robot.canonical_arm.readings import Reader
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
)
from cuspaudit.robot.fixed_motions import is_algebraic
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.frames import frames
from cuspaudit.robot.relations import relations
from cuspaudit.robot.snap_policy import NO_SNAPPING
from cuspaudit.robot.snapping import faithful, snap
from cuspaudit.robot.virtual_joint import TOOL_AXES

ROBOTS = Path(__file__).parents[3] / "robots"


def in_meters(chain: Chain) -> Chain:
    """The chain with its lengths in m."""
    if chain.unit == "m":
        return chain

    def scaled(motions: tuple[Motion, ...]) -> tuple[Motion, ...]:
        return tuple(
            replace(m, vector=tuple(x / 1000 for x in m.vector))
            if isinstance(m, Translation)
            else m
            for m in motions
        )

    joints = [replace(j, before=scaled(j.before)) for j in chain.joints]
    return replace(chain, joints=tuple(joints), tool=scaled(chain.tool), unit="m")


def structure(chain: Chain) -> set[str]:
    """The relations of its axes, whatever the base."""
    return {word for word in relations(chain) if "the base" not in word}


def written(found: Invariants) -> Chain:
    """The canonical chain of typed numbers, nothing rounded."""
    return canonical(found, Reader(found.floor, 1e-13, False, False)).chain


def own_arms() -> list[Chain]:
    """The arms of robots/, in m."""
    return [in_meters(read_robot(p).chain) for p in sorted(ROBOTS.glob("*.yaml"))]


@pytest.mark.parametrize("chain", own_arms(), ids=lambda chain: chain.name)
def test_the_canonical_chain_is_the_same_arm(chain: Chain) -> None:
    """Base, tip and joint values mean the same in the chain written by invariants."""
    other = written(invariants(chain, NO_SNAPPING))
    rng = np.random.default_rng(0)
    for posture in rng.uniform(-3, 3, (4, len(chain.joints))):
        ours, theirs = (frames(c, posture)[-1] for c in (other, chain))
        assert np.abs(ours - theirs).max() < 1e-9
    assert structure(other) == structure(chain)


@pytest.mark.parametrize(
    ("digits", "turned"),
    [
        (9, True),
        (5, False),
        *(
            pytest.param(digits, turned, marks=pytest.mark.slow)
            for digits, turned in ((17, True), (17, False), (6, True), (5, True))
        ),
    ],
)
def test_link_frames_and_digits_keep_every_relation_of_our_arms(
    digits: int, turned: bool, tmp_path: Path
) -> None:
    """Each of our arms, exported with other frames, snaps to the relations it has."""
    for chain in own_arms():
        meant = snap(chain)[0]
        other = reexported(meant, digits, digits, tmp_path, fixed=turned, turned=turned)
        found = snap(other)[0]
        assert structure(found) == structure(meant), chain.name
        if digits > 6 and is_algebraic(meant):
            assert is_algebraic(found), chain.name


@pytest.mark.slow
@pytest.mark.parametrize("digits", [17, 9, 6, 5])
def test_link_frames_and_digits_keep_every_relation_of_public_arms(
    digits: int, corpus: Path, tmp_path: Path
) -> None:
    """57 public six-joint arms: all at 17 and 9 digits, 98 % at 6, 90 % at 5.

    None gains a relation: what rounds an arm to a structure is never taken for it.
    """
    index = json.loads((corpus / "urdf" / "FK_ORACLE.json").read_text())["robots"]
    kept = number = 0
    for name, entry in index.items():
        path = corpus / "urdf" / f"{name}.urdf"
        chain = read_urdf(path, base=entry["root"], tip=entry["tip"]).chain
        if len(chain.joints) != 6:
            continue
        meant = snap(chain)[0]
        for seed, turned in ((number, False), (number + 1, True)):
            named = replace(meant, name=name, near=())
            other = reexported(
                named, digits, seed, tmp_path, fixed=turned, turned=turned
            )
            found = structure(snap(other)[0])
            assert found <= structure(meant), name
            kept += found == structure(meant)
            number += 1
    assert number > 100
    assert kept >= {17: 1.0, 9: 1.0, 6: 0.98, 5: 0.9}[digits] * number


def test_a_genuine_offset_stays_at_any_number_of_digits(tmp_path: Path) -> None:
    """A wrist whose axes miss each other by 0.35 mm is none at 5 digits either."""
    chain = arm(
        ("0", ".28", "0", "0", "0", "0"),
        ("0", ".01", "0", ".31", ".00035", ".1"),
        (90, 0, 90, 90, 90, 0),
        "RRRRRR",
    )
    chain = replace(chain, task="pose")
    for digits in (17, 9, 6, 5):
        for seed in range(6):
            other = reexported(chain, digits, seed, tmp_path, fixed=True)
            assert "axes 4, 5 and 6 meet in one point" not in structure(snap(other)[0])


@given(
    alpha=st.tuples(*[st.sampled_from((-90, 0, 30, 45, 60, 90, 180))] * 3),
    a=st.tuples(*[st.integers(0, 3)] * 3),
    d=st.tuples(*[st.integers(-2, 2)] * 3),
    kinds=st.sampled_from(("RRR", "RPR", "RRP", "PRR", "PPR", "PRP")),
    seed=st.integers(0, 10**6),
)
def test_frames_keep_special_arms(
    alpha: tuple[int, ...],
    a: tuple[int, ...],
    d: tuple[int, ...],
    kinds: str,
    seed: int,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    """Zero lengths, parallel axes, slides: frames of 9 digits neither add nor lose."""
    chain = arm(a, d, alpha, kinds)
    meant = structure(faithful(chain))
    folder = tmp_path_factory.mktemp("frames")
    other = reexported(chain, 9, seed, folder)
    assert structure(snap(other)[0]) == meant


@pytest.mark.parametrize("kinds", ["RRR", "RPR", "PRR", "RRP", "RPP", "PPR"])
def test_slides_are_written_as_the_arm_they_are(kinds: str) -> None:
    """A slide's line is placed by what follows; the motion of the tip is the same."""
    chain = arm((1, 2, 1), (0, 1, 2), (60, 45, 0), kinds, (0, 25, 0))
    other = written(invariants(chain, NO_SNAPPING))
    rng = np.random.default_rng(1)
    for posture in rng.uniform(-3, 3, (4, 3)):
        ours, theirs = (frames(c, posture)[-1] for c in (other, chain))
        assert np.abs(ours - theirs).max() < 1e-9


def test_nearly_parallel_axes_need_no_kilometers() -> None:
    """A tilt of 1e-4 rad is a turn about y, not an offset of 10 km."""
    tilt = Rotation(Y_AXIS, degrees("0.0057"))
    joints = (
        Joint("a", "revolute"),
        Joint("b", "revolute", (Translation((Fraction(1), *[Fraction(0)] * 2)), tilt)),
        Joint(
            "c", "revolute", (Translation((Fraction(1), *[Fraction(0)] * 2)),), X_AXIS
        ),
    )
    chain = Chain("tilted", joints, (Translation((Fraction(1),) * 3),))
    found = invariants(chain, NO_SNAPPING)
    assert found.rows[0].form == "tilted"
    reach = max(
        abs(x)
        for joint in written(found).joints
        for motion in joint.before
        if isinstance(motion, Translation)
        for x in motion.vector
    )
    assert reach < 10


def test_nothing_depends_on_where_the_first_frames_sit(tmp_path: Path) -> None:
    """Parallel axes before the first common normal have no offset of their own."""
    chain = arm((1, 1, 1), (0, 1, 1), (0, 90, 0), "RRR")
    rows = {
        tuple(
            (float(row.a), str(row.form)) for row in invariants(other, NO_SNAPPING).rows
        )
        for other in (chain, written(invariants(chain, NO_SNAPPING)))
    }
    assert len(rows) == 1


@pytest.mark.parametrize("task", sorted(TOOL_AXES))
def test_the_tool_axis_is_the_last_line(task: str) -> None:
    """Five joints keep tip and tool axis, whichever axis of the tip's frame it is."""
    table = arm((1, 1, 1, 0, 0), (0, 1, 1, 1, 1), (90, 0, 90, 60, 90), "RRRRR")
    turn = Rotation((Fraction(1), Fraction(2), Fraction(2)), degrees(40))
    chain = replace(table, task=task, tool=(*table.tool, turn))  # type: ignore[arg-type]
    other = written(invariants(chain, NO_SNAPPING))
    assert other.task == task
    axis = np.array([float(x) for x in TOOL_AXES[chain.task]])
    for posture in np.random.default_rng(2).uniform(-3, 3, (4, 5)):
        ours, theirs = (frames(c, posture)[-1] for c in (other, chain))
        assert np.abs(ours[:3, 3] - theirs[:3, 3]).max() < 1e-9
        assert np.abs(ours[:3, :3] @ axis - theirs[:3, :3] @ axis).max() < 1e-9


def test_errors_hold_the_numbers_that_were_meant(tmp_path: Path) -> None:
    """At 6 digits every invariant's ball, with its error, holds the true number."""
    chain = arm(("1/5", "2/5", "3/10"), ("0", "1/10", "1/5"), (50, 70, 0), "RRR")
    [*rows] = invariants(chain, NO_SNAPPING).rows
    for seed in range(20):
        other = reexported(chain, 6, seed, tmp_path)
        found = invariants(other, replace(NO_SNAPPING, printed=True)).rows
        for true, ball in zip(rows, found, strict=True):
            for name in ("a", "alpha"):
                exact, seen = getattr(true, name), getattr(ball, name)
                assert abs(float(seen) - float(exact)) <= float(seen.rad()) + 1e-12
                assert float(seen.rad()) < 1e-3 * math.pi


def test_frame_axes_name_the_geometry_of_z_only() -> None:
    """A chain of one direction has one relation for each pair, none for its frames."""
    joints = tuple(Joint(name, "revolute", (), Z_AXIS) for name in "abc")
    chain = Chain("coaxial", joints, (Translation((Fraction(1), *[Fraction(0)] * 2)),))
    assert structure(written(invariants(chain, NO_SNAPPING))) == structure(chain)
