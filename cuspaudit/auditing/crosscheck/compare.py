"""The exact model against Pinocchio: no verdict is given where they disagree.

Three comparisons [mathematics 3, 9]: pose and det J at random postures; loss of rank at
postures computed on det J = 0; no loss of rank along a witness path. Lengths are
divided by the reach L of the arm. An exact model that replaces angles or axes by
rational points records by how much; the sum e of these differences (rad) moves no
point by more than e L and is allowed for. All numbers here are doubles.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cuspaudit.algebra.numeric import NumericPolynomial, numeric_values
from cuspaudit.auditing.crosscheck.pinocchio_model import (
    LockValue,
    PinocchioArm,
    PinocchioPosture,
    arm_from_chain,
    arm_from_urdf,
    reach_scale,
)
from cuspaudit.auditing.crosscheck.singular_postures import (
    model_points,
    random_postures,
    singular_postures,
)
from cuspaudit.errors import CrossCheckError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import polynomial_map
from cuspaudit.robot.virtual_joint import without_virtual_joint

__all__ = ["CrossCheck", "crosscheck", "singular_postures"]

Array = NDArray[np.float64]
Postures = Sequence[Sequence[float] | Array]

_ROUNDING = 1e-9
_SMALLEST_SCALE = 1e-6
_RANK = 1e-7
_MARGIN = 1e-12


@dataclass(frozen=True)
class CrossCheck:
    """What was compared, and how closely it agreed.

    Attributes:
        engine: "pinocchio".
        samples: number of random postures compared.
        max_relative_error: largest difference in position (of L), rotation (of 1) and
            det J (of its largest absolute value met).
        singular_points_checked: number of postures on det J = 0 where Pinocchio's
            Jacobian loses rank.
        agree: always true; a disagreement raises.
        allowed_error: what ``max_relative_error`` was held to.
        path_points_checked: way points and midpoints without loss of rank.
        seed: of the random postures.
        against: "URDF" when Pinocchio read the robot's own file, "chain" when it was
            given the exact chain (no URDF, or one that Pinocchio refuses).
    """

    engine: str
    samples: int
    max_relative_error: float
    singular_points_checked: int
    agree: bool
    allowed_error: float
    path_points_checked: int
    seed: int
    against: str


def crosscheck(
    model: ExactModel,
    *,
    urdf: Path | None = None,
    literal: ExactModel | None = None,
    locked: Mapping[str, LockValue] | None = None,
    singular: Postures | None = None,
    path: Postures | None = None,
    path_is_literal: bool = True,
    samples: int = 100,
    seed: int = 0,
) -> CrossCheck:
    """Compare exact models with Pinocchio.

    Args:
        model: the model that the verdict is about, literal or snapped.
        urdf: the file the chain was read from; without it Pinocchio is given the
            chain of the model.
        literal: the model of the literal chain, if ``model`` is the snapped one: then
            ``literal`` is compared with the file (or with its own chain), and
            ``model`` with its own chain.
        locked: joints that the chain holds fixed, as for `robot.task.lock`.
        singular: postures on det J = 0 of ``model``; None for 20 of
            `singular_postures`.
        path: way points of a witness, joint values in the model's order, not reduced
            modulo 2 pi.
        path_is_literal: whether ``path`` belongs to ``literal`` (if given), as a
            certificate's does, or to ``model``.
        samples: random postures for each comparison.
        seed: of the random postures.

    Raises:
        CrossCheckError: they disagree; the message has the numbers.
        InvalidRobotError: Pinocchio cannot read ``urdf``.
    """
    own, written = _Comparison(model, None, locked), None
    if urdf is not None or literal is not None:
        written = _Comparison(literal or model, urdf, locked)
    comparisons = [c for c in (own, written) if c is not None]
    rng = np.random.default_rng(seed)
    results = [c.random(samples, rng) for c in comparisons]
    if singular is None:
        singular = singular_postures(model, 20, seed, own.length)
    for posture in singular:
        own.check_singular(posture)
    checked = 0
    if path is not None:
        subject = written if written is not None and path_is_literal else own
        checked = subject.check_path(path)
    return CrossCheck(
        engine="pinocchio",
        samples=samples * len(comparisons),
        max_relative_error=max(error for error, _ in results),
        singular_points_checked=len(singular),
        agree=True,
        allowed_error=max(allowed for _, allowed in results),
        path_points_checked=checked,
        seed=seed,
        against="chain" if urdf is None else "URDF",
    )


class _Comparison:
    """One exact model beside one Pinocchio arm."""

    def __init__(
        self,
        model: ExactModel,
        urdf: Path | None,
        locked: Mapping[str, LockValue] | None,
    ) -> None:
        chain = without_virtual_joint(model.chain)
        self.model = model
        self.length = reach_scale(chain)
        self.name = f"{chain.name} ({urdf.name if urdf else 'its chain'})"
        self.arm: PinocchioArm = (
            arm_from_urdf(chain, urdf, locked) if urdf else arm_from_chain(chain)
        )
        self.moved = sum(a.difference for a in model.approximations)
        self._map = polynomial_map(model)
        self._determinant = NumericPolynomial(model.ring, jacobian_determinant(model))

    def random(self, samples: int, rng: np.random.Generator) -> tuple[float, float]:
        """(largest relative error, what is allowed) at random postures."""
        postures = random_postures(self.model, samples, rng, self.length)
        placed = [self._placed(posture) for posture in postures]
        points = model_points(self.model, postures)
        slides = [j.kind == "prismatic" for j in self.model.joints]
        reach = self.length + float(np.abs(postures[:, slides]).sum(axis=1).max())
        allowed = _ROUNDING + 2 * self.moved
        worst = 0.0
        for what, mine, theirs, scale in (
            ("position", self._position(points), _positions(placed), reach),
            ("rotation", self._rotation(points), _rotations(placed), 1.0),
        ):
            errors = np.abs(mine - theirs).max(axis=1) / scale
            self._check(what, errors, allowed, postures)
            worst = max(worst, float(errors.max()))
        errors, spread = self._determinant_errors(points, placed)
        self._check("det J", errors, _ROUNDING + self.moved * spread, postures)
        allowed += self.moved * spread
        return max(worst, float(errors.max())), allowed

    def _determinant_errors(
        self, points: Array, placed: list[PinocchioPosture]
    ) -> tuple[Array, float]:
        """Errors of det J relative to its largest value, and what e may add to them.

        A column of length N moves by at most 2 e max(N, 1), so the determinant by at
        most 2 n e times the product of the columns' lengths (Hadamard).
        """
        mine = self._values(points)
        theirs = np.array([p.determinant for p in placed]) / self.length**3
        scale = max(float(np.abs(theirs).max()), _SMALLEST_SCALE)
        bound = max(self._hadamard(p) for p in placed)
        spread = 2 * len(self.model.joints) * bound / scale
        return np.abs(mine - theirs) / scale, spread

    def check_singular(self, posture: Sequence[float] | Array) -> None:
        """Check that Pinocchio's Jacobian loses rank at ``posture``.

        The posture is known to about 1e-15, so det J / (product of the other singular
        values) would be 1e-14; where two singular values vanish together each is about
        the root of that, and the root of e is added for a model that was moved.
        """
        values = self._placed(posture).singular_values(self.length)
        ratio = float(values[-1] / values[0])
        bound = _RANK + self.moved**0.5
        if not ratio <= bound:
            raise CrossCheckError(
                f"{self.name}: det J = 0 at {_text(posture)}, but the Jacobian of "
                f"Pinocchio keeps its rank there (smallest / largest singular value "
                f"{ratio:.3g}, bound {bound:.3g})"
            )

    def check_path(self, path: Postures) -> int:
        """Check that det J keeps one sign on ``path``; the number of points looked at.

        |det J| must exceed its own rounding error, 1e-12 times the product of the
        columns' lengths, and the polynomial must have the same sign.
        """
        points = np.asarray(path, dtype=np.float64)
        middles = (points[1:] + points[:-1]) / 2
        postures: Array = np.vstack([points, middles])
        placed = [self._placed(posture) for posture in postures]
        theirs = np.array([p.determinant for p in placed]) / self.length**3
        margin = np.array([_MARGIN * self._hadamard(p) for p in placed])
        mine = self._values(model_points(self.model, postures))
        sign = np.sign(theirs[0])
        bad = (sign * theirs <= margin) | (np.sign(mine) != sign)
        if bad.any():
            k = int(bad.argmax())
            raise CrossCheckError(
                f"{self.name}: the witness path is singular or changes sign at "
                f"{_text(postures[k])} (det J / L^3 is {theirs[0]:.6g} at its start, "
                f"{theirs[k]:.6g} there by Pinocchio, {mine[k]:.6g} by the polynomial)"
            )
        return len(postures)

    def _placed(self, posture: Sequence[float] | Array) -> PinocchioPosture:
        """Pinocchio's answer, which knows nothing of a virtual joint at the end."""
        return self.arm.at(posture[: len(self.arm.chain.joints)])

    def _values(self, points: Array) -> Array:
        return np.asarray(self._determinant(points) / self.length**3)

    def _position(self, points: Array) -> Array:
        return numeric_values(self.model.ring, self._map.position.components, points)

    def _rotation(self, points: Array) -> Array:
        return numeric_values(self.model.ring, self._map.rotation.components, points)

    def _hadamard(self, placed: PinocchioPosture) -> float:
        columns = np.linalg.norm(placed.scaled_jacobian(self.length), axis=0)
        return float(np.maximum(columns, 1.0).prod())

    def _check(self, what: str, errors: Array, allowed: float, postures: Array) -> None:
        worst = int(errors.argmax())
        if not errors[worst] <= allowed:
            raise CrossCheckError(
                f"{self.name}: {what} of the exact model and of Pinocchio differ by "
                f"{errors[worst]:.3g} (allowed {allowed:.3g}) at "
                f"{_text(postures[worst])}"
            )


def _positions(placed: list[PinocchioPosture]) -> Array:
    return np.array([p.pose[:3, 3] for p in placed])


def _rotations(placed: list[PinocchioPosture]) -> Array:
    return np.array([p.pose[:3, :3].ravel() for p in placed])


def _text(posture: ArrayLike) -> str:
    return "(" + ", ".join(f"{x:.6g}" for x in np.asarray(posture)) + ")"
