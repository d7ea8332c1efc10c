"""An exact algebraic model of a chain, over Q or Q(sqrt 2) or Q(sqrt 3).

Cosine and sine of a multiple of pi/4 or pi/6 are exact in the field of the model. Any
other angle, and any axis whose length is irrational, has no exact algebraic form: it
is replaced by a rational point of the circle or of the sphere within ``tolerance``,
and the replacement is recorded. A rotation about a joint's own axis is not geometry:
it shifts the joint's zero and needs no cosine.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from flint import arb, ctx, fmpq

from cuspaudit.algebra.rationals import exact_rational, simplest_between
from cuspaudit.algebra.ring import Polynomial, Ring, rational
from cuspaudit.kinematics.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)

__all__ = ["Approximation", "ExactJoint", "ExactModel", "Transform", "exact_model"]

TOLERANCE = Fraction(1, 10**12)
_BITS = 256

Column = tuple[Polynomial, ...]
Rows = tuple[Column, ...]


@dataclass(frozen=True)
class Approximation:
    """A number of the chain that the exact model only comes close to.

    Attributes:
        where: joint and what about it.
        difference: a bound on the distance, in rad.
    """

    where: str
    difference: float


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
        return tuple(dot(self.ring, row, direction) for row in self.rotation)

    def apply(self, point: Column) -> Column:
        """The image of a point."""
        turned = self.turn(point)
        return tuple(a + b for a, b in zip(turned, self.translation, strict=True))

    def inverse(self) -> Transform:
        """The inverse motion."""
        back: Rows = tuple(zip(*self.rotation, strict=True))
        turned = Transform(self.ring, back, self.translation).turn(self.translation)
        return Transform(self.ring, back, tuple(-x for x in turned))


@dataclass(frozen=True)
class ExactJoint:
    """A joint of the model.

    Attributes:
        name: as in the chain.
        kind: "revolute" or "prismatic".
        before: the fixed transform from the previous joint's moved frame.
        axis: unit vector.
        zero: what is added to the joint value to get the model's variable (rad).
        variables: names of (cos, sin), or of the displacement, in the ring.
    """

    name: str
    kind: str
    before: Transform
    axis: Column
    zero: Angle
    variables: tuple[str, ...]


@dataclass(frozen=True)
class ExactModel:
    """A chain in exact numbers.

    Attributes:
        chain: what it models.
        ring: K[c1, s1, ...], the variables of all joints, base to tip.
        joints: base to tip.
        tool: the fixed transform after the last joint.
        approximations: empty when the model is the chain exactly.
    """

    chain: Chain
    ring: Ring
    joints: tuple[ExactJoint, ...]
    tool: Transform
    approximations: tuple[Approximation, ...]

    @property
    def is_exact(self) -> bool:
        """Whether no number was approximated."""
        return not self.approximations

    def motion(self, joint: ExactJoint) -> Transform:
        """The transform of a joint's own motion, polynomial in its variables."""
        ring = self.ring
        if joint.kind == "prismatic":
            q = ring.gen(joint.variables[0])
            identity = _turn(ring, joint.axis, ring.constant(1), ring.constant(0))
            return Transform(ring, identity, tuple(x * q for x in joint.axis))
        c, s = (ring.gen(name) for name in joint.variables)
        return Transform(ring, _turn(ring, joint.axis, c, s), _zero(ring))


def exact_model(chain: Chain, tolerance: Fraction = TOLERANCE) -> ExactModel:
    """The exact model of ``chain``.

    Args:
        chain: any chain.
        tolerance: how far, in rad, an angle or an axis may be moved to a rational one.
    """
    plan = [_absorb(joint) for joint in chain.joints]
    rest = [motion for joint, _ in plan for motion in joint.before]
    ring = Ring(_variables(chain), _radicand(chain, [*rest, *chain.tool]))
    seen: list[Approximation] = []

    def note(where: str, exact: bool) -> None:
        if not exact:
            seen.append(Approximation(where, float(tolerance)))

    joints = []
    for number, (joint, zero) in enumerate(plan, 1):
        before = _product(ring, joint.before, tolerance, f"{joint.name} before", note)
        axis, exact = _unit(joint.axis, tolerance)
        note(f"{joint.name} axis", exact)
        names = _names(number, joint)
        joints.append(
            ExactJoint(joint.name, joint.kind, before, _column(ring, axis), zero, names)
        )
    tool = _product(ring, chain.tool, tolerance, "tool", note)
    return ExactModel(chain, ring, tuple(joints), tool, tuple(seen))


def dot(ring: Ring, a: Column, b: Column) -> Polynomial:
    """The inner product, reduced in the field."""
    return ring.reduce(ring.total(x * y for x, y in zip(a, b, strict=True)))


def cross(ring: Ring, a: Column, b: Column) -> Column:
    """The vector product, reduced in the field."""
    (x, y, z), (u, v, w) = a, b
    entries = (y * w - z * v, z * u - x * w, x * v - y * u)
    return tuple(ring.reduce(entry) for entry in entries)


def _names(number: int, joint: Joint) -> tuple[str, ...]:
    if joint.kind == "prismatic":
        return (f"q{number}",)
    return (f"c{number}", f"s{number}")


def _variables(chain: Chain) -> Iterator[str]:
    for number, joint in enumerate(chain.joints, 1):
        yield from _names(number, joint)


def _absorb(joint: Joint) -> tuple[Joint, Angle]:
    """The joint without rotations about its own axis before it, and their angle."""
    before, zero = list(joint.before), Angle()
    if joint.kind == "revolute":
        while before and isinstance(before[-1], Rotation):
            factor = _ratio(before[-1].axis, joint.axis)
            if factor is None:
                break
            last = before.pop()
            assert isinstance(last, Rotation)
            zero = zero + (last.angle if factor > 0 else -last.angle)
    return Joint(joint.name, joint.kind, tuple(before), joint.axis), zero


def _ratio(a: Vector, b: Vector) -> Fraction | None:
    """The factor with a = factor b, or None."""
    at = max(range(3), key=lambda i: abs(b[i]))
    factor = a[at] / b[at]
    parallel = all(x == factor * y for x, y in zip(a, b, strict=True))
    return factor if parallel else None


def _radicand(chain: Chain, motions: list[Motion]) -> int | None:
    """The radicand that most of the angles ask for, or None.

    When the angles of a three-joint chain ask for two, neither field makes its model
    exact, and the elimination is fifty times faster over Q. The reductions of a
    six-joint chain gain from every angle that stays exact.
    """
    wanted: Counter[int] = Counter()
    for motion in motions:
        if isinstance(motion, Rotation) and motion.angle.radians == 0:
            denominator = motion.angle.half_turns.denominator
            wanted[{4: 2, 3: 3, 6: 3}.get(denominator, 0)] += 1
    del wanted[0]
    if len(wanted) > 1 and len(chain.joints) <= 3:
        return None
    return wanted.most_common(1)[0][0] if wanted else None


def _product(
    ring: Ring,
    motions: tuple[Motion, ...],
    tolerance: Fraction,
    where: str,
    note: Callable[[str, bool], None],
) -> Transform:
    result = Transform(ring, _identity(ring), _zero(ring))
    for motion in motions:
        if isinstance(motion, Translation):
            step = Transform(ring, _identity(ring), _column(ring, motion.vector))
        else:
            axis, exact_axis = _unit(motion.axis, tolerance)
            c, s, exact = _cos_sin(ring, motion.angle, tolerance)
            note(f"{where}, rotation axis", exact_axis)
            note(f"{where}, angle", exact)
            turn = _turn(ring, _column(ring, axis), c, s)
            step = Transform(ring, turn, _zero(ring))
        result = result @ step
    return result


def _identity(ring: Ring) -> Rows:
    return tuple(_column(ring, axis) for axis in (X_AXIS, Y_AXIS, Z_AXIS))


def _zero(ring: Ring) -> Column:
    return _column(ring, (Fraction(0),) * 3)


def _column(ring: Ring, vector: Vector) -> Column:
    x, y, z = (ring.constant(entry) for entry in vector)
    return (x, y, z)


def _turn(ring: Ring, axis: Column, c: Polynomial, s: Polynomial) -> Rows:
    """The rotation matrix c 1 + (1 - c) axis axis^T + s [axis]_x (Rodrigues)."""
    x, y, z = axis
    k = 1 - c
    rows = (
        (c + x * x * k, x * y * k - z * s, x * z * k + y * s),
        (y * x * k + z * s, c + y * y * k, y * z * k - x * s),
        (z * x * k - y * s, z * y * k + x * s, c + z * z * k),
    )
    return tuple(tuple(ring.reduce(entry) for entry in row) for row in rows)


def _cos_sin(
    ring: Ring, angle: Angle, tolerance: Fraction
) -> tuple[Polynomial, Polynomial, bool]:
    """(cos, sin, whether they are exact) in the field of the ring."""
    if angle.radians == 0:
        table = _TABLE.get((ring.radicand, angle.half_turns % 2))
        table = table or _TABLE.get((None, angle.half_turns % 2))
        if table is not None:
            c, s = (
                ring.constant(plain) + (ring.surd * surd if surd else 0)
                for plain, surd in table
            )
            return c, s, True
    near = _near_cos_sin(angle, tolerance)
    return ring.constant(near[0]), ring.constant(near[1]), False


_Table = dict[tuple[int | None, Fraction], tuple[tuple[fmpq, fmpq], ...]]


def _build_table() -> _Table:
    """(radicand, half turns) -> (cos, sin), each as plain + surd sqrt(radicand)."""
    half, zero, one = fmpq(1, 2), fmpq(0), fmpq(1)
    first: dict[tuple[int | None, Fraction], tuple[fmpq, fmpq, fmpq, fmpq]] = {
        (None, Fraction(0)): (one, zero, zero, zero),
        (2, Fraction(1, 4)): (zero, half, zero, half),
        (3, Fraction(1, 6)): (zero, half, half, zero),
        (3, Fraction(1, 3)): (half, zero, zero, half),
    }
    table: _Table = {}
    for (radicand, turns), (c, cs, s, ss) in first.items():
        for quarter in range(4):
            key = (radicand, turns + Fraction(quarter, 2))
            table[key] = ((c, cs), (s, ss))
            c, cs, s, ss = -s, -ss, c, cs
    return table


_TABLE = _build_table()


def _near_cos_sin(angle: Angle, tolerance: Fraction) -> tuple[fmpq, fmpq]:
    """A rational point of the circle within ``tolerance`` of the angle.

    The opposite angle gives the conjugate point, so that axes that two such turns
    make parallel stay parallel.
    """
    saved, ctx.prec = ctx.prec, _BITS
    try:
        value = arb(rational(angle.half_turns)) * arb.pi() + arb(
            rational(angle.radians)
        )
        quarter = round(float(2 * value / arb.pi()))
        t = _simplest(((value - quarter * arb.pi() / 2) / 2).tan(), tolerance / 2)
    finally:
        ctx.prec = saved
    c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    for _ in range(quarter % 4):
        c, s = -s, c
    return c, s


def _unit(axis: Vector, tolerance: Fraction) -> tuple[Vector, bool]:
    """(rational unit vector, whether it is the direction exactly)."""
    square = sum((x * x for x in axis), Fraction(0))
    root = rational(square).sqrt() if _is_square(square) else None
    if root is not None:
        length = Fraction(int(root.p), int(root.q))
        x, y, z = (entry / length for entry in axis)
        return (x, y, z), True
    at = max(range(3), key=lambda i: abs(axis[i]))
    sign = 1 if axis[at] > 0 else -1
    saved, ctx.prec = ctx.prec, _BITS
    try:
        length_ball = arb(rational(square)).sqrt()
        rest = [
            _simplest(
                arb(rational(axis[i])) / (length_ball + sign * arb(rational(axis[at]))),
                tolerance / 4,
            )
            for i in range(3)
            if i != at
        ]
    finally:
        ctx.prec = saved
    p, q = (Fraction(int(x.p), int(x.q)) for x in rest)
    below = 1 + p * p + q * q
    found = [2 * p / below, 2 * q / below]
    found.insert(at, sign * (1 - p * p - q * q) / below)
    return (found[0], found[1], found[2]), False


def _is_square(value: Fraction) -> bool:
    return all(
        isqrt(part) ** 2 == part for part in (value.numerator, value.denominator)
    )


def _simplest(value: arb, tolerance: Fraction) -> fmpq:
    """The simplest rational within ``tolerance`` of a narrow ball."""
    middle = exact_rational(value)
    width = rational(tolerance) * fmpq(9, 10)
    return simplest_between(middle - width, middle + width)
