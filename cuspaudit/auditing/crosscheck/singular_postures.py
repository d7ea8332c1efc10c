"""Points of the singular set, in floating point, for the cross-check.

On det J = 0 all joints but one may be chosen freely: in the one left, det J is a
trigonometric polynomial of low degree (affine in (c_i, s_i) for the second and the
last but one joint), and its real roots are singular postures.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.numeric import NumericPolynomial
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactJoint, ExactModel
from cuspaudit.robot.frames import angle_value

__all__ = ["model_points", "random_postures", "singular_postures"]

Array = NDArray[np.float64]

_ON_CIRCLE = 1e-6
_RESIDUAL = 1e-13
_STEPS = 3


def model_points(model: ExactModel, postures: Array) -> Array:
    """The variables of the model at (m, n) joint values: (m, variables of the ring)."""
    columns: list[Array] = []
    for joint, values in zip(model.joints, np.asarray(postures).T, strict=True):
        if joint.kind == "prismatic":
            columns.append(values)
        else:
            turned = values + angle_value(joint.zero)
            columns += [np.cos(turned), np.sin(turned)]
    return np.stack(columns, axis=1)


def random_postures(
    model: ExactModel, count: int, rng: np.random.Generator, length: float
) -> Array:
    """(count, n) joint values: a full turn each, or a slide within ``length``.

    A virtual joint stays at 0, where the tip is that of the arm without it.
    """
    joints = model.chain.joints
    half = np.where([joint.kind == "revolute" for joint in joints], np.pi, length)
    half = np.where([joint.is_virtual for joint in joints], 0.0, half)
    return np.asarray(rng.uniform(-half, half, size=(count, len(half))))


def singular_postures(
    model: ExactModel, count: int, seed: int = 0, length: float = 1.0
) -> list[Array]:
    """Postures with det J = 0, each solved for one joint at random others.

    The joints that det J depends on take turns, so that every factor of it is met.

    Args:
        model: a chain with a square task.
        count: how many are wanted.
        seed: of the other joints' values.
        length: slides are drawn from (-length, length).

    Returns:
        At most ``count`` postures (n,); fewer, or none, where few choices of the other
        joints have a real solution.
    """
    determinant = jacobian_determinant(model)
    rng = np.random.default_rng(seed)
    if determinant == 0:
        return list(random_postures(model, count, rng, length))
    used = determinant.degrees()
    index = model.ring.context.variable_to_index
    solvers = [
        (k, _Solver(model, k, determinant))
        for k, joint in enumerate(model.joints)
        if any(used[index(name)] for name in joint.variables)
    ]
    found: list[Array] = []
    for posture in random_postures(model, 4 * count, rng, length):
        if len(found) >= count or not solvers:
            break
        k, solver = solvers.pop(0)
        solvers.append((k, solver))
        for value in solver.roots(posture):
            found.append(np.r_[posture[:k], value, posture[k + 1 :]])
    return found[:count]


class _Solver:
    """det J as a polynomial in the variables of one joint."""

    def __init__(self, model: ExactModel, k: int, determinant: Polynomial) -> None:
        ring = model.ring
        self._model = model
        self._joint: ExactJoint = model.joints[k]
        parts = ring.coefficients(determinant, self._joint.variables)
        self._parts = {key: NumericPolynomial(ring, p) for key, p in parts.items()}

    def roots(self, posture: Array) -> list[float]:
        """The values of the joint at which det J = 0, the others as in ``posture``."""
        point = model_points(self._model, posture[None, :])
        at = {key: float(part(point)[0]) for key, part in self._parts.items()}
        if self._joint.kind == "prismatic":
            return _real_roots({int(key[0]): value for key, value in at.items()})
        zero = angle_value(self._joint.zero)
        turns = _turns({(int(key[0]), int(key[1])): value for key, value in at.items()})
        return [turn - zero for turn in turns]


def _real_roots(parts: dict[int, float]) -> list[float]:
    """Real roots of the polynomial with coefficient ``parts[k]`` of degree k."""
    dense = [parts.get(k, 0.0) for k in range(max(parts), -1, -1)]
    return [float(x.real) for x in np.roots(dense) if abs(x.imag) < _ON_CIRCLE]


def _turns(parts: dict[tuple[int, int], float]) -> list[float]:
    """Angles at which sum of parts[a, b] c^a s^b is 0.

    With z = e^(i theta), c = (z + 1/z)/2 and s = (z - 1/z)/(2 i): roots z of modulus 1,
    then Newton's method in theta.
    """
    degree = max(a + b for a, b in parts)
    total = np.zeros(2 * degree + 1, dtype=complex)
    for (a, b), value in parts.items():
        term = np.array([value], dtype=complex)
        factors = [[0.5, 0, 0.5]] * a + [[-0.5j, 0, 0.5j]] * b
        for factor in factors + [[0, 1, 0]] * (degree - a - b):
            term = np.convolve(term, np.array(factor))
        total += term
    size = float(np.abs(total).sum())
    on_circle = [z for z in np.roots(total) if abs(abs(z) - 1) < _ON_CIRCLE]
    polished = [_polish(total, degree, float(np.angle(z))) for z in on_circle]
    return [t for t in polished if abs(_value(total, degree, t)) <= _RESIDUAL * size]


def _polish(total: NDArray[np.complex128], degree: int, theta: float) -> float:
    powers = np.arange(degree, -degree - 1, -1)
    for _ in range(_STEPS):
        slope = float((total * 1j * powers * np.exp(1j * powers * theta)).sum().real)
        if slope == 0:
            break
        step = _value(total, degree, theta) / slope
        if abs(step) > _ON_CIRCLE:
            break
        theta -= step
    return theta


def _value(total: NDArray[np.complex128], degree: int, theta: float) -> float:
    powers = np.arange(degree, -degree - 1, -1)
    return float((total * np.exp(1j * powers * theta)).sum().real)
