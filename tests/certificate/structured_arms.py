"""Arms whose axes stand in relations, with structure certificates of them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from certified_arms import X, Z, exact, from_dh

from cuspaudit.certificate import (
    CertifiedJoint,
    Motion,
    PairsCertificate,
    Relation,
    Rotate,
    StructureCertificate,
    Task,
    Translate,
    Word,
)

Robot = tuple[tuple[CertifiedJoint, ...], tuple[Motion, ...]]
Y = (Fraction(0), Fraction(1), Fraction(0))
REGULAR = ("0.4", "-0.9", "1.3", "0.7", "1.1", "-0.5")


def relation(word: Word, *axes: int) -> Relation:
    """These axes stand so."""
    return Relation(axes, word)


def structure(
    robot: Robot, theorem: str, *relations: Relation, task: Task = "pose"
) -> StructureCertificate:
    """The claim that the robot is noncuspidal by a theorem."""
    joints, tool = robot
    return StructureCertificate(
        robot_name=theorem,
        task=task,
        unit="m",
        joints=joints,
        tool=tool,
        theorem=theorem,
        relations=relations,
        regular=exact(REGULAR[: len(joints)]),
        made_by="the tests",
    )


def puma() -> Robot:
    """Axes 2 and 3 parallel, 4, 5 and 6 through one point."""
    return from_dh(
        [0, 0.4318, 0.0203, 0, 0, 0],
        [0.67, 0.139, 0, 0.4318, 0, 0.056],
        [90, 0, -90, 90, -90, 0],
    )


def universal() -> Robot:
    """The UR5."""
    return from_dh(
        [0, -0.425, -0.39225, 0, 0, 0],
        [0.0892, 0, 0, 0.1093, 0.09475, 0.0825],
        [90, 0, 0, 90, -90, 0],
    )


def stanford() -> Robot:
    """A spherical wrist behind a slide; axes 1 and 2 meet."""
    return from_dh([0] * 6, [0.4, 0, 0, 0, 0, 0.3], [-90, 90, 0, -90, 90, 0], "RRPRRR")


def scara() -> Robot:
    """Joints 1, 2 and 4 turn about parallel axes, 3 slides along them."""
    return from_dh([0.325, 0.275, 0, 0], [0.4, 0, 0, 0.1], [0, 180, 0, 0], "RRPR")


def palletizer() -> Robot:
    """Axes 2, 3, 4 parallel and square to axis 1."""
    return from_dh([0.1, 0.5, 0.4, 0.2], [0.3, 0, 0, 0], [90, 0, 0, 0])


def elbow() -> Robot:
    """Three joints, axes 2 and 3 parallel, every other number odd."""
    return from_dh([0.1, 0.5, 0.4], [0.3, 0.11, 0.05], [77, 0, 0])


def without_offset() -> Robot:
    """Three joints, axes 1 and 3 in one plane across axis 2."""
    return from_dh([1, 0.7, 0.6], [0.2, 0, 0.3], [90, -90, 0])


def crossing() -> Robot:
    """Three joints, axes 1 and 2 meeting at 60 degrees."""
    return from_dh([0, 0.5, 0.4], [0.3, 0.11, 0.05], [60, 50, 0])


def by_other_words(*before: Motion) -> Robot:
    """The PUMA with the transform between axes 2 and 3 written in another way."""
    joints, tool = puma()
    third = CertifiedJoint("third", "revolute", Z, before)
    return (*joints[:2], third, *joints[3:]), tool


WRIST = relation("meeting", 4, 5, 6)
ELBOW = relation("parallel", 2, 3)
CORNERS = tuple(
    relation(word, *axes)
    for axes in ((1, 2), (4, 5), (5, 6))
    for word in ("meeting", "square")
)


def some_structures() -> dict[str, StructureCertificate]:
    """A true certificate of every theorem."""
    level = relation("parallel", 2, 3, 4)
    reverse = _reversed(puma())
    tumbling = (
        Rotate(X, radians=Fraction(3, 5)),
        Translate((Fraction(2, 5), Fraction(0), Fraction(0))),
        Rotate(X, radians=Fraction(-3, 10)),
        Rotate(X, radians=Fraction(-3, 10)),
    )
    angle: Any = {"task": "position-and-angle"}
    short: Any = {"task": "position"}
    return {
        "wrist": structure(puma(), "spherical wrist", WRIST, ELBOW),
        "wrist by a pair": structure(puma(), "triple and pair", ELBOW, WRIST),
        "shoulder": structure(
            reverse,
            "spherical shoulder",
            relation("meeting", 1, 2, 3),
            relation("parallel", 4, 5),
        ),
        "slide": structure(
            stanford(), "spherical wrist", WRIST, relation("meeting", 1, 2)
        ),
        "universal": structure(universal(), "UR pattern", level, *CORNERS),
        "level": structure(
            universal(), "triple and pair", level, relation("meeting", 5, 6)
        ),
        "scara": structure(
            scara(), "parallel axes", relation("parallel", 1, 2, 4), **angle
        ),
        "palletizer": structure(
            palletizer(), "yaw and pitch", relation("square", 1, 2), level, **angle
        ),
        "elbow": structure(elbow(), "pair of axes", ELBOW, **short),
        "crossing": structure(
            crossing(), "pair of axes", relation("meeting", 1, 2), **short
        ),
        "no offset": structure(
            without_offset(), "no offset", relation("level", 1, 2, 3), **short
        ),
        "wrist without offset": structure(
            from_dh(
                [1, 0.7, 0, 0, 0, 0], [0.2, 0, 0, 0.5, 0, 0.1], [90, -90, 90, 90, 90, 0]
            ),
            "spherical wrist",
            WRIST,
            relation("level", 1, 2, 3),
        ),
        "cancelling turns": structure(
            by_other_words(*tumbling), "spherical wrist", WRIST, ELBOW
        ),
    }


def _reversed(robot: Robot) -> Robot:
    """The arm from tip to base."""
    joints, tool = robot
    fixed = [*(joint.before for joint in joints[1:]), tool]
    after = [_undone(motions) for motions in fixed]
    back = [
        CertifiedJoint(joint.name, joint.kind, joint.axis, before)
        for joint, before in zip(joints, after, strict=True)
    ]
    return tuple(back[::-1]), _undone(joints[0].before)


def _undone(motions: tuple[Motion, ...]) -> tuple[Motion, ...]:
    return tuple(
        Translate(tuple(-x for x in motion.vector))
        if isinstance(motion, Translate)
        else Rotate(motion.axis, -motion.half_turns, -motion.radians)
        for motion in reversed(motions)
    )


def pairs(robot: Robot, *parting: str) -> PairsCertificate:
    """The claim that three joints are noncuspidal by all their pairs."""
    joints, tool = robot
    return PairsCertificate(
        robot_name="three joints",
        task="position",
        unit="m",
        joints=joints,
        tool=tool,
        parting=exact(parting),
        regular=exact(REGULAR[:3]),
        made_by="the tests",
    )


def some_pairs() -> dict[str, PairsCertificate]:
    """Noncuspidal arms of the literature, of two and of four aspects."""
    square, skew = [-90, 90, 0], [-60, 90, 0]
    return {
        "two aspects": pairs(
            from_dh([1, 0.7, 0.3], [0, 0.2, 0], square), "1.326", "4.468"
        ),
        "four aspects": pairs(
            from_dh([1, 0.5, 0.8], [0, 0.2, 0], square),
            *("1.196", "2.505", "3.656", "4.965"),
        ),
        "skew": pairs(
            from_dh([1, 0.2, 2], [0, 1, 0], skew), *("1.213", "1.946", "4.267", "4.965")
        ),
    }
