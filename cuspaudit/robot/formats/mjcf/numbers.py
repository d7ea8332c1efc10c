"""The numbers of MJCF: vectors, and the five ways to write an orientation.

Decimals are read exactly. A quaternion of decimals is a rational rotation matrix
whatever its length; as turns about z, y and x it has angles whose tangents are
rational. Those that are multiples of pi/4 are exact, any other is kept to 40 digits.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from flint import arb, ctx

from cuspaudit.algebra.rationals import exact_rational
from cuspaudit.algebra.ring import rational
from cuspaudit.robot.axes import scaled_axis, unit_axis
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Motion,
    Rotation,
    Vector,
)
from cuspaudit.robot.numbers import parse_decimal
from cuspaudit.robot.place import Place, quoted

__all__ = [
    "ORIENTATIONS",
    "angle",
    "direction",
    "numbers",
    "orientation",
    "quaternion_turns",
    "turn_of_z",
    "vector",
]

_LARGEST = Fraction(10**10)
_BITS = 192
_DIGITS = 40
ORIENTATIONS = ("quat", "axisangle", "euler", "xyaxes", "zaxis")
_AXES = {"x": X_AXIS, "y": Y_AXIS, "z": Z_AXIS}

Matrix = tuple[Vector, Vector, Vector]


def numbers(text: str, count: int, place: Place) -> tuple[Fraction, ...]:
    """So many decimals, none above 1e10, as MuJoCo has it.

    Raises:
        InvalidRobotError: they are not.
    """
    words = text.split()
    if len(words) != count:
        found = f"{len(words)} numbers in {quoted(text)}" if words else "it is empty"
        raise place.error(found, f"write {count} decimal numbers")
    values = tuple(parse_decimal(word, place) for word in words)
    for word, value in zip(words, values, strict=True):
        if abs(value) > _LARGEST:
            raise place.error(f"{quoted(word)} is above 1e10", "write a smaller number")
    return values


def vector(text: str, place: Place) -> Vector:
    """Three decimals."""
    x, y, z = numbers(text, 3, place)
    return x, y, z


def direction(text: str, place: Place) -> Vector:
    """A direction that is not zero, the exact unit vector where that is rational."""
    given = vector(text, place)
    if not any(given):
        raise place.error("the zero vector", "write a direction")
    return unit_axis(given) or scaled_axis(given)


def angle(value: Fraction, degrees: bool) -> Angle:
    """A bare number in the unit of the file."""
    return Angle(value / 180) if degrees else Angle(radians=value)


def orientation(
    attributes: Mapping[str, str],
    degrees: bool,
    sequence: str,
    source: str,
    place: Place,
) -> tuple[Motion, ...]:
    """The rotation of a body, frame or site, as turns from left to right.

    Args:
        attributes: of the element.
        degrees: whether bare angles are in degrees.
        sequence: of Euler angles, such as "xyz"; capitals turn about fixed axes.
        source: what the numbers are called.
        place: where they stand.

    Raises:
        InvalidRobotError: they cannot be read, or there are two orientations.
    """
    given = [name for name in ORIENTATIONS if name in attributes]
    if len(given) > 1:
        found = f"two orientations, {' and '.join(given)}"
        raise place.error(found, "leave one")
    if not given:
        return ()
    [name] = given
    text, here = attributes[name], place.at(name)
    turns: Sequence[tuple[Vector, Angle]]
    if name == "axisangle":
        *axis, turn = numbers(text, 4, here)
        if not any(axis):
            raise here.error("the zero vector", "write a direction")
        turns = [(scaled_axis((axis[0], axis[1], axis[2])), angle(turn, degrees))]
    elif name == "euler":
        turns = _euler(vector(text, here), degrees, sequence)
    elif name == "quat":
        turns = quaternion_turns(numbers(text, 4, here), here)
    elif name == "zaxis":
        turns = turn_of_z(vector(text, here), here)
    else:
        turns = _axes(numbers(text, 6, here), here)
    return tuple(
        Rotation(axis, turn, f"{source} {name}")
        for axis, turn in turns
        if not turn.is_zero
    )


def _euler(values: Vector, degrees: bool, sequence: str) -> list[tuple[Vector, Angle]]:
    turns: list[tuple[Vector, Angle]] = []
    for letter, value in zip(sequence, values, strict=True):
        turn = (_AXES[letter.lower()], angle(value, degrees))
        turns.insert(len(turns) if letter.islower() else 0, turn)
    return turns


def quaternion_turns(
    values: Sequence[Fraction], place: Place
) -> list[tuple[Vector, Angle]]:
    """The turns of a quaternion w, x, y, z of any length, left to right.

    Raises:
        InvalidRobotError: it is zero.
    """
    w, x, y, z = values
    if not any(values):
        raise place.error("the zero quaternion", "write one of length 1")
    for axis, part, others in (
        (X_AXIS, x, (y, z)),
        (Y_AXIS, y, (x, z)),
        (Z_AXIS, z, (x, y)),
    ):
        if not any(others):
            # the turn is twice the angle whose tangent is part / w
            return [(axis, _angle_of(2 * w * part, w * w - part * part))]
    return _turns(
        (
            (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
        )
    )


def turn_of_z(given: Vector, place: Place) -> list[tuple[Vector, Angle]]:
    """The shortest turn from z to a direction, about x where that is -z.

    Raises:
        InvalidRobotError: it is the zero vector.
    """
    x, y, z = given
    if not any(given):
        raise place.error("the zero vector", "write a direction")
    if x == y == 0:
        return [] if z > 0 else [(X_AXIS, Angle(Fraction(1)))]
    axis = scaled_axis((-y, x, Fraction(0)))
    return [(axis, _angle_of(Fraction(1), z, x * x + y * y))]


def _axes(values: Sequence[Fraction], place: Place) -> list[tuple[Vector, Angle]]:
    """The turns to an x axis and a y axis, of which the part across x counts.

    Raises:
        InvalidRobotError: one is the zero vector, or they are along one line.
    """
    (a, b, c), second = values[:3], values[3:]
    square = a * a + b * b + c * c
    if square == 0 or not any(second):
        raise place.error("the zero vector", "write two directions")
    along = (a * second[0] + b * second[1] + c * second[2]) / square
    y = (second[0] - along * a, second[1] - along * b, second[2] - along * c)
    if not any(y):
        raise place.error("two axes along one line", "write two directions")
    z = (b * y[2] - c * y[1], c * y[0] - a * y[2], a * y[1] - b * y[0])
    # z is as long as x and y together, so y is |x| times too short beside it
    if a == b == 0:
        sign = 1 if c > 0 else -1
        roll = _angle_of(-sign * y[0], -sign * z[0], square)
        return [(Y_AXIS, Angle(Fraction(-sign, 2))), (X_AXIS, roll)]
    yaw, roll = _angle_of(b, a), _angle_of(y[2], z[2], square)
    return [(Z_AXIS, yaw), (Y_AXIS, _pitch(-c, a * a + b * b)), (X_AXIS, roll)]


def _turns(R: Matrix) -> list[tuple[Vector, Angle]]:
    """The turns about z, y, x of a rotation matrix, or of a positive multiple of it."""
    level = R[0][0] ** 2 + R[1][0] ** 2
    if level == 0:
        pitch = Angle(Fraction(-1 if R[2][0] > 0 else 1, 2))
        sign = -1 if R[2][0] > 0 else 1
        roll = _angle_of(sign * R[0][1], sign * R[0][2])
        return [(Y_AXIS, pitch), (X_AXIS, roll)]
    yaw, roll = _angle_of(R[1][0], R[0][0]), _angle_of(R[2][1], R[2][2])
    return [(Z_AXIS, yaw), (Y_AXIS, _pitch(-R[2][0], level)), (X_AXIS, roll)]


def _pitch(sine: Fraction, level: Fraction) -> Angle:
    """The angle with this sine and the root of ``level`` as cosine, up to a factor."""
    if sine * sine == level or sine == 0:
        return Angle(Fraction((sine > 0) - (sine < 0), 4))
    return _angle_of(sine / level, Fraction(1), level)


def _angle_of(
    sine: Fraction, cosine: Fraction, square: Fraction = Fraction(1)
) -> Angle:
    """The angle of the point (cosine, sine * root of ``square``), other than 0."""
    if sine == 0 or cosine == 0 or sine * sine * square == cosine * cosine:
        x, y = (cosine > 0) - (cosine < 0), (sine > 0) - (sine < 0)
        eighths = {(1, 0): 0, (1, 1): 1, (0, 1): 2, (-1, 1): 3}
        eighths |= {(-1, 0): 4, (-1, -1): -3, (0, -1): -2, (1, -1): -1}
        return Angle(Fraction(eighths[x, y], 4))
    saved, ctx.prec = ctx.prec, _BITS
    try:
        height = arb(rational(sine)) * arb(rational(square)).sqrt()
        return _kept(arb.atan2(height, arb(rational(cosine))))
    finally:
        ctx.prec = saved


def _kept(value: arb) -> Angle:
    """An angle to 40 digits."""
    exact = exact_rational(value)
    scaled = Fraction(int(exact.p), int(exact.q)) * 10**_DIGITS
    return Angle(radians=Fraction(round(scaled), 10**_DIGITS))
