from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cuspaudit.errors import InvalidRobotError, UnsupportedJointError
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.frames import frames
from cuspaudit.robot.robot import Robot

Reader = Callable[..., Robot]


def joint(
    name: str, parent: str, child: str, kind: str = "revolute", **parts: str
) -> str:
    """A <joint> with an element for each of ``parts``."""
    body = "".join(f"<{part} {text}/>" for part, text in parts.items())
    links = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{links}{body}</joint>\n'


LIMIT = 'lower="-1" upper="2.5"'
THREE = (
    joint("j1", "l0", "l1", axis='xyz="0 0 1"', limit=LIMIT)
    + joint("j2", "l1", "l2", origin='xyz="1 0 0" rpy="-1.57 0 0"', limit=LIMIT)
    + joint("j3", "l2", "l3", axis='xyz="0.6 0 0.8"', limit=LIMIT)
)
FLANGE = joint("jt", "l3", "tip", "fixed", origin='xyz="1.5 0 0"')


@pytest.fixture
def read(tmp_path: Path) -> Reader:
    """A reader of the URDF with the given joints and links."""

    def reader(joints: str, links: str = "l0 l1 l2 l3 tip", **options: str) -> Robot:
        declared = "".join(f'<link name="{name}"/>' for name in links.split())
        path = tmp_path / "arm.urdf"
        path.write_text(f'<robot name="arm">\n{declared}{joints}</robot>')
        return read_urdf(path, **options)

    return reader


def test_forward_kinematics_of_real_files(corpus: Path) -> None:
    """All 79 public URDFs import, and place their tips where pinocchio does."""
    oracle = json.loads((corpus / "urdf" / "FK_ORACLE.json").read_text())["robots"]
    assert len(oracle) == 79
    for name, entry in oracle.items():
        path = corpus / "urdf" / f"{name}.urdf"
        chain = read_urdf(path, base=entry["root"], tip=entry["tip"]).chain
        assert [j.name for j in chain.joints] == entry["joints"]
        for sample in entry["samples"]:
            posture = [sample["q"][name] for name in entry["joints"]]
            error = frames(chain, posture)[-1] - np.array(sample["T_root_tip"])
            assert np.abs(error).max() <= 1e-12, name


def test_defaults_and_exact_numbers(read: Reader) -> None:
    """The default axis is x, decimals are exact, rational axes are unit, tools fold."""
    robot = read(THREE + FLANGE)
    chain = robot.chain
    assert chain.joints[1].axis == (1, 0, 0)
    assert chain.joints[2].axis == (Fraction(3, 5), 0, Fraction(4, 5))
    assert chain.joints[1].before[1].angle == Angle(radians=Fraction(-157, 100))
    assert chain.joints[0].limits == (
        Angle(radians=Fraction(-1)),
        Angle(radians=Fraction(5, 2)),
    )
    assert (chain.base, chain.tip, chain.task) == ("l0", "tip", "position")
    assert frames(chain, [0, 0, 0])[-1][0, 3] == pytest.approx(2.5)
    assert robot.notes == ()


def test_roll_pitch_yaw_is_yaw_pitch_roll(read: Reader) -> None:
    """The rotation of rpy="r p y" is Rz(y) Ry(p) Rx(r)."""
    turned = FLANGE.replace("0 0", "0 0").replace('"/>', '" rpy="0.1 0.2 0.3"/>')
    turned = joint("jt", "l3", "tip", "fixed", origin='rpy="0.1 0.2 0.3"')
    rotation = frames(read(THREE + turned).chain, [0, 1.57, 0])[-1][:3, :3]
    pitch = -np.arcsin(rotation[2, 0])
    roll = np.arctan2(rotation[2, 1], rotation[2, 2])
    yaw = np.arctan2(rotation[1, 0], rotation[0, 0])
    assert [roll, pitch, yaw] == pytest.approx([0.1, 0.2, 0.3])


def test_continuous_and_prismatic(read: Reader) -> None:
    """A continuous joint turns without limits; a prismatic one has lengths for them."""
    text = THREE.replace('"revolute"', '"continuous"', 1)
    text = text.replace('name="j3" type="revolute"', 'name="j3" type="prismatic"')
    chain = read(text + FLANGE).chain
    assert chain.kinds == ("revolute", "revolute", "prismatic")
    assert chain.joints[0].limits is None
    assert chain.joints[2].limits == (-1, Fraction(5, 2))


def test_a_frame_at_the_base_is_no_tip(read: Reader) -> None:
    """A leaf that fewer joints carry leaves the tip unambiguous."""
    text = THREE + FLANGE + joint("jb", "l0", "mount", "fixed")
    assert read(text, "l0 l1 l2 l3 tip mount").chain.tip == "tip"


def test_two_tools_matter_to_a_position(read: Reader) -> None:
    """Two tips in different places are listed for a position task."""
    text = THREE + FLANGE + joint("ju", "l3", "cam", "fixed")
    links = "l0 l1 l2 l3 tip cam"
    with pytest.raises(InvalidRobotError, match="one: --tip tip; --tip cam"):
        read(text, links)
    assert read(text, links, tip="cam").chain.tool == ()


def test_two_tools_do_not_matter_to_a_pose(read: Reader) -> None:
    """For a pose task one tip is taken among rigidly joined ones, with a note."""
    text = THREE + FLANGE + joint("ju", "l3", "cam", "fixed")
    robot = read(text, "l0 l1 l2 l3 tip cam", task="pose")
    assert robot.notes == ('tip "tip" taken among "tip", "cam"',)


def test_branches_are_listed(read: Reader) -> None:
    """Fingers that move make the tip a choice, and the palm is named."""
    text = THREE + joint("f1", "l3", "a", "prismatic") + joint("f2", "l3", "b")
    with pytest.raises(InvalidRobotError, match=r"3 chains .*: --tip l3 .3 j"):
        read(text, "l0 l1 l2 l3 a b")
    assert read(text, "l0 l1 l2 l3 a b", tip="l3").chain.tip == "l3"


def test_a_mimic_joint_counts_only_on_the_chain(read: Reader) -> None:
    """A mimic joint that turns a tool is refused, beside the chain it is ignored."""
    mimic = joint("m", "l3", "l4", mimic='joint="j1"')
    tool = joint("jt", "l4", "tip", "fixed", origin='xyz="0 1.5 0"')
    links = "l0 l1 l2 l3 l4 tip"
    with pytest.raises(UnsupportedJointError, match=r'joint "m" .*mimics joint "j1"'):
        read(THREE + mimic + tool, links)
    assert len(read(THREE + mimic + tool, links, tip="l3").chain.joints) == 3
    assert len(read(THREE + mimic + tool, links, tip="l4").chain.joints) == 3


def test_a_mimic_joint_of_nothing_is_refused(read: Reader) -> None:
    """The joint that is mimicked has to be in the file."""
    with pytest.raises(InvalidRobotError, match=r'mimics joint "j9", which is not in'):
        read(THREE + joint("m", "l3", "tip", mimic='joint="j9"'))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (('<child link="l3"/>', '<child link="l9"/>'), "not declared"),
        (('<child link="l3"/>', '<child link="l1"/>'), "already that of joint"),
        (('<parent link="l0"/>', '<parent link="l1"/>'), "the same link"),
        (('<parent link="l0"/>', '<parent link="tip"/>'), "form a loop"),
        (('name="j2"', 'name="j1"'), "already used in line 2"),
        (('"revolute"', '"planar"'), "the joint type .planar."),
        (('"revolute"', '"Revolute"'), "write .revolute."),
        (('type="revolute"', ""), "no type"),
        (('xyz="0 0 1"', 'xyz="0 0 0"'), "zero vector"),
        (('xyz="1 0 0"', 'xyz="1 0"'), "2 numbers"),
        (('xyz="1 0 0"', 'xyz=""'), "is empty"),
        (('xyz="1 0 0"', 'xyz="${a} 0 0"'), "expand it first"),
        (("-1.57", "pi/2"), "origin rpy: .pi/2. is not a number"),
        (('lower="-1"', 'lower="3"'), "exchange them"),
        (("</joint>", "", 1), "mismatched tag"),
    ],
)
def test_what_is_wrong_is_said_with_its_joint(
    read: Reader, change: tuple[str, ...], said: str
) -> None:
    """Each mistake in a URDF is refused on one line that names its place."""
    old, new, *_ = change
    text = THREE + FLANGE
    assert old in text
    with pytest.raises(InvalidRobotError, match=said) as caught:
        read(text.replace(old, new, 1))
    assert "\n" not in str(caught.value)


def test_no_document_type(tmp_path: Path) -> None:
    """A DTD is refused where it begins; no entity is defined, no file opened."""
    path = tmp_path / "arm.urdf"
    path.write_text(
        '<!DOCTYPE robot [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n<robot>&x;</robot>'
    )
    with pytest.raises(InvalidRobotError, match="no DTD or entities") as caught:
        read_urdf(path)
    assert "/bin" not in str(caught.value)


def test_a_folder_or_missing_file(tmp_path: Path) -> None:
    """A folder and a missing file are refused by name."""
    with pytest.raises(InvalidRobotError, match="not a regular file"):
        read_urdf(tmp_path)
    with pytest.raises(InvalidRobotError, match="No such file"):
        read_urdf(tmp_path / "none.urdf")


def test_text_before_the_declaration_gets_advice_that_works(tmp_path: Path) -> None:
    """A warning printed before <?xml is named; without it the file reads."""
    body = THREE + FLANGE
    links = "".join(
        f'<link name="{name}"/>' for name in ("l0", "l1", "l2", "l3", "tip")
    )
    good = f'<?xml version="1.0"?>\n<robot name="arm">{links}{body}</robot>'
    path = tmp_path / "arm.urdf"
    path.write_text("xacro: in-order processing became default\n" + good)
    with pytest.raises(InvalidRobotError, match=r"42 bytes before <.xml; delete"):
        read_urdf(path)
    path.write_text(good)
    assert read_urdf(path).chain.tip == "tip"
