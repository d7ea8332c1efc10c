"""Joints that are driven by another one, and the arm without them that is the same.

A driven joint has the value multiplier * (its driver) + offset. Two kinds change the
joints and not the question:

Its driver is not on the chain. Then the joint moves freely (its multiplier is not 0),
and so does every other joint of the chain.

It turns about the line of a neighbouring joint that moves freely (a parallelogram whose
forearm keeps its angle to the ground; a belt through a wrist), and so do the two
together, by u = (value of the neighbour) +- (value of the driven joint). With u in the
neighbour's place the values of all links are free: the change of joints is linear and
triangular, so invertible. Postures as the links stand, their poses, det J up to a
factor that is not 0, and nonsingular paths are those of the chain without the driven
joint. Limits of the neighbour hold for u minus the driver's share, and no box of joint
values is theirs; where it has none limits are carried (`coupled_limits`).

Before that, what a parallelogram holds level is brought onto that line. Let the axes
from the driver to the driven joint be parallel and their turns add up to nothing. Then
what follows moves without turning against what stands before the driver, and a fixed
step that follows may as well be taken before it: T(v) T(b) = T(b) T(v). So a plate
between two arms adds its step at the shoulder, and a hand that is held level adds its
tool there; the tip is then on the axis of its joint, which a position does not feel.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from cuspaudit.errors import UnsupportedJointError
from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.coupled_limits import Limits, carried, carried_limits, shared
from cuspaudit.robot.place import Place, quoted

__all__ = ["Coupling", "uncoupled"]


@dataclass(frozen=True, slots=True)
class Coupling:
    """A joint that is driven by another.

    Attributes:
        driver: the name of the other.
        multiplier: of its value.
        offset: that is added, in rad or the unit of length.
        place: where the file says so.
        limits: of the driver, for one that is off the chain; None for none.
    """

    driver: str
    multiplier: Fraction
    offset: Fraction
    place: Place
    limits: Limits = None


def uncoupled(
    chain: Chain, couplings: Mapping[str, Coupling]
) -> tuple[Chain, list[str]]:
    """The chain without joints that are driven, and a note for each.

    Args:
        chain: all joints, the driven ones as if they moved freely.
        couplings: those of the driven joints, by name; others are ignored.

    Raises:
        UnsupportedJointError: a driven joint is of neither kind above.
    """
    names = [joint.name for joint in chain.joints]
    driven = {name: couplings[name] for name in names if name in couplings}
    notes: list[str] = []
    for name, coupling in driven.items():
        if coupling.driver in names or coupling.multiplier == 0:
            continue
        shared = [n for n, c in driven.items() if c.driver == coupling.driver]
        if len(shared) > 1:
            other = next(n for n in shared if n != name)
            raise _refused(name, coupling, f"so does {quoted(other)}")
        chain = _driven_from_outside(chain, name, coupling)
        notes.append(f"{name} mimics {coupling.driver}, off the chain: it moves freely")
    held = {n: c for n, c in driven.items() if c.driver in names or c.multiplier == 0}
    if not held:
        return chain, notes
    free = len(names) - len(held)
    for name in reversed(list(held)):
        if _partner(chain, name, held) is None:
            chain = _levelled(chain, name, held) or chain
    last = names[-1]
    partners: dict[str, str] = {}
    for name, coupling in held.items():
        if name == last and free == 3 and not _steps(chain.tool):
            continue
        partner = _partner(chain, name, held)
        if coupling.driver in held or coupling.multiplier == 0 or partner is None:
            raise _refused(name, coupling, "no joint that moves freely shares its axis")
        partners[name] = partner
    chained = [n for n in partners if held[n].driver in partners.values()]
    if chained or len(set(partners.values())) < len(partners):
        name = (chained or list(held))[0]
        raise _refused(name, held[name], "its driver is coupled as well")
    shares = {
        n: (c.driver, c.multiplier, c.offset)
        for n, c in held.items()
        if c.multiplier and c.driver in names
    }
    ranges, remark = carried_limits(chain.joints, shares, partners)
    for name, coupling in held.items():
        chain = _without(chain, name, coupling)
        if name not in partners:
            notes.append(f"{name} mimics {coupling.driver} and turns no arm: left out")
            continue
        sum_of = f"{partners[name]} and {coupling.driver}"
        notes.append(
            f"{name} mimics {coupling.driver} about the axis of {partners[name]}: both "
            f"turn by one free sum of {sum_of}, which stands for {partners[name]}"
        )
    limited = [replace(joint, limits=ranges[joint.name]) for joint in chain.joints]
    return chain.with_joints(limited), [*notes, remark]


def _driven_from_outside(chain: Chain, name: str, coupling: Coupling) -> Chain:
    """The chain with a joint's range the part of it that its driver's range gives.

    Raises:
        UnsupportedJointError: that is nothing.
    """
    joints = list(chain.joints)
    at = [joint.name for joint in joints].index(name)
    turns = joints[at].kind == "revolute"
    if coupling.limits is None or isinstance(coupling.limits[0], Angle) != turns:
        return chain
    given = carried(coupling.limits, coupling.multiplier, coupling.offset)
    try:
        own = shared(joints[at].limits, given)
    except ValueError:
        raise _refused(name, coupling, "their limits leave it no range") from None
    joints[at] = replace(joints[at], limits=own)
    return chain.with_joints(joints)


def _partner(chain: Chain, name: str, held: Mapping[str, Coupling]) -> str | None:
    """The neighbour that moves freely about the same line, not the driver."""
    joints = chain.joints
    at = [joint.name for joint in joints].index(name)
    for first, second, other in ((at, at + 1, at + 1), (at - 1, at, at - 1)):
        if first < 0 or second >= len(joints):
            continue
        found = joints[other].name
        usable = found not in held and found != held[name].driver
        if usable and _one_line(joints[first], joints[second]):
            return found
    return None


def _levelled(chain: Chain, name: str, held: Mapping[str, Coupling]) -> Chain | None:
    """The chain with the fixed step after a levelled joint taken before its driver.

    None where the joint is not held level: the turns from its driver on do not add up
    to nothing about parallel axes.
    """
    joints = list(chain.joints)
    index = {joint.name: k for k, joint in enumerate(joints)}
    first, last = index[held[name].driver], index[name]
    run = joints[first : last + 1]
    if first > last or not _adds_up_to_nothing(run, held):
        return None
    fixed = [motion for joint in run[1:] for motion in joint.before]
    fixed += [_offset(joint, held[joint.name]) for joint in run if joint.name in held]
    turned = [m for m in fixed if isinstance(m, Rotation) and not m.angle.is_zero]
    after = joints[last + 1].before if last + 1 < len(joints) else chain.tool
    turns = [*turned, *(m for m in after if isinstance(m, Rotation))]
    back = [Rotation(m.axis, -m.angle) for m in reversed(turns)]
    step = (*turned, *after, *back) if _steps(after) else ()
    joints[first] = replace(joints[first], before=(*joints[first].before, *step))
    rest = tuple(motion for motion in after if isinstance(motion, Rotation))
    if last + 1 == len(joints):
        return replace(chain, joints=tuple(joints), tool=rest)
    joints[last + 1] = replace(joints[last + 1], before=rest)
    return chain.with_joints(joints)


def _adds_up_to_nothing(run: list[Joint], held: Mapping[str, Coupling]) -> bool:
    """Whether joints turn about parallel axes, by angles whose sum is constant."""
    total: dict[str, Fraction] = {}
    axis = run[0].axis
    for k, joint in enumerate(run):
        turns = [m for m in joint.before if isinstance(m, Rotation)] if k else []
        if joint.kind != "revolute" or not _along(joint.axis, axis):
            return False
        if not all(_along(motion.axis, axis) for motion in turns):
            return False
        same = sum(a * b for a, b in zip(joint.axis, axis, strict=True)) > 0
        coupling = held.get(joint.name)
        name = coupling.driver if coupling else joint.name
        share = coupling.multiplier if coupling else Fraction(1)
        total[name] = total.get(name, Fraction(0)) + (share if same else -share)
    return not any(total.values())


def _steps(motions: tuple[Motion, ...]) -> bool:
    return any(isinstance(motion, Translation) for motion in motions)


def _offset(joint: Joint, coupling: Coupling) -> Rotation:
    angle = Angle(radians=coupling.offset)
    return Rotation(joint.axis, angle, f"{joint.name} offset")


def _one_line(first: Joint, second: Joint) -> bool:
    """Whether two neighbours that turn do so about one line, by exact numbers."""
    turning = first.kind == second.kind == "revolute"
    return (
        turning
        and _along(second.axis, first.axis)
        and all(
            _along(m.vector if isinstance(m, Translation) else m.axis, first.axis)
            for m in second.before
        )
    )


def _along(a: Vector, b: Vector) -> bool:
    cross = (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
    return not any(cross)


def _without(chain: Chain, name: str, coupling: Coupling) -> Chain:
    """The chain with a driven joint fixed at its offset."""
    joints: list[Joint] = []
    pending: tuple[Motion, ...] = ()
    for joint in chain.joints:
        if joint.name != name:
            joints.append(replace(joint, before=pending + joint.before))
            pending = ()
            continue
        pending = pending + joint.before
        if coupling.offset:
            pending += (_offset(joint, coupling),)
    return replace(chain, joints=tuple(joints), tool=pending + chain.tool)


def _refused(name: str, coupling: Coupling, why: str) -> UnsupportedJointError:
    here = coupling.place
    return UnsupportedJointError(
        file=here.file,
        where=here.where,
        found=f"it mimics joint {quoted(coupling.driver)}, and {why}",
        expected="the joints of a chain must move independently",
    )
