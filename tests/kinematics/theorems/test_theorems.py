from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from short_tables import Number, arm, degrees, shift, with_wrist

from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.theorems.registry import THEOREMS, looked_for, reduction_of
from cuspaudit.kinematics.theorems.theorem import Reduction
from cuspaudit.robot.chain import Y_AXIS, Chain, Motion, Rotation, reverse
from cuspaudit.robot.frames import frames

Row = tuple[Number, ...]
REGIONAL = ((1, 2, "3/2"), (0, 1, "1/3"), (-90, 90, 30))
UR = ((0, 2, 3, 0, 0, 1), (1, 0, 0, 1, 2, 1), (90, 0, 0, 90, -90, 0))


def reduced(chain: Chain) -> Reduction | None:
    """The reduction of a chain."""
    return reduction_of(exact_model(chain))


def test_the_regional_arm_moves_the_wrist_center() -> None:
    """The tip of the regional arm is where axes 4, 5, 6 meet, at random postures."""
    chain = with_wrist(arm(*REGIONAL))
    found = reduced(chain)
    assert found is not None
    assert found.regional is not None
    for q in np.random.default_rng(3).uniform(-3, 3, (5, 6)):
        center = frames(found.regional.chain, q[:3])[-1, :3, 3]
        placed = frames(chain, q)
        for i in (3, 4, 5):
            axis = placed[i, :3, 2]
            arrow = center - placed[i, :3, 3]
            assert np.allclose(np.cross(axis, arrow), 0, atol=1e-9)
    alone = exact_model(arm(*REGIONAL))
    determinant = found.regional.ring.from_other(
        jacobian_determinant(alone), alone.ring
    )
    assert jacobian_determinant(found.regional) == determinant
    assert determinant != 0


@pytest.mark.parametrize("along", ["0", "0.3", "-1.25"])
def test_the_wrist_may_be_written_anywhere_on_its_axes(along: str) -> None:
    """Origins of joints 4, 5, 6 may slide along their axes."""
    chain = with_wrist(arm(*REGIONAL))
    joints = list(chain.joints)
    slide = shift(0, 0, along)
    # joint 4's frame up its own axis, joint 5 back by as much
    back = shift(0, 0, str(-Fraction(along)))
    joints[3] = replace(joints[3], before=(*joints[3].before, slide))
    joints[4] = replace(joints[4], before=(back, *joints[4].before))
    moved = chain.with_joints(joints)
    first, second = reduced(chain), reduced(moved)
    assert first is not None
    assert second is not None
    assert second.kind == "spherical wrist"
    assert first.regional is not None
    assert second.regional is not None
    one, other = (jacobian_determinant(r.regional) for r in (first, second))
    assert one == other


def test_a_wrist_is_not_a_shoulder() -> None:
    """The wrist is looked for first; reversed it is a shoulder."""
    chain = with_wrist(arm(*REGIONAL))
    first, second = reduced(chain), reduced(reverse(chain))
    assert first is not None
    assert second is not None
    assert (first.kind, first.is_reversed) == ("spherical wrist", False)
    assert (second.kind, second.is_reversed) == ("spherical shoulder", True)
    assert "last three joints" in second.why


@pytest.mark.parametrize(
    ("joint", "motion", "kept"),
    [
        (5, shift("0.01", 0, 0), False),
        (5, shift(0, 0, "0.01"), False),
        (4, shift("0.01", 0, 0), False),
        # along axis 6, and about it: the wrist is the same
        (5, shift(0, "0.01", 0), True),
        (5, Rotation(Y_AXIS, degrees(1)), True),
    ],
)
def test_a_moved_wrist_axis_is_noticed(joint: int, motion: Motion, kept: bool) -> None:
    """A wrist axis beside the center makes no spherical wrist."""
    chain = with_wrist(arm(*REGIONAL))
    joints = list(chain.joints)
    before = (motion, *joints[joint].before)
    joints[joint] = replace(joints[joint], before=before)
    found = reduced(chain.with_joints(joints))
    assert (found is not None) == kept


def test_two_centers_are_not_one() -> None:
    """Axes 4, 5 and 5, 6 may meet at right angles in two different points."""
    chain = with_wrist(arm(*REGIONAL))
    joints = list(chain.joints)
    # along axis 5, which is the z axis of joint 5's frame
    joints[5] = replace(joints[5], before=(shift(0, 0, "1/100"), *joints[5].before))
    assert reduced(chain.with_joints(joints)) is None


def test_the_ur_pattern_needs_no_regional_arm() -> None:
    """The theorem says noncuspidal by itself."""
    found = reduced(arm(*UR))
    assert found is not None
    assert found.kind == "UR pattern"
    assert found.regional is None
    assert not found.is_reversed


def test_the_determinant_of_the_ur_pattern() -> None:
    """The determinant is a multiple of s3 s5 E, as the docstring says."""
    model = exact_model(arm(*UR))
    determinant = jacobian_determinant(model)
    ring = model.ring
    for name in ("s3", "s5"):
        assert divmod(determinant, ring.gen(name))[1] == 0
    rest = divmod(determinant, ring.gen("s3") * ring.gen("s5"))[0]
    # E has one term of length a2 = 2, those of a3 = 3 and of d5 = 2
    assert rest.derivative("s5") == rest.derivative("c5") == 0


@pytest.mark.parametrize("kinds", ["PRRRRR", "RRRPRR", "RRRRRP"])
def test_theorems_on_turns_say_nothing_of_slides(kinds: str) -> None:
    """With a sliding joint only a theorem on slides may hold."""
    found = reduced(arm(*UR, kinds))
    assert found is None or found.kind in ("plane and pair", "three slides")


def test_what_is_looked_for_is_listed() -> None:
    """One line a structure, and the names of all."""
    names = looked_for("pose")
    assert len(names) == len(set(names)) >= 6
    assert set(names) == {each.looked_for for each in THEOREMS if each.task == "pose"}
    assert "UR pattern" in names[2]


def test_each_theorem_gives_its_own_name() -> None:
    """What a theorem says bears its name, and no two share one."""
    names = [theorem.name for theorem in THEOREMS]
    assert len(set(names)) == len(names)
    found = [reduced(arm(*UR)), reduced(with_wrist(arm(*REGIONAL)))]
    assert {each.kind for each in found if each} == {"UR pattern", "spherical wrist"}
    assert {"UR pattern", "spherical wrist"} <= set(names)


@pytest.mark.parametrize(
    ("twists", "equivalent", "full"),
    [
        ((-90, 90), True, True),
        ((-60, 90), True, False),
        ((60, 60), True, False),
        ((120, -60), True, False),
        # the squares of the cosines add up to 1, and to more
        ((45, 45), False, False),
        ((60, 30), False, False),
        ((30, 45), False, False),
    ],
)
def test_what_the_twists_of_a_wrist_allow(
    twists: Row, equivalent: bool, full: bool
) -> None:
    """A cuspidal regional arm makes the arm so if axis 6 can stand square to axis 4."""
    found = reduced(with_wrist(arm(*REGIONAL), twists))
    assert found is not None
    assert found.kind == "spherical wrist"
    assert (found.is_equivalent, found.is_full) == (equivalent, full)
    back = reduced(reverse(with_wrist(arm(*REGIONAL), twists)))
    assert back is not None
    assert back.kind == "spherical shoulder"
    assert back.is_equivalent == equivalent


@pytest.mark.parametrize("twists", [(-60, 90), (60, 45), (30, 45)])
def test_the_center_of_a_skew_wrist(twists: Row) -> None:
    """Axes 4, 5, 6 pass through the tip of the regional arm, whatever the twists."""
    chain = with_wrist(arm(*REGIONAL), twists)
    joints = list(chain.joints)
    joints[3] = replace(joints[3], before=(*joints[3].before, shift(0, 0, "0.3")))
    joints[4] = replace(joints[4], before=(shift(0, 0, "-0.3"), *joints[4].before))
    chain = chain.with_joints(joints)
    found = reduced(chain)
    assert found is not None
    assert found.regional is not None
    for q in np.random.default_rng(3).uniform(-3, 3, (5, 6)):
        center = frames(found.regional.chain, q[:3])[-1, :3, 3]
        placed = frames(chain, q)
        for i in (3, 4, 5):
            arrow = center - placed[i, :3, 3]
            assert np.allclose(np.cross(placed[i, :3, 2], arrow), 0, atol=1e-9)


def test_the_eight_aspects_of_the_ur_pattern_stand_a_flood_fill() -> None:
    """On a grid of (theta2, theta3, theta4) the UR5's s3 E has four components."""
    a2, a3, d5 = -0.425, -0.39225, 0.09465
    angles = (np.arange(48) + 0.5) * 2 * np.pi / 48
    t2, t3, t4 = np.meshgrid(angles, angles, angles, indexing="ij")
    reach = a2 * np.cos(t2) + a3 * np.cos(t2 + t3) + d5 * np.sin(t2 + t3 + t4)
    left = (np.sin(t3) > 0) * 2 + (reach > 0)
    seen = np.zeros(left.shape, dtype=bool)
    components = 0
    for start in np.ndindex(*left.shape):
        if seen[start]:
            continue
        components += 1
        seen[start] = True
        todo = [start]
        while todo:
            cell = todo.pop()
            for axis in range(3):
                for step in (1, -1):
                    near = list(cell)
                    near[axis] = (near[axis] + step) % 48
                    index = tuple(near)
                    if not seen[index] and left[index] == left[cell]:
                        seen[index] = True
                        todo.append(index)
    assert components == 4
