"""The theorems that a structure certificate may rest on, and the relations each needs.

Every theorem says: where these relations hold and det J is not 0 everywhere, the arm is
noncuspidal. docs/certificate.md has their statements with proofs. The words below that
are not of the certificate: two axes in a row are a *pair*, and three a *triple*, when
they are meeting or parallel; the joints of both turn.

An entry here lets a certificate be checked. `auditing.proofs.structure_certificate`
proposes the relations that are written, and the checker in JavaScript has its own list.

A certificate lists exactly the relations of its theorem: what is listed is tested, and
what is not listed is not there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from cuspaudit.certificate.model import Relation, StructureCertificate, Task

__all__ = ["THEOREMS", "Theorem", "theorem_misfit"]


@dataclass(frozen=True, slots=True)
class Theorem:
    """A theorem about arms whose axes stand in certain relations.

    Attributes:
        tasks: that it is about.
        statement: one sentence.
        fits: whether the relations of a certificate, in the order of their axes and
            words, are those of the theorem.
    """

    tasks: tuple[Task, ...]
    statement: str
    fits: Callable[[StructureCertificate, Sequence[Relation]], bool]


def theorem_misfit(certificate: StructureCertificate) -> str | None:
    """Why the theorem does not follow from the relations, if they hold; or None."""
    theorem = THEOREMS.get(certificate.theorem)
    if theorem is None:
        return "no theorem of this name is known here"
    if certificate.task not in theorem.tasks:
        return f"the theorem says nothing about the task {certificate.task}"
    relations = sorted(certificate.relations, key=lambda r: (r.axes, r.word))
    if not theorem.fits(certificate, relations):
        return "the relations listed are not those that the theorem needs"
    return None


_POSE: tuple[Task, ...] = ("pose", "position-and-axis")


def _pair_of_axes(arm: StructureCertificate, relations: Sequence[Relation]) -> bool:
    return len(relations) == 1 and _is_pair(arm, relations[0])


def _no_offset(arm: StructureCertificate, relations: Sequence[Relation]) -> bool:
    return list(relations) == [Relation((1, 2, 3), "level")] and _turn(arm, (1, 2, 3))


def _triple_and_pair(arm: StructureCertificate, relations: Sequence[Relation]) -> bool:
    if len(relations) != 2 or not _turn(arm, range(1, 7)):
        return False
    pair, triple = sorted(relations, key=lambda r: len(r.axes))
    apart = not set(pair.axes) & set(triple.axes)
    return _is_pair(arm, pair) and _is_row(triple, 3) and apart


def _wrist(arm: StructureCertificate, relations: Sequence[Relation]) -> bool:
    return _point_and_rest(arm, relations, (4, 5, 6), (1, 2, 3))


def _shoulder(arm: StructureCertificate, relations: Sequence[Relation]) -> bool:
    return _point_and_rest(arm, relations, (1, 2, 3), (4, 5, 6))


def _point_and_rest(
    arm: StructureCertificate,
    relations: Sequence[Relation],
    point: tuple[int, ...],
    rest: tuple[int, ...],
) -> bool:
    """Three axes meeting in ``point``, and a pair of the rest, or all of them level."""
    if Relation(point, "meeting") not in relations or len(relations) != 2:
        return False
    other = next((r for r in relations if r.axes != point), relations[0])
    if not set(other.axes) <= set(rest) or not _turn(arm, point):
        return False
    is_level = other == Relation(rest, "level") and _turn(arm, rest)
    return is_level or _is_pair(arm, other)


def _ur_pattern(arm: StructureCertificate, relations: Sequence[Relation]) -> bool:
    corners = ((1, 2), (4, 5), (5, 6))
    needed = {Relation((2, 3, 4), "parallel")}
    needed |= {
        Relation(axes, word) for axes in corners for word in ("meeting", "square")
    }
    are_all = set(relations) == needed and len(relations) == len(needed)
    return are_all and _turn(arm, range(1, 7))


def _parallel_axes(arm: StructureCertificate, relations: Sequence[Relation]) -> bool:
    turning = tuple(k for k in range(1, 5) if _turn(arm, (k,)))
    return list(relations) == [Relation(turning, "parallel")]


def _yaw_and_pitch(arm: StructureCertificate, relations: Sequence[Relation]) -> bool:
    needed = [Relation((1, 2), "square"), Relation((2, 3, 4), "parallel")]
    return _turn(arm, range(1, 5)) and list(relations) == needed


def _is_pair(arm: StructureCertificate, relation: Relation) -> bool:
    return _is_row(relation, 2) and _turn(arm, relation.axes)


def _is_row(relation: Relation, length: int) -> bool:
    first = relation.axes[0]
    in_a_row = relation.axes == tuple(range(first, first + length))
    return in_a_row and relation.word in ("meeting", "parallel")


def _turn(arm: StructureCertificate, axes: Sequence[int]) -> bool:
    return all(arm.joints[k - 1].kind == "revolute" for k in axes)


THEOREMS = {
    "pair of axes": Theorem(
        ("position",),
        "three joints, two in a row of which turn about axes that meet or are "
        "parallel: two signs tell all postures of a position apart",
        _pair_of_axes,
    ),
    "no offset": Theorem(
        ("position",),
        "three joints that turn, axes 1 and 3 in one plane across axis 2: a sign, and "
        "the side of joint 3, tell all postures of a position apart",
        _no_offset,
    ),
    "triple and pair": Theorem(
        _POSE,
        "six joints that turn, three axes in a row meeting in one point or parallel, "
        "two others in a row meeting or parallel: three signs tell all postures of a "
        "pose apart",
        _triple_and_pair,
    ),
    "spherical wrist": Theorem(
        _POSE,
        "axes 4, 5, 6 meet in one point, so the arm is cuspidal only if its first "
        "three joints, moving that point, are; and two of their axes in a row meet or "
        "are parallel, or they have no offset, so they are not",
        _wrist,
    ),
    "spherical shoulder": Theorem(
        _POSE,
        "axes 1, 2, 3 meet in one point, so the arm is cuspidal only if its last three "
        "joints, taken from tip to base and moving that point, are; and two of their "
        "axes in a row meet or are parallel, or they have no offset, so they are not",
        _shoulder,
    ),
    "UR pattern": Theorem(
        _POSE,
        "six joints that turn, axes 2, 3, 4 parallel and axes 1-2, 4-5, 5-6 meeting at "
        "right angles: the signs of the three factors of det J tell all postures of a "
        "pose apart",
        _ur_pattern,
    ),
    "parallel axes": Theorem(
        ("position-and-angle",),
        "four joints, all that turn about parallel axes: postures of one position and "
        "angle differ in the sign of det J",
        _parallel_axes,
    ),
    "yaw and pitch": Theorem(
        ("position-and-angle",),
        "four joints that turn, axes 2, 3, 4 parallel and axis 1 square to them: the "
        "signs of the two factors of det J tell all postures of a position and angle "
        "apart",
        _yaw_and_pitch,
    ),
}
