"""May one posture reach another without a singularity?

No where det J has opposite signs at the two, or where the exact aspects differ, within
limits too, since a path within limits is a path; of three joints also where the exact
aspects of their limits differ. Yes where a path is proved by `certificate.cover`, or
where the exact aspects, without limits or those of the limits, are equal. Else open.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from flint import arb, ctx
from numpy.typing import NDArray

from cuspaudit.auditing.search.aspect_routing import route_aspects
from cuspaudit.auditing.search.mixed_joints import way_over_net
from cuspaudit.auditing.witness import certificate_of
from cuspaudit.certificate.cover import Cover, Refusal
from cuspaudit.errors import AssumptionError, UnableError
from cuspaudit.runtime.clock import check_time, time_is_up, time_limit
from cuspaudit.toolpath.aspect_labels import aspect_labels
from cuspaudit.toolpath.ball_arm import BITS
from cuspaudit.toolpath.box_labels import BoxLabels, box_labels
from cuspaudit.toolpath.joint_pose import JointValue, float_values, value_balls
from cuspaudit.toolpath.limits import joint_ranges
from cuspaudit.toolpath.traced_arm import TracedArm

__all__ = ["FoundConnection", "connection_record", "same_aspect", "sign_near"]

Array = NDArray[np.float64]

SCHEMA = "cuspaudit/same/1"
_DEEPEST = 14
_ROUNDED = 1e-12


@dataclass(frozen=True, eq=False)
class FoundConnection:
    """Whether two joint vectors lie in one aspect.

    Attributes:
        answer: "same", "different" or "open".
        why: one sentence.
        path: (m, n) joint values of a proved path, or None; without limits it may end
            whole turns of a joint beside the second vector.
        signs: of det J at the two, None where a posture is singular or too near.
        within_limits: whether the limits counted.
    """

    answer: Literal["same", "different", "open"]
    why: str
    path: Array | None
    signs: tuple[int | None, int | None]
    within_limits: bool


def same_aspect(
    arm: TracedArm,
    first: Sequence[JointValue],
    second: Sequence[JointValue],
    within_limits: bool = False,
    seed: int = 0,
    progress: Callable[[str], None] = lambda step: None,
    timeout: float | None = None,
) -> FoundConnection:
    """Whether the arm can go from one joint vector to another without a singularity.

    Args:
        arm: an arm with a square task.
        first: joint values of the robot, exact.
        second: likewise.
        within_limits: whether the path must keep within the limits of the joints.
        seed: of the search for a path.
        progress: called with the name of each step.
        timeout: seconds after which no further step is begun.
    """
    with ctx.workprec(BITS), time_limit(timeout):
        ends = [_completed(arm, value_balls(values)) for values in (first, second)]
        signs = (sign_near(arm, ends[0]), sign_near(arm, ends[1]))

        def result(answer: Any, why: str, path: Array | None = None) -> FoundConnection:
            return FoundConnection(answer, why, path, signs, within_limits)

        for number, sign in zip(("first", "second"), signs, strict=True):
            if sign is None:
                why = f"the {number} posture is singular, or too near to tell"
                return result("open", why)
        if signs[0] != signs[1]:
            return result("different", "det J has opposite signs at the two")
        if within_limits:
            outside = _outside(arm, ends)
            if outside:
                return result("different", outside)
        progress("aspects")
        labels = aspect_labels(arm)
        names = [None if labels is None else labels.label(end) for end in ends]
        told = None not in names
        if told and names[0] != names[1]:
            return result("different", "they lie in two of the exactly known aspects")
        box = box_labels(arm) if within_limits else None
        if box is not None and _apart(box, first, second):
            why = "they lie in two of the exactly known aspects within the limits"
            return result("different", why)
        progress("paths")
        floats = [np.array(float_values(values)) for values in (first, second)]
        for path in _proposals(arm, floats[0], floats[1], within_limits, seed):
            if _is_proved(arm, path, signs[0] or 0):
                return result("same", "det J keeps its sign along a proved path", path)
        if told and not within_limits:
            return result("same", "they lie in one of the exactly known aspects")
        if box is not None and _together(box, first, second):
            why = "they lie in one of the exactly known aspects within the limits"
            return result("same", why)
        tried = "the straight way and the widest way over saddles of |det J|"
        if not all(arm.turning):
            tried = "the straight way and ways over postures far from singular ones"
        why = f"neither a path nor a proof was found: {tried} were tried"
        if time_is_up():
            why = f"neither a path nor a proof was found within {timeout:g} s"
        return result("open", why)


def _apart(
    box: BoxLabels, first: Sequence[JointValue], second: Sequence[JointValue]
) -> bool:
    """Whether two joint vectors have two labels in the larger box."""
    names = {box.label(values, inside=False) for values in (first, second)}
    return None not in names and len(names) == 2


def _together(
    box: BoxLabels, first: Sequence[JointValue], second: Sequence[JointValue]
) -> bool:
    """Whether two joint vectors have one label in the smaller box."""
    names = {box.label(values, inside=True) for values in (first, second)}
    return None not in names and len(names) == 1


def connection_record(found: FoundConnection, name: str, file: str) -> dict[str, Any]:
    """The answer as a JSON record, schema ``cuspaudit/same/1``."""
    return {
        "schema": SCHEMA,
        "robot": {"name": name, "file": file},
        "answer": found.answer,
        "why": found.why,
        "signs": list(found.signs),
        "within_limits": found.within_limits,
        "path": None if found.path is None else found.path.tolist(),
    }


def _completed(arm: TracedArm, balls: list[arb]) -> list[arb]:
    """With the virtual joint of a tool axis at 0."""
    return balls + [arb(0)] * (len(arm.chain.joints) - len(balls))


def sign_near(arm: TracedArm, values: Sequence[arb]) -> int | None:
    """The sign of det J near the values, the doubles next to them included."""
    value = _determinant(arm, [v + arb(0, _ROUNDED) * (1 + abs(v)) for v in values])
    return 1 if value > 0 else -1 if value < 0 else None


def _determinant(arm: TracedArm, values: Sequence[arb]) -> arb:
    """Det J on a box of joint values; no pose plays a part in it."""
    scaled = [v / arb(s) for v, s in zip(values, arm.balls.scales, strict=True)]
    return arm.determinant(scaled)


def _outside(arm: TracedArm, ends: Sequence[Sequence[arb]]) -> str:
    """Which joint is outside its limits in an end, or ""."""
    ranges = joint_ranges(arm.chain.joints, arm.scales)
    for number, values in zip(("first", "second"), ends, strict=True):
        for joint, interval, value, scale in zip(
            arm.chain.joints, ranges, values, arm.balls.scales, strict=True
        ):
            if interval is not None and not interval.has(value / arb(scale)):
                return f"{joint.name} of the {number} posture is not inside its limits"
    return ""


def _proposals(
    arm: TracedArm, first: Array, second: Array, within: bool, seed: int
) -> Iterator[Array]:
    """Paths of all joints of the robot to be proved, the likely ones first."""
    turning = arm.turning[: arm.joints]
    if time_is_up():
        return
    gap = second - first
    yield np.vstack([first, second])
    if not within:
        short = np.where(turning, np.remainder(gap + np.pi, 2 * np.pi) - np.pi, gap)
        yield np.vstack([first, first + short])
    if not all(turning) and len(arm.chain.joints) == 6 and arm.task == "pose":
        over = way_over_net(arm.chain, first, second, seed)
        if over is not None:
            yield from _ended(arm, over, second, within)
        return
    try:
        check_time("paths")
        routing = route_aspects(arm.model, seed)
    except (AssumptionError, UnableError):
        return
    extra = np.zeros(len(arm.chain.joints) - arm.joints)
    found = routing.widest_path(np.append(first, extra), np.append(second, extra))
    if found is None:
        return
    path = np.asarray(found.points)[:, : arm.joints]
    yield from _ended(arm, np.vstack([first, path[1:]]), second, within)


def _ended(arm: TracedArm, path: Array, second: Array, within: bool) -> Iterator[Array]:
    """The path with its end the second posture, where it keeps within limits."""
    turning = arm.turning[: arm.joints]
    path = np.vstack([path[:-1], _near(path[-1], second, turning)])
    if not within or _stays(arm, path, second):
        yield path


def _near(end: Array, second: Array, turning: NDArray[np.bool_]) -> Array:
    """The second posture in the winding in which a path reaches it."""
    turns = np.where(turning, np.round((end - second) / (2 * np.pi)), 0.0)
    return np.asarray(second + 2 * np.pi * turns)


def _stays(arm: TracedArm, path: Array, second: Array) -> bool:
    """Whether all points of a path lie within the limits, and it ends in ``second``."""
    ranges = joint_ranges(arm.robot_chain.joints, arm.scales[: arm.joints])
    for k, interval in enumerate(ranges):
        if interval is None:
            continue
        values = [arb(float(x)) / arb(arm.balls.scales[k]) for x in path[:, k]]
        if not all(interval.has(value) for value in values):
            return False
        if abs(path[-1, k] - second[k]) > 1e-9:
            return False
    return True


def _is_proved(arm: TracedArm, path: Array, sign: int) -> bool:
    """Whether det J keeps its sign along the path, and at the exact ends' roundings."""
    if arm.joints == 4:
        return all(_keeps(arm, a, b, sign, _DEEPEST) for a, b in pairwise(path))
    extra = np.zeros((len(path), len(arm.chain.joints) - arm.joints))
    whole = np.hstack([path, extra])
    try:
        Cover(certificate_of(arm.chain, sign, whole)).cover()
    except Refusal:
        return False
    return True


def _hull(x: float, y: float) -> arb:
    """A ball of all values between two doubles, and of what rounds to them."""
    rounded = _ROUNDED * (1 + abs(x) + abs(y))
    return arb((x + y) / 2, abs(y - x) / 2 + rounded)


def _keeps(arm: TracedArm, a: Array, b: Array, sign: int, depth: int) -> bool:
    """Whether det J has the sign on the segment from a to b, by halving boxes."""
    box = [_hull(float(x), float(y)) for x, y in zip(a, b, strict=True)]
    value = _determinant(arm, box) * sign
    if value > 0:
        return True
    if value < 0 or depth == 0:
        return False
    middle = (a + b) / 2
    return _keeps(arm, a, middle, sign, depth - 1) and _keeps(
        arm, middle, b, sign, depth - 1
    )
