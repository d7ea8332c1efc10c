"""The structure that the joint axes of a chain have, in floats."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames

Line = tuple[np.ndarray, np.ndarray]


def lines(chain: Chain) -> list[Line]:
    """Direction and a point of each joint axis at posture 0."""
    result = []
    placed = frames(chain, [0.0] * len(chain.joints))[:-1]
    for joint, frame in zip(chain.joints, placed, strict=True):
        axis = np.array([float(x) for x in joint.axis])
        result.append((frame[:3, :3] @ axis / np.linalg.norm(axis), frame[:3, 3]))
    return result


def are_parallel(first: Line, second: Line, tolerance: float) -> bool:
    """Whether two axes have one direction."""
    return bool(np.linalg.norm(np.cross(first[0], second[0])) <= tolerance)


def meet_in_one_point(group: list[Line], tolerance: float) -> bool:
    """Whether a point lies on all axes."""
    rows = [np.eye(3) - np.outer(d, d) for d, _ in group]
    values = np.hstack([r @ p for r, (_, p) in zip(rows, group, strict=True)])
    matrix = np.vstack(rows)
    point = np.linalg.lstsq(matrix, values, rcond=None)[0]
    return bool(np.abs(matrix @ point - values).max() <= tolerance)


def structure(chain: Chain, tolerance: float = 1e-12) -> str:
    """Return a (spherical wrist), b (three parallel axes) or c (neither)."""
    axes = lines(chain)
    wrist = axes[-3:]
    apart = not any(are_parallel(*p, tolerance) for p in pairwise(wrist))
    if apart and meet_in_one_point(wrist, tolerance):
        return "a"
    triples = (axes[k : k + 3] for k in range(len(axes) - 2))
    if any(all(are_parallel(*p, tolerance) for p in pairwise(t)) for t in triples):
        return "b"
    return "c"
