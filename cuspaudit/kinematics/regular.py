"""Whether an arm moves with the full freedom of its task in some posture.

det J is a polynomial that may have thousands of terms. That it is not identically 0 is
seen at one posture, in ball arithmetic; only where it is 0 there, or a ball too wide to
tell, the polynomial is made.
"""

from __future__ import annotations

from flint import arb, arb_mat, ctx

from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.transform import Column, Transform

__all__ = ["is_regular_somewhere"]

_BITS = 128
_HALVES = ((1, 3), (2, 5), (-3, 7), (5, 4), (-7, 9), (11, 8))
"""Tangents of half the joint angles, or displacements: nothing special."""


def is_regular_somewhere(model: ExactModel) -> bool:
    """Whether det J is not identically 0; proved either way.

    Raises:
        UnableError: the number of joints is not the dimension of the task.
    """
    count = {"position": 3, "pose": 6}.get(model.chain.task)
    if count == len(model.joints):
        saved, ctx.prec = ctx.prec, _BITS
        try:
            if not _determinant(model).contains(0):
                return True
        finally:
            ctx.prec = saved
    return bool(jacobian_determinant(model) != 0)


def _determinant(model: ExactModel) -> arb:
    """A ball with det J at one posture, of a position or pose task."""
    turn, place = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1]), arb_mat(3, 1)
    axes, points = [], []
    for joint, (above, below) in zip(model.joints, _HALVES, strict=False):
        before, shift = _balls(model, joint.before)
        turn, place = turn * before, place + turn * shift
        axis = _column(model, joint.axis)
        axes.append(turn * axis)
        points.append(place)
        if joint.kind == "prismatic":
            place = place + turn * axis * (arb(above) / below)
        else:
            turn = turn * _rotation(axis, arb(above) / below)
    tip = place + turn * _balls(model, model.tool)[1]
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


def _balls(model: ExactModel, motion: Transform) -> tuple[arb_mat, arb_mat]:
    entries = [entry for row in motion.rotation for entry in row]
    rotation = [model.ring.evaluate(entry, {}) for entry in entries]
    return arb_mat(3, 3, rotation), _column(model, motion.translation)


def _column(model: ExactModel, column: Column) -> arb_mat:
    return arb_mat(3, 1, [model.ring.evaluate(entry, {}) for entry in column])
