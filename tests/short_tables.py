"""Chains written in one line, for tests: D-H columns with angles in degrees."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
)

Number = int | str | Fraction


def degrees(value: Number) -> Angle:
    """An angle in degrees, exactly."""
    return Angle(Fraction(value) / 180)


def shift(x: Number, y: Number, z: Number) -> Translation:
    """A translation."""
    return Translation((Fraction(x), Fraction(y), Fraction(z)))


def arm(
    a: Sequence[Number],
    d: Sequence[Number],
    alpha: Sequence[Number],
    kinds: str = "",
    theta: Sequence[Number] = (),
    modified: bool = False,
) -> Chain:
    """A chain of a D-H table, angles in degrees; task by the number of joints.

    Standard: Rz(theta) Tz(d) Tx(a) Rx(alpha). Modified: Rx(alpha) Tx(a) Rz Tz(d).
    """
    joints: list[Joint] = []
    pending: tuple[Motion, ...] = ()
    for i, (length, rise, twist) in enumerate(zip(a, d, alpha, strict=True)):
        across = (shift(length, 0, 0), Rotation(X_AXIS, degrees(twist)))
        offset = (Rotation(Z_AXIS, degrees(theta[i])),) if theta else ()
        before = (*pending, *(across[::-1] if modified else ()), *offset)
        kind = "prismatic" if kinds[i : i + 1] == "P" else "revolute"
        joints.append(Joint(f"joint_{i + 1}", kind, before, Z_AXIS))
        pending = (shift(0, 0, rise), *(() if modified else across))
    task = "position" if len(a) == 3 else "pose"
    return Chain("arm", tuple(joints), pending, task)


def with_wrist(chain: Chain, twists: Sequence[Number] = (-90, 90)) -> Chain:
    """The six-joint arm with a spherical wrist whose center is the tip of ``chain``."""
    first, second = (Rotation(X_AXIS, degrees(twist)) for twist in twists)
    wrist = (
        Joint("wrist_1", "revolute", chain.tool),
        Joint("wrist_2", "revolute", (first,)),
        Joint("wrist_3", "revolute", (second,)),
    )
    tool = (shift("0.1", "0", "0.2"),)
    return replace(chain, joints=chain.joints + wrist, tool=tool, task="pose")


def ask(chain: Chain) -> Answer:
    """The exact answer for the chain."""
    return answer(exact_model(chain))


def numbers(found: Answer) -> tuple[object, ...]:
    """(verdict, aspects, most postures, cusps, nodes), which no change of frame moves.

    A count that is not proved, for the model at least, is given as None.
    """
    counts = (found.aspects, found.postures, found.cusps, found.nodes)
    of_model = found.is_exact_run and not found.model.is_exact
    return (
        found.verdict.value,
        *(c.count if c and (c.proved or of_model) else None for c in counts),
    )
