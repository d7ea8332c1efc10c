"""An arm written again as a URDF, with link frames of a program's choosing.

Every frame is put somewhere on its axis and turned anyhow; the numbers are computed in
floating point and printed with so many digits, as CAD programs do. Axes may be turned
round. The geometry is the same to rounding, and so is the meaning of a joint vector but
for zeros and signs.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.frames import frames
from cuspaudit.robot.virtual_joint import TOOL_AXES

Matrix = NDArray[np.float64]


def reexported(
    chain: Chain,
    digits: int,
    seed: int,
    folder: Path,
    *,
    fixed: bool = False,
    turned: bool = False,
    spread: float = 0.3,
) -> Chain:
    """The chain read back from the URDF that a program would write.

    Args:
        chain: any chain, its unit m.
        digits: significant digits of every number.
        seed: of the frames.
        folder: where the file goes.
        fixed: whether a fixed joint stands before every moving one.
        turned: whether some axes point the other way.
        spread: how far along its axis a frame may slide, in m.
    """
    rng = np.random.default_rng(seed)
    placed = frames(chain, [0.0] * len(chain.joints))
    base = rigid(rotation(rng), rng.uniform(-1, 1, 3)) if turned else np.eye(4)
    parts, last, link = [], np.eye(4), "base"
    for number, (joint, frame) in enumerate(
        zip(chain.joints, placed[:-1], strict=True), 1
    ):
        axis = np.array([float(x) for x in joint.axis])
        axis = frame[:3, :3] @ axis / np.linalg.norm(axis)
        axis = -axis if turned and rng.random() < 0.5 else axis
        point = frame[:3, 3] + rng.uniform(-spread, spread) * axis
        own = rigid(rotation(rng), point)
        step = np.linalg.inv(last) @ (base @ own if number == 1 else own)
        if fixed:
            middle = rigid(rotation(rng), rng.uniform(-0.2, 0.2, 3))
            parts.append(joint_text(f"f{number}", "fixed", link, middle, digits))
            link, step = f"of-f{number}", np.linalg.inv(middle) @ step
        kind = "continuous" if joint.kind == "revolute" else "prismatic"
        local = own[:3, :3].T @ axis
        parts.append(joint_text(joint.name, kind, link, step, digits, local))
        link, last = f"of-{joint.name}", own
    parts.append(
        joint_text("tool", "fixed", link, np.linalg.inv(last) @ placed[-1], digits)
    )
    path = folder / f"{chain.name}-{digits}-{seed}.urdf"
    path.write_text(
        f'<robot name="{chain.name}"><link name="base"/>{"".join(parts)}</robot>'
    )
    return read_urdf(path, tip="of-tool", task=task_of(chain)).chain


def task_of(chain: Chain) -> str:
    """The task by name."""
    assert chain.task in TOOL_AXES or chain.task.startswith("po")
    return chain.task


def joint_text(
    name: str,
    kind: str,
    parent: str,
    step: Matrix,
    digits: int,
    axis: Matrix | None = None,
) -> str:
    """A joint and its child link."""

    def text(values: Matrix) -> str:
        return " ".join(f"{x:.{digits}g}" for x in values)

    R = step[:3, :3]
    pitch = np.arcsin(np.clip(-R[2, 0], -1, 1))
    rpy = np.array([np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])])
    moving = "" if axis is None else f'<axis xyz="{text(axis)}"/>'
    limit = '<limit lower="-1" upper="1"/>' if kind == "prismatic" else ""
    return (
        f'<link name="of-{name}"/><joint name="{name}" type="{kind}">'
        f'<parent link="{parent}"/><child link="of-{name}"/>'
        f'<origin xyz="{text(step[:3, 3])}" rpy="{text(rpy)}"/>{moving}{limit}</joint>'
    )


def rotation(rng: np.random.Generator) -> Matrix:
    """A random rotation matrix."""
    Q = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return np.asarray(Q if np.linalg.det(Q) > 0 else -Q)


def rigid(R: Matrix, point: Matrix) -> Matrix:
    """The rigid motion x -> R x + point."""
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = R, point
    return result
