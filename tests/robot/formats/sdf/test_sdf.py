from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.formats.read_robot import chains_in, read_robot
from cuspaudit.robot.frames import frames
from tests.robot.formats.sdf.sdf_arms import ROWS, placed, sdf_text, urdf_text


def write(folder: Path, text: str, name: str = "arm.sdf") -> Path:
    """A model in a file."""
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize("style", ["joints", "model", "frames", "old"])
def test_a_model_stands_as_the_urdf_of_the_arm(tmp_path: Path, style: str) -> None:
    """Poses on joints, on the model, on frames and axes of SDF 1.4: one motion."""
    chain = read_robot(write(tmp_path, sdf_text(style)), tip="tool").chain
    other = read_robot(write(tmp_path, urdf_text(), "arm.urdf")).chain
    assert chain.kinds == other.kinds == ("revolute",) * 4 + ("prismatic", "revolute")
    for values in np.random.default_rng(0).uniform(-3, 3, (100, 6)):
        found = frames(chain, values)[-1]
        assert np.abs(found - frames(other, values)[-1]).max() < 1e-12
        assert np.abs(found - placed(values)).max() < 1e-12


def test_poses_on_joints_keep_the_numbers_of_the_file(tmp_path: Path) -> None:
    """What two ways share cancels: the chain of a converted URDF is that URDF's."""
    chain = read_robot(write(tmp_path, sdf_text("joints")), tip="tool").chain
    other = read_robot(write(tmp_path, urdf_text(), "arm.urdf")).chain
    assert [joint.before for joint in chain.joints] == [j.before for j in other.joints]
    assert [joint.axis for joint in chain.joints] == [j.axis for j in other.joints]
    assert [joint.limits for joint in chain.joints] == [j.limits for j in other.joints]
    assert chain.tool == other.tool


def test_degrees_and_quaternions_are_exact(tmp_path: Path) -> None:
    """A pose in degrees has multiples of pi; a quaternion is x, y, z, w."""
    text = sdf_text("joints")
    first = '<pose relative_to="base">'
    assert first in text
    degrees = text.replace(first, '<pose relative_to="base" degrees="true">')
    turn = read_robot(write(tmp_path, degrees)).chain.joints[0].before[-1]
    assert turn.angle == Angle(Fraction(ROWS[0][1].split()[0]) / 180)
    pose = '<pose relative_to="base" rotation_format="quat_xyzw">0 0 1 .5 0 0 .5</pose>'
    start, end = text.index(first), text.index("</pose>", text.index(first)) + 7
    chain = read_robot(write(tmp_path, text[:start] + pose + text[end:])).chain
    assert chain.joints[0].before[-1].angle == Angle(Fraction(1, 2))


def test_a_frame_ends_a_chain_where_it_is_named(tmp_path: Path) -> None:
    """Without its name the last link is the tip, and frames stand beside it."""
    path = write(tmp_path, sdf_text("joints"))
    robot = read_robot(path)
    assert (robot.chain.base, robot.chain.tip) == ("base", "l6")
    assert [chain.tip for chain in robot.beside] == ["tool"]
    assert [one.tip for one in chains_in(path)] == ["l6"]


MIMIC = """\
<mimic joint="j1"><multiplier>-1</multiplier><offset>0.5</offset>
<reference>0.25</reference></mimic>
"""


def test_a_mimic_joint_is_a_coupling(tmp_path: Path) -> None:
    """Its value is m (x - reference) + offset: 0.75 where its driver is at 0."""
    rows = ['<link name="l0"/>']
    for k, (z, axis) in enumerate(((0, "0 0 1"), (1, "0 1 0"), (1, "0 1 0")), 1):
        rows.append(_row(k, z, axis, ""))
    rows += [_row(4, 1, "0 1 0", MIMIC), _row(5, 0, "0 1 0", "")]
    text = f'<sdf version="1.11"><model name="m">{"".join(rows)}</model></sdf>'
    robot = read_robot(write(tmp_path, text), task="position-and-angle")
    assert robot.notes[0].startswith("j4 mimics j1 about the axis of j5")
    [turn] = [m for m in robot.chain.joints[3].before if hasattr(m, "angle")]
    assert turn.angle == Angle(radians=Fraction(3, 4))


def _row(k: int, z: int, axis: str, inside: str) -> str:
    return (
        f'<link name="l{k}"><pose relative_to="j{k}"/></link>'
        f'<joint name="j{k}" type="revolute"><parent>l{k - 1}</parent>'
        f'<child>l{k}</child><pose relative_to="l{k - 1}">0 0 {z} 0 0 0</pose>'
        f"<axis><xyz>{axis}</xyz>{inside}</axis></joint>"
    )


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("<link", "<include><uri>model://x</uri></include><link", "an <include>"),
        ("<sdf", '<!DOCTYPE s [<!ENTITY e "x">]><sdf', "a document type declaration"),
        (
            'relative_to="base"',
            'relative_to="nowhere"',
            "stands on .nowhere., which is",
        ),
        ('relative_to="base"', 'relative_to="j2"', "goes round in a loop"),
        ("<child>l2</child>", "<child>l3</child>", "already that of joint"),
        ("<child>l2</child>", "", "joint .j2. .* no child"),
        ("<child>l2</child>", "<child>elbow</child>", "its child .elbow. is no link"),
        ("<parent>base</parent>", "<parent>l6</parent>", "form a loop"),
        ("<xyz>0 0 1</xyz>", "<xyz>0 0 0</xyz>", "axis xyz: the zero vector"),
        ("<xyz>0 0 1</xyz>", "<xyz>0 1</xyz>", "2 numbers"),
        ("<xyz>0 0 1</xyz>", '<xyz expressed_in="q">0 0 1</xyz>', "expressed in .q."),
        ("<xyz>0 0 1</xyz>", "<xyz>0 0 nan</xyz>", "is not finite"),
        ('type="prismatic"', 'type="screw"', "the joint type .screw."),
        ('type="prismatic"', "", "the joint type"),
        ('name="j2"', 'name="j1"', "its name is already used"),
        ("</model>", '<model name="hand"/></model>', "a model inside a model"),
        ("</model>", "</modle>", "mismatched tag"),
        ("<sdf", "<robot", "mismatched tag|not sdf"),
    ],
)
def test_what_is_wrong_is_said_on_one_line(
    tmp_path: Path, old: str, new: str, said: str
) -> None:
    """Each breach names the element and its line, and nothing outside is opened."""
    text = sdf_text("joints")
    assert old in text
    with pytest.raises(InvalidRobotError, match=said) as refused:
        read_robot(write(tmp_path, text.replace(old, new, 1)))
    assert "\n" not in str(refused.value)


def test_two_models_are_asked_about(tmp_path: Path) -> None:
    """A world with two arms names both."""
    model = sdf_text("joints").partition("<model")[2].rpartition("</sdf>")[0]
    world = (
        f'<sdf version="1.9"><world name="w"><model{model}<model{model}</world></sdf>'
    )
    with pytest.raises(InvalidRobotError, match="2 models with joints; leave one of"):
        read_robot(write(tmp_path, world))
