"""Three joints within their limits, exactly: a verdict and the aspects of the box."""

from __future__ import annotations

from dataclasses import dataclass, replace

from cuspaudit.auditing.limits.joint_limits import ranges_of, width_of
from cuspaudit.count import Count
from cuspaudit.cuspidality.box_decision import BoxDecision, decide_box
from cuspaudit.cuspidality.box_values import ValuesDecision, decide_box_by_values
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.kinematics.tip_circles import tip_circles
from cuspaudit.runtime.clock import Clock
from cuspaudit.surface.box_aspects import box_aspects, charted_box, of_factors
from cuspaudit.surface.box_edges import Range, is_over_half_turn
from cuspaudit.surface.box_stability import count_between
from cuspaudit.surface.first_joint import FirstJoint

__all__ = ["ThreeInBox", "aspects_in_box", "decide_three"]


@dataclass(frozen=True)
class ThreeInBox:
    """What the exact routes say of three joints within their limits.

    Attributes:
        verdict: one of three.
        why: one sentence.
        aspects: components of {det J != 0} within the limits.
        decision: with the couples, where it is CUSPIDAL.
    """

    verdict: Verdict
    why: str
    aspects: Count
    decision: BoxDecision | ValuesDecision


def decide_three(model: ExactModel, clock: Clock) -> ThreeInBox:
    """Decide a position task of three joints within the limits of its chain.

    By pairs of postures; by sample values where joint 2 slides.

    Raises:
        UnableError: the arm is outside what both routes handle.
        RetryableError: numbers were not told apart.
    """
    if model.joints[1].kind == "revolute":
        found = _by_pairs(model, clock)
    else:
        found = _by_values(model, clock)
    if model.is_exact:
        return found
    why = f"{found.why}; for a model whose angles and axes are rational, within 1e-12"
    return replace(found, why=why, aspects=Count(found.aspects.count, False))


def _by_pairs(model: ExactModel, clock: Clock) -> ThreeInBox:
    first, second, third = ranges_of(model)
    joint = _first_joint(model, first)
    box = decide_box(*reduced_map(model), (second, third), joint, clock.step)
    why = (
        f"of {box.pairs} pairs of postures of one pose, one in every cell between the "
        f"walls of the limits, {len(box.couples) or 'none'} lie in one aspect of the "
        "box"
    )
    return ThreeInBox(box.verdict, why, box.aspects, box)


def _by_values(model: ExactModel, clock: Clock) -> ThreeInBox:
    first, second, third = ranges_of(model)
    found = decide_box_by_values(*reduced_map(model), (second, third), clock.step)
    why = (
        f"of {found.samples} sample values, one in every cell between critical values "
        f"and images of the limits, {len(found.couples) or 'none'} have two postures "
        "in one aspect of the box"
    )
    verdict = found.verdict
    free = first is None or (
        model.joints[0].kind == "revolute" and is_over_half_turn(width_of(first))
    )
    if verdict is Verdict.CUSPIDAL and not free:
        verdict = Verdict.UNDECIDED
        why += "; whether joint 1 can follow within its limits was not decided"
    return ThreeInBox(verdict, why, found.aspects, found)


def _first_joint(model: ExactModel, limits: Range | None) -> FirstJoint | None:
    if limits is None:
        return None
    circles = tip_circles(model)
    return FirstJoint(
        kind="circle" if model.joints[0].kind == "revolute" else "line",
        axis=circles.axis,
        second=circles.second,
        origin=circles.origin,
        height=circles.height,
        square=circles.square,
        across=circles.across,
        width=width_of(limits),
    )


def aspects_in_box(model: ExactModel) -> Count | None:
    """The aspects of three joints in their box; None for other arms, or out of reach.

    Joint 1 moves no det J, and the box is a product: its range does not matter. Proved
    for the arm only where the model is the arm exactly.
    """
    if model.chain.task != "position":
        return None
    try:
        _, second, third = ranges_of(model)
        surface, delta = oriented(*reduced_map(model))
        ranges = of_factors(surface, (second, third))
        surface, outer, inner = charted_box(surface, delta, ranges)
        wide = box_aspects(surface, delta, outer)
        narrow = None if inner is None else box_aspects(surface, delta, inner)
        count = count_between(wide, narrow, ranges)
    except (UnableError, RetryableError):
        return None
    return Count(count.count, count.proved and model.is_exact)
