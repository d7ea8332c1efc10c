from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.locked.axes import not_parallel
from cuspaudit.kinematics.locked.locked_arm import locked_arm
from cuspaudit.kinematics.locked.regular_over import is_regular, is_singular_everywhere
from cuspaudit.kinematics.locked.span import WHOLE_CIRCLE, Span
from cuspaudit.kinematics.locked.structures import holds, structures
from cuspaudit.kinematics.regular import determinant_at
from cuspaudit.robot.chain import Angle, Chain, Joint, Rotation, Translation
from cuspaudit.robot.task import lock

Read = Callable[[str], Chain]


def degrees(low: int, high: int) -> Span:
    """A span of whole degrees."""
    return Span(Angle(Fraction(low, 180)), Angle(Fraction(high, 180)))


@pytest.mark.parametrize(
    ("name", "names"),
    [
        ("kuka-lbr-iiwa-14", {"spherical wrist", "triple and pair"}),
        ("barrett-wam", {"spherical wrist", "triple and pair"}),
        ("motoman-sia5d", {"spherical wrist", "triple and pair"}),
        ("motoman-sia50d", {"spherical wrist"}),
        ("motoman-sia5d-a1", set()),
        ("motoman-sia50d-a3", set()),
        ("franka-panda", set()),
        ("ufactory-xarm7", set()),
    ],
)
def test_structures_at_every_value_of_joint_3(
    seven_joints: Read, name: str, names: set[str]
) -> None:
    """With joint 3 locked, arms that are published noncuspidal have a structure."""
    held = locked_arm(seven_joints(name), 3)
    found = structures(held)
    assert {each.name for each in found} == names
    for part in WHOLE_CIRCLE.parts(36) if found else ():
        assert any(holds(held, each, part) for each in found)


def test_a_structure_of_some_values_is_none_of_all(seven_joints: Read) -> None:
    """Axes 2 and 4 of SIA50D with a3 are parallel at 0, which is no identity."""
    chain = seven_joints("motoman-sia50d-a3")
    held = locked_arm(chain, 3)
    assert structures(held) == ()
    ring, arm = held.arm.ring, held.arm
    entries = not_parallel(held, 2)
    assert not held.vanishes(*entries)
    there = {"c3": 1, "s3": 0}
    assert all(ring.substitute(entry, there) == 0 for entry in entries)
    assert arm.chain.kinds == ("revolute",) * 6


def test_a_locked_elbow_is_singular_everywhere(seven_joints: Read) -> None:
    """Joint 4 of an iiwa locked, shoulder and wrist keep their distance: det J = 0."""
    assert is_singular_everywhere(locked_arm(seven_joints("kuka-lbr-iiwa-14"), 4))
    assert not is_singular_everywhere(locked_arm(seven_joints("franka-panda"), 4))


def test_values_that_make_every_posture_singular_are_in_no_structure(
    seven_joints: Read,
) -> None:
    """At theta2 = 0 axes 1 and 3 of an iiwa are one line: the theorem is silent."""
    held = locked_arm(seven_joints("kuka-lbr-iiwa-14"), 2)
    found = structures(held)
    assert any(holds(held, each, degrees(30, 31)) for each in found)
    assert not any(holds(held, each, degrees(-1, 1)) for each in found)
    assert not is_regular(held, degrees(0, 0))
    assert is_regular(held, degrees(30, 40))


@pytest.mark.parametrize("number", range(1, 8))
def test_the_locked_arm_is_the_arm_locked(seven_joints: Read, number: int) -> None:
    """Det J with the lock's variables put in is that of the chain locked there."""
    chain = seven_joints("franka-panda")
    held = locked_arm(chain, number)
    for twelfths in (1, 7, -4):
        value = Angle(Fraction(twelfths, 12) * 2)
        own = exact_model(lock(chain, {chain.joints[number - 1].name: value}))
        at = held.values(Span(value, value))
        one = determinant_at(held.arm, 2, at)
        other = determinant_at(own, 2)
        shift = held.arm.zeros - own.zeros
        if np.abs(np.sin(shift / 2)).max() < 1e-12:
            assert abs(float(one) - float(other)) < 1e-12


@pytest.mark.parametrize("number", [2, 3])
def test_a_shoulder_is_asked_about_its_own_lock(number: int) -> None:
    """Four axes through one point, one locked: a shoulder where no two are parallel."""
    one, x, z = Fraction(1), (1, 0, 0), (0, 0, 1)
    square, third = (
        Rotation((Fraction(a), Fraction(b), Fraction(c)), Angle(Fraction(1, part)))
        for (a, b, c), part in ((x, 2), (z, 3))
    )
    along, up = (Translation((one * a, one * b, one * c)) for a, b, c in (x, z))
    before = ((), (square,), (third, square), (square,))
    before += ((along, square), (up, square), (along, square))
    joints = tuple(
        Joint(name, "revolute", motions)
        for name, motions in zip("abcdefg", before, strict=True)
    )
    held = locked_arm(Chain("four through one point", joints, (up,)), number)
    shoulders = [s for s in structures(held) if s.name == "spherical shoulder"]
    assert shoulders
    parallel = Angle(Fraction(-1, 3)) if number == 2 else Angle()
    for structure in shoulders:
        assert holds(held, structure, degrees(40, 42))
        assert not holds(held, structure, Span(parallel, parallel))


def test_spans_cover_and_halve_exactly() -> None:
    """Parts and halves of a span share their ends and leave nothing out."""
    parts = WHOLE_CIRCLE.parts(7)
    assert parts[0].lower == WHOLE_CIRCLE.lower
    assert parts[-1].upper == WHOLE_CIRCLE.upper
    assert all(a.upper == b.lower for a, b in pairwise(parts))
    left, right = parts[3].halves()
    assert left.upper == right.lower == parts[3].middle
    assert WHOLE_CIRCLE.degrees == pytest.approx(360)
