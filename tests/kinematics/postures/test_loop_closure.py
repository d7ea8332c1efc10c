from __future__ import annotations

import pytest
from flint import fmpq, fmpq_poly
from short_tables import arm

from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.postures.exact import arm_and_pose
from cuspaudit.kinematics.postures.loop_closure import closes
from cuspaudit.kinematics.postures.loop_turns import cos_sin

TANGENTS = tuple(fmpq(k, 3) for k in (1, -2, 4, 5, -1, 2))


@pytest.mark.parametrize("twist", [90, 60, 45])
def test_a_posture_closes_its_loop_and_no_other_does(twist: int) -> None:
    """The given posture does; with one angle changed, or one number, it does not."""
    table = ((1, 2, 0, 1, 0, 0), (0, 1, 0, 1, 2, 1), (90, twist, 90, twist, 90, 0))
    field, own, pose = arm_and_pose(exact_model(arm(*table)), TANGENTS)
    values = [x for t in TANGENTS for x in cos_sin(t)]
    omega = fmpq_poly([-3, 1])
    if field.radicand is not None:
        omega = fmpq_poly([-field.radicand, 0, 1])

    def answer(numbers: list[fmpq]) -> bool:
        rho = [x * omega.derivative() % omega for x in map(_constant, numbers)]
        if field.radicand is not None:
            rho.append(fmpq_poly([0, 1]) * omega.derivative() % omega)
        return closes(field, own, pose, omega, rho)

    assert answer(values)
    for k in range(6):
        c, s = cos_sin(TANGENTS[k] + fmpq(1, 10**9))
        assert not answer([*values[: 2 * k], c, s, *values[2 * k + 2 :]])
    assert not answer([values[0] + 1, *values[1:]])


def _constant(value: fmpq) -> fmpq_poly:
    return fmpq_poly([value])
