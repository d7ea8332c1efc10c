"""The snapped chain: what the designer meant by the numbers a file prints.

A file writes pi/2 as 1.5708, 1.57 or 1.570796326589793, and a parallel axis with 3.7e-6
left over from a CAD system. As printed, such axes neither meet nor stand parallel;
snapped they do. Relations live in the geometry and not in the digits of single numbers,
so they are looked for twice.

*Number by number*: an angle is what it is read as wherever it stands, since only then a
model is exact; a small component of a length or an axis goes where a relation of the
axes comes of it. The chain keeps its frames.

*By the invariants* (`invariants`): where the file's link frames are arbitrary, or turns
that are no multiples of 30 or 45 degrees cancel, the relations are seen in no single
number. Then the chain is written anew by its invariants (`canonical`), each of which is
the structural value or the simplest number of its interval. A chain whose model is
exact and has every such relation stays itself, and so does a plain table whose angles
are typed: it has one turn between two axes, and nothing to lose.

Every number that is replaced is listed with its replacement and with the relations that
hold because of it, and the literal chain stays what it is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from cuspaudit.robot.axes import scaled_axis, unit_axis
from cuspaudit.robot.canonical_arm.canonical import Canonical, Taken, canonical
from cuspaudit.robot.canonical_arm.invariants import invariants
from cuspaudit.robot.canonical_arm.readings import Reader
from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.fixed_motions import geometry, has_exact_cosine, is_algebraic
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.numbers import format_angle
from cuspaudit.robot.printed_angles import PI, is_printed, printed_multiple
from cuspaudit.robot.relations import relations
from cuspaudit.robot.snap_policy import DEFAULT_POLICY, NO_SNAPPING, SnapPolicy

__all__ = ["Snapped", "faithful", "snap"]

_LONG = 15
_ROUNDING = 1e-9
_NO_ROUNDING = 1e-13
_EXACT = 1e-30
_NOISE = 1e-15


@dataclass(frozen=True, slots=True)
class Snapped:
    """One number that was replaced.

    Attributes:
        where: its place in the file, such as "joint_2 rpy[0]" or "joint_2 alpha", or
            the invariant that it is, such as "axes 4 and 5, common normal".
        given: what stands there, in rad or the chain's unit.
        used: the exact text of what is used instead.
        difference: used minus given.
        effect: the relations of the axes (`relations`) that hold only because of it;
            "" when none do.
        error: how far an invariant may be off by the rounding of the file's numbers;
            None for a number of the file.
    """

    where: str
    given: float
    used: str
    difference: float
    effect: str = ""
    error: float | None = None


def snap(
    chain: Chain, policy: SnapPolicy = DEFAULT_POLICY
) -> tuple[Chain, tuple[Snapped, ...]]:
    """The snapped chain and the list of what was snapped, base to tip.

    Limits are left alone. With nothing to snap the chain itself comes back, or the
    same arm in numbers that keep its relations (`faithful`).
    """
    by_numbers, entries = _by_numbers(chain, policy)
    if not is_algebraic(by_numbers):
        by_invariants = _by_invariants(chain, policy)
        gains = is_algebraic(by_invariants.chain)
        if _is_plain(by_numbers, gains) and _has_all(by_numbers, by_invariants.chain):
            return by_numbers, entries
        angles = _angles_read(chain) if policy.printed else []
        return by_invariants.chain, (*angles, *_listed(by_invariants.taken))
    by_invariants = _by_invariants(by_numbers, policy)
    if _has_all(by_numbers, by_invariants.chain):
        return by_numbers, entries
    return by_invariants.chain, (*entries, *_listed(by_invariants.taken))


def faithful(chain: Chain) -> Chain:
    """The same arm in numbers whose exact model keeps every relation of its axes.

    That is the chain itself, unless turns that have no exact cosine follow each other,
    or an axis has no rational unit vector: then it is written by its invariants, and
    nothing is snapped.
    """
    return snap(chain, NO_SNAPPING)[0]


def _by_invariants(chain: Chain, policy: SnapPolicy) -> Canonical:
    found = invariants(chain, policy)
    printed = found.printed
    is_rounded = policy.length > 0 and (printed.is_generic or printed.digits >= _LONG)
    slack = _ROUNDING if is_rounded else _NO_ROUNDING
    reader = Reader(found.floor, slack, policy.printed, is_rounded)
    return canonical(found, reader)


def _has_all(chain: Chain, other: Chain) -> bool:
    """Whether ``chain`` has every relation of the axes of ``other``."""
    wanted = {word for word in relations(other) if "the base" not in word}
    return wanted <= relations(chain)


def _is_plain(chain: Chain, prints: bool) -> bool:
    """Whether one inexact turn at most, about a rational axis, stands between two axes.

    Such a chain has nothing to lose where the turn is moved to a rational cosine.

    Args:
        chain: the chain.
        prints: whether a turn that a program printed counts as too much: it has an
            error, and a number within that has an exact cosine.
    """
    if chain.near or any(unit_axis(joint.axis) is None for joint in chain.joints):
        return False
    for part in geometry(chain):
        turns = [motion for motion in part if isinstance(motion, Rotation)]
        if any(unit_axis(turn.axis) is None for turn in turns):
            return False
        inexact = [turn for turn in turns if not has_exact_cosine(turn.angle)]
        if len(inexact) > 1 or (prints and any(turn.decimals for turn in inexact)):
            return False
    return True


def _angles_read(chain: Chain) -> list[Snapped]:
    """The printed angles that the invariants take for multiples of pi."""
    entries = []
    for motion in (m for part in geometry(chain) for m in part):
        if isinstance(motion, Rotation) and not motion.angle.half_turns:
            multiple = printed_multiple(motion.angle.radians)
            if multiple:
                given = motion.angle.radians
                difference = float(multiple * PI - given)
                text = format_angle(Angle(multiple))
                entries.append(Snapped(motion.source, float(given), text, difference))
    return entries


def _listed(taken: Sequence[Taken]) -> list[Snapped]:
    """The invariants that were changed, as entries of the list."""
    return [
        Snapped(
            entry.where,
            entry.reading.given,
            entry.reading.text,
            entry.reading.difference,
            entry.relation,
            entry.reading.error,
        )
        for entry in taken
        if not entry.reading.is_near
        and abs(entry.reading.difference) > (_EXACT if entry.relation else _NOISE)
    ]


def _by_numbers(chain: Chain, policy: SnapPolicy) -> tuple[Chain, tuple[Snapped, ...]]:
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
    return replace(joint, before=before, axis=axis, printed_axis=None)


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
    difference = float(used.half_turns * PI - given.radians)
    text = format_angle(used)
    taken = record.takes(motion.source, angle_value(given), text, difference)
    return used if taken else given


def _meant(radians: Fraction, policy: SnapPolicy) -> Angle | None:
    """The multiple of pi that ``radians`` stands for, if any."""
    right = Fraction(round(2 * radians / PI), 2)
    if policy.printed and is_printed(radians, right * PI):
        return Angle(right)
    for parts in (6, 4):
        multiple = Fraction(round(parts * radians / PI), parts)
        if abs(radians - multiple * PI) <= policy.angle:
            return Angle(multiple)
    return None


def _small(vector: Vector, bound: Fraction) -> list[int]:
    """The components that are not 0 and at most ``bound``."""
    return [k for k, value in enumerate(vector) if 0 < abs(value) <= bound]
