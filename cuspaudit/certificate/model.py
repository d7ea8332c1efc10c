"""A certificate: a robot, its numbers exact, and a claim about it of one of the kinds.

kind "path" claims that the robot is cuspidal: two postures put the tool in exactly the
same place, they differ modulo 2 pi, and det J has the stated sign all along the path
that joins them. Nothing is claimed about how the path was found, and nothing outside
the file is needed to prove it. The second posture is an approximation, because postures
are algebraic numbers in general; the checker proves that one true posture lies next to
it.

kind "lock" claims that of every robot that comes of it when one joint more is locked at
any value of an interval: the path moves with the value.

kind "cusp" claims the same as "path" by one posture: next to it the map has a cusp, and
postures of one pose lie in one aspect as near to a cusp as one likes.

kind "pairs" claims that a robot of three joints is noncuspidal, by a look at all pairs
of postures of one position.

kind "structure" claims that the robot is noncuspidal: some of its axes meet, are
parallel or are square, and there is a theorem about such arms.

Each kind is a class of its own, a `Certificate` with what its claim needs besides.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

__all__ = [
    "JOINTS_OF_TASK",
    "Certificate",
    "CertifiedJoint",
    "CuspCertificate",
    "JointKind",
    "Limits",
    "Lock",
    "LockCertificate",
    "Loose",
    "Motion",
    "Numbers",
    "PairsCertificate",
    "PathCertificate",
    "Posture",
    "Relation",
    "Rotate",
    "StructureCertificate",
    "Task",
    "Tolerance",
    "Translate",
    "Vector",
    "Word",
    "is_loose",
    "printable",
]

Vector = tuple[Fraction, Fraction, Fraction]
Posture = tuple[Fraction, ...]
JointKind = Literal["revolute", "prismatic"]
Task = Literal["position", "position-and-angle", "position-and-axis", "pose"]
Word = Literal["level", "meeting", "parallel", "square"]
Numbers = Literal["literal", "snapped"]
Limits = tuple[tuple[Fraction, Fraction] | None, ...]

JOINTS_OF_TASK: dict[Task, int] = {
    "position": 3,
    "position-and-angle": 4,
    "position-and-axis": 6,
    "pose": 6,
}
"""The number of joints that makes the Jacobian matrix of each task square."""

_VERBS = {"meeting": "meet", "level": "are level, the outer two in a plane across"}


@dataclass(frozen=True, slots=True)
class Translate:
    """A translation by ``vector``, in the robot's unit of length."""

    vector: Vector


@dataclass(frozen=True, slots=True)
class Rotate:
    """A rotation by ``half_turns * pi + radians`` about ``axis`` (not zero)."""

    axis: Vector
    half_turns: Fraction = Fraction(0)
    radians: Fraction = Fraction(0)


@dataclass(frozen=True, slots=True)
class Loose:
    """A number of the robot that is known within ``within`` only.

    Attributes:
        kind: a "turn" about ``axis`` by at most ``within`` rad, one way or the other,
            or a "slide" along it by at most ``within`` of the unit of length.
        axis: not zero, of any length.
        within: 0 or more.
    """

    kind: Literal["turn", "slide"]
    axis: Vector
    within: Fraction


Motion = Translate | Rotate | Loose


@dataclass(frozen=True, slots=True)
class CertifiedJoint:
    """A joint and the fixed transform before it.

    The frame of the joint is the previous joint's moved frame followed by
    ``before``, left to right; the joint turns about, or slides along, the unit
    vector along ``axis``.
    """

    name: str
    kind: JointKind
    axis: Vector
    before: tuple[Motion, ...] = ()


@dataclass(frozen=True, slots=True)
class Tolerance:
    """How far the axes of a robot as built may be from where its certificate has them.

    Each link carries two axes, or one and the tip. Each of the two, in the frame of
    the link, may be elsewhere: a point of it moved by at most ``lengths`` and its
    direction turned by at most ``angles`` (`play` says it exactly).

    Attributes:
        lengths: in the robot's unit.
        angles: rad.
    """

    lengths: Fraction
    angles: Fraction


@dataclass(frozen=True, slots=True, kw_only=True)
class Certificate:
    """A robot, and a claim about it with all that its proof needs.

    Attributes:
        robot_name: for the reader; the proof does not use it.
        task: "position" (3 joints), "pose" (6), or "position-and-axis" (6): then the
            last joint is virtual, a turn about the tool axis through the tip. The
            claim is about the five others, the position of the tip and the direction
            of that axis: a pose of six joints is this task's place and one angle, and
            the virtual joint's value is known from them, so both claims are the same.
            "position-and-angle" (4, for the kind "structure" only): the fourth row of
            J is the part of the angular velocity along the last axis that turns.
        unit: unit of every length, for the reader.
        joints: base to tip.
        tool: the fixed transform after the last joint.
        numbers: whose numbers these are: "literal", those of the robot's file, or
            "snapped", those of its ideal arm; None where the file does not say. For
            the reader: the claim is about the numbers as they stand.
        limits: for each joint an open interval (rad, or the unit of length) or None;
            with limits the claim is one within them, and without it is for all values.
        tolerance: with one the claim is about every robot so close.
        made_by: free text; the proof does not use it.
    """

    robot_name: str
    task: Task
    unit: str
    joints: tuple[CertifiedJoint, ...]
    tool: tuple[Motion, ...]
    numbers: Numbers | None = None
    limits: Limits | None = None
    tolerance: Tolerance | None = None
    made_by: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PathCertificate(Certificate):
    """The claim that a robot is cuspidal, by a path between two postures of one pose.

    Attributes:
        sign: the sign, 1 or -1, that det J keeps along the path.
        postures: the first is exact by definition; the second is close to a true one.
        path: way points joined by straight segments, from the first posture to the
            second, exactly; rad, or the unit of length.
    """

    sign: Literal[1, -1]
    postures: tuple[Posture, Posture]
    path: tuple[Posture, ...]


@dataclass(frozen=True, slots=True)
class Lock:
    """A rotation of a robot whose angle is not told: a joint locked at any value.

    Attributes:
        joint: before which joint it stands, from 1; one more than there are joints for
            the tool.
        motion: which of the motions there it is, from 0.
        half: the angle is what stands there and at most so much more or less, rad.
    """

    joint: int
    motion: int
    half: Fraction


@dataclass(frozen=True, slots=True, kw_only=True)
class LockCertificate(Certificate):
    """The claim that a robot is cuspidal at every value of a locked joint.

    For the value that is d more than what stands in the file the way points are those
    of the path, and d times the slopes, and d^2 times the bends.

    Attributes:
        sign: the sign, 1 or -1, that det J keeps along the paths of all values.
        path: way points joined by straight segments, at the value in the file.
        lock: which rotation it is.
        slopes: a row a way point; rad, or the unit of length, for one rad.
        bends: a row a way point, for one rad squared.
    """

    sign: Literal[1, -1]
    path: tuple[Posture, ...]
    lock: Lock
    slopes: tuple[Posture, ...]
    bends: tuple[Posture, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CuspCertificate(Certificate):
    """The claim that a robot is cuspidal, by a cusp of the map of its task.

    Attributes:
        posture: close to the cusp; rad, or the unit of length.
    """

    posture: Posture


@dataclass(frozen=True, slots=True)
class Relation:
    """How some axes stand to each other, in every posture.

    Attributes:
        axes: their numbers from 1, increasing.
        word: "meeting" in one point and not parallel, "parallel", "square", at right
            angles, or of three "level": the outer two lie in one plane across the
            middle one.
    """

    axes: tuple[int, ...]
    word: Word

    def __str__(self) -> str:
        *first, last = map(str, self.axes)
        axes = f"axes {', '.join(first)} and {last}" if first else f"axis {last}"
        return f"{axes} {_VERBS.get(self.word, f'are {self.word}')}"


@dataclass(frozen=True, slots=True, kw_only=True)
class StructureCertificate(Certificate):
    """The claim that a robot is noncuspidal, by a theorem about how its axes stand.

    Attributes:
        theorem: its name.
        relations: exactly those that the theorem needs.
        regular: a posture at which det J is not 0; rad, or the unit of length.
    """

    theorem: str
    relations: tuple[Relation, ...]
    regular: Posture


@dataclass(frozen=True, slots=True, kw_only=True)
class PairsCertificate(Certificate):
    """The claim that three joints are noncuspidal, by all pairs of one position.

    Attributes:
        parting: values of joint 3 (rad) that no path passes on which det J has one of
            the two signs: which, the proof finds out.
        regular: a posture at which det J is not 0; rad.
    """

    parting: tuple[Fraction, ...]
    regular: Posture


def is_loose(certificate: Certificate) -> bool:
    """Whether the claim is about more robots than the one with these numbers."""
    motions = (m for joint in certificate.joints for m in joint.before)
    numbers = (isinstance(m, Loose) for m in (*motions, *certificate.tool))
    return certificate.tolerance is not None or any(numbers)


def printable(name: str) -> str:
    r"""``name`` on one line, its control characters written out.

    The names of a file are its author's: printed as they stand, one could overwrite
    the checker's answer on a terminal.

    >>> printable("arm"), printable("arm\raccepted")
    ('arm', 'arm\\raccepted')
    """
    return name if name.isprintable() else repr(name)[1:-1]
