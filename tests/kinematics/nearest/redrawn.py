"""Arms drawn anew: other link frames, other zeros of the joints, moved axes."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np

from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
)

_QUARTER = Angle(Fraction(1, 2))


def redrawn(chain: Chain, seed: int) -> Chain:
    """The same arm: frames slide along and turn about their axes, and lie otherwise."""
    rng = np.random.default_rng(seed)
    joints: list[Joint] = []
    back: tuple[Motion, ...] = ()
    for joint in chain.joints:
        x, y, z = joint.axis
        height = Fraction(int(rng.integers(-9, 10)), 10)
        slide = Translation((height * x, height * y, height * z))
        undo = Translation((-height * x, -height * y, -height * z))
        turn = Rotation(joint.axis, Angle(radians=Fraction(int(rng.integers(9)), 3)))
        if joint.kind == "prismatic":
            turn = Rotation(joint.axis, Angle())
        # a frame that is turned by a quarter about x sees the axis as (x, z, -y)
        before = (*back, *joint.before, slide, turn, Rotation(X_AXIS, _QUARTER))
        joints.append(replace(joint, before=before, axis=(x, z, -y)))
        back = (Rotation(X_AXIS, -_QUARTER), undo)
    base = (Translation((Fraction(1), Fraction(2), Fraction(3))),)
    joints[0] = replace(joints[0], before=(*base, *joints[0].before))
    return replace(chain, joints=tuple(joints), tool=(*back, *chain.tool))


def moved(chain: Chain, seed: int, length: Fraction, angle: Fraction) -> Chain:
    """An arm whose axes have each moved in their links by so much at most."""
    rng = np.random.default_rng(seed)
    joints = [chain.joints[0]]
    for joint in chain.joints[1:]:
        x, y, z = (Fraction(int(v), 1000) for v in rng.integers(-577, 578, 3))
        shift = Translation((x * length, y * length, z * length))
        tilt = Angle(radians=angle * Fraction(int(rng.integers(-1000, 1001)), 1000))
        about = (X_AXIS, Y_AXIS)[int(rng.integers(2))]
        motions = (*joint.before, shift, Rotation(about, tilt))
        joints.append(replace(joint, before=motions))
    return chain.with_joints(joints)
