"""What may be asked of a chain instead: tasks and joints to lock, each tried first.

A proposal is tried on the snapped chain at a few postures in floating point: where its
Jacobian has full rank at one of them, det J is not 0 everywhere. This finds advice and
decides nothing; an audit tests det J exactly.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations, islice

import numpy as np

from cuspaudit.robot.chain import Angle, Chain, Task
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.snapping import snap
from cuspaudit.robot.task import DIMENSIONS, default_task, lock

__all__ = ["fitting_locks", "fitting_tasks", "is_regular"]

_POSTURES = 4
_RANK = 1e-9
_PARALLEL = 1e-9
_MOST_TRIED = 200


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


def fitting_locks(chain: Chain, count: int, most: int = 50) -> list[tuple[str, ...]]:
    """The first ``most`` sets of ``count`` joints to lock at 0 that leave a task.

    The task is the default one for the joints left.
    """
    left = len(chain.joints) - count
    if left not in DIMENSIONS.values():
        return []
    snapped = snap(chain)[0]
    return list(islice(_locks(replace(snapped, task=default_task(left)), count), most))


def is_regular(chain: Chain) -> bool:
    """Whether the snapped chain moves with the full freedom of its task somewhere."""
    fits = len(chain.joints) == DIMENSIONS[chain.task]
    return fits and _does(snap(chain)[0])


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
