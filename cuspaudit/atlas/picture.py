"""A small drawing of an arm: links as a line, joints as dots on their axes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames

__all__ = ["picture"]

Array = NDArray[np.float64]

_WIDTH, _HEIGHT, _MARGIN = 160, 120, 14
_TURN, _RISE = np.radians(-60.0), np.radians(20.0)


def picture(chain: Chain, postures: Sequence[Sequence[float]]) -> str:
    """The arm in one or more postures, seen from the side and a little from above.

    Args:
        chain: the arm.
        postures: joint values; the first is drawn strongest.
    """
    lines = [_flat(_points(chain, posture)) for posture in postures]
    axes = [_flat(_axes(chain, posture)) for posture in postures]
    every = np.vstack([*lines, *axes])
    low, high = every.min(axis=0), every.max(axis=0)
    room = np.array([_WIDTH, _HEIGHT]) - 2 * _MARGIN
    scale = float((room / np.maximum(high - low, 1e-9)).min())
    shift = np.array([_WIDTH, _HEIGHT]) / 2 - scale * (low + high) / 2
    drawn = [
        _arm(scale * line + shift, scale * axis + shift, number)
        for number, (line, axis) in reversed(
            list(enumerate(zip(lines, axes, strict=True)))
        )
    ]
    return (
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" class="arm" role="img" '
        f'aria-label="the arm in outline">{"".join(drawn)}</svg>'
    )


def _arm(line: Array, axes: Array, number: int) -> str:
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in line)
    ends = axes.reshape(-1, 2, 2)
    sticks = "".join(
        f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}"/>'
        for a, b in ends
    )
    kind = "first" if number == 0 else "other"
    return f'<g class="{kind}"><polyline points="{path}"/>{sticks}</g>'


def _points(chain: Chain, posture: Sequence[float]) -> Array:
    """Base, the origins of the joints, and the tip."""
    placed = frames(chain, posture)
    return np.vstack([np.zeros(3), placed[:, :3, 3]])


def _axes(chain: Chain, posture: Sequence[float]) -> Array:
    """Two ends of a stick along each joint axis, a tenth of the arm long."""
    placed = frames(chain, posture)
    origins = placed[:, :3, 3]
    reach = float(np.ptp(origins, axis=0).max()) or 1.0
    ends = []
    for joint, frame in zip(chain.joints, placed, strict=False):
        axis = np.array([float(x) for x in joint.axis])
        stick = frame[:3, :3] @ axis / np.linalg.norm(axis) * reach / 16
        ends += [frame[:3, 3] - stick, frame[:3, 3] + stick]
    return np.array(ends)


def _flat(points: Array) -> Array:
    """Seen by the eye: right and down."""
    x, y, z = points.T
    right = np.cos(_TURN) * x - np.sin(_TURN) * y
    depth = np.sin(_TURN) * x + np.cos(_TURN) * y
    return np.stack([right, -(np.cos(_RISE) * z + np.sin(_RISE) * depth)], axis=1)
