from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cuspaudit.errors import UnsupportedJointError
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.coupling import Coupling, uncoupled
from cuspaudit.robot.frames import frames
from cuspaudit.robot.place import Place

PLACE = Place("arm.urdf")
LIMITS = (Angle(radians=Fraction(-1)), Angle(radians=Fraction(1)))


def step(*xyz: str) -> Translation:
    """A translation."""
    x, y, z = map(Fraction, xyz)
    return Translation((x, y, z))


def turning(name: str, axis: Vector, *before: Motion) -> Joint:
    """A revolute joint."""
    return Joint(name, "revolute", before, axis, LIMITS)


def couple(driver: str, multiplier: str = "-1", offset: str = "0") -> Coupling:
    """A coupling."""
    return Coupling(driver, Fraction(multiplier), Fraction(offset), PLACE)


YAW = turning("yaw", Z_AXIS, step("0", "0", "0.2"))
SHOULDER = turning("shoulder", Y_AXIS, step("0.1", "0", "0.1"))
LEVEL = turning("level", Y_AXIS, step("0", "0", "0.5"))
ELBOW = turning("elbow", Y_AXIS)
FOREARM = (step("0.4", "0.02", "0"), Rotation(X_AXIS, Angle(Fraction(1, 5))))
PLATE = turning("elbow", Y_AXIS, step("0.07", "0", "0.03"))
HAND = turning("hand", Y_AXIS, step("0.4", "0.02", "0"))
TOOL = (step("0.1", "0", "-0.15"),)


def tip(chain: Chain, values: dict[str, float]) -> np.ndarray:
    """Where the tip is at joint values by name."""
    return frames(chain, [values[joint.name] for joint in chain.joints])[-1]


@pytest.mark.parametrize("offset", ["0", "0.3"])
@pytest.mark.parametrize("multiplier", ["-1", "1", "1/2"])
def test_a_joint_beside_its_partner_goes_into_it(multiplier: str, offset: str) -> None:
    """Whatever the multiplier, the links stand as with one free joint less."""
    chain = Chain("arm", (YAW, SHOULDER, LEVEL, ELBOW), FOREARM)
    coupling = couple("shoulder", multiplier, offset)
    free, notes = uncoupled(chain, {"level": coupling})
    assert [joint.name for joint in free.joints] == ["yaw", "shoulder", "elbow"]
    assert all(joint.limits is None for joint in free.joints)
    assert any("stands for elbow" in note for note in notes)
    assert notes[-1] == 'limits are left out: those of "elbow" hold for a sum of values'
    for yaw, shoulder, elbow in np.random.default_rng(0).uniform(-3, 3, (5, 3)):
        share = float(coupling.multiplier) * shoulder
        values = {"yaw": yaw, "shoulder": shoulder, "elbow": elbow}
        coupled = values | {"level": share + float(coupling.offset)}
        merged = values | {"elbow": elbow + share}
        assert tip(free, merged) == pytest.approx(tip(chain, coupled), abs=1e-12)


def test_a_palletizer_is_three_joints() -> None:
    """A plate and a hand held level: the place of the tip is that of three joints."""
    chain = Chain("arm", (YAW, SHOULDER, LEVEL, PLATE, HAND), TOOL)
    couplings = {"level": couple("shoulder"), "hand": couple("elbow", "-1", "0.4")}
    free, notes = uncoupled(chain, couplings)
    assert [joint.name for joint in free.joints] == ["yaw", "shoulder", "elbow"]
    assert "hand mimics elbow and turns no arm: left out" in notes
    for yaw, shoulder, elbow in np.random.default_rng(1).uniform(-3, 3, (5, 3)):
        values = {"yaw": yaw, "shoulder": shoulder, "elbow": elbow}
        coupled = values | {"level": -shoulder, "hand": 0.4 - elbow}
        merged = values | {"elbow": elbow - shoulder}
        expected = tip(chain, coupled)[:3, 3]
        assert tip(free, merged)[:3, 3] == pytest.approx(expected, abs=1e-12)


def test_a_driver_off_the_chain_leaves_the_joint_free() -> None:
    """With its driver elsewhere a joint is free; two joints of one driver are not."""
    chain = Chain("arm", (YAW, SHOULDER, ELBOW), FOREARM)
    free, notes = uncoupled(chain, {"elbow": couple("motor")})
    assert free == chain
    assert notes == ["elbow mimics motor, off the chain: it moves freely"]
    bounded = replace(couple("motor", "-1/2", "0.1"), limits=LIMITS)
    free, _ = uncoupled(chain, {"elbow": bounded})
    own = (Angle(radians=Fraction(-2, 5)), Angle(radians=Fraction(3, 5)))
    assert free.joints[-1].limits == own
    assert free.joints[0].limits == LIMITS
    far = replace(couple("motor", "1", "7"), limits=LIMITS)
    with pytest.raises(UnsupportedJointError, match="limits leave it no range"):
        uncoupled(chain, {"elbow": far})
    with pytest.raises(UnsupportedJointError, match='"motor", and so does'):
        uncoupled(chain, {"elbow": couple("motor"), "yaw": couple("motor")})


@pytest.mark.parametrize(
    ("joints", "couplings"),
    [
        ((YAW, SHOULDER, PLATE), {"elbow": couple("shoulder")}),
        ((YAW, SHOULDER, LEVEL, PLATE), {"level": couple("shoulder", "-2")}),
        ((YAW, SHOULDER, LEVEL, ELBOW), {"level": couple("shoulder", "0")}),
        (
            (YAW, SHOULDER, LEVEL, ELBOW),
            {"level": couple("elbow"), "shoulder": couple("level")},
        ),
    ],
)
def test_another_coupling_is_refused_with_its_reason(
    joints: tuple[Joint, ...], couplings: dict[str, Coupling]
) -> None:
    """A driven joint alone on its axis, or in a ring of couplings, is refused."""
    with pytest.raises(UnsupportedJointError, match=r"it mimics joint .*, and "):
        uncoupled(Chain("arm", joints, FOREARM), couplings)


def test_limits_are_carried_where_the_box_stays_one() -> None:
    """With a partner without limits a driver keeps what its driven joint leaves."""
    loose = replace(ELBOW, limits=None)
    chain = Chain("arm", (YAW, SHOULDER, LEVEL, loose), FOREARM)
    free, notes = uncoupled(chain, {"level": couple("shoulder", "-2", "0.5")})
    assert notes[-1] == "limits of driven joints are taken for their drivers"
    yaw, shoulder, elbow = free.joints
    assert (yaw.limits, elbow.limits) == (LIMITS, None)
    # level = 0.5 - 2 shoulder lies within 1
    assert shoulder.limits == (
        Angle(radians=Fraction(-1, 4)),
        Angle(radians=Fraction(3, 4)),
    )
    rng = np.random.default_rng(4)
    for value in rng.uniform(-1.2, 1.2, 50):
        inside = abs(value) < 1 and abs(0.5 - 2 * value) < 1
        assert (-0.25 < value < 0.75) == inside


def test_a_hand_that_turns_no_arm_still_limits_its_driver() -> None:
    """It is left out, and its limits hold for the joint it follows."""
    wide = (Angle(radians=Fraction(-3)), Angle(radians=Fraction(3)))
    plate = replace(PLATE, limits=wide)
    chain = Chain("arm", (YAW, SHOULDER, plate, HAND), TOOL)
    free, notes = uncoupled(chain, {"hand": couple("elbow", "-1", "0.4")})
    assert notes[0] == "hand mimics elbow and turns no arm: left out"
    elbow = free.joints[-1]
    assert elbow.name == "elbow"
    assert elbow.limits == tuple(Angle(radians=Fraction(x, 5)) for x in (-3, 7))
