from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import X_AXIS, Angle, Chain, Joint, Translation
from cuspaudit.robot.frames import frames
from cuspaudit.robot.proposals import check_task
from cuspaudit.robot.task import default_task, lock

STEP = Translation((Fraction(1), Fraction(0), Fraction(1, 2)))
JOINTS = tuple(
    Joint(f"j{k}", "prismatic" if k == 2 else "revolute", (STEP,), X_AXIS)
    for k in range(1, 5)
)
ARM = Chain("arm", JOINTS, (STEP,))


def test_a_locked_joint_stands_still() -> None:
    """Locking is the chain with that joint at the given value, first and last too."""
    full = frames(ARM, [0.5, 0.25, 0.75, 1.0])[-1]
    for values, rest in (
        ({"j1": "0.5 rad"}, [0.25, 0.75, 1.0]),
        ({"j2": "1/4"}, [0.5, 0.75, 1.0]),
        ({"j4": Angle(radians=Fraction(1)), "j2": Fraction(1, 4)}, [0.5, 0.75]),
    ):
        chain = lock(ARM, values)
        assert frames(chain, rest)[-1] == pytest.approx(full, abs=1e-15)


def test_a_joint_locked_at_zero_leaves_nothing() -> None:
    """Zero needs no unit and adds no motion."""
    assert lock(ARM, {"j1": "0"}).joints[0].before == (STEP, STEP)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"j9": "0"}, 'the joints are "j1", "j2", "j3", "j4"'),
        ({"j1": "1.57"}, "no unit"),
        ({"j2": "1 deg"}, "is not a number"),
        ({"j2": Angle()}, "give a length"),
        ({"j1": "0", "j2": "0", "j3": "0", "j4": "0"}, "leave some joints free"),
    ],
)
def test_locks_that_cannot_be(
    values: dict[str, str | Angle | Fraction], said: str
) -> None:
    """An unknown joint, a value of another kind, and locking all are refused."""
    with pytest.raises(InvalidRobotError, match=said):
        lock(ARM, values)


def test_the_task_has_to_be_square() -> None:
    """Each task fits one number of joints; others are told what to lock or to ask."""
    check_task(lock(ARM, {"j2": "0"}))
    with pytest.raises(InvalidRobotError, match=r'lock one of .*"j4" by --lock'):
        check_task(ARM)
    with pytest.raises(InvalidRobotError, match=r"1 joint for .* 3 joints is needed"):
        check_task(ARM.with_joints(JOINTS[:1]))
    square = replace(ARM.with_joints([JOINTS[k] for k in (0, 1, 3)]), task="pose")
    with pytest.raises(InvalidRobotError, match="give --task position"):
        check_task(square)
    with pytest.raises(InvalidRobotError, match="give --lock j1=0 --lock j3=0"):
        check_task(ARM.with_joints([*JOINTS, replace(JOINTS[0], name="j5")]))
    assert [default_task(n) for n in (3, 6, 7)] == ["position", "pose", "pose"]
    assert default_task(5) == "position-and-z-axis"
