"""What the arm is shown doing: joint vectors in order, with what is drawn beside them.

A witness path is resampled by arc length in joint space, so that the animation, its
slider and the strip of det J share one clock. Everything here is floating point and
for drawing only: the certificate, not this file, says that det J keeps its sign.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.errors import InvalidInputError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames, jacobian, transform

__all__ = ["PathFrames", "chain_length", "sample_path", "sample_postures"]

Matrix = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PathFrames:
    """Joint vectors to draw, in order, with their tool and det J.

    Attributes:
        postures: (m, n) joint values, rad or the chain's unit.
        tips: (m, 4, 4) frames of the tip in base coordinates.
        determinants: (m,) det J of the geometric Jacobian, in floating point.
        groups: what each posture is called together with those of its colour, for
            instance its aspect; only for separate postures.
        is_path: whether the postures follow a path, or stand each for itself.
    """

    postures: Matrix
    tips: Matrix
    determinants: Matrix
    groups: tuple[str, ...]
    is_path: bool

    @property
    def distances(self) -> Matrix:
        """(m,) distances of the tool from its place in the first posture."""
        points = self.tips[:, :3, 3]
        return np.asarray(np.linalg.norm(points - points[0], axis=1))

    @property
    def turns(self) -> Matrix:
        """(m,) angles in rad of the tool from its orientation in the first posture."""
        rotations = self.tips[:, :3, :3]
        traces = np.einsum("mij,ij->m", rotations, rotations[0])
        return np.asarray(np.arccos(np.clip((traces - 1.0) / 2.0, -1.0, 1.0)))


def sample_path(
    chain: Chain, path: Sequence[Sequence[float]], count: int = 181
) -> PathFrames:
    """Resample ``path`` at ``count`` postures equally far apart, both ends kept.

    Args:
        chain: a chain of n joints.
        path: at least two joint vectors, joined by straight segments in joint space.
        count: number of postures in the result, at least 2.

    Returns:
        The postures along the path, with tips and det J.

    Raises:
        InvalidInputError: the path is not a list of vectors of n finite numbers.
    """
    points = _joint_vectors(chain, path, least=2)
    steps = np.linalg.norm(np.diff(points, axis=0) * _weights(chain), axis=1)
    clock = np.r_[0.0, np.cumsum(steps)]
    wanted = np.linspace(0.0, clock[-1], max(2, count))
    postures = np.array([np.interp(wanted, clock, column) for column in points.T]).T
    return _frames(chain, postures, (), is_path=True)


def sample_postures(
    chain: Chain,
    postures: Sequence[Sequence[float]],
    groups: Sequence[str] | None = None,
) -> PathFrames:
    """Take ``postures`` as they are, each standing for itself.

    Args:
        chain: a chain of n joints.
        postures: at least one joint vector.
        groups: one name a posture, for instance its aspect; postures of one group
            get one colour. By default the sign of det J.

    Returns:
        The postures, with tips and det J.

    Raises:
        InvalidInputError: a posture is not a vector of n finite numbers, or there are
            not as many groups as postures.
    """
    found = _frames(chain, _joint_vectors(chain, postures, least=1), (), is_path=False)
    if groups is None:
        groups = ["det J > 0" if d > 0 else "det J < 0" for d in found.determinants]
    if len(groups) != len(found.postures):
        raise InvalidInputError(
            file=chain.name,
            found=f"{len(groups)} groups for {len(found.postures)} postures",
            expected="give one group a posture",
        )
    return PathFrames(
        found.postures, found.tips, found.determinants, tuple(groups), is_path=False
    )


def chain_length(chain: Chain) -> float:
    """The length of the arm stretched out, in the chain's unit; 1 if it has none."""
    motions = [*(joint.before for joint in chain.joints), chain.tool]
    lengths = [
        float(np.linalg.norm(transform([motion])[:3, 3]))
        for before in motions
        for motion in before
    ]
    return math.fsum(lengths) or 1.0


def _joint_vectors(
    chain: Chain, vectors: Sequence[Sequence[float]], least: int
) -> Matrix:
    wanted = len(chain.joints)
    rows = [[float(value) for value in vector] for vector in vectors]
    if len(rows) < least or any(len(row) != wanted for row in rows):
        raise InvalidInputError(
            file=chain.name,
            found=f"{len(rows)} joint vectors of {sorted({len(r) for r in rows})}",
            expected=f"give at least {least} of {wanted} numbers each",
        )
    result = np.array(rows, dtype=np.float64)
    if not np.all(np.isfinite(result)):
        raise InvalidInputError(
            file=chain.name,
            found="a joint value that is not a finite number",
            expected="give numbers in rad or in the robot's unit of length",
        )
    return result


def _weights(chain: Chain) -> Matrix:
    """A radian, and a slide as long as the arm, count the same along a path."""
    size = chain_length(chain)
    return np.array([1.0 if kind == "revolute" else 1.0 / size for kind in chain.kinds])


def _frames(
    chain: Chain, postures: Matrix, groups: tuple[str, ...], *, is_path: bool
) -> PathFrames:
    tips = np.array([frames(chain, list(posture))[-1] for posture in postures])
    values = np.array([_determinant(chain, list(posture)) for posture in postures])
    return PathFrames(postures, tips, values, groups, is_path)


def _determinant(chain: Chain, posture: Sequence[float]) -> float:
    J = jacobian(chain, posture)
    if J.shape[0] == J.shape[1]:
        return float(np.linalg.det(J))
    return math.sqrt(max(0.0, float(np.linalg.det(J @ J.T))))
