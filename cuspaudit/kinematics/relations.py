"""How the axes of a chain stand to each other, in words.

Only what holds in every posture is named: two axes in a row, or three in a row that
meet in one point. The tolerance is that of floating point; the words describe, and
nothing is decided by them.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from cuspaudit.kinematics.chain import Chain
from cuspaudit.kinematics.frames import Matrix, frames

__all__ = ["relations"]

_TOLERANCE = 1e-12


def relations(chain: Chain) -> frozenset[str]:
    """The sentences that hold of ``chain``, axes counted from 1 at the base.

    >>> from fractions import Fraction
    >>> from cuspaudit.kinematics.chain import X_AXIS, Joint
    >>> joints = (Joint("a", "revolute"), Joint("b", "revolute", (), X_AXIS))
    >>> sorted(relations(Chain("arm", joints)))
    ['axes 1 and 2 are square', 'axes 1 and 2 meet']
    """
    lines = _lines(chain)
    reach = 1.0 + max(float(np.abs(point).max()) for _, point in lines)
    found = set()
    for k, (first, second) in enumerate(pairwise(lines), 1):
        found |= {f"axes {k} and {k + 1} {w}" for w in _pair(first, second, reach)}
    for k in range(len(lines) - 2):
        if _concur(lines[k : k + 3], reach):
            found.add(f"axes {k + 1}, {k + 2} and {k + 3} meet in one point")
    return frozenset(found)


def _lines(chain: Chain) -> list[tuple[Matrix, Matrix]]:
    """Direction and a point of each axis at posture 0."""
    result = []
    placed = frames(chain, [0.0] * len(chain.joints))
    for joint, frame in zip(chain.joints, placed, strict=False):
        axis = np.array([float(x) for x in joint.axis])
        result.append((frame[:3, :3] @ axis / np.linalg.norm(axis), frame[:3, 3]))
    return result


def _pair(
    first: tuple[Matrix, Matrix], second: tuple[Matrix, Matrix], reach: float
) -> list[str]:
    (u, p), (v, q) = first, second
    normal = np.cross(u, v)
    if np.linalg.norm(normal) <= _TOLERANCE:
        apart = np.linalg.norm(np.cross(u, q - p))
        return ["coincide" if apart <= _TOLERANCE * reach else "are parallel"]
    words = []
    if abs(float(normal @ (q - p))) <= _TOLERANCE * reach:
        words.append("meet")
    if abs(float(u @ v)) <= _TOLERANCE:
        words.append("are square")
    return words


def _concur(lines: list[tuple[Matrix, Matrix]], reach: float) -> bool:
    """Whether one point lies on all three lines, no two in a row being parallel."""
    for (u, _), (v, _) in pairwise(lines):
        if np.linalg.norm(np.cross(u, v)) <= _TOLERANCE:
            return False
    rows = [np.eye(3) - np.outer(u, u) for u, _ in lines]
    matrix = np.vstack(rows)
    values = np.hstack([row @ p for row, (_, p) in zip(rows, lines, strict=True)])
    point = np.linalg.lstsq(matrix, values, rcond=None)[0]
    return bool(np.abs(matrix @ point - values).max() <= _TOLERANCE * reach)
