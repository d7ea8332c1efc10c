from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest
from axis_structure import structure
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.robot.chain import (
    X_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    reverse,
)
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.relations import relations
from cuspaudit.robot.snapping import snap

QUARTER = Fraction(1, 2)


def step(
    a: Fraction | int, alpha: Fraction | int, d: Fraction | int
) -> tuple[Motion, ...]:
    """Along x and z, then a twist of so many half turns about x."""
    shift = Translation((Fraction(a), Fraction(0), Fraction(d)))
    return shift, Rotation(X_AXIS, Angle(Fraction(alpha)))


def arm(*steps: tuple[Motion, ...], tool: tuple[Motion, ...] = ()) -> Chain:
    """Revolute joints about z, the steps between them."""
    joints = [Joint(f"j{k}", "revolute", before) for k, before in enumerate(steps)]
    return Chain("arm", tuple(joints), tool, "position" if tool else "pose")


def among(chain: Chain) -> list[str]:
    """The relations of the axes among themselves."""
    return sorted(words for words in relations(chain) if "base" not in words)


@pytest.mark.parametrize(
    ("alpha", "word"),
    [
        (QUARTER, "axes 1 and 2 are square"),
        (Fraction(2, 3), "axes 1 and 2 stand at 60 deg"),
        (Fraction(-1, 4), "axes 1 and 2 stand at 45 deg"),
        (Fraction(5, 6), "axes 1 and 2 stand at 30 deg"),
        (1, "axes 1 and 2 are parallel"),
    ],
)
def test_twists(alpha: Fraction | int, word: str) -> None:
    """A twist that has an exact cosine is named, whatever its sign."""
    assert among(arm((), step(1, alpha, 2))) == [word]
    off = Rotation(X_AXIS, Angle(radians=Fraction(1, 10**30)))
    assert among(arm((), (*step(1, alpha, 2), off))) == []


def test_offsets() -> None:
    """An offset along an axis is that between its two common normals."""
    square = step(1, QUARTER, 0)
    assert "no offset along axis 2" in among(arm((), square, square))
    raised = step(1, QUARTER, Fraction(1, 10**30))
    assert "no offset along axis 2" not in among(arm((), square, raised))


def test_offsets_along_parallel_axes() -> None:
    """Parallel axes share one offset: what one step adds another can take away."""
    square, up, down = step(1, QUARTER, 0), step(1, 0, 3), step(1, QUARTER, -3)
    assert "no offset along axes 2 to 3" in among(arm((), square, up, down))
    assert len(among(arm((), square, up, square))) == 3


def test_offset_of_the_tip() -> None:
    """The tip of a position task ends the last axis; that of a pose does not."""
    square = step(1, QUARTER, 0)
    level = arm((), square, tool=step(1, 0, 0))
    assert "no offset along axis 2" in among(level)
    assert "no offset along axis 2" not in among(replace(level, task="pose"))


def test_a_wrist_meets_in_one_point() -> None:
    """Two meeting pairs make a wrist only without an offset between the points."""
    square = step(0, QUARTER, 0)
    assert "axes 1, 2 and 3 meet in one point" in among(arm((), square, square))
    offset = among(arm((), square, step(0, QUARTER, 1)))
    assert "axes 2 and 3 meet" in offset
    assert not any("one point" in words for words in offset)


def test_nothing_is_said_of_an_offset_along_a_sliding_axis() -> None:
    """The offset along a prismatic joint is its value, no relation."""
    square = step(1, QUARTER, 0)
    chain = arm((), square, square)
    joints = list(chain.joints)
    joints[1] = replace(joints[1], kind="prismatic")
    assert "no offset along axis 2" not in among(chain.with_joints(joints))


steps = st.builds(
    step,
    st.sampled_from([0, 1, Fraction(1, 3)]),
    st.sampled_from([0, QUARTER, Fraction(1, 4), Fraction(1, 7)]),
    st.sampled_from([0, 1]),
)


@given(st.lists(steps, min_size=3, max_size=6), st.integers(1, 6), st.integers(-9, 9))
def test_relations_hold_in_every_posture(
    parts: list[tuple[Motion, ...]], at: int, radians: int
) -> None:
    """A turn of a joint changes no relation."""
    chain = arm(*parts)
    k = at % len(parts)
    turn = Rotation(chain.joints[k].axis, Angle(radians=Fraction(radians)))
    joints = list(chain.joints)
    joints[k] = replace(joints[k], before=(*joints[k].before, turn))
    assert relations(chain.with_joints(joints)) == relations(chain)


@given(st.lists(steps, min_size=3, max_size=6))
def test_a_chain_and_its_reverse_have_the_same_relations(
    parts: list[tuple[Motion, ...]],
) -> None:
    """Counted from the tip the relations are as many, and of the same kinds."""
    chain = arm(*parts)
    kinds = [
        sorted("".join(c for c in words if not c.isdigit()) for words in among(c))
        for c in (chain, reverse(chain))
    ]
    assert kinds[0] == kinds[1]


def test_the_words_agree_with_the_structure_of_public_arms(corpus: Path) -> None:
    """Wrist and parallel triples in words are those found in floating point."""
    index = json.loads((corpus / "urdf" / "INDEX.json").read_text())
    for name, entry in index.items():
        if len(entry["dof"]) != 6:
            continue
        path = corpus / "urdf" / f"{name}.urdf"
        chain = snap(read_urdf(path, base=entry["root"], tip=entry["tip"]).chain)[0]
        words = relations(chain)
        aligned = [
            {f"axes {k} and {k + 1} {w}" for w in ("are parallel", "coincide")} & words
            for k in range(1, 6)
        ]
        if "axes 4, 5 and 6 meet in one point" in words:
            found = "a"
        else:
            found = "b" if any(x and y for x, y in pairwise(aligned)) else "c"
        assert found == structure(chain), name
