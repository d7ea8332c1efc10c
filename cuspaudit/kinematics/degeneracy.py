"""Why det J vanishes in every posture: the cause, tested exactly, in the arm's words.

The screws of the joints are then dependent in every posture. The causes known here are
all of one kind: some joints move in a group of motions that has fewer dimensions than
they are. One line, one translation, a plane, a point, a sphere about the tip. Each test
is an identity of polynomials in the joints between, on the circles of their angles.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cuspaudit.kinematics.distant_axes import (
    always_coincide,
    always_orthogonal,
    always_parallel,
    dependent,
)
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.neighbors import concurrent
from cuspaudit.kinematics.transform import cross

__all__ = ["cause_of_degeneracy"]

_NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven")


def cause_of_degeneracy(model: ExactModel) -> str | None:
    """The first cause that holds exactly, one clause; None when none known does.

    Args:
        model: whose det J is identically 0, a virtual joint included.
    """
    return next(_causes(model), None)


def _causes(model: ExactModel) -> Iterator[str]:
    joints = model.joints
    count = len(joints)
    turning = [k for k in range(count) if joints[k].kind == "revolute"]
    sliding = [k for k in range(count) if joints[k].kind == "prismatic"]
    real = count - model.chain.joints[-1].is_virtual
    if len(turning) == count and all(
        always_parallel(model, 1, k) for k in range(2, real + 1)
    ):
        yield f"all {_NUMBERS[real]} axes are parallel"
    yield from _same_lines(model, turning)
    yield from _few_translations(model, sliding)
    if len(turning) == 3 and model.chain.task == "pose":
        yield from _few_turns(model, turning)
    if model.chain.task == "position":
        yield from _about_the_tip(model, turning)
    for first in range(count - 3):
        run = range(first, first + 4)
        if all(k in turning for k in run) and _meet(model, first):
            yield f"{_axes(run)} meet in one point"
    yield from _planes(model, turning)


def _same_lines(model: ExactModel, turning: Sequence[int]) -> Iterator[str]:
    """Two joints that turn about one line in every posture."""
    for at, i in enumerate(turning):
        for j in turning[at + 1 :]:
            if always_coincide(model, i + 1, j + 1):
                if model.chain.joints[j].is_virtual:
                    yield f"{model.joints[i].name} turns about the tool axis itself"
                else:
                    yield f"axes {i + 1} and {j + 1} coincide"


def _few_translations(model: ExactModel, sliding: Sequence[int]) -> Iterator[str]:
    """Slides whose directions are dependent in every posture."""
    for at, i in enumerate(sliding):
        for j in sliding[at + 1 :]:
            if always_parallel(model, i + 1, j + 1):
                yield f"slides {i + 1} and {j + 1} are parallel"
    if len(sliding) > 3:
        yield f"{_NUMBERS[len(sliding)]} joints slide, and space has three directions"
    if len(sliding) == 3:
        i, j, k = (index + 1 for index in sliding)
        if dependent(model, i, j, k):
            yield f"slides {i}, {j}, {k} stay in the directions of one plane"


def _few_turns(model: ExactModel, turning: Sequence[int]) -> Iterator[str]:
    """Three joints that turn the tip, about directions that stay dependent."""
    for at, i in enumerate(turning):
        for j in turning[at + 1 :]:
            if always_parallel(model, i + 1, j + 1):
                yield f"axes {i + 1} and {j + 1} are parallel, and three joints turn"


def _about_the_tip(model: ExactModel, turning: Sequence[int]) -> Iterator[str]:
    """A tip on an axis, or at one distance from a point."""
    count = len(model.joints)
    if count - 1 in turning:
        last = model.joints[-1]
        off = cross(model.ring, model.tool.translation, last.axis)
        if all(entry == 0 for entry in off):
            yield f"the tip lies on axis {count}"
    if count == 3 and len(turning) == 3 and concurrent(model, 1):
        yield "axes 1, 2, 3 meet in one point, about which the tip stays on a sphere"


def _planes(model: ExactModel, turning: Sequence[int]) -> Iterator[str]:
    """More joints that move in one plane than motions in it are free."""
    count = len(model.joints)
    free = 2 if model.chain.task == "position" else 3
    for length in range(count, free, -1):
        for first in range(count - length + 1):
            run = range(first, first + length)
            axes = [k for k in run if k in turning]
            if axes and all(_keeps_plane(model, axes[0], k, k in axes) for k in run):
                names = ", ".join(str(k + 1) for k in run)
                yield f"joints {names} all move in one plane"


def _keeps_plane(model: ExactModel, axis: int, joint: int, turns: bool) -> bool:
    """Whether a joint turns about the axis's direction, or slides across it."""
    test = always_parallel if turns else always_orthogonal
    return axis == joint or test(model, axis + 1, joint + 1)


def _meet(model: ExactModel, first: int) -> bool:
    """Whether four axes from index ``first`` meet in one point.

    Neighbours are not parallel, so the two triples share the point of their two common
    axes.
    """
    return concurrent(model, first + 1) and concurrent(model, first + 2)


def _axes(run: Sequence[int]) -> str:
    return f"axes {', '.join(str(k + 1) for k in run)}"
