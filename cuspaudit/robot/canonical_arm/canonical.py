"""The canonical chain: an arm written by its invariants, so that no relation is lost.

Denavit-Hartenberg numbers are free coordinates: each may be 0 or a right angle whatever
the others are. So the relations that the invariants of a chain have, each within its
own error, can all be taken at once, and a model built on them has them exactly, which a
product of rounded turns has not.

The chain keeps its joints, their names, signs and zeros: a joint vector means the same
posture in both, and the frames of base and tip are the same up to the rounding that was
taken back. Of the fixed motions only those between axes are geometry; the first one and
the last (`chain.idle_motions`) place the arm in the world and a tool on the tip.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from flint import arb, ctx
from numpy.typing import NDArray

from cuspaudit.robot.canonical_arm.invariants import AxisRow, CanonicalFrame, Invariants
from cuspaudit.robot.canonical_arm.links import BITS
from cuspaudit.robot.canonical_arm.readings import Reader, ReadNumber
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.frames import transform
from cuspaudit.robot.lines import cross, dot
from cuspaudit.robot.virtual_joint import TO_Z, without_virtual_joint

__all__ = ["Canonical", "Taken", "canonical"]


@dataclass(frozen=True, slots=True)
class Taken:
    """One invariant, read.

    Attributes:
        where: which one: "axes 2 and 3, twist".
        reading: the number.
        relation: what is so because of it; "" for a number that is not structural.
    """

    where: str
    reading: ReadNumber
    relation: str


@dataclass(frozen=True, slots=True)
class Canonical:
    """An arm written by its invariants.

    Attributes:
        chain: the chain.
        taken: its numbers, base to tip.
    """

    chain: Chain
    taken: tuple[Taken, ...]


def canonical(found: Invariants, reader: Reader) -> Canonical:
    """The chain with the invariants ``found``, each read by ``reader``."""
    with ctx.workprec(BITS):
        return _Writer(found, reader).result()


class _Writer:
    def __init__(self, found: Invariants, reader: Reader) -> None:
        self.found, self.reader = found, reader
        self.taken: list[Taken] = []
        self.forced = [0.0]

    def result(self) -> Canonical:
        chain = self.found.chain
        joints = [replace(chain.joints[0], before=self._base(), axis=Z_AXIS)]
        for number, row in enumerate(self.found.rows, 1):
            before = self._row(number, row)
            joint = chain.joints[number]
            axis = joint.axis if joint.is_virtual else Z_AXIS
            before += self._to_tool_axis(axis) if joint.is_virtual else []
            zero = self._zero(number, row)
            if not zero.is_zero:
                before.append(Rotation(axis, zero, f"{joint.name} zero"))
            joints.append(
                replace(joint, before=tuple(before), axis=axis, printed_axis=None)
            )
        joints[0] = replace(joints[0], printed_axis=None)
        tool = self._tool(joints[-1].is_virtual)
        near = tuple(t.where for t in self.taken if t.reading.is_near)
        written = replace(chain, joints=tuple(joints), tool=tool, near=near)
        return Canonical(without_virtual_joint(written), tuple(self.taken))

    # ---- the rows

    def _row(self, number: int, row: AxisRow) -> list[Motion]:
        """The motions from axis ``number`` to the next."""
        pair = f"axes {number} and {number + 1}"
        motions: list[Motion] = []
        alpha = self._twist(pair, row)
        x, y = self._across(pair, row)
        d = self._along(number, row)
        if x or y or d:
            motions.append(Translation((x, y, d), f"{pair} offset"))
        if not alpha.is_zero:
            motions.append(Rotation(X_AXIS, alpha, f"{pair} twist"))
        if row.beta is not None:
            beta = self.reader.angle(row.beta)
            self._note(f"{pair}, tilt", beta, "")
            if not _angle(beta).is_zero:
                motions.append(Rotation(Y_AXIS, _angle(beta), f"{pair} tilt"))
        return motions

    def _twist(self, pair: str, row: AxisRow) -> Angle:
        if row.form == "parallel":
            angle = Angle(Fraction(int(row.is_turned)))
            reading = replace(
                self.reader.angle(row.alpha),
                value=angle,
                text="pi" if row.is_turned else "0",
                difference=-float(row.alpha.mid()),
                is_special=True,
                is_near=False,
            )
            self.forced.append(row.moved * row.lever)
        else:
            reading = self.reader.angle(row.alpha)
            moved = reading.moved if reading.is_special else 0.0
            self.forced.append(moved * row.lever)
        angle = _angle(reading)
        word = _TWISTS.get(angle.half_turns % 1) if reading.is_special else None
        self._note(f"{pair}, twist", reading, f"{pair} {word}" if word else "")
        return angle

    def _across(self, pair: str, row: AxisRow) -> tuple[Fraction, Fraction]:
        """The offset across the first axis."""
        if row.b is not None:
            x, y = self.reader.offset(row.a), self.reader.offset(row.b)
            self._note(f"{pair}, offset x", x, "")
            self._note(f"{pair}, offset y", y, "")
            return _fraction(x), _fraction(y)
        a = self.reader.length(row.a, self.forced[-1])
        self._note(f"{pair}, common normal", a, self._meets(pair, row, a))
        return _fraction(a), Fraction(0)

    def _meets(self, pair: str, row: AxisRow, a: ReadNumber) -> str:
        if a.value:
            return ""
        return f"{pair} coincide" if row.form == "parallel" else f"{pair} meet"

    def _along(self, number: int, row: AxisRow) -> Fraction:
        if row.d is None:
            return Fraction(0)
        if self.found.chain.joints[number - 1].kind == "prismatic":
            return _fraction(self.reader.offset(row.d))
        return self._offset(row.since, number, row.d)

    def _offset(self, since: int, number: int, d: arb) -> Fraction:
        axes = f"axis {number}" if since == number else f"axes {since} to {number}"
        reading = self.reader.length(d, sum(self.forced[since - 1 :]))
        relation = "" if reading.value else self._level(since, number)
        self._note(f"{axes}, offset", reading, relation)
        return _fraction(reading)

    def _level(self, since: int, number: int) -> str:
        """The sentence for no offset along these axes."""
        if since < number:
            return f"no offset along axes {since} to {number}"
        seen = {entry.relation for entry in self.taken}
        pairs = {f"axes {k} and {k + 1} meet" for k in (number - 1, number)}
        if pairs <= seen:
            return f"axes {number - 1}, {number} and {number + 1} meet in one point"
        return f"no offset along axis {number}"

    def _zero(self, number: int, row: AxisRow) -> Angle:
        joint = self.found.chain.joints[number]
        if joint.kind == "revolute":
            return self.reader.zero(row.zero)
        reading = self.reader.angle(row.zero)
        self._note(f"axis {number + 1}, turn", reading, "")
        return _angle(reading)

    def _note(self, where: str, reading: ReadNumber, relation: str) -> None:
        self.taken.append(Taken(where, reading, relation))

    # ---- base and tip

    def _to_tool_axis(self, axis: Vector) -> list[Motion]:
        """From z to the tool axis of the tip's frame, and along it to the tip."""
        last = self.found.last
        along = _fraction(self.reader.offset(-dot(last.origin, last.z)))
        x, y, z = (along * part for part in axis)
        move = [Translation((x, y, z), "tip")] if along else []
        return [*TO_Z[axis], *move]

    def _base(self) -> tuple[Motion, ...]:
        return _motions(_matrix(self.found.first))

    def _tool(self, is_virtual: bool) -> tuple[Motion, ...]:
        """What follows the last axis: the tip, then how its frame is turned."""
        if is_virtual:
            return ()
        back = np.linalg.inv(_matrix(self.found.last))
        whole = back @ transform(self.found.chain.tool)
        tip = self.found.tip
        if tip is None:
            return _motions(whole)
        number = len(self.found.chain.joints)
        d = Fraction(0)
        if tip.d is not None:
            slides = self.found.chain.joints[-1].kind == "prismatic"
            d = (
                _fraction(self.reader.offset(tip.d))
                if slides
                else self._offset(tip.since, number, tip.d)
            )
        a = self.reader.length(tip.a)
        relation = "" if a.value else f"the tip lies on axis {number}"
        self._note(f"tip from axis {number}, distance", a, relation)
        point = Translation((_fraction(a), Fraction(0), d), "tip")
        turn = [m for m in _motions(whole) if isinstance(m, Rotation)]
        return (point, *turn) if any(point.vector) else tuple(turn)


_TWISTS = {
    Fraction(0): "are parallel",
    Fraction(1, 2): "are square",
    Fraction(1, 3): "stand at 60 deg",
    Fraction(2, 3): "stand at 60 deg",
    Fraction(1, 4): "stand at 45 deg",
    Fraction(3, 4): "stand at 45 deg",
    Fraction(1, 6): "stand at 30 deg",
    Fraction(5, 6): "stand at 30 deg",
}
"""The twist in half turns modulo 1, in words."""


def _fraction(reading: ReadNumber) -> Fraction:
    assert isinstance(reading.value, Fraction)
    return reading.value


def _angle(reading: ReadNumber) -> Angle:
    assert isinstance(reading.value, Angle)
    return reading.value


def _matrix(frame: CanonicalFrame) -> NDArray[np.float64]:
    """A frame as a (4, 4) matrix of doubles."""
    result = np.eye(4)
    columns = (frame.x, cross(frame.z, frame.x), frame.z, frame.origin)
    for k, column in enumerate(columns):
        result[:3, k] = [float(entry.mid()) for entry in column]
    return result


def _motions(matrix: NDArray[np.float64]) -> tuple[Motion, ...]:
    """A rigid motion of doubles as a translation and one turn, to 1e-12."""
    motions: list[Motion] = []
    move = _vector(matrix[:3, 3])
    if any(move):
        motions.append(Translation(move))
    angle, axis = _turn(matrix[:3, :3])
    if angle:
        half_turns = Fraction(round(12 * angle / math.pi), 12)
        if abs(angle - float(half_turns) * math.pi) < 1e-11:
            motions.append(Rotation(_vector(axis), Angle(half_turns)))
        else:
            motions.append(Rotation(_vector(axis), Angle(radians=_short(angle))))
    return tuple(motions)


def _turn(R: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
    """Angle in [0, pi] and axis of a rotation matrix, by its quaternion."""
    K = np.array(
        [
            [R[0, 0] - R[1, 1] - R[2, 2], 0.0, 0.0, 0.0],
            [R[0, 1] + R[1, 0], R[1, 1] - R[0, 0] - R[2, 2], 0.0, 0.0],
            [R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], R[2, 2] - R[0, 0] - R[1, 1], 0.0],
            [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], np.trace(R)],
        ]
    )
    values, vectors = np.linalg.eigh(K / 3)
    x, y, z, w = vectors[:, np.argmax(values)]
    if w < 0:
        x, y, z, w = -x, -y, -z, -w
    axis = np.array([x, y, z])
    size = float(np.linalg.norm(axis))
    if size < 1e-12:
        return 0.0, np.array([0.0, 0.0, 1.0])
    return 2 * math.atan2(size, w), axis / np.abs(axis).max()


def _vector(entries: Sequence[float] | NDArray[np.float64]) -> Vector:
    x, y, z = (_short(float(entry)) for entry in entries)
    return x, y, z


def _short(value: float) -> Fraction:
    return Fraction(round(value * 10**13), 10**13)
