"""Whether floating point shows that the claim of a certificate does not hold.

Nothing of either checker is used, and what is near the border is left alone: a claim
that is not false here need not be true.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from certified_arms import det, kinematics

from cuspaudit.certificate import (
    Certificate,
    CuspCertificate,
    PairsCertificate,
    PathCertificate,
    StructureCertificate,
)

STARTS = 24
STEP = 1e-5


def is_false(claim: Certificate) -> bool:
    """Whether the claim does not hold, beyond doubt.

    A path: the values of the two postures differ by more than 1e-7, the ends do not
    fit, or det J has the wrong sign at one of 300 points. A structure: an angle or a
    distance that ought to be 0 is more than 1e-9. A cusp: det J, or its derivative
    along the kernel, is far from 0 there. Pairs: the map has a cusp.
    """
    match claim:
        case PathCertificate():
            return _is_false_path(claim)
        case StructureCertificate():
            return _is_false_structure(claim)
        case CuspCertificate():
            return _is_false_cusp(claim)
        case PairsCertificate():
            return _has_cusp(claim)
    raise TypeError(type(claim).__name__)


def _is_false_path(claim: PathCertificate) -> bool:
    first, second = claim.postures
    if claim.path[0] != first or claim.path[-1] != second:
        return True
    (T, _), (U, _) = kinematics(claim, first), kinematics(claim, second)  # type: ignore[arg-type]
    rows = T[:3] - U[:3] if len(claim.joints) == 6 else T[:3, 3] - U[:3, 3]
    if np.abs(rows).max() > 1e-7:
        return True
    for a, b in pairwise(claim.path):
        for s in np.linspace(0, 1, 300 // (len(claim.path) - 1)):
            q = [float(x) + s * float(y - x) for x, y in zip(a, b, strict=True)]
            if claim.sign * det(claim, q) < -1e-12:
                return True
    return False


def _is_false_structure(claim: StructureCertificate) -> bool:
    q = [0.3 * k for k, _ in enumerate(claim.joints)]
    lines = _lines(claim, q)
    for relation in claim.relations:
        chosen = [lines[k - 1] for k in relation.axes]
        for (u, p), (v, r) in pairwise(chosen):
            normal = np.cross(u, v)
            if relation.word == "parallel" and np.linalg.norm(normal) > 1e-9:
                return True
            if relation.word == "square" and abs(u @ v) > 1e-9:
                return True
            if relation.word == "meeting" and abs((r - p) @ normal) > 1e-9:
                return True
    return False


def _lines(claim: Any, q: Sequence[float]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Direction and a point of each axis at joint values q, in floats."""
    _, J = kinematics(claim, q)
    tip = kinematics(claim, q)[0][:3, 3]
    found = []
    for k, joint in enumerate(claim.joints):
        w, v = (J[3:, k], J[:3, k]) if joint.kind == "revolute" else (J[:3, k], None)
        # v = w x (tip - p), with w of length 1: p = tip - v x w is on the axis
        found.append((w, tip if v is None else tip - np.cross(v, w)))
    return found


def _is_false_cusp(claim: Any) -> bool:
    q = np.array([float(x) for x in claim.posture])
    value, along, slope = _conditions(claim, q)
    near = 1e-5 if claim.tolerance is None and not _is_loose(claim) else 1.0
    return abs(value) > near * slope or abs(along) > 100 * near * slope


def _is_loose(claim: Certificate) -> bool:
    motions = [m for joint in claim.joints for m in joint.before] + [*claim.tool]
    return any(hasattr(m, "within") for m in motions)


def _has_cusp(claim: Any) -> bool:
    """Whether Newton meets a cusp that is none by rounding, from one of some starts."""
    rng = np.random.default_rng(0)
    return any(_cusp_from(claim, rng.uniform(-np.pi, np.pi, 2)) for _ in range(STARTS))


def _cusp_from(claim: Any, start: np.ndarray) -> bool:
    def both(x: np.ndarray) -> np.ndarray:
        value, along, slope = _conditions(claim, np.r_[0.0, x])
        return np.array([value, along]) / slope

    x = start
    for _ in range(30):
        rows = [(both(x + d) - both(x - d)) / (2 * STEP) for d in STEP * np.eye(2)]
        matrix, here = np.array(rows).T, both(x)
        if not np.all(np.isfinite(matrix)) or np.linalg.cond(matrix) > 1e6:
            return False
        move = np.linalg.solve(matrix, here)
        x = x - move / max(1.0, float(np.linalg.norm(move)))
        if np.linalg.norm(move) < 1e-9:
            k = _kernel(claim, np.r_[0.0, x])
            third = (both(x + STEP * k[1:]) - both(x - STEP * k[1:]))[1] / (2 * STEP)
            return bool(np.abs(both(x)).max() < 1e-7 and abs(third) > 1e-2)
    return False


def _conditions(claim: Any, q: np.ndarray) -> tuple[float, float, float]:
    """Det J, its derivative along the kernel, and the length of its gradient."""
    slope = np.array(
        [(det(claim, q + d) - det(claim, q - d)) / (2 * STEP) for d in _steps(q)]
    )
    return det(claim, q), float(slope @ _kernel(claim, q)), float(norm(slope))


def _kernel(claim: Any, q: np.ndarray) -> np.ndarray:
    J = kinematics(claim, q)[1][: len(q)]
    k = np.linalg.svd(J)[2][-1]
    return k * np.sign(k[np.abs(k).argmax()])


def _steps(q: np.ndarray) -> np.ndarray:
    return STEP * np.eye(len(q))


def norm(vector: np.ndarray) -> float:
    """Its length."""
    return float(np.linalg.norm(vector))
