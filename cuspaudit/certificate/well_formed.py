"""Whether the parts of a certificate fit together; its truth is another question."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from numbers import Rational

from cuspaudit.certificate.model import (
    JOINTS_OF_TASK,
    Certificate,
    CertifiedJoint,
    CuspCertificate,
    LockCertificate,
    Loose,
    Motion,
    PairsCertificate,
    PathCertificate,
    Posture,
    Rotate,
    StructureCertificate,
    Translate,
    Vector,
)
from cuspaudit.errors import InvalidCertificateError

__all__ = ["check_certificate"]

_TASKS = " or ".join(f'"{task}"' for task in JOINTS_OF_TASK)
_WORDS = ("level", "meeting", "parallel", "square")


def check_certificate(certificate: Certificate, file: str = "certificate") -> None:
    """Raise unless the parts of ``certificate`` fit together.

    Checked: the task and its number of joints, the limits and the tolerance, every
    number rational, and no axis of length zero; of a path the sign, two postures, two
    or more way points, one value a joint in each. Whether the claim is true is the
    business of `verify`.

    Raises:
        InvalidCertificateError: naming the first part that does not fit.
    """
    for where, found, expected in _misfits(certificate):
        raise InvalidCertificateError(
            file=file, where=where, found=found, expected=expected
        )


_Misfits = Iterator[tuple[str, str, str]]


def _misfits(certificate: Certificate) -> _Misfits:
    """Each misfit as (where, found, expected)."""
    if certificate.task not in JOINTS_OF_TASK:
        yield "robot.task", repr(certificate.task), f"use {_TASKS}"
        return
    joints, needed = certificate.joints, JOINTS_OF_TASK[certificate.task]
    if len(joints) != needed:
        expected = f"a {certificate.task} task takes {needed}"
        yield "robot.joints", f"{len(joints)} joints", expected
    for index, joint in enumerate(joints):
        yield from _joint_misfits(joint, f"robot.joints[{index}]")
    yield from _motion_misfits(certificate.tool, "robot.tool")
    if certificate.task == "position-and-axis":
        yield from _virtual_misfits(certificate)
    yield from _limit_misfits(certificate)
    if isinstance(certificate, PathCertificate):
        yield from _path_misfits(certificate)
    if isinstance(certificate, LockCertificate):
        yield from _lock_misfits(certificate)
    if isinstance(certificate, CuspCertificate):
        yield from _cusp_misfits(certificate)
    if isinstance(certificate, StructureCertificate):
        yield from _structure_misfits(certificate)
    if isinstance(certificate, PairsCertificate):
        yield from _pairs_misfits(certificate)


def _limit_misfits(certificate: Certificate) -> _Misfits:
    if certificate.limits is not None:
        if len(certificate.limits) != len(certificate.joints):
            expected = f"give {len(certificate.joints)}, one a joint"
            yield "limits", f"{len(certificate.limits)} entries", expected
        for index, pair in enumerate(certificate.limits):
            where = f"limits[{index}]"
            yield from _row_misfits(pair or (Fraction(0), Fraction(1)), 2, where)
            if pair and not pair[0] < pair[1]:
                yield where, "an empty interval", "give the lower limit first"
    if certificate.tolerance is not None:
        balls = certificate.tolerance.lengths, certificate.tolerance.angles
        yield from _row_misfits(balls, 2, "tolerance")
        if any(radius < 0 for radius in balls):
            yield "tolerance", "a negative number", "give 0 or more"


def _path_misfits(certificate: PathCertificate) -> _Misfits:
    needed = JOINTS_OF_TASK[certificate.task]
    yield from _way_misfits(certificate, certificate.sign, certificate.path)
    if len(certificate.postures) != 2:
        yield "postures", f"{len(certificate.postures)} postures", "give two"
    for index, row in enumerate(certificate.postures):
        yield from _row_misfits(row, needed, f"postures[{index}]")


def _way_misfits(
    certificate: Certificate, sign: int, path: tuple[Posture, ...]
) -> _Misfits:
    if certificate.task == "position-and-angle":
        yield "robot.task", repr(certificate.task), "a path is of another task"
    if sign not in (1, -1):
        yield "sign", repr(sign), "use 1 or -1"
    if len(path) < 2:
        yield "path", f"{len(path)} way points", "give at least two"
    for index, row in enumerate(path):
        needed = JOINTS_OF_TASK[certificate.task]
        yield from _row_misfits(row, needed, f"path[{index}]")


def _lock_misfits(certificate: LockCertificate) -> _Misfits:
    needed, lock = JOINTS_OF_TASK[certificate.task], certificate.lock
    yield from _way_misfits(certificate, certificate.sign, certificate.path)
    places = (*(joint.before for joint in certificate.joints), certificate.tool)
    if type(lock.joint) is not int or not 1 <= lock.joint <= len(places):
        yield "lock.joint", repr(lock.joint), f"give a number from 1 to {len(places)}"
        return
    motions = places[lock.joint - 1]
    if type(lock.motion) is not int or not 0 <= lock.motion < len(motions):
        yield "lock.motion", repr(lock.motion), "give the index of a rotation there"
    elif not isinstance(motions[lock.motion], Rotate):
        yield "lock.motion", "a translation", "give the index of a rotation"
    yield from _row_misfits((lock.half,), 1, "lock.half")
    if isinstance(lock.half, Rational) and lock.half < 0:
        yield "lock.half", "a negative number", "give 0 or more"
    for key, rows in (("slopes", certificate.slopes), ("bends", certificate.bends)):
        if len(rows) != len(certificate.path):
            expected = f"give {len(certificate.path)}, one a way point"
            yield key, f"{len(rows)} rows", expected
        for index, row in enumerate(rows):
            yield from _row_misfits(row, needed, f"{key}[{index}]")


def _cusp_misfits(certificate: CuspCertificate) -> _Misfits:
    if certificate.task == "position-and-angle":
        yield "robot.task", repr(certificate.task), "a cusp is of another task"
    needed = JOINTS_OF_TASK[certificate.task]
    yield from _row_misfits(certificate.posture, needed, "posture")


def _structure_misfits(certificate: StructureCertificate) -> _Misfits:
    needed = JOINTS_OF_TASK[certificate.task]
    for index, relation in enumerate(certificate.relations):
        where, axes = f"relations[{index}]", relation.axes
        if relation.word not in _WORDS:
            yield f"{where}.are", repr(relation.word), f"use one of {_WORDS}"
        inside = all(type(k) is int and 1 <= k <= needed for k in axes)
        if not axes or not inside or sorted(set(axes)) != list(axes):
            expected = f"give numbers from 1 to {needed}, increasing"
            yield f"{where}.axes", repr(list(axes)), expected
    yield from _row_misfits(certificate.regular, needed, "regular")


def _pairs_misfits(certificate: PairsCertificate) -> _Misfits:
    if certificate.task != "position":
        yield "robot.task", repr(certificate.task), 'pairs are of the task "position"'
    yield from _row_misfits(certificate.parting, len(certificate.parting), "parting")
    yield from _row_misfits(certificate.regular, len(certificate.joints), "regular")


def _virtual_misfits(certificate: Certificate) -> _Misfits:
    if certificate.joints and certificate.joints[-1].kind != "revolute":
        expected = "the virtual joint, which is the last, turns about the tool axis"
        yield f"robot.joints[{len(certificate.joints) - 1}].type", "a slide", expected
    if certificate.tool:
        yield "robot.tool", "a transform", "the tip lies on the virtual joint: give []"


def _joint_misfits(joint: CertifiedJoint, where: str) -> _Misfits:
    if joint.kind not in ("revolute", "prismatic"):
        yield f"{where}.type", repr(joint.kind), 'use "revolute" or "prismatic"'
    yield from _axis_misfits(joint.axis, f"{where}.axis")
    yield from _motion_misfits(joint.before, f"{where}.before")


def _motion_misfits(motions: tuple[Motion, ...], where: str) -> _Misfits:
    for index, motion in enumerate(motions):
        place = f"{where}[{index}]"
        if isinstance(motion, Translate):
            yield from _row_misfits(motion.vector, 3, f"{place}.translate")
        elif isinstance(motion, Loose):
            yield from _axis_misfits(motion.axis, f"{place}.{motion.kind}")
            yield from _row_misfits((motion.within,), 1, f"{place}.within")
            if motion.within < 0:
                yield f"{place}.within", "a negative number", "give 0 or more"
        else:
            yield from _axis_misfits(motion.axis, f"{place}.rotate")
            angle = motion.half_turns, motion.radians
            yield from _row_misfits(angle, 2, f"{place}.angle")


def _axis_misfits(axis: Vector, where: str) -> _Misfits:
    yield from _row_misfits(axis, 3, where)
    if not any(axis):
        yield where, "a zero axis", "give a direction"


def _row_misfits(row: tuple[Fraction, ...], needed: int, where: str) -> _Misfits:
    if len(row) != needed:
        yield where, f"{len(row)} values", f"give {needed}"
    for index, number in enumerate(row):
        if not isinstance(number, Rational):
            yield f"{where}[{index}]", repr(number), "give a rational number"
