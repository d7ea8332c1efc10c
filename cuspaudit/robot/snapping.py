"""The snapped chain: what the designer meant by the numbers a file prints.

A file writes pi/2 as 1.5708, 1.57 or 1.570796326589793, and a parallel axis with
3.7e-6 left over from a CAD system. As printed, such axes neither meet nor stand
parallel; snapped they do. An angle is what it is read as wherever it stands, since only
then a model is exact; a small component of a length or an axis goes only where a
relation of the axes comes of it. Every number that is replaced is listed with its
replacement and with the relations that hold because of it, and the literal chain stays
what it is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from cuspaudit.robot.axes import scaled_axis, unit_axis
from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.numbers import decimal_places, format_angle
from cuspaudit.robot.relations import relations
from cuspaudit.robot.snap_policy import DEFAULT_POLICY, SnapPolicy

__all__ = ["Snapped", "snap"]

_PI = Fraction("3.14159265358979323846264338327950288419716939937510")


@dataclass(frozen=True, slots=True)
class Snapped:
    """One number that was replaced.

    Attributes:
        where: its place in the file, such as "joint_2 rpy[0]" or "joint_2 alpha".
        given: what stands there, in rad or the chain's unit.
        used: the exact text of what is used instead.
        difference: used minus given.
        effect: the relations of the axes (`relations`) that hold only because of it;
            "" when none do.
    """

    where: str
    given: float
    used: str
    difference: float
    effect: str = ""


def snap(
    chain: Chain, policy: SnapPolicy = DEFAULT_POLICY
) -> tuple[Chain, tuple[Snapped, ...]]:
    """The snapped chain and the list of what was snapped, base to tip.

    Limits are left alone. With nothing to snap the chain itself comes back.
    """
    record = _Record()
    whole = _snapped(chain, policy, record)
    if not record.entries:
        return chain, ()

    def without(left: frozenset[int]) -> Chain:
        return _snapped(chain, policy, _Record(left))

    left = _idle(record.small, relations(whole), without)
    snapped = without(left)
    gained = relations(snapped) - relations(chain)
    entries = []
    for number, entry in enumerate(record.entries):
        if number not in left:
            lost = gained - relations(without(left | {number}))
            entries.append(replace(entry, effect="; ".join(sorted(lost))))
    return snapped, tuple(entries)


def _idle(
    small: Sequence[int],
    wanted: frozenset[str],
    without: Callable[[frozenset[int]], Chain],
) -> frozenset[int]:
    """Those of the small components that no relation needs, found one by one."""
    left: frozenset[int] = frozenset()
    for number in small:
        if wanted <= relations(without(left | {number})):
            left |= {number}
    return left


@dataclass
class _Record:
    """What can be snapped, in order.

    Attributes:
        left: the numbers of the entries that are left as they are.
        entries: all of them.
        small: the numbers of those that are small components.
    """

    left: frozenset[int] = frozenset()
    entries: list[Snapped] = field(default_factory=list)
    small: list[int] = field(default_factory=list)

    def takes(self, where: str, given: float, used: str, difference: float) -> bool:
        """Note a number; whether it is to be replaced."""
        self.entries.append(Snapped(where, given, used, difference))
        return len(self.entries) - 1 not in self.left

    def clears(self, where: str, given: Fraction) -> bool:
        """Note a small component; whether it is to be replaced by 0."""
        self.small.append(len(self.entries))
        return self.takes(where, float(given), "0", -float(given))


def _snapped(chain: Chain, policy: SnapPolicy, record: _Record) -> Chain:
    reach = policy.length * (1000 if chain.unit == "mm" else 1)
    joints = [_joint(joint, policy, reach, record) for joint in chain.joints]
    tool = _motions(chain.tool, policy, reach, record)
    return replace(chain, joints=tuple(joints), tool=tool)


def _joint(joint: Joint, policy: SnapPolicy, reach: Fraction, record: _Record) -> Joint:
    before = _motions(joint.before, policy, reach, record)
    axis = joint.axis
    small = [
        k
        for k in _small(scaled_axis(axis), policy.axis)
        if record.clears(f"{joint.name} axis[{k}]", axis[k])
    ]
    if small:
        kept = [Fraction(0) if k in small else x for k, x in enumerate(axis)]
        direction: Vector = (kept[0], kept[1], kept[2])
        axis = unit_axis(direction) or direction
    return replace(joint, before=before, axis=axis)


def _motions(
    motions: tuple[Motion, ...],
    policy: SnapPolicy,
    reach: Fraction,
    record: _Record,
) -> tuple[Motion, ...]:
    """The motions with their numbers replaced; those that became 0 are left out."""
    result: list[Motion] = []
    for motion in motions:
        if isinstance(motion, Translation):
            vector = _vector(motion, reach, record)
            if any(vector):
                result.append(replace(motion, vector=vector))
        else:
            angle = _angle(motion, policy, record)
            if not angle.is_zero:
                result.append(replace(motion, angle=angle))
    return tuple(result)


def _vector(motion: Translation, reach: Fraction, record: _Record) -> Vector:
    xyz = motion.source.endswith("xyz")
    small = [
        k
        for k in _small(motion.vector, reach)
        if record.clears(motion.source + (f"[{k}]" if xyz else ""), motion.vector[k])
    ]
    x, y, z = (Fraction(0) if k in small else v for k, v in enumerate(motion.vector))
    return x, y, z


def _angle(motion: Rotation, policy: SnapPolicy, record: _Record) -> Angle:
    """The angle meant by a number in rad; one written with pi or deg is kept."""
    given = motion.angle
    if given.half_turns or not given.radians:
        return given
    used = _meant(given.radians, policy)
    if used is None:
        return given
    difference = float(used.half_turns * _PI - given.radians)
    text = format_angle(used)
    taken = record.takes(motion.source, angle_value(given), text, difference)
    return used if taken else given


def _meant(radians: Fraction, policy: SnapPolicy) -> Angle | None:
    """The multiple of pi that ``radians`` stands for, if any."""
    right = Fraction(round(2 * radians / _PI), 2)
    if policy.printed and _is_printed(radians, right * _PI):
        return Angle(right)
    for parts in (6, 4):
        multiple = Fraction(round(parts * radians / _PI), parts)
        if abs(radians - multiple * _PI) <= policy.angle:
            return Angle(multiple)
    return None


def _is_printed(value: Fraction, exact: Fraction) -> bool:
    """Whether ``value`` is ``exact``, not 0, rounded or cut at its own last decimal."""
    places = decimal_places(value.denominator)
    if places is None or places < 2 or exact == 0:
        return False
    shift = 10**places
    cut = int(abs(exact) * shift)
    sign = 1 if exact > 0 else -1
    return sign * value * shift in (cut, round(abs(exact) * shift))


def _small(vector: Vector, bound: Fraction) -> list[int]:
    """The components that are not 0 and at most ``bound``."""
    return [k for k, value in enumerate(vector) if 0 < abs(value) <= bound]
