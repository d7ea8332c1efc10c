"""A path that moves with the value of a locked joint, in ball arithmetic.

With d the difference of the lock's value from what stands in the file, the path of a
certificate of kind "lock" runs straight from way point to way point, and these are at
p_i + d v_i + d^2 u_i.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import arb

from cuspaudit.certificate.arm import Arm, ArmJoint
from cuspaudit.certificate.balls import (
    Frame,
    S,
    ball_from_fraction,
    identity,
    lifted_frame,
)
from cuspaudit.certificate.model import LockCertificate, Motion, Rotate
from cuspaudit.certificate.motions import axis_from_vector, frame_from_motions

__all__ = ["arm_at_lock", "moving_point"]


def arm_at_lock(certificate: LockCertificate, d: S, lift: Callable[[arb], S]) -> Arm[S]:
    """The arm whose locked joint stands at d more than what the file has.

    Args:
        certificate: well formed.
        d: a ball, or a power series.
        lift: turns a ball into a number of the same kind.
    """
    places = (*(joint.before for joint in certificate.joints), certificate.tool)
    frames = [
        _locked(motions, certificate.lock.motion, d, lift)
        if number == certificate.lock.joint
        else lifted_frame(frame_from_motions(motions), lift)
        for number, motions in enumerate(places, 1)
    ]
    joints = tuple(
        ArmJoint(
            turns=joint.kind == "revolute",
            axis=axis_from_vector(joint.axis, lift),
            before=frame,
            after=frame.inverse(),
        )
        for joint, frame in zip(certificate.joints, frames, strict=False)
    )
    return Arm(joints, frames[-1], identity(lift(arb(1))))


def moving_point(certificate: LockCertificate, index: int, d: S) -> list[S]:
    """The way point of this index at d."""
    rows = (certificate.path, certificate.slopes, certificate.bends)
    return [
        d * (d * ball_from_fraction(u) + ball_from_fraction(v)) + ball_from_fraction(p)
        for p, v, u in zip(*(row[index] for row in rows), strict=True)
    ]


def _locked(
    motions: Sequence[Motion], index: int, d: S, lift: Callable[[arb], S]
) -> Frame[S]:
    turn = motions[index]
    assert isinstance(turn, Rotate), "checked by check_certificate"
    half_turns, radians = map(ball_from_fraction, (turn.half_turns, turn.radians))
    sine, cosine = (d + (arb.pi() * half_turns + radians)).sin_cos()
    axis = axis_from_vector(turn.axis, lift)
    moving = Frame(axis.rotation(sine, cosine), (None, None, None))
    before, after = (
        lifted_frame(frame_from_motions(some), lift)
        for some in (motions[:index], motions[index + 1 :])
    )
    return before.then(moving).then(after)
