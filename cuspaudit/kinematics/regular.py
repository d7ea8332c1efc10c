"""Whether an arm moves with the full freedom of its task in some posture.

det J is a polynomial that may have thousands of terms. That it is not identically 0 is
seen at one posture, in ball arithmetic; only where it is 0 there, or a ball too wide to
tell, the polynomial is made.
"""

from __future__ import annotations

from collections.abc import Mapping

from flint import arb, arb_mat, ctx

from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.transform import Column, Transform

__all__ = ["POSTURES", "determinant_at", "is_regular_somewhere"]

_BITS = 128
_HALVES = ((1, 3), (2, 5), (-3, 7), (5, 4), (-7, 9), (11, 8))
"""Tangents of half the joint angles, or displacements: nothing special."""
POSTURES = len(_HALVES)
"""How many postures there are to start from."""


def is_regular_somewhere(model: ExactModel) -> bool:
    """Whether det J is not identically 0; proved either way.

    Raises:
        UnableError: the number of joints is not the dimension of the task.
    """
    count = {"position": 3, "pose": 6}.get(model.chain.task)
    if count == len(model.joints):
        saved, ctx.prec = ctx.prec, _BITS
        try:
            if not determinant_at(model).contains(0):
                return True
        finally:
            ctx.prec = saved
    return bool(jacobian_determinant(model) != 0)


def determinant_at(
    model: ExactModel, start: int = 0, values: Mapping[str, arb] | None = None
) -> arb:
    """A ball with det J at one posture, of a position or pose task.

    Args:
        model: of as many joints as the task has dimensions.
        start: which posture, from 0 to `POSTURES` - 1.
        values: of variables that stand in its fixed transforms, as balls.
    """
    turn, place = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1]), arb_mat(3, 1)
    axes, points = [], []
    known = values or {}
    halves = _HALVES[start:] + _HALVES[:start]
    for joint, (above, below) in zip(model.joints, halves, strict=False):
        before, shift = _balls(model, joint.before, known)
        turn, place = turn * before, place + turn * shift
        axis = _column(model, joint.axis, known)
        axes.append(turn * axis)
        points.append(place)
        if joint.kind == "prismatic":
            place = place + turn * axis * (arb(above) / below)
        else:
            turn = turn * _rotation(axis, arb(above) / below)
    tip = place + turn * _balls(model, model.tool, known)[1]
    columns = []
    for joint, axis, point in zip(model.joints, axes, points, strict=True):
        if joint.kind == "prismatic":
            linear, angular = axis, arb_mat(3, 1)
        else:
            linear, angular = _skew(axis) * (tip - point), axis
        columns.append([*linear.entries(), *angular.entries()][: len(model.joints)])
    flat = [entry for column in columns for entry in column]
    return arb_mat(len(columns), len(columns), flat).det()


def _rotation(axis: arb_mat, half: arb) -> arb_mat:
    """The rotation about a unit axis by the angle of which ``half`` is tan(angle / 2).

    It is 1 + s K + (1 - c) K^2 (Rodrigues), K the vector product with the axis.
    """
    below = 1 + half * half
    K = _skew(axis)
    one = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1])
    return one + K * (2 * half / below) + K * K * (2 * half * half / below)


def _skew(vector: arb_mat) -> arb_mat:
    x, y, z = vector.entries()
    return arb_mat(3, 3, [0, -z, y, z, 0, -x, -y, x, 0])


def _balls(
    model: ExactModel, motion: Transform, values: Mapping[str, arb]
) -> tuple[arb_mat, arb_mat]:
    entries = [entry for row in motion.rotation for entry in row]
    rotation = [model.ring.evaluate(entry, values) for entry in entries]
    return arb_mat(3, 3, rotation), _column(model, motion.translation, values)


def _column(model: ExactModel, column: Column, values: Mapping[str, arb]) -> arb_mat:
    return arb_mat(3, 1, [model.ring.evaluate(entry, values) for entry in column])
