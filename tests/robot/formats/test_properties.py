"""What holds of every chain, and of every text however damaged."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from strategies import chains, damaged, table_texts, urdf_texts

from cuspaudit.errors import CuspauditError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.dh.write import table_text
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.frames import frames
from cuspaudit.robot.snapping import snap

URDF = """<?xml version="1.0"?><robot name="arm"><link name="a"/><link name="b"/>
<link name="c"/><joint name="j" type="revolute"><parent link="a"/><child link="b"/>
<origin xyz="0 0.1 1.5e-3" rpy="1.5708 0 -3.14"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="k" type="prismatic"><parent link="b"/><child link="c"/></joint></robot>"""
TABLE = """convention: standard
units: {length: m, angle: deg}
joints:
  - {type: revolute, a: 1, alpha: -pi/2, d: 3/2, limits: [-1, 1 rad]}
  - {type: P, before: [move 0 0 1, turn pi/2 about 1 0 0], axis: 0 3 4}
tool: [turn 30 deg about 0 0 1]
"""
CSV = "# convention=standard\njoint,type,theta,d,a,alpha\n1,R,0,1,2,pi/2\n2,R,0,0,1,0\n"


def read(content: bytes, ending: str) -> Chain | None:
    """The chain in a file of this content; None when it is refused in one line."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"arm{ending}"
        path.write_bytes(content)
        try:
            chain = read_robot(path).chain
        except CuspauditError as error:
            assert "\n" not in str(error)
            assert str(path) in str(error)
            return None
    snap(chain)
    return chain


@given(chains())
def test_a_chain_comes_back_from_its_file(chain: Chain) -> None:
    """A chain and its robot file have the same words and the same kinematics."""
    back = read(table_text(chain).encode(), ".yaml")
    assert back is not None
    assert (back.name, back.task, back.unit) == (chain.name, chain.task, chain.unit)
    assert [j.name for j in back.joints] == [j.name for j in chain.joints]
    assert back.kinds == chain.kinds
    for posture in np.random.default_rng(0).uniform(-3, 3, (3, len(chain.joints))):
        first, second = frames(chain, posture)[-1], frames(back, posture)[-1]
        assert np.abs(first - second).max() <= 1e-12


@given(chains())
def test_a_file_is_stable(chain: Chain) -> None:
    """What is read from a written file is written the same way again."""
    text = table_text(chain)
    back = read(text.encode(), ".yaml")
    assert back is not None
    again = read(table_text(back).encode(), ".yaml")
    assert again is not None
    assert table_text(again) == table_text(back)


@given(st.data())
def test_damaged_files_are_refused_in_one_line(data: st.DataObject) -> None:
    """Whatever is done to the bytes of a file, it is read or refused by name."""
    for text, ending in ((URDF, ".urdf"), (TABLE, ".yaml"), (CSV, ".csv")):
        read(data.draw(damaged(text)), ending)


@given(urdf_texts())
def test_any_urdf_is_read_or_refused(text: str) -> None:
    """A URDF with any numbers and any tree is read or refused by name."""
    read(text.encode(), ".urdf")


@given(table_texts())
def test_any_table_is_read_or_refused(text: str) -> None:
    """A table with any cells is read or refused by name."""
    read(text.encode(), ".yaml")
