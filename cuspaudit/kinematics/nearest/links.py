"""An arm as its links: how each joint axis lies to the axis before it.

A link holds two axes in a row, and nothing else of the arm matters to its theorems:
not the frames, not the zeros of the joints, not the base. To speak of how far an axis
moves, a place is chosen on each axis, the one where a rope is shortest (in the sum of
squares) that runs from axis to axis to the tip, if the task asks where that is. The
squares are those of distances within one link, so the places are fixed in the links and
do not depend on the posture; nor do they run away where axes are nearly parallel, as
the feet of common normals do. The length of the rope is the reach.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = ["Link", "Vector", "links_of", "reach_of"]

Vector = NDArray[np.float64]

_LEVEL = 1e-6
"""Singular values of the rope's equations below this leave its places as they are."""


@dataclass(frozen=True, eq=False)
class Link:
    """What a joint moves: its own axis, and the axis of the next joint or the tip.

    All vectors are in one frame, that of the base while all joints stand at 0.

    Attributes:
        axis: the unit vector of its own axis.
        step: from the place on its own axis to that on the next one, or to the tip.
        next: the unit vector of the next axis; of the last link, its own.
        is_last: whether the tip comes next.
    """

    axis: Vector
    step: Vector
    next: Vector
    is_last: bool = False

    def with_step(self, step: Vector, next_axis: Vector) -> Link:
        """The link whose next axis lies elsewhere, seen from its own."""
        return replace(self, step=step, next=next_axis)


def links_of(chain: Chain) -> tuple[Link, ...]:
    """The links of ``chain``, base to tip, in floating point.

    The last link, from the last axis to the tip, is there for the task "position"
    only. A virtual joint counts as a joint.
    """
    chain = with_virtual_joint(chain)
    placed = frames(chain, np.zeros(len(chain.joints)))
    axes = [
        frame[:3, :3] @ _unit(np.array([float(x) for x in joint.axis]))
        for joint, frame in zip(chain.joints, placed, strict=False)
    ]
    points = [frame[:3, 3] for frame in placed[:-1]]
    places = _places(chain, axes, points, placed[-1][:3, 3])
    links = [
        Link(axis, after - place, following)
        for (axis, following), (place, after) in zip(
            pairwise(axes), pairwise(places), strict=True
        )
    ]
    if chain.task == "position":
        last = placed[-1][:3, 3] - places[-1]
        links.append(Link(axes[-1], last, axes[-1], is_last=True))
    return tuple(links)


def reach_of(links: Sequence[Link]) -> float:
    """The length of the rope: the sum of the steps."""
    return float(sum(np.linalg.norm(link.step) for link in links))


def _places(
    chain: Chain, axes: Sequence[Vector], points: Sequence[Vector], tip: Vector
) -> list[Vector]:
    """The place on each axis; the axis of a joint that slides may lie anywhere."""
    free = [
        np.eye(3) if joint.kind == "prismatic" else axis[:, None]
        for joint, axis in zip(chain.joints, axes, strict=True)
    ]
    starts = np.cumsum([0, *(columns.shape[1] for columns in free)])
    fixed = [*points, tip] if chain.task == "position" else list(points)
    rows, sides = [], []
    for k, (here, there) in enumerate(pairwise(fixed)):
        block = np.zeros((3, starts[-1]))
        block[:, starts[k] : starts[k + 1]] = -free[k]
        if k + 1 < len(free):
            block[:, starts[k + 1] : starts[k + 2]] = free[k + 1]
        rows.append(block)
        sides.append(here - there)
    found = np.linalg.lstsq(np.vstack(rows), np.concatenate(sides), rcond=_LEVEL)[0]
    return [
        point + columns @ found[starts[k] : starts[k + 1]]
        for k, (point, columns) in enumerate(zip(points, free, strict=True))
    ]


def _unit(vector: Vector) -> Vector:
    return np.asarray(vector / np.linalg.norm(vector), dtype=np.float64)
