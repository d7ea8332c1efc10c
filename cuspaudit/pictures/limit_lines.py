"""The sides of the box that joint limits make, on the plane of joints 2 and 3.

A joint without limits has none. A side runs along the whole range of the other joint, a
full turn where that has no limits. A range of more than a turn comes back to itself:
its sides say where it ends, not what it holds.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cuspaudit.auditing.limits.joint_limits import interval_of
from cuspaudit.pictures.joint_surface import Array, JointSurface

__all__ = ["limit_sides"]

_STEPS = 400


def limit_sides(surface: JointSurface) -> Iterator[Array]:
    """(m, 2) points (y, x) of each side."""
    joints = surface.model.chain.joints[1:3]
    ranges = [interval_of(joint) for joint in joints]
    halves = [math.pi if j.kind == "revolute" else surface.reach for j in joints]
    zeros = np.array(surface.model.zeros[1:])
    for k, pair in enumerate(ranges):
        low, high = ranges[1 - k] or (-halves[1 - k], halves[1 - k])
        for end in pair or ():
            side = np.empty((_STEPS, 2))
            side[:, k], side[:, 1 - k] = end, np.linspace(low, high, _STEPS)
            yield surface.points_at(side + zeros)
