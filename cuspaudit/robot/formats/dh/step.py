"""The fixed transform between two joint axes as D-H numbers, where these are exact.

With z both the axis before and the axis after, a transform is sought as

    Rz(theta) Tz(d) Tx(a) Rx(alpha) Rz(psi) Tz(rise)

whose lengths are rational and whose angles are sums of those in the chain. That exists
when all rotations but one are quarter turns and the axes stand in line with the frames,
as data sheets draw them; there is no division, so nothing blows up where axes are
nearly parallel. In every other case there is no step, and a file has to hold the
motions themselves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from cuspaudit.robot.axes import unit_axis
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Motion,
    Translation,
    Vector,
)

__all__ = ["DhStep", "dh_step", "z_screw"]

Matrix = tuple[Vector, Vector, Vector]

_ZERO: Vector = (Fraction(0), Fraction(0), Fraction(0))
_NONE = Angle()
_NOTHING = Fraction(0)
_QUARTERS: dict[tuple[Fraction | int, Fraction | int], int] = {
    (1, 0): 0,
    (0, 1): 1,
    (-1, 0): 2,
    (0, -1): 3,
}


@dataclass(frozen=True, slots=True)
class DhStep:
    """Rz(theta) Tz(d) Tx(a) Rx(alpha) Rz(psi) Tz(rise)."""

    theta: Angle = _NONE
    d: Fraction = _NOTHING
    a: Fraction = _NOTHING
    alpha: Angle = _NONE
    psi: Angle = _NONE
    rise: Fraction = _NOTHING

    @property
    def is_plain(self) -> bool:
        """Whether no angle mixes a multiple of pi with rad, so that each can snap."""
        angles = (self.theta, self.alpha, self.psi)
        return not any(angle.half_turns and angle.radians for angle in angles)

    def between(self, before: DhStep, after: DhStep) -> DhStep:
        """This step with one about z before it and one about z after it."""
        return DhStep(
            self.theta + before.psi,
            self.d + before.rise,
            self.a,
            self.alpha,
            self.psi + after.psi,
            self.rise + after.rise,
        )


def z_screw(motions: Sequence[Motion]) -> DhStep | None:
    """The motions as Rz(psi) Tz(rise), None when one is not about or along z."""
    psi, rise = Angle(), Fraction(0)
    for motion in motions:
        if isinstance(motion, Translation):
            if any(motion.vector[:2]):
                return None
            rise += motion.vector[2]
        else:
            if any(motion.axis[:2]):
                return None
            psi += motion.angle if motion.axis[2] > 0 else -motion.angle
    return DhStep(psi=psi, rise=rise)


def dh_step(motions: Sequence[Motion]) -> DhStep | None:
    """The step equal to the product of ``motions``, None where none is exact."""
    first = 0
    while first < len(motions) and z_screw(motions[first : first + 1]):
        first += 1
    last = len(motions)
    while last > first and z_screw(motions[last - 1 : last]):
        last -= 1
    before, after = z_screw(motions[:first]), z_screw(motions[last:])
    core = _core(motions[first:last])
    if before is None or after is None or core is None:
        return None
    return core.between(before, after)


def _core(motions: Sequence[Motion]) -> DhStep | None:
    """The step of motions of which at most one is no quarter turn.

    T(left) Rot(axis, bend) T(right) R is their product, R and the vectors rational.
    """
    R: Matrix = (X_AXIS, Y_AXIS, Z_AXIS)
    left, right = _ZERO, _ZERO
    bend: tuple[Vector, Angle] | None = None
    for motion in motions:
        if isinstance(motion, Translation):
            right = _plus(right, _turned(R, motion.vector))
            continue
        axis = unit_axis(motion.axis)
        if axis is None:
            return None
        quarter = _quarters_of(motion.angle)
        if quarter is not None:
            R = _product(R, _quarter_turn(axis, quarter))
        elif bend is None:
            bend = _turned(R, axis), motion.angle
            left, right = right, _ZERO
        else:
            return None
    if bend is None:
        return _square(R, right)
    return _bent(left, bend[0], bend[1], right, R)


def _bent(
    left: Vector, axis: Vector, bend: Angle, right: Vector, R: Matrix
) -> DhStep | None:
    """The step of T(left) Rot(axis, bend) T(right) R."""
    z = _turned(R, Z_AXIS)
    if not any(axis[:2]) and not any(left[:2]):
        rest = _square(R, right)
        turn = DhStep(psi=bend if axis[2] > 0 else -bend, rise=left[2])
        return rest and rest.between(turn, DhStep())
    if axis in (z, _opposite(z)) and not any(_cross(right, axis)):
        rest = _square(R, _plus(left, right))
        turn = DhStep(psi=bend if _dot(axis, z) > 0 else -bend)
        return rest and rest.between(DhStep(), turn)
    quarter = _QUARTERS.get((axis[0], axis[1]))
    if quarter is None or _dot(axis, z) != 0:
        return None
    side = _cross(axis, Z_AXIS)
    beta = _QUARTERS.get((_dot(z, Z_AXIS), _dot(z, side)))
    if beta is None or _dot(left, side) or _dot(right, _cross(axis, z)):
        return None
    psi = _last_angle(R, quarter, beta)
    a, rise = _dot(_plus(left, right), axis), _dot(right, z)
    alpha = bend + _half_turns(beta)
    if psi is None:
        return None
    return DhStep(_half_turns(quarter), left[2], a, alpha, psi, rise)


def _square(R: Matrix, p: Vector) -> DhStep | None:
    """The step of T(p) R when z and R z are parallel or at right angles."""
    z = _turned(R, Z_AXIS)
    if not any(z[:2]):
        quarter = 0 if p[1] == 0 else 1
        twist = 0 if z[2] > 0 else 2
        x, rise = (Y_AXIS if quarter else X_AXIS), Fraction(0)
        if quarter and p[0]:
            return None
    else:
        x = _cross(Z_AXIS, z)
        if z[2] != 0 or (x[0], x[1]) not in _QUARTERS:
            return None
        quarter, twist, rise = _QUARTERS[x[0], x[1]], 1, _dot(p, z)
        if quarter >= 2:
            x, quarter, twist = _opposite(x), quarter - 2, 3
    psi = _last_angle(R, quarter, twist)
    alpha = _half_turns(twist)
    if psi is None:
        return None
    return DhStep(_half_turns(quarter), p[2], _dot(p, x), alpha, psi, rise)


def _last_angle(R: Matrix, quarter: int, twist: int) -> Angle | None:
    """Psi with R = Rz(quarter) Rx(twist) Rz(psi), when it is a quarter turn."""
    back = _product(_quarter_turn(X_AXIS, -twist), _quarter_turn(Z_AXIS, -quarter))
    rest = _product(back, R)
    found = _QUARTERS.get((rest[0][0], rest[1][0]))
    return None if found is None else _half_turns(found)


def _quarters_of(angle: Angle) -> int | None:
    doubled = 2 * angle.half_turns
    return int(doubled) if angle.radians == 0 and doubled.denominator == 1 else None


def _half_turns(quarters: int) -> Angle:
    """The angle of some quarter turns, in (-pi, pi]."""
    return Angle(Fraction(quarters if quarters <= 2 else quarters - 4, 2))


def _quarter_turn(axis: Vector, quarters: int) -> Matrix:
    """The rotation about a unit vector by so many quarter turns (Rodrigues)."""
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarters % 4]
    x, y, z = axis
    k = 1 - c
    return (
        (c + x * x * k, x * y * k - z * s, x * z * k + y * s),
        (y * x * k + z * s, c + y * y * k, y * z * k - x * s),
        (z * x * k - y * s, z * y * k + x * s, c + z * z * k),
    )


def _product(A: Matrix, B: Matrix) -> Matrix:
    columns = list(zip(*B, strict=True))
    first, second, third = (
        (_dot(row, columns[0]), _dot(row, columns[1]), _dot(row, columns[2]))
        for row in A
    )
    return first, second, third


def _turned(R: Matrix, vector: Vector) -> Vector:
    return _dot(R[0], vector), _dot(R[1], vector), _dot(R[2], vector)


def _dot(a: Vector, b: Vector) -> Fraction:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _plus(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _opposite(a: Vector) -> Vector:
    return -a[0], -a[1], -a[2]
