"""What may be asked of a chain instead: tasks and joints to lock, each tried first.

A proposal is tried on the snapped chain at a few postures in floating point: where its
Jacobian has full rank at one of them, det J is not 0 everywhere. This finds advice and
decides nothing; an audit tests det J exactly.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, islice

import numpy as np

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Angle, Chain, Task
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.place import listing, quoted
from cuspaudit.robot.snapping import snap
from cuspaudit.robot.task import DIMENSIONS, default_task, lock

__all__ = ["check_task", "fitting_locks", "fitting_tasks", "is_regular", "locks_named"]

_POSTURES = 4
_RANK = 1e-9
_PARALLEL = 1e-9
_MOST_TRIED = 200
_TOO_FEW = "an arm of at least 3 joints is needed"
_NO_REMEDY = "no other task and no joints to lock were found that leave it free to move"


def check_task(chain: Chain, file: str | None = None) -> None:
    """Check that the task has as many dimensions as the chain has joints.

    Args:
        chain: the chain, joints locked or not.
        file: what the message begins with; by default the robot's name.

    Raises:
        InvalidRobotError: it has not; the message says what to ask or to lock.
    """
    joints, dimension = len(chain.joints), DIMENSIONS[chain.task]
    if joints == dimension:
        return
    count = "1 joint" if joints == 1 else f"{joints} joints"
    found = f"{count} for a {chain.task} task of {dimension} dimensions"
    raise InvalidRobotError(
        file=file or quoted(chain.name),
        found=found,
        expected=" or ".join(_remedies(chain))
        or (_TOO_FEW if joints < 3 else _NO_REMEDY),
    )


def locks_named(locks: Sequence[tuple[str, ...]]) -> str:
    """The options that lock the joints, for a message."""
    if len(locks[0]) > 1:
        words = (f"--lock {shlex.quote(f'{name}=0')}" for name in locks[0])
        return f"give {' '.join(words)}"
    names = [name for [name] in locks]
    if len(names) == 1:
        return f"give --lock {shlex.quote(f'{names[0]}=0')}"
    return f"lock one of {listing(names)} by --lock JOINT=VALUE (each was tried at 0)"


def fitting_tasks(chain: Chain) -> list[Task]:
    """The tasks of as many dimensions as there are joints that the arm can do.

    The default one is first when it is among them.
    """
    count = len(chain.joints)
    snapped = snap(chain)[0]
    names = sorted(
        (task for task, dimension in DIMENSIONS.items() if dimension == count),
        key=lambda task: task != default_task(count),
    )
    return [task for task in names if _does(replace(snapped, task=task))]


def fitting_locks(
    chain: Chain, count: int, most: int = 50, task: Task | None = None
) -> list[tuple[str, ...]]:
    """The first ``most`` sets of ``count`` joints to lock at 0 that leave a task.

    Args:
        chain: the chain.
        count: how many joints to lock.
        most: how many sets are wanted.
        task: the task; by default the one for the joints left.
    """
    left = len(chain.joints) - count
    if left not in DIMENSIONS.values():
        return []
    held = replace(snap(chain)[0], task=task or default_task(left))
    names = [joint.name for joint in chain.joints]
    found = list(islice(_locks(held, count), most))
    return sorted(found, key=lambda locked: [names.index(name) for name in locked])


def is_regular(chain: Chain) -> bool:
    """Whether the snapped chain moves with the full freedom of its task somewhere."""
    fits = len(chain.joints) == DIMENSIONS[chain.task]
    return fits and _does(snap(chain)[0])


def _remedies(chain: Chain) -> Iterator[str]:
    """What makes the task of a chain square: another task, or joints to lock."""
    joints, dimension = len(chain.joints), DIMENSIONS[chain.task]
    tasks = fitting_tasks(chain)
    if tasks:
        yield f"give --task {tasks[0]}"
    if joints > dimension:
        locks = fitting_locks(chain, joints - dimension, task=chain.task)
        if locks:
            yield locks_named(locks)


def _locks(chain: Chain, count: int) -> Iterator[tuple[str, ...]]:
    names = [joint.name for joint in chain.joints]
    zeros = {
        joint.name: Angle() if joint.kind == "revolute" else "0"
        for joint in chain.joints
    }
    # joint 3 is the one that most arms of seven joints have to spare
    order = sorted(names, key=lambda name: abs(names.index(name) - 2))
    for chosen in islice(combinations(order, count), _MOST_TRIED):
        if _does(lock(chain, {name: zeros[name] for name in chosen})):
            yield tuple(sorted(chosen, key=names.index))


def _does(chain: Chain) -> bool:
    """Whether the Jacobian has full rank at one of a few postures."""
    rng = np.random.default_rng(0)
    size = _size(chain)
    if chain.task == "position-and-angle" and not _has_angle(chain):
        return False
    for _ in range(_POSTURES):
        posture = rng.uniform(-3, 3, len(chain.joints))
        slides = [kind == "prismatic" for kind in chain.kinds]
        posture[slides] *= size
        J = jacobian(chain, posture)
        J[:3] /= size
        J[:, slides] *= size
        values = np.linalg.svd(J, compute_uv=False)
        if values[-1] > _RANK * max(values[0], 1e-300):
            return True
    return False


def _has_angle(chain: Chain) -> bool:
    """Whether all axes that turn are parallel, or the last three and across axis 1."""
    posture = np.random.default_rng(1).uniform(-3, 3, len(chain.joints))
    placed = frames(chain, posture)
    axes = [
        frame[:3, :3] @ (axis / np.linalg.norm(axis))
        for joint, frame in zip(chain.joints, placed, strict=False)
        if joint.kind == "revolute"
        for axis in [np.array([float(x) for x in joint.axis])]
    ]
    across = [np.linalg.norm(np.cross(axis, axes[-1])) for axis in axes]
    if not axes or max(across[1:], default=0) > _PARALLEL:
        return False
    yaws = len(axes) == 4 and abs(float(axes[0] @ axes[-1])) < _PARALLEL
    return bool(across[0] < _PARALLEL or yaws)


def _size(chain: Chain) -> float:
    """A length of the chain's own, so that its Jacobian is well scaled."""
    placed = frames(chain, np.zeros(len(chain.joints)))
    origins = np.vstack([np.zeros(3), placed[:, :3, 3]])
    return float(np.linalg.norm(np.diff(origins, axis=0), axis=1).sum()) or 1.0
