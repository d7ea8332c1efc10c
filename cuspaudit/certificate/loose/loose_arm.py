"""A robot with play: its screws and its places of play, for all robots at once.

All is enclosed in balls: of joint values and of the play of every link. A walk starts
at a link and lists, in the coordinates of that link, the screw of each joint and the
frame in which each play stands, with the place to which the play has carried the
origin.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import arb

from cuspaudit.certificate.arm import ArmJoint, Screw
from cuspaudit.certificate.balls import Frame, Matrix, Row, identity
from cuspaudit.certificate.loose.play import Play, Step, steps_of_links
from cuspaudit.certificate.model import Certificate
from cuspaudit.certificate.motions import axis_from_vector

__all__ = ["LooseArm", "PlacedPlay", "Walk", "loose_arm"]


@dataclass(frozen=True, slots=True)
class PlacedPlay:
    """A play where it stands.

    Attributes:
        play: what moves.
        before: the joint, counted from 0, that is the next after it towards the tip.
        step: which step of the link it is.
        R: the turn of the frame in which the play is described.
        o: where the play carries the origin of this frame.
    """

    play: Play
    before: int
    step: int
    R: Matrix[arb]
    o: Row[arb]


@dataclass(slots=True)
class Walk:
    """What a walk met.

    Attributes:
        screws: of the joints, by their number from 0.
        places: of the play.
        base: the frame of joint 1 before it moves, which stands for the base.
        hand: the frame of the last joint, moved.
        tip: the frame of the tip.
    """

    screws: dict[int, Screw[arb]]
    places: list[PlacedPlay]
    base: Frame[arb]
    hand: Frame[arb]
    tip: Frame[arb]


@dataclass(frozen=True, slots=True)
class LooseArm:
    """The arm of a certificate with its play, enclosed at one working precision.

    Attributes:
        joints: base to tip; of each only its axis and its kind are used.
        links: the steps before each joint, and those after the last. The play before
            joint 1 moves the base, and of a pose that after the last joint the target
            with the tip: neither is listed.
    """

    joints: tuple[ArmJoint[arb], ...]
    links: tuple[tuple[Step, ...], ...]

    def walk(self, k: int, q: Sequence[arb]) -> Walk:
        """Walk from the k-th link (0 is the base) to the tip, and to the base."""
        still = identity(arb(1))
        found = Walk({}, [], still, still, still)
        self._inward(found, k, q, still)
        self._outward(found, k, q, still)
        return found

    def _outward(
        self, found: Walk, k: int, q: Sequence[arb], still: Frame[arb]
    ) -> None:
        frame, size = still, len(self.joints)
        for index in range(k, size + 1):
            if index == size:
                found.hand = frame
            for number, step in enumerate(self.links[index] if index else ()):
                if isinstance(step, Play):
                    R, frame = frame.R, frame.then(step.frame)
                    if self._matters(index):
                        found.places.append(PlacedPlay(step, index, number, R, frame.p))
                else:
                    frame = frame.then(step)
            if index < size:
                joint = self.joints[index]
                found.screws[index] = joint.screw(frame)
                frame = frame.then(joint.motion(still, q[index]))
        found.tip = frame

    def _inward(self, found: Walk, k: int, q: Sequence[arb], still: Frame[arb]) -> None:
        frame = still
        for index in reversed(range(k)):
            joint = self.joints[index]
            found.screws[index] = joint.screw(frame)
            frame = frame.then(joint.motion(still, q[index], backwards=True))
            steps = list(enumerate(self.links[index] if index else ()))
            for number, step in reversed(steps):
                if isinstance(step, Play):
                    o, frame = frame.p, frame.then(step.back)
                    found.places.append(PlacedPlay(step, index, number, frame.R, o))
                else:
                    frame = frame.then(step.inverse())
        found.base = frame

    def _matters(self, index: int) -> bool:
        size = len(self.joints)
        return index < size or size == 3


def loose_arm(certificate: Certificate) -> LooseArm:
    """The arm at the working precision."""
    still = identity(arb(1))
    joints = tuple(
        ArmJoint(
            joint.kind == "revolute", axis_from_vector(joint.axis, arb), still, still
        )
        for joint in certificate.joints
    )
    return LooseArm(joints, tuple(map(tuple, steps_of_links(certificate))))
