from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.formats.read_robot import chains_in, read_robot
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.proposals import is_regular

JOINT = (
    '<joint name="{0}" type="{3}"><parent link="{1}"/><child link="{2}"/>'
    '<origin xyz="{4}"/><axis xyz="{5}"/><limit lower="-1" upper="1"/></joint>'
)
ARM = (
    ("pan", "base", "shoulder", "revolute", "0 0 0.06", "0 0 1"),
    ("lift", "shoulder", "upper", "revolute", "0.03 0 0.05", "0 1 0"),
    ("elbow", "upper", "lower", "revolute", "0.03 0 0.1", "0 1 0"),
    ("pitch", "lower", "wrist", "revolute", "0.13 0 0", "0 1 0"),
    ("roll", "wrist", "gripper", "revolute", "0.06 0 0", "1 0 0"),
)
FRAME = ("frame", "gripper", "tool frame", "fixed", "0.1 0 0", "0 0 1")
JAW = ("jaw", "gripper", "moving_jaw", "revolute", "0.02 0.02 0", "0 0 1")
CAMERA = ("eye", "lower", "camera", "fixed", "0 0 0.1", "0 0 1")

Writer = Callable[..., Path]


@pytest.fixture
def write(tmp_path: Path) -> Writer:
    """A writer of a URDF of joints."""

    def writer(*joints: tuple[str, ...]) -> Path:
        links = dict.fromkeys(name for joint in joints for name in joint[1:3])
        text = "".join(f'<link name="{name}"/>' for name in links)
        text += "".join(JOINT.format(*joint) for joint in joints)
        path = tmp_path / "arm.urdf"
        path.write_text(f'<robot name="arm">{text}</robot>')
        return path

    return writer


def test_a_tool_frame_beside_a_jaw_is_asked_for(write: Writer) -> None:
    """The frame comes first, the jaw is named as one, and the options can be pasted."""
    path = write(*ARM, FRAME, JAW)
    with pytest.raises(InvalidRobotError) as caught:
        read_robot(path)
    said = str(caught.value)
    assert '2 chains may be meant; choose one: --tip "' not in said
    assert re.search(r"one: --tip 'tool frame' \(5 joints, .*; --tip moving_jaw", said)
    assert '"jaw" moves this link alone, a jaw?' in said
    options = re.search("choose one: (.*?) \\(", said)
    assert options is not None
    assert shlex.split(options[1]) == ["--tip", "tool frame"]


def test_a_camera_on_the_forearm_is_no_end(write: Writer) -> None:
    """A frame that carries less than the arm leaves one chain."""
    bare = (*ARM[:4], ("roll", "wrist", "flange", "revolute", "0.06 0 0", "1 0 0"))
    assert read_robot(write(*bare, CAMERA)).chain.tip == "flange"


def test_an_only_end_that_is_called_a_jaw_is_asked_about(write: Writer) -> None:
    """Without a frame beside it the joint may be one of the arm: both are named."""
    path = write(*ARM, JAW, CAMERA)
    with pytest.raises(InvalidRobotError) as asked:
        read_robot(path)
    assert "choose one: --tip gripper (5 joints, task" in str(asked.value)
    assert '--tip moving_jaw (6 joints, task pose, "jaw" moves this' in str(asked.value)
    for tip, count in (("gripper", 5), ("moving_jaw", 6)):
        assert len(read_robot(path, tip=tip).chain.joints) == count
    plain = ("turn", JAW[1], "flange", *JAW[3:])
    assert read_robot(write(*ARM, plain, CAMERA)).chain.tip == "flange"


def test_a_hand_ends_the_arm_and_its_fingers_come_last(write: Writer) -> None:
    """The palm of two fingers is listed before them."""
    fingers = [
        (f"f{k}", "gripper", f"finger {k}", "prismatic", "0 0 0", "0 1 0") for k in "ab"
    ]
    found = chains_in(write(*ARM, *fingers))
    assert [chain.tip for chain in found] == ["gripper", "finger a", "finger b"]
    assert [chain.is_jaw for chain in found] == [False, True, True]
    assert found[0].is_arm


def test_arms_of_a_torso_begin_where_they_fork(write: Writer) -> None:
    """Chains of more than 7 joints from the root begin at the last fork."""
    torso = [
        (f"t{k}", f"t{k}", f"t{k + 1}", "revolute", "0 0 0.3", axis)
        for k, axis in enumerate(("0 0 1", "0 1 0", "0 0 1"))
    ]
    sides = [
        (f"{name} {side}", f"{a}{side}" if k else "t3", f"{b}{side}", *rest)
        for side in "LR"
        for k, (name, a, b, *rest) in enumerate((*ARM, FRAME))
    ]
    found = chains_in(write(*torso, *sides))
    assert [(c.base, c.tip, len(c.joints)) for c in found] == [
        ("t3", "tool frameL", 5),
        ("t3", "tool frameR", 5),
    ]
    assert found[0].options == "--base t3 --tip 'tool frameL'"


@pytest.mark.parametrize("number", range(3))
def test_each_listed_chain_opens_by_its_options(write: Writer, number: int) -> None:
    """What is proposed was tried: the options open an arm whose det J is not 0."""
    seventh = ("extra", "tool frame", "end", "revolute", "0 0.05 0.1", "0 1 1")
    path = write(*ARM, *[(FRAME, JAW), (FRAME,), (FRAME, seventh, JAW)][number])
    tried = 0
    for chain in chains_in(path):
        if chain.task is None:
            continue
        lock = dict.fromkeys(chain.locked, "0")
        robot = open_robot(
            path, base=chain.base, tip=chain.tip, task=chain.task, lock=lock
        )
        assert is_regular(robot.chain)
        tried += 1
    assert tried > 0
