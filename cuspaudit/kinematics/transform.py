"""Rigid motions with entries in a polynomial ring."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.robot.chain import X_AXIS, Y_AXIS, Z_AXIS, Vector

__all__ = [
    "Column",
    "Rows",
    "Transform",
    "column",
    "cross",
    "dot",
    "identity",
    "turn",
    "zero",
]

Column = tuple[Polynomial, ...]
Rows = tuple[Column, ...]


@dataclass(frozen=True)
class Transform:
    """x -> rotation x + translation, entries constant or polynomial in a ring.

    Attributes:
        ring: where the entries live.
        rotation: three rows.
        translation: three entries.
    """

    ring: Ring
    rotation: Rows
    translation: Column

    def __matmul__(self, other: Transform) -> Transform:
        columns = zip(*other.rotation, strict=True)
        turned = [self.turn(column) for column in columns]
        return Transform(
            self.ring,
            tuple(zip(*turned, strict=True)),
            self.apply(other.translation),
        )

    def turn(self, direction: Column) -> Column:
        """The image of a direction."""
        dot = self.ring.dot
        first, second, third = self.rotation
        return (dot(first, direction), dot(second, direction), dot(third, direction))

    def apply(self, point: Column) -> Column:
        """The image of a point."""
        turned = self.turn(point)
        return tuple(a + b for a, b in zip(turned, self.translation, strict=True))

    def inverse(self) -> Transform:
        """The inverse motion."""
        back: Rows = tuple(zip(*self.rotation, strict=True))
        turned = Transform(self.ring, back, self.translation).turn(self.translation)
        return Transform(self.ring, back, tuple(-x for x in turned))


def dot(ring: Ring, a: Column, b: Column) -> Polynomial:
    """The inner product, reduced in the field."""
    return ring.dot(a, b)


def cross(ring: Ring, a: Column, b: Column) -> Column:
    """The vector product, reduced in the field."""
    (x, y, z), (u, v, w) = a, b
    entries = (y * w - z * v, z * u - x * w, x * v - y * u)
    return tuple(ring.reduce(entry) for entry in entries)


def identity(ring: Ring) -> Rows:
    """The identity matrix."""
    return tuple(column(ring, axis) for axis in (X_AXIS, Y_AXIS, Z_AXIS))


def zero(ring: Ring) -> Column:
    """The zero vector."""
    return column(ring, (Fraction(0),) * 3)


def column(ring: Ring, vector: Vector) -> Column:
    """A rational vector as constants of the ring."""
    x, y, z = (ring.constant(entry) for entry in vector)
    return (x, y, z)


def turn(ring: Ring, axis: Column, c: Polynomial, s: Polynomial) -> Rows:
    """The rotation matrix c 1 + (1 - c) axis axis^T + s [axis]_x (Rodrigues)."""
    x, y, z = axis
    k = 1 - c
    rows = (
        (c + x * x * k, x * y * k - z * s, x * z * k + y * s),
        (y * x * k + z * s, c + y * y * k, y * z * k - x * s),
        (z * x * k - y * s, z * y * k + x * s, c + z * z * k),
    )
    return tuple(tuple(ring.reduce(entry) for entry in row) for row in rows)
