"""What the searches met beside a verdict: evidence, and what was tried."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from cuspaudit.algebra.angles import shortest_turn
from cuspaudit.algebra.ring import Rational
from cuspaudit.kinematics.exact_model import ExactModel

if TYPE_CHECKING:
    from cuspaudit.algebra.points.parametrization import RealPoint

__all__ = ["Crowd", "Label", "PairMaximum", "PairRecord", "SearchRecord"]

Label = tuple[int, ...]

_BITS = 64


@dataclass(frozen=True)
class SearchRecord:
    """What a search tried.

    Attributes:
        poses: number of random poses.
        postures: how many poses had so many postures.
        uneven: poses of which a posture was certainly lost.
        pairs: couples of one pose with one sign of det J.
        joined: how many of them a path joins on which no sample is singular; such a
            path may still jump through a crossing of the singular set.
        clearance: of the widest of these paths, smallest over largest |det J|, sampled.
        seed: of every random choice.
        stopped: why it ended early, or None.
    """

    poses: int
    postures: dict[str, int]
    uneven: int
    pairs: int
    joined: int
    clearance: float
    seed: int
    stopped: str | None = None


@dataclass(frozen=True)
class PairMaximum:
    """A local maximum of |det J| at both ends of a pair, multiplied.

    Attributes:
        postures: the two ends, joint values; first and last joint are as they were met.
        sign: of det J at both.
        level: |h h'| over the square of the largest |h| met, in [0, 1].
        found: how many ascents ended here.
        together: whether both ends lie in one aspect.
    """

    postures: tuple[tuple[float, ...], tuple[float, ...]]
    sign: int
    level: float
    found: int
    together: bool


@dataclass(frozen=True)
class PairRecord:
    """What a search over pairs met; evidence, not proof.

    Attributes:
        pairs: seeded pairs with one sign of det J.
        lost: how many ascents from them did not settle at a maximum.
        maxima: the distinct ones, up to the order of the ends, the highest first.
        missed: Good-Turing estimate of the chance that one more ascent ends at a
            maximum that was not met: those met once over all ascents; None without any.
        together: how many maxima have both ends in one aspect.
        aspects: how the aspect of an end was told, "exact labels" or, in floating
            point, "ascents of |det J|".
        seed: of the random pairs.
    """

    pairs: int
    lost: int
    maxima: tuple[PairMaximum, ...]
    missed: float | None
    together: int
    aspects: str
    seed: int


@dataclass(frozen=True, eq=False)
class Crowd:
    """A pose with two postures in one aspect: a proof that its arm is cuspidal.

    Attributes:
        model: the arm.
        tangents: tan(theta_i / 2) of a posture of the pose, which fixes it exactly;
            theta_i is the value of joint i and its zero in the model.
        aspects: all postures of the pose, by the label of the aspect they lie in.
        grounds: what the list of postures, and the aspects, rest on.
    """

    model: ExactModel
    tangents: tuple[Rational, ...]
    aspects: dict[Label, list[RealPoint]]
    grounds: tuple[str, ...]

    @property
    def count(self) -> int:
        """How many postures the pose has."""
        return sum(map(len, self.aspects.values()))

    @property
    def postures(self) -> list[list[float]]:
        """Two postures in one aspect, joint values in rad, rounded."""
        shared = max(self.aspects.values(), key=len)
        return [self._angles(posture)[: self._joints] for posture in shared[:2]]

    @property
    def _joints(self) -> int:
        """The number of joints that a motor moves; they come first."""
        return sum(not joint.is_virtual for joint in self.model.chain.joints)

    def _angles(self, posture: RealPoint) -> list[float]:
        ball = posture.ball(_BITS)
        pairs = zip(self.model.circles, self.model.zeros, strict=True)
        angles = [
            math.atan2(ball[s].mid(), ball[c].mid()) - zero for (c, s), zero in pairs
        ]
        return [float(angle) for angle in shortest_turn(np.array(angles))]

    def sentence(self) -> str:
        """What is proved, in one sentence."""
        shared = max(map(len, self.aspects.values()))
        first, second = (
            "(" + ", ".join(f"{angle:.4f}" for angle in posture) + ")"
            for posture in self.postures
        )
        return (
            f"of the {self.count} postures of one pose {shared} lie in one aspect, "
            f"{first} and {second} rad among them"
        )

    def record(self) -> dict[str, Any]:
        """The pose and the two postures, for the JSON of an audit."""
        return {
            "half_angle_tangents": [str(t) for t in self.tangents[: self._joints]],
            "count": self.count,
            "in_one_aspect": max(map(len, self.aspects.values())),
            "postures": self.postures,
        }
