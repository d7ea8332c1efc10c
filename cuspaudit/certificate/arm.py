"""The arm of a certificate in ball arithmetic: its frames and the screws of its joints.

The screw of a joint, written in some frame, is what the arm beyond the joint does when
the joint moves at unit speed: the angular velocity w, and the velocity m of the point
that passes through the frame's origin. A joint that turns about the unit vector n
through the point p has (w, m) = (n, p x n); one that slides along n has (0, n).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic

from flint import arb

from cuspaudit.certificate.balls import (
    Frame,
    Row,
    S,
    cross,
    identity,
    lifted_frame,
    plus,
    times,
    turned,
)
from cuspaudit.certificate.loose.play import frame_of, steps_of_links
from cuspaudit.certificate.model import Certificate, CertifiedJoint
from cuspaudit.certificate.motions import Axis, axis_from_vector

__all__ = ["Arm", "ArmJoint", "Screw", "arm_from_certificate"]


@dataclass(frozen=True, slots=True)
class Screw(Generic[S]):
    """Motion of a joint at unit speed.

    Attributes:
        w: angular velocity.
        m: velocity of the point that passes through the frame's origin.
    """

    w: Row[S]
    m: Row[S]

    @property
    def column(self) -> tuple[S | None, ...]:
        """The six entries (m, w)."""
        (a, b, c), (x, y, z) = self.m, self.w
        return a, b, c, x, y, z

    def velocity(self, p: Row[S]) -> Row[S]:
        """The velocity m + w x p of the point that passes through p."""
        x, y, z = cross(self.w, p)
        return plus(self.m[0], x), plus(self.m[1], y), plus(self.m[2], z)


@dataclass(frozen=True, slots=True)
class ArmJoint(Generic[S]):
    """A joint with its constants.

    Attributes:
        turns: whether the joint is revolute.
        axis: the joint axis, in the frame of the joint.
        before: the fixed transform before the joint.
        after: the inverse of that transform.
    """

    turns: bool
    axis: Axis[S]
    before: Frame[S]
    after: Frame[S]

    def motion(self, still: Frame[S], q: S, backwards: bool = False) -> Frame[S]:
        """The motion of the joint by q, or by -q; ``still`` is the identity."""
        if self.turns:
            sine, cosine = q.sin_cos()
            R = self.axis.rotation(-sine if backwards else sine, cosine)
            return Frame(R, still.p)
        x, y, z = self.axis.n
        step = -q if backwards else q
        return Frame(still.R, (times(x, step), times(y, step), times(z, step)))

    def screw(self, frame: Frame[S]) -> Screw[S]:
        """The screw of the joint in the coordinates in which ``frame`` is its frame."""
        n = turned(frame.R, self.axis.n)
        if not self.turns:
            return Screw((None, None, None), n)
        return Screw(n, cross(frame.p, n))


@dataclass(frozen=True, slots=True)
class Arm(Generic[S]):
    """A serial arm, its constants enclosed at one working precision.

    Attributes:
        joints: base to tip.
        tool: the fixed transform after the last joint.
        still: the identity.
    """

    joints: tuple[ArmJoint[S], ...]
    tool: Frame[S]
    still: Frame[S]

    def outward(self, k: int, q: Sequence[S]) -> tuple[list[Screw[S]], Frame[S]]:
        """Walk from the k-th link to the tip.

        Args:
            k: 0 for the base; else the link that joint k (counted from 1) moves.
            q: one value a joint.

        Returns:
            The screws of the joints k+1, ..., n and the frame of the tip, all in
            the coordinates of the k-th link.
        """
        frame, screws = self.still, []
        for joint, value in zip(self.joints[k:], q[k:], strict=True):
            frame = frame.then(joint.before)
            screws.append(joint.screw(frame))
            frame = frame.then(joint.motion(self.still, value))
        return screws, frame.then(self.tool)

    def inward(self, k: int, q: Sequence[S]) -> list[Screw[S]]:
        """Walk from the k-th link to the base.

        Returns:
            The screws of the joints 1, ..., k in the coordinates of the k-th link.
            The value of joint 1 plays no part: its axis stays where it is.
        """
        frame, screws = self.still, []
        for index in reversed(range(k)):
            joint = self.joints[index]
            screws.append(joint.screw(frame))
            if index:
                frame = frame.then(joint.motion(self.still, q[index], backwards=True))
                frame = frame.then(joint.after)
        return screws[::-1]


def arm_from_certificate(certificate: Certificate, lift: Callable[[arb], S]) -> Arm[S]:
    """Return the arm with its constants enclosed at the working precision.

    Args:
        certificate: a well-formed certificate; with play the arm encloses each robot
            that it allows.
        lift: turns a ball into the kind of number to compute with.
    """
    *links, tool = map(frame_of, steps_of_links(certificate))
    joints = tuple(
        _joint(joint, before, lift)
        for joint, before in zip(certificate.joints, links, strict=True)
    )
    return Arm(joints, lifted_frame(tool, lift), identity(lift(arb(1))))


def _joint(
    joint: CertifiedJoint, before: Frame[arb], lift: Callable[[arb], S]
) -> ArmJoint[S]:
    return ArmJoint(
        turns=joint.kind == "revolute",
        axis=axis_from_vector(joint.axis, lift),
        before=lifted_frame(before, lift),
        after=lifted_frame(before.inverse(), lift),
    )
