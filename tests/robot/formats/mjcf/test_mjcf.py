from __future__ import annotations

import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from mjcf_arms import Peer, packaged_models

from cuspaudit.api.calls import audit, load
from cuspaudit.errors import AssumptionError, InvalidRobotError
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.formats.mjcf.read import mjcf_candidates, read_mjcf
from cuspaudit.robot.formats.read_robot import chains_in, read_robot
from cuspaudit.robot.frames import frames

ARM = """\
<mujoco model="arm">
  <compiler angle="degree" eulerseq="zYx"/>
  <default>
    <joint axis="0 1 0" range="-90 90"/>
    <default class="roll"><joint axis="1 0 0"/><site quat="1 2 0 1"/>
      <default class="slider">
        <joint type="slide" range="0 0.5" limited="false"/>
      </default>
    </default>
  </default>
  <worldbody>
    <body name="base" pos="0 0 0.1" quat="0.5 0 0 0.866025">
      <frame pos="0.1 0 0" euler="10 20 30">
        <body name="one" axisangle="1 1 0 35">
          <joint name="j1" axis="0 0 1"/>
          <joint name="j2" class="roll" pos="0.01 0.02 0" ref="15"/>
          <body name="two" pos="0 0 0.3" quat="0.3 -0.4 0.1 0.8" childclass="roll">
            <joint name="j3" axis="1 2 2"/>
            <body name="three" pos="0.2 0 0" xyaxes="0 1 0 0 0 1">
              <joint name="j4" class="slider"/>
              <body name="four" pos="0 0.1 0" zaxis="1 0 0">
                <joint name="j5" limited="true" range="-20 400"/>
                <body name="five" pos="0 0.1 0.1" quat="0.707107 0 -0.707107 0">
                  <joint name="j6"/>
                  <frame euler="0 40 0"><site name="turned" pos="0.1 0.2 0.3"/></frame>
                  <site name="aimed" zaxis="-0.3 0.2 -0.5" pos="0 0.1 0"/>
                  <site name="skew" xyaxes="1 2 0.5 -0.4 1 3"/>
                  <site name="upright" xyaxes="0 0 -3 1 2 5"/>
                  <site name="under" zaxis="0 0 -2"/>
                  <site name="rod" type="capsule" size="0.1" class="main"
                    fromto="0.1 0 0 0.3 -0.2 0.5"/>
                  <site name="five"/>
                  <body name="tool tip" pos="0 0 0.1"/>
                </body>
              </body>
            </body>
          </body>
        </body>
      </frame>
    </body>
  </worldbody>
</mujoco>
"""
RADIANS = ARM.replace("degree", "radian").replace('ref="15"', 'ref="0.2"')
EXTRINSIC = ARM.replace("zYx", "XZY")


def write(folder: Path, text: str) -> Path:
    """A model in a file."""
    path = folder / "arm.xml"
    path.write_text(text)
    return path


@pytest.mark.parametrize("text", [ARM, RADIANS, EXTRINSIC])
def test_every_way_to_place_a_body_is_mujoco_s(tmp_path: Path, text: str) -> None:
    """Units, Euler sequences, classes, frames, anchors and references as MuJoCo's."""
    path = write(tmp_path, text)
    chain = read_robot(path).chain
    assert chain.kinds == (*["revolute"] * 3, "prismatic", "revolute", "revolute")
    assert (chain.base, chain.tip, chain.task) == ("world", "tool tip", "pose")
    peer = Peer(path)
    for values in np.random.default_rng(0).uniform(-3, 3, (100, 6)):
        names = [joint.name for joint in chain.joints]
        expected = peer.tip("world", "tool tip", names, values)
        assert np.abs(frames(chain, values)[-1] - expected).max() < 1e-12


SITES = ["turned", "aimed", "skew", "upright", "under", "rod"]


@pytest.mark.parametrize("site", SITES)
@pytest.mark.parametrize("text", [ARM, RADIANS, EXTRINSIC])
def test_a_site_ends_a_chain_where_mujoco_has_it(
    tmp_path: Path, text: str, site: str
) -> None:
    """Any axes, rods, classes and frames around a site give MuJoCo's own frame."""
    path = write(tmp_path, text)
    chain = read_robot(path, tip=site).chain
    names = [joint.name for joint in chain.joints]
    peer = Peer(path)
    for values in np.random.default_rng(1).uniform(-3, 3, (100, 6)):
        expected = peer.tip("world", site, names, values)
        assert np.abs(frames(chain, values)[-1] - expected).max() < 1e-12


def test_sites_are_no_ends_of_their_own(tmp_path: Path) -> None:
    """They are taken by name alone; one with the name of a body by that of both."""
    path = write(tmp_path, ARM)
    assert [one.tip for one in chains_in(path)] == ["tool tip"]
    robot = read_robot(path)
    assert {*SITES, "five/five"} < {chain.tip for chain in robot.beside}
    turn = read_robot(path, tip="five/five").chain.tool
    assert len(turn) == 3  # that of its class alone


SHORT = """\
<mujoco><worldbody><body name="a"><joint name="j1" axis="0 0 1"/>
<body name="b" pos="0.1 0 0"><joint name="j2" axis="0 1 0"/>
<body name="hand" pos="0 0 0.7"><joint name="j3" axis="0 1 0"/>
<site name="grip" pos="0 0 0.5"/></body></body></body></worldbody></mujoco>
"""


def test_a_site_is_proposed_where_the_body_is_no_tip(tmp_path: Path) -> None:
    """The body lies on the last axis: the site is named, and following it decides."""
    robot = load(write(tmp_path, SHORT))
    assert any("--tip grip" in note for note in robot.notes)
    with pytest.raises(AssumptionError, match="give --tip grip"):
        audit(robot)
    assert audit(load(write(tmp_path, SHORT), tip="grip")).verdict == "noncuspidal"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ('zaxis="0 0 0"', "zaxis: the zero vector"),
        ('xyaxes="1 0 0 2 0 0"', "xyaxes: two axes along one line"),
        ('xyaxes="1 0 0 0 0 0"', "xyaxes: the zero vector"),
        ('fromto="1 2 3 1 2 3"', "fromto: the zero vector"),
        ('name="turned"', "its name is already used"),
    ],
)
def test_sites_without_a_frame_are_refused(
    tmp_path: Path, change: str, said: str
) -> None:
    """A direction that is none is said with the site's name and line."""
    old = 'zaxis="0 0 -2"' if "name" not in change else 'name="under" zaxis="0 0 -2"'
    with pytest.raises(InvalidRobotError, match=f"site .* {said}"):
        read_robot(write(tmp_path, ARM.replace(old, change)), tip="tool tip")


def test_limits_follow_classes_and_units(tmp_path: Path) -> None:
    """A range in degrees is exact; limited="false" of a class leaves none."""
    joints = read_mjcf(write(tmp_path, ARM)).chain.joints
    quarter = Angle(Fraction(1, 2))
    assert joints[0].limits == (-quarter, quarter)
    assert joints[3].limits is None
    assert joints[4].limits == (Angle(Fraction(-1, 9)), Angle(Fraction(20, 9)))
    off = ARM.replace('angle="degree"', 'angle="degree" autolimits="false"')
    assert read_mjcf(write(tmp_path, off)).chain.joints[0].limits is None


def test_quarter_turns_of_quaternions_are_exact(tmp_path: Path) -> None:
    """A quaternion of rounded decimals whose parts agree is a multiple of pi/4."""
    chain = read_mjcf(write(tmp_path, ARM)).chain
    [turn] = [m for m in chain.joints[5].before if hasattr(m, "angle")]
    assert turn.angle == Angle(Fraction(-1, 2))


@pytest.mark.skipif(not packaged_models(), reason="no packages with MJCF models")
def test_arms_of_packages_stand_as_in_mujoco() -> None:
    """At least fifteen arms shipped as MJCF: 100 postures each, to 1e-12."""
    arms = 0
    for path in packaged_models():
        peer = Peer(path)
        for candidate in chains_in(path):
            chain = candidate.chain
            if chain is None or len(chain.joints) < 5:
                continue
            names = [joint.name for joint in chain.joints]
            rng = np.random.default_rng(arms)
            for values in rng.uniform(-3, 3, (100, len(names))):
                expected = peer.tip(chain.base, chain.tip, names, values)
                found = frames(chain, values)[-1]
                assert np.abs(found - expected).max() < 1e-12, (path, chain.tip)
            arms += 1
    assert arms >= 15


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("<worldbody>", '<include file="/etc/passwd"/><worldbody>'), "an <include>"),
        (("<mujoco", '<!DOCTYPE m [<!ENTITY e "x">]><mujoco'), "a document type decl"),
        (('pos="0 0 0.3"', 'pos="0 0 1e300"'), "body .two. .* pos: .1e300. is above"),
        (('pos="0 0 0.3"', 'pos="0 0 nan"'), "is not finite"),
        (('pos="0 0 0.3"', 'pos="0 0.3"'), "2 numbers in"),
        (('quat="0.3 -0.4 0.1 0.8"', 'quat="0 0 0 0"'), "the zero quaternion"),
        (('axis="1 2 2"', 'axis="0 0 0"'), "joint .j3. .* axis: the zero vector"),
        (('name="j3"', 'name="j1"'), "its name is already used in line"),
        (('name="three"', 'name="one"'), "its name is already used in line"),
        (('class="roll" pos', 'class="pitch" pos'), "the class .pitch. is not in the"),
        (('name="j3"', 'name="j3" type="ball"'), "a ball joint"),
        (('name="j3"', 'name="j3" type="Hinge"'), "the joint type .Hinge."),
        (("zYx", "zzq"), "the eulerseq .zzq."),
        (('angle="degree"', 'angle="degree" coordinate="global"'), "global coordin"),
        (("<frame", '<frame quat="1 0 0 0"'), "two orientations, quat and euler"),
        (('<default class="roll">', "<default>"), "a default without a class"),
        (("</mujoco>", ""), "no element found"),
        (("<mujoco model", "<sdf model"), "mismatched tag|not mujoco"),
    ],
)
def test_what_is_wrong_is_said_on_one_line(
    tmp_path: Path, change: tuple[str, str], said: str
) -> None:
    """Hostile and broken models are refused by file, element and line."""
    assert change[0] in ARM
    path = write(tmp_path, ARM.replace(*change, 1))
    with pytest.raises(InvalidRobotError, match=said) as caught:
        read_mjcf(path)
    assert "\n" not in str(caught.value)
    assert str(path) in str(caught.value)


def test_deep_nesting_is_refused(tmp_path: Path) -> None:
    """Thousands of nested bodies are one line, no recursion error."""
    text = "<mujoco><worldbody>" + "<body>" * 5000 + "</body>" * 5000
    with pytest.raises(InvalidRobotError, match="nested"):
        read_mjcf(write(tmp_path, text + "</worldbody></mujoco>"))


def test_equalities_are_couplings_or_loops(tmp_path: Path) -> None:
    """A joint tied to another is no free one, and a loop on the chain is refused."""
    tie = '<equality><joint joint1="j6" joint2="j1"/></equality></mujoco>'
    path = write(tmp_path, ARM.replace("</mujoco>", tie))
    with pytest.raises(InvalidRobotError, match=r'it mimics joint "j1", and'):
        read_mjcf(path)
    loop = '<equality><connect body1="five" body2="one"/></equality></mujoco>'
    path = write(tmp_path, ARM.replace("</mujoco>", loop))
    with pytest.raises(InvalidRobotError, match="a <connect> that ties joints"):
        read_mjcf(path)
    off = loop.replace("<connect", '<connect active="false"')
    assert read_mjcf(write(tmp_path, ARM.replace("</mujoco>", off))).chain.joints


def test_a_floating_body_is_a_base(tmp_path: Path) -> None:
    """A body with a free joint begins its chain, and the world does not."""
    text = ARM.replace('0.866025">', '0.866025"><freejoint/>', 1)
    robot = read_mjcf(write(tmp_path, text))
    assert robot.chain.base == "base"
    assert robot.notes == read_mjcf(write(tmp_path, ARM)).notes


def test_the_root_element_chooses_between_urdf_and_mjcf(tmp_path: Path) -> None:
    """Files in .xml are read by what they hold; advice for another ending works."""
    path = write(tmp_path, ARM)
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(ARM)
    with pytest.raises(InvalidRobotError, match=r"an MJCF model: .*rename"):
        read_robot(urdf)
    assert read_robot(urdf.rename(tmp_path / "other.mjcf")).chain.tip == "tool tip"
    assert [one.tip for one in mjcf_candidates(path)] == ["tool tip"]


def test_an_include_is_read_once_mujoco_has_saved_it(tmp_path: Path) -> None:
    """The message names a command; run as it stands, it leaves a file that is read."""
    pytest.importorskip("mujoco")
    inner = "<mujoco>" + ARM.partition("<worldbody>")[2].partition("</worldbody>")[0]
    (tmp_path / "inner.xml").write_text(inner + "</mujoco>")
    head, tail = ARM.partition("<body")[0], ARM.partition("</worldbody>")[2]
    include = '<include file="inner.xml"/>'
    tail = f"</worldbody>{tail}".replace(
        "</mujoco>", '<compiler boundmass="1" boundinertia="1"/></mujoco>'
    )
    path = write(tmp_path, head + include + tail)
    with pytest.raises(InvalidRobotError) as refused:
        read_robot(path)
    program = str(refused.value).partition('python -c "')[2].partition('"')[0]
    command = [sys.executable, "-c", program]
    subprocess.run(command, cwd=tmp_path, check=True, timeout=60)
    chain = read_robot(tmp_path / "whole.xml").chain
    assert chain.kinds == read_robot(write(tmp_path, ARM)).chain.kinds
