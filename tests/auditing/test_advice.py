from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.errors import CuspauditError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.regular import is_regular_somewhere
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap

HEAD = "convention: {}\nunits: m\njoints:\n"
FIVE = """\
  - {alpha: 0, a: 0, d: 1, theta: 0}
  - {alpha: pi/2, a: 0, d: 0, theta: 0}
  - {alpha: 0, a: 2, d: 0, theta: 0}
  - {type: P, alpha: pi, a: 3, theta: 0}
  - {alpha: pi/2, a: 0, d: 5, theta: 0}
"""
THREE = """\
  - {alpha: 0, a: 0, d: 0.06}
  - {alpha: pi/2, a: 0.15, d: 0}
  - {alpha: 0, a: 0.15, d: 0}
"""
WRIST = """\
  - {alpha: -pi/2, a: 0.035, d: 0.109}
  - {alpha: 0, a: 0.146, d: 0}
  - {alpha: pi/2, a: 0, d: 0.052}
  - {alpha: -pi/2, a: 0, d: 0.115}
  - {alpha: pi/2, a: 0, d: 0}
  - {alpha: 0, a: 0, d: 0.072}
"""
FOUR = """\
  - {alpha: pi/2, a: 1, d: 0}
  - {alpha: pi/3, a: 2, d: 1}
  - {alpha: pi/2, a: 1, d: 0.5}
  - {alpha: 0, a: 1, d: 0}
"""
PARALLEL = """\
  - {alpha: 0, a: 0, d: 1140}
  - {alpha: 0, a: 460, d: 0}
  - {alpha: 0, a: 1050, d: 0}
  - {alpha: 0, a: 250, d: 1205}
  - {alpha: 0, a: 0, d: 0}
  - {alpha: 0, a: 0, d: 215}
"""
BENT = """\
<robot name="arm"><link name="base"/><link name="l1"/><link name="l2"/><link name="l3"/>
<link name="flange"/><link name="tool tip"/>
<joint name="j1" type="continuous"><parent link="base"/><child link="l1"/>
<axis xyz="0 0 1"/></joint>
<joint name="j2" type="continuous"><parent link="l1"/><child link="l2"/>
<origin xyz="0.1 0 0.2"/><axis xyz="0 1 0"/></joint>
<joint name="j3" type="continuous"><parent link="l2"/><child link="l3"/>
<origin xyz="0.3 0 0"/><axis xyz="1 0 0"/></joint>
<joint name="f" type="fixed"><parent link="l3"/><child link="flange"/>
<origin xyz="0.2 0 0"/></joint>
<joint name="t" type="fixed"><parent link="flange"/><child link="tool tip"/>
<origin xyz="0.1 0 0.1"/></joint></robot>
"""

Ask = Callable[..., Any]


def ask(path: Path, **options: Any) -> str | None:
    """The message that refuses an arm, None when it is audited."""
    try:
        audit(open_robot(path, **options), Options(timeout=1.0))
    except CuspauditError as error:
        return str(error)
    return None


def works(path: Path, **options: Any) -> bool:
    """Whether an arm opens so, and its det J does not vanish identically."""
    chain = open_robot(path, **options).chain
    return is_regular_somewhere(exact_model(snap(chain)[0]))


def write(folder: Path, rows: str, convention: str = "modified") -> Path:
    """A table in a file."""
    path = folder / "arm.yaml"
    path.write_text(HEAD.format(convention) + rows)
    return path


def options_in(said: str, name: str) -> str:
    """The value of an option that a message proposes."""
    words = shlex.split(said.replace(";", " ; ").replace('"', ""))
    return words[words.index(name) + 1]


def test_a_turn_about_the_tool_axis_is_told_its_task_and_a_tool(tmp_path: Path) -> None:
    """Five joints, the last about z of the tip: both proposals lead to an audit."""
    path = write(tmp_path, FIVE)
    said = ask(path)
    assert said is not None
    assert "joint_5 turns about the tool axis itself" in said
    assert options_in(said, "--task") == "position-and-x-axis"
    assert ask(path, task=options_in(said, "--task")) is None
    tool = re.search(r"tool: \[.*?\]", said)
    assert tool is not None
    path.write_text(path.read_text().replace("joints:", f"{tool[0]}\njoints:"))
    assert works(path)


def test_a_tip_on_the_last_axis_is_told_a_tool(tmp_path: Path) -> None:
    """Three joints without a tool: the tool that is proposed makes an arm of them."""
    path = write(tmp_path, THREE)
    said = ask(path)
    assert said is not None
    assert "the tip lies on axis 3" in said
    assert "--tip" not in said
    tool = re.search(r"tool: \[.*?\]", said)
    assert tool is not None
    path.write_text(path.read_text().replace("joints:", f"{tool[0]}\njoints:"))
    assert ask(path) is None


def test_a_flange_on_the_last_axis_is_told_a_link_off_it(tmp_path: Path) -> None:
    """The tip of a URDF that lies on axis 3 gets a link that does not."""
    path = tmp_path / "arm.urdf"
    path.write_text(BENT)
    said = ask(path, tip="flange")
    assert said is not None
    assert "the tip lies on axis 3" in said
    assert options_in(said, "--tip") == "tool tip"
    assert ask(path, tip="tool tip") is None


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_other_convention_is_named_where_it_helps(
    tmp_path: Path, convention: str
) -> None:
    """A wrist table read as modified has axes 5 and 6 on one line; as standard not."""
    said = ask(write(tmp_path, WRIST, convention))
    if convention == "standard":
        assert said is None
    else:
        assert said is not None
        assert "axes 5 and 6 coincide" in said
        assert "perhaps the table is standard" in said


def test_parallel_axes_are_said_and_nothing_is_proposed(tmp_path: Path) -> None:
    """Six parallel axes have no remedy, and none is printed."""
    said = ask(write(tmp_path, PARALLEL, "standard"))
    assert said is not None
    assert "all six axes are parallel" in said
    assert "--" not in said


def test_four_joints_without_an_angle_are_told_which_can_be_locked(
    tmp_path: Path,
) -> None:
    """Every joint that is proposed leaves three that place the tip."""
    path = write(tmp_path, FOUR, "standard")
    said = ask(path)
    assert said is not None
    assert "the tip has no angle" in said
    names = re.search(r"lock one of (.*?) by --lock", said)
    assert names is not None
    for name in shlex.split(names[1].replace(",", " ")):
        assert works(path, lock={name: "0"})


@pytest.mark.parametrize(
    ("rows", "task"), [(FIVE, "pose"), (FOUR, "position"), (WRIST, "position")]
)
def test_a_task_that_does_not_fit_is_told_one_that_does(
    tmp_path: Path, rows: str, task: str
) -> None:
    """The task and the locks that are proposed make the arm square and regular."""
    path = write(tmp_path, rows, "modified" if rows == FIVE else "standard")
    said = ask(path, task=task)
    assert said is not None
    followed = 0
    if "--task" in said:
        assert works(path, task=options_in(said, "--task"))
        followed += 1
    one = re.search(r"lock one of (.*?) by --lock", said)
    names = shlex.split(one[1].replace(",", " ")) if one else []
    held = [{name: "0"} for name in names]
    pasted = re.findall(r"--lock (\S+?)=0", said)
    held += [dict.fromkeys(pasted, "0")] if pasted else []
    for lock in held:
        assert works(path, task=task, lock=lock)
        followed += 1
    assert followed > 0
