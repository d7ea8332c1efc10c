"""Play: the small motions by which a robot as built may differ from its numbers.

**What a tolerance means.** A link carries two axes, that of the joint before it and
that of the joint after it (the last one an axis and the tip). With the tolerance (l, a)
the motion from one to the other, ``before`` of a joint or ``tool``, is any product

    Q before P,    Q and P of the form  x -> R x + v,  |v| <= l, R a turn by at most a.

P moves the axis that follows: in the frame of the joint before it, its point at the
origin of its frame by at most l, and its direction, and the frame with it, by at most
a. Q does the same to the axis at the beginning, as seen from the other end.

**Theorem.** The box holds every robot (to a renumbering of joint values) whose axes are
off like this, read in either of two ways.

1. *Link by link*: on each link the line of each of its two axes, as seen from the
   frame of the other, has a point within l of the frame's origin and a direction within
   a of the axis.
2. *As a whole*: in some posture, all the axes as lines in space, each within l and a of
   where the numbers put it, whatever the other axes do.

*Proof.* 1. Let the line run along n' through o', n the axis, o the origin. The turn R
in the plane of n and n' with R n = n' is one by at most a, and x -> R x + (o' - o) with
the origin at o is a motion P that carries the axis to the line; a P has not to say
more, as a turn about n' or a slide along it commutes with the joint and changes only
where its value is counted from, and the frames of all that follow are carried along.
The same for Q. 2. Let G_k, such a motion in the frame of joint k at that posture, carry
axis k to its line; a joint about the moved line is G_k (joint) G_k^-1. In the product
of the arm G_(k-1)^-1 stands after joint k - 1 and G_k before joint k, so the link
between them is Q before P with Q = G_(k-1)^-1, P = G_k, and the inverse of x -> R x + v
is x -> R^T x - R^T v, of the same |v| and angle. QED

Every row of Denavit and Hartenberg with numbers within (l, a) is in the box, with Q =
turn about and slide along the old axis, P = slide along and turn about the common
normal; and a tilt of an axis that is parallel to its neighbour, which no such numbers
describe, is in it as well. Joint values are counted as the frames say: what is claimed
within limits holds although the zero of a joint may be off by a on either side.

A `Loose` motion is play of one number: a turn about, or a slide along, a given axis.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from decimal import ROUND_DOWN, Context, Decimal
from fractions import Fraction

from flint import arb

from cuspaudit.certificate.balls import Frame, Row, ball_from_fraction, identity
from cuspaudit.certificate.model import (
    Certificate,
    Loose,
    Motion,
    Tolerance,
    printable,
)
from cuspaudit.certificate.motions import axis_from_vector, frame_from_motions

__all__ = [
    "Play",
    "Step",
    "for_every_robot",
    "frame_of",
    "steps_of_links",
    "without_play",
]


@dataclass(frozen=True, slots=True)
class Play:
    """A set of motions, the identity among them.

    Attributes:
        frame: encloses each of them.
        back: encloses the inverse of each.
        lengths: of the vector v of x -> R x + v; of a slide the way.
        angles: of R; of a turn the angle. Balls of radius 0.
        axis: of the play of one number, a unit vector; None where all directions are
            meant.
    """

    frame: Frame[arb]
    back: Frame[arb]
    lengths: arb
    angles: arb
    axis: Row[arb] | None = None


Step = Play | Frame[arb]
"""A piece of a link: a fixed motion, or play."""


def steps_of_links(certificate: Certificate) -> list[list[Step]]:
    """The motions before each joint and after the last, cut at each play.

    The play at both ends of the base's link, and of a pose of the last one, is there
    too; it moves the base, or the tip with the target.
    """
    links = [joint.before for joint in certificate.joints] + [certificate.tool]
    if certificate.tolerance is None:
        return [list(_steps(motions)) for motions in links]
    play = _of_tolerance(certificate.tolerance)
    return [[play, *_steps(motions), play] for motions in links]


def without_play(certificate: Certificate) -> Certificate:
    """The certificate of the one robot in the middle: each play is the identity."""
    joints = tuple(
        replace(joint, before=_fixed(joint.before)) for joint in certificate.joints
    )
    return replace(
        certificate, joints=joints, tool=_fixed(certificate.tool), tolerance=None
    )


def for_every_robot(certificate: Certificate) -> str:
    """What a summary says of the robots that a claim is about."""
    said = []
    if certificate.tolerance is not None:
        way, turn = certificate.tolerance.lengths, certificate.tolerance.angles
        radii = (
            f"{_rounded(way)} {printable(certificate.unit)} and {_rounded(turn)} rad"
        )
        said.append(f"for every arm within {radii}")
    motions = [m for joint in certificate.joints for m in joint.before]
    loose = sum(isinstance(m, Loose) for m in (*motions, *certificate.tool))
    if loose:
        numbers = "loose number" if loose == 1 else f"{loose} loose numbers"
        said.append(f"for every value of its {numbers}")
    return ", " + ", ".join(said or ["for these numbers"])


def _rounded(number: Fraction) -> str:
    """Few digits of a number, not more than it is."""
    down = Context(prec=4, rounding=ROUND_DOWN)
    return str(down.divide(Decimal(number.numerator), Decimal(number.denominator)))


def _fixed(motions: Iterable[Motion]) -> tuple[Motion, ...]:
    return tuple(motion for motion in motions if not isinstance(motion, Loose))


def _steps(motions: Iterable[Motion]) -> Iterable[Step]:
    """The product of each run of fixed motions, and the play between them."""
    fixed: list[Motion] = []
    for motion in motions:
        if isinstance(motion, Loose):
            if fixed:
                yield frame_from_motions(fixed)
            fixed = []
            yield _of_number(motion)
        else:
            fixed.append(motion)
    if fixed:
        yield frame_from_motions(fixed)


def frame_of(steps: Iterable[Step]) -> Frame[arb]:
    """The product of the steps of a link: it encloses what all play makes of it."""
    frame = identity(arb(1))
    for step in steps:
        frame = frame.then(step.frame if isinstance(step, Play) else step)
    return frame


def _of_tolerance(tolerance: Tolerance) -> Play:
    """All turns by at most a and translations by at most l.

    A turn R by the angle t has |R e - e| <= t for each unit vector e, and the entries
    of its diagonal are at least cos t >= 1 - t^2 / 2.
    """
    lengths = ball_from_fraction(tolerance.lengths)
    angles = ball_from_fraction(tolerance.angles)
    off, way = arb(0, angles.upper()), arb(0, lengths.upper())
    half = (angles.upper() ** 2 / 4).upper()
    on = 1 - half + arb(0, half)
    R = (on, off, off), (off, on, off), (off, off, on)
    frame = Frame(R, (way, way, way))
    # the inverse of a member is one
    return Play(frame, frame, lengths, angles)


def _of_number(motion: Loose) -> Play:
    within = ball_from_fraction(motion.within)
    frame, axis = frame_from_motions([motion]), axis_from_vector(motion.axis, arb).n
    if motion.kind == "turn":
        return Play(frame, frame, arb(0), within, axis)
    return Play(frame, frame, within, arb(0), axis)
