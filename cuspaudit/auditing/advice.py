"""What to ask instead, where an arm cannot do what was asked; each piece was tried.

det J of every chain that is proposed was found not to vanish identically, by proof.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

from cuspaudit.errors import CuspauditError
from cuspaudit.kinematics.common_direction import common_direction
from cuspaudit.kinematics.degeneracy import cause_of_degeneracy
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.regular import is_regular_somewhere
from cuspaudit.robot.chain import Chain, Motion, Task, Translation
from cuspaudit.robot.formats.motion_text import format_motion
from cuspaudit.robot.formats.registry import format_of
from cuspaudit.robot.proposals import fitting_locks, fitting_tasks, locks_named
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import snap
from cuspaudit.robot.task import default_task, lock
from cuspaudit.robot.virtual_joint import without_virtual_joint

__all__ = ["advice_on_degeneracy", "advice_without_angle"]

_STEP = {"m": Fraction(1, 10), "mm": Fraction(100)}


def advice_without_angle(model: ExactModel) -> str:
    """Which joints of four may be locked where the tip has no angle, "" for none."""
    locks = _locks(model.chain, "position")
    return f"{locks_named(locks)}, which leaves the task position" if locks else ""


def advice_on_degeneracy(robot: Robot, model: ExactModel) -> str:
    """Why det J vanishes everywhere, and what to ask instead, in one sentence.

    Args:
        robot: as it was read.
        model: of its snapped chain, a virtual joint included.
    """
    chain = without_virtual_joint(model.chain)
    cause = cause_of_degeneracy(model)
    said = "det J vanishes at every posture" + (f": {cause}" if cause else "")
    said += f", so {chain.tip} never moves with the full freedom of the task "
    ways = list(_ways(robot, chain, cause or ""))
    rest = " or ".join(ways) or "no other task, tool or joint to lock was found to help"
    return f"{said}{chain.task}; {rest}"


def _ways(robot: Robot, chain: Chain, cause: str) -> Iterator[str]:
    """What helps, likely help first."""
    other = robot.other_convention
    about_tool = "tool axis" in cause
    if other is not None and not about_tool and _works(snap(other.chain)[0]):
        yield f"perhaps the table is {other.convention}: then det J does not vanish"
    tasks = [task for task in fitting_tasks(chain) if task != chain.task]
    tasks = [task for task in tasks if _works(replace(chain, task=task))]
    if tasks:
        yield f"give --task {tasks[0]}"
    if cause.startswith("the tip") or about_tool:
        yield from _other_tips(robot, chain)
    count = len(chain.joints)
    if count in (4, 5) and not tasks:
        task = default_task(count - 1)
        locks = _locks(chain, task)
        if locks:
            yield f"{locks_named(locks)}, which leaves the task {task}"


def _other_tips(robot: Robot, chain: Chain) -> Iterator[str]:
    """Another point of the last body: a link of a tree, a tool of a table."""
    for other in robot.beside:
        if _works(snap(replace(other, task=chain.task))[0]):
            yield f"give --tip {shlex.quote(other.tip)}"
            return
    known = format_of(Path(robot.file))
    step = _STEP[chain.unit]
    for k in range(3):
        x, y, z = (step if k == axis else Fraction(0) for axis in range(3))
        motion: Motion = Translation((x, y, z))
        if _works(replace(chain, tool=(*chain.tool, motion))):
            text = format_motion(motion)
            if known is None or known.chains is None:
                yield f"give a tool off that axis, such as tool: [{text}]"
            else:
                offset = text.removeprefix("move ")
                found = f"fix a link at {offset} on {chain.tip}, off that axis"
                yield f"{found}, and give it by --tip"
            return


def _works(chain: Chain) -> bool:
    """Whether det J of the chain, which is snapped, does not vanish identically."""
    try:
        model = exact_model(chain)
        if chain.task == "position-and-angle":
            common_direction(model)
        return is_regular_somewhere(model)
    except CuspauditError:
        return False


def _locks(chain: Chain, task: Task) -> list[tuple[str, ...]]:
    """The joints of which one may be locked at 0 so that the task works."""
    found = fitting_locks(chain, 1, task=task)
    return [
        names
        for names in found
        if _works(replace(lock(chain, dict.fromkeys(names, "0")), task=task))
    ]
