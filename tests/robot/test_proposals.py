from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Chain,
    Joint,
    Translation,
    Vector,
)
from cuspaudit.robot.proposals import fitting_locks, fitting_tasks, is_regular
from cuspaudit.robot.task import lock


def arm(*axes: Vector) -> Chain:
    """Revolute joints about the axes, one unit apart in different directions."""
    steps = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 1), (1, 0, 1))
    joints = []
    for k, axis in enumerate(axes):
        x, y, z = (Fraction(entry) for entry in steps[k % 6])
        joints.append(Joint(f"j{k + 1}", "revolute", (Translation((x, y, z)),), axis))
    tool = (Translation((Fraction(0), Fraction(0), Fraction(1))),)
    return Chain("arm", tuple(joints), tool)


def test_a_joint_about_the_tool_axis_leaves_the_other_axes() -> None:
    """Five joints, the last about z of the tip at the tip: z is not proposed."""
    chain = arm(Z_AXIS, Y_AXIS, Y_AXIS, Y_AXIS, Z_AXIS)
    assert fitting_tasks(chain) == ["position-and-x-axis", "position-and-y-axis"]
    assert not is_regular(replace(chain, task="position-and-z-axis"))
    assert fitting_tasks(arm(Z_AXIS, Y_AXIS, Y_AXIS, Y_AXIS, X_AXIS)) == [
        "position-and-z-axis",
        "position-and-x-axis",
        "position-and-y-axis",
    ]


def test_four_joints_have_an_angle_or_a_joint_to_lock() -> None:
    """Four joints with an angle have their task; without, one can be locked."""
    yaw_and_pitch = arm(Z_AXIS, Y_AXIS, Y_AXIS, Y_AXIS)
    assert fitting_tasks(yaw_and_pitch) == ["position-and-angle"]
    general = arm(Z_AXIS, Y_AXIS, X_AXIS, Y_AXIS)
    assert fitting_tasks(general) == []
    locks = fitting_locks(general, 1)
    assert len(locks) > 1
    for names in locks:
        held = lock(general, dict.fromkeys(names, "0"))
        assert is_regular(replace(held, task="position"))


def test_a_lock_that_makes_axes_coincide_is_not_proposed() -> None:
    """Locking the joint between two axes that then are one leaves no pose."""
    axes = (Z_AXIS, Y_AXIS, Z_AXIS, Y_AXIS, Z_AXIS, Y_AXIS, Z_AXIS)
    chain = arm(*axes)
    joints = list(chain.joints)
    for k in (1, 2, 4, 6):
        along = (Fraction(0), Fraction(0), Fraction(k % 2))
        joints[k] = replace(joints[k], before=(Translation(along),))
    chain = chain.with_joints(joints)
    proposed = [names for [names] in fitting_locks(chain, 1)]
    assert proposed
    assert "j2" not in proposed  # axes 1 and 3 are then one line
