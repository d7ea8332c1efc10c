"""One arm as URDF and as SDF in several styles, and where its tip is by numpy."""

from __future__ import annotations

import numpy as np

#: xyz, rpy, axis, type of each joint, as printed
ROWS = (
    ("0 0 0.3", "1.5 0 0", "0 0 1", "revolute"),
    ("0.1 0 0.2", "1.2 -0.4 0.3", "0 1 0", "revolute"),
    ("0 0.05 0.4", "0 0.7 0", "1 0 0", "revolute"),
    ("0.3 0 0", "0.1 0.2 0.3", "0 0.6 0.8", "revolute"),
    ("0 0 0.1", "-1 0 2", "0 0 -1", "prismatic"),
    ("0.02 0.03 0.04", "0 1.5 0", "1 2 2", "revolute"),
)
TOOL = ("0 0.1 0.2", "0.4 0 0")
LIMITS = ("-2.5", "2.25")


def motion(xyz: str, rpy: str) -> np.ndarray:
    """T(xyz) Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = (float(x) for x in rpy.split())
    found = np.eye(4)
    turn = [np.eye(3) for _ in range(3)]
    for k, angle in enumerate((roll, pitch, yaw)):
        c, s = np.cos(angle), np.sin(angle)
        i, j = [(1, 2), (2, 0), (0, 1)][k]
        turn[k][i, i] = turn[k][j, j] = c
        turn[k][j, i], turn[k][i, j] = s, -s
    found[:3, :3] = turn[2] @ turn[1] @ turn[0]
    found[:3, 3] = [float(x) for x in xyz.split()]
    return found


def placed(values: np.ndarray) -> np.ndarray:
    """The frame of the tool."""
    tip = np.eye(4)
    for (xyz, rpy, axis, kind), value in zip(ROWS, values, strict=True):
        n = np.array([float(x) for x in axis.split()])
        n /= np.linalg.norm(n)
        own = np.eye(4)
        if kind == "prismatic":
            own[:3, 3] = value * n
        else:
            K = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
            own[:3, :3] += np.sin(value) * K + (1 - np.cos(value)) * K @ K
        tip = tip @ motion(xyz, rpy) @ own
    return tip @ motion(*TOOL)


def urdf_text() -> str:
    """The arm as a URDF."""
    rows = ['<link name="base"/>']
    for k, (xyz, rpy, axis, kind) in enumerate(ROWS, 1):
        parent = "base" if k == 1 else f"l{k - 1}"
        rows.append(
            f'<link name="l{k}"/><joint name="j{k}" type="{kind}">'
            f'<parent link="{parent}"/><child link="l{k}"/>'
            f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>'
            f'<limit lower="{LIMITS[0]}" upper="{LIMITS[1]}"/></joint>'
        )
    rows.append(
        '<link name="tool"/><joint name="t" type="fixed"><parent link="l6"/>'
        f'<child link="tool"/><origin xyz="{TOOL[0]}" rpy="{TOOL[1]}"/></joint>'
    )
    return f'<robot name="arm">{"".join(rows)}</robot>'


def sdf_text(style: str) -> str:
    """The arm as SDF.

    Args:
        style: "joints": poses relative to the joint and the parent, as converters write
            them; "model": all links in the model's frame; "frames": axes and links in
            frames of their own; "old": SDF 1.4, axes in the model's frame.
    """
    rows = ['<link name="base"/>']
    tip = np.eye(4)
    for k, (xyz, rpy, axis, kind) in enumerate(ROWS, 1):
        parent = "base" if k == 1 else f"l{k - 1}"
        tip = tip @ motion(xyz, rpy)
        joint_pose, link_pose = "", f"<pose>{_printed(tip)}</pose>"
        words, where = axis, ""
        if style == "joints":
            joint_pose = f'<pose relative_to="{parent}">{xyz} {rpy}</pose>'
            link_pose = f'<pose relative_to="j{k}">0 0 0 0 0 0</pose>'
        if style == "frames":
            rows.append(
                f'<frame name="f{k}"><pose>{_printed(tip)}</pose></frame>'
                f'<frame name="g{k}" attached_to="l{k}">'
                "<pose>0 0 0 0.5 0 0</pose></frame>"
            )
            link_pose, where = f'<pose relative_to="f{k}"/>', f' expressed_in="g{k}"'
            words = _turned(np.linalg.inv(motion("0 0 0", "0.5 0 0")), axis)
        if style == "old":
            words = _turned(tip, axis)
        rows.append(
            f'<link name="l{k}">{link_pose}</link><joint name="j{k}" type="{kind}">'
            f"<parent>{parent}</parent><child>l{k}</child>{joint_pose}"
            f"<axis><xyz{where}>{words}</xyz><limit><lower>{LIMITS[0]}</lower>"
            f"<upper>{LIMITS[1]}</upper></limit></axis></joint>"
        )
    pose = f"<pose>{TOOL[0]} {TOOL[1]}</pose>"
    rows.append(f'<frame name="tool" attached_to="l6">{pose}</frame>')
    version = "1.4" if style == "old" else "1.9"
    body = "".join(rows)
    return f'<sdf version="{version}"><model name="arm">{body}</model></sdf>'


def _printed(frame: np.ndarray) -> str:
    """X y z roll pitch yaw."""
    R = frame[:3, :3]
    turn = (
        np.arctan2(R[2, 1], R[2, 2]),
        np.arcsin(-R[2, 0]),
        np.arctan2(R[1, 0], R[0, 0]),
    )
    return " ".join(f"{x:.17g}" for x in (*frame[:3, 3], *turn))


def _turned(frame: np.ndarray, axis: str) -> str:
    n = frame[:3, :3] @ np.array([float(x) for x in axis.split()])
    return " ".join(f"{x:.17g}" for x in n)
