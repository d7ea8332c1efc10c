"""An arm drawn from its chain alone: tubes, joint housings, base and tool.

All lengths are fractions of the arm's stretched length, so a hand of 0.1 m and a
crane of 5000 mm are drawn with the same proportions. Each link is a tube that leaves
its joint along the joint's axis and turns off square to it, as the d and a of a D-H
table do; each revolute joint is a short cylinder on its true axis, each prismatic one
a sleeve on a square bar.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Chain, Joint, Motion, Translation
from cuspaudit.robot.frames import transform
from cuspaudit.viz.scene.motion import PathFrames

__all__ = [
    "ArmPiece",
    "Role",
    "arm_pieces",
    "bar_ends",
    "elbows",
    "pointing",
    "triad",
    "tube_radius",
    "unit_axis",
]

Matrix = NDArray[np.float64]
Role = Literal["base", "link", "housing", "cap", "tool", "x", "y", "z"]

TUBE = 0.024  # radius of the first link
TAPER = 0.45  # the last link is thinner by this part
HOUSING = 1.6  # radius of a housing, in radii of its link
LEAST = 1e-9  # shorter than this is no length


@dataclass(frozen=True, slots=True)
class ArmPiece:
    """A primitive carried by a body of the arm.

    Attributes:
        body: index of the joint that carries it, -1 for the base.
        kind: "cylinder" (size: radius, height; along its z), "sphere" (radius) or
            "box" (three sides).
        size: lengths as fractions of the arm's length.
        origin: (4, 4) placement in the body's frame, lengths scaled alike.
        role: what it is, which gives its colour.
    """

    body: int
    kind: Literal["cylinder", "sphere", "box"]
    size: tuple[float, ...]
    origin: Matrix
    role: Role


def arm_pieces(
    chain: Chain,
    scale: float,
    shown: PathFrames,
    skip: frozenset[int] = frozenset(),
) -> list[ArmPiece]:
    """The primitives of ``chain``, for bodies -1 (base) to n - 1 (last link).

    Args:
        chain: a chain of n joints.
        scale: drawn length of one unit of the chain.
        shown: the postures that will be drawn, which say how far joints slide.
        skip: bodies drawn by other means, from their meshes.

    Returns:
        The pieces, base first. The last body ends in the tool.
    """
    pieces: list[ArmPiece] = []
    for body in range(-1, len(chain.joints)):
        if body in skip:
            continue
        radius = tube_radius(chain, body)
        pieces += _tube(body, elbows(chain, body, scale), radius)
        if body >= 0:
            values = shown.postures[:, body] * scale
            pieces += _joint(chain, body, scale, radius, values)
    last = len(chain.joints) - 1
    return pieces + _tool(chain, last, transform(chain.tool), scale)


def tube_radius(chain: Chain, body: int) -> float:
    """Radius of the tube of ``body``, falling evenly from base to tip."""
    return TUBE * (1.0 - TAPER * max(body, 0) / max(1, len(chain.joints) - 1))


def elbows(chain: Chain, body: int, scale: float) -> Matrix:
    """(k, 3) points from the frame of ``body`` to the next joint, square to its axis.

    Every translation on the way is split into its part along the axis of the joint
    that carries the body and the rest, in this order.
    """
    joints = chain.joints
    motions = joints[body + 1].before if body + 1 < len(joints) else chain.tool
    axis = unit_axis(joints[body]) if body >= 0 else np.array([0.0, 0.0, 1.0])
    points, placed = [np.zeros(3)], np.eye(4)
    for motion in motions:
        if isinstance(motion, Translation):
            step = placed[:3, :3] @ transform([motion])[:3, 3] * scale
            along = (step @ axis) * axis
            for part in (along, step - along):
                if np.linalg.norm(part) > LEAST:
                    points.append(points[-1] + part)
        placed = placed @ transform([motion])
    return np.array(points)


def unit_axis(joint: Joint) -> Matrix:
    """The direction of the joint's axis in its own frame."""
    axis = np.array([float(x) for x in joint.axis])
    return np.asarray(axis / np.linalg.norm(axis))


def pointing(direction: Matrix, at: Matrix) -> Matrix:
    """A (4, 4) placement at ``at`` whose z axis points along ``direction``."""
    z = direction / np.linalg.norm(direction)
    side = np.eye(3)[int(np.argmin(np.abs(z)))]
    x = np.cross(side, z)
    x /= np.linalg.norm(x)
    placed = np.eye(4)
    placed[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    placed[:3, 3] = at
    return placed


def triad(body: int, origin: Matrix, length: float, radius: float) -> list[ArmPiece]:
    """Three rods along the axes of the frame ``origin``: red x, green y, blue z."""
    roles: Sequence[Role] = ("x", "y", "z")
    rods = []
    for column, role in enumerate(roles):
        axis = origin[:3, column]
        middle = origin[:3, 3] + axis * length / 2
        placed = pointing(axis, middle)
        rods.append(ArmPiece(body, "cylinder", (radius, length), placed, role))
    return rods


def _tube(body: int, points: Matrix, radius: float) -> list[ArmPiece]:
    role: Role = "base" if body < 0 else "link"
    pieces = []
    for start, end in pairwise(points):
        length = float(np.linalg.norm(end - start))
        placed = pointing(end - start, (start + end) / 2)
        pieces.append(ArmPiece(body, "cylinder", (radius, length), placed, role))
        pieces.append(ArmPiece(body, "sphere", (radius,), _at(end), role))
    return pieces


def _joint(
    chain: Chain, body: int, scale: float, radius: float, values: Matrix
) -> list[ArmPiece]:
    joint, axis = chain.joints[body], unit_axis(chain.joints[body])
    if joint.kind == "revolute":
        return _housing(body, axis, radius * HOUSING)
    return _slide(body, joint.before, axis, scale, radius, values)


def _housing(body: int, axis: Matrix, radius: float) -> list[ArmPiece]:
    """A short cylinder on the axis, its two faces, and a mark that turns with it."""
    placed = pointing(axis, np.zeros(3))
    mark = placed @ _at(np.array([radius * 1.02, 0.0, 0.0]))
    return [
        ArmPiece(body, "cylinder", (radius, 2.5 * radius), placed, "housing"),
        ArmPiece(body, "cylinder", (0.72 * radius, 2.62 * radius), placed, "cap"),
        ArmPiece(body, "box", (0.16 * radius, 0.3 * radius, 1.7 * radius), mark, "cap"),
    ]


def _slide(
    body: int,
    before: Sequence[Motion],
    axis: Matrix,
    scale: float,
    radius: float,
    values: Matrix,
) -> list[ArmPiece]:
    """A sleeve fixed to the body before, and the bar that runs through it."""
    fixed = transform(before)
    fixed[:3, 3] *= scale
    side = 2.0 * HOUSING * radius
    sleeve = fixed @ pointing(axis, np.zeros(3))
    low, high = bar_ends(values, 0.8 * side)
    bar = pointing(axis, axis * (high + low) / 2)
    return [
        ArmPiece(body - 1, "box", (side, side, 1.4 * side), sleeve, "housing"),
        ArmPiece(body, "box", (1.5 * radius, 1.5 * radius, high - low), bar, "cap"),
    ]


def bar_ends(values: Matrix, margin: float) -> tuple[float, float]:
    """Where a sliding bar begins and ends along its axis, to stay in its sleeve."""
    far, near = max(0.0, float(values.max())), min(0.0, float(values.min()))
    return -far - margin, -near + margin


def _tool(chain: Chain, body: int, tool: Matrix, scale: float) -> list[ArmPiece]:
    placed = tool.copy()
    placed[:3, 3] *= scale
    ball = ArmPiece(body, "sphere", (1.15 * TUBE,), placed, "tool")
    if chain.task == "position":
        return [ball]
    return [ball, *triad(body, placed, 0.085, 0.0075)]


def _at(point: Matrix) -> Matrix:
    placed = np.eye(4)
    placed[:3, 3] = point
    return placed
