"""Poses in exact numbers, and the tool paths that they make."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

__all__ = ["Pose", "Quaternion", "ToolPath", "Vector", "half_turn", "same_orientation"]

Vector = tuple[Fraction, Fraction, Fraction]
Quaternion = tuple[Fraction, Fraction, Fraction, Fraction]


@dataclass(frozen=True, slots=True)
class Pose:
    """A place of the tip.

    Attributes:
        position: in the unit of the chain.
        quaternion: (w, x, y, z), not zero, of any length: the rotation is that of the
            unit quaternion along it, a matrix of rational numbers. None when only the
            position is given.
        row: where the file has it, 1 for the first; 0 when it has none.
    """

    position: Vector
    quaternion: Quaternion | None = None
    row: int = 0

    @property
    def rotation(self) -> tuple[Vector, Vector, Vector]:
        """The rotation matrix, by rows; the identity without a quaternion."""
        w, x, y, z = self.quaternion or (Fraction(1), *(Fraction(0),) * 3)
        n = w * w + x * x + y * y + z * z
        return (
            (
                (w * w + x * x - y * y - z * z) / n,
                2 * (x * y - w * z) / n,
                2 * (x * z + w * y) / n,
            ),
            (
                2 * (x * y + w * z) / n,
                (w * w - x * x + y * y - z * z) / n,
                2 * (y * z - w * x) / n,
            ),
            (
                2 * (x * z - w * y) / n,
                2 * (y * z + w * x) / n,
                (w * w - x * x - y * y + z * z) / n,
            ),
        )

    def is_same(self, other: Pose) -> bool:
        """Whether the two are one pose, exactly."""
        return self.position == other.position and same_orientation(
            self.quaternion, other.quaternion
        )


@dataclass(frozen=True, slots=True)
class ToolPath:
    """Poses, one after the other.

    Between two of them the position is linear, and the orientation turns about one
    axis at constant rate, by less than half a turn.

    Attributes:
        poses: two at least.
        joints: the joint vectors that the poses come from, where the file has these.
        file: where it comes from.
    """

    poses: tuple[Pose, ...]
    joints: tuple[tuple[float, ...], ...] | None = None
    file: str = ""

    @property
    def is_closed(self) -> bool:
        """Whether the last pose is the first."""
        return self.poses[0].is_same(self.poses[-1])

    @property
    def legs(self) -> int:
        """How many legs there are."""
        return len(self.poses) - 1


def same_orientation(a: Quaternion | None, b: Quaternion | None) -> bool:
    """Whether two quaternions are multiples of each other: one rotation."""
    if a is None or b is None:
        return a is b
    k = next(i for i in range(4) if a[i])
    return bool(b[k]) and all(x * b[k] == y * a[k] for x, y in zip(a, b, strict=True))


def half_turn(first: Pose, second: Pose) -> bool:
    """Whether the orientations are half a turn apart, to 1e-9."""
    a, b = first.quaternion, second.quaternion
    if a is None or b is None:
        return False
    inner = sum(x * y for x, y in zip(a, b, strict=True))
    sizes = [sum(x * x for x in q) for q in (a, b)]
    return inner * inner <= Fraction(1, 10**18) * sizes[0] * sizes[1]
