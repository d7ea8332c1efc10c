"""The Denavit-Hartenberg invariants of a chain, as balls.

The verdict on an arm is a function of how each joint axis lies to the next and of what
the task needs of the tip. Of two axes in a row these are the twist alpha from the first
to the second, their distance a along the common normal, and along each axis the offset
d between two common normals. Where link frames sit, what the base is, and where a joint
has its zero say nothing of the arm.

**Rows.** With z along axis i and x along the common normal, the next axis is reached by
T(a, 0, d) Rx(alpha) (and Ry(beta), `axis_pair`), and joint i + 1 begins at the turn
``zero`` about it. A run of parallel axes has one offset, written at its last axis,
because the others move no axis; the offset along the first axes, up to the first common
normal that is well known, belongs to the base.

**Slides.** A slide has a direction only. Its line is laid through the reference point
of the next axis that turns (where that one's common normal with what follows ends, or
the tip is level with it). Then ``d`` is the zero of the slide, and ``zero`` is no zero
but an invariant of the arm.

**Reference.** One coordinate walks along the axes and gives d. It begins at the first
common normal that is well known, carried back, so that nothing depends on link frames.
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb, ctx

from cuspaudit.robot.canonical_arm.axis_pair import (
    CommonNormal,
    Floor,
    Form,
    Pair,
    length_of,
    turn_angle,
)
from cuspaudit.robot.canonical_arm.links import (
    BITS,
    FixedStep,
    axis_ball,
    matrix_times,
    placed,
    scaled,
    unit,
)
from cuspaudit.robot.canonical_arm.printed import Printed, printed_errors
from cuspaudit.robot.chain import Chain, Motion
from cuspaudit.robot.lines import Ball, cross, dot, minus
from cuspaudit.robot.snap_policy import SnapPolicy
from cuspaudit.robot.virtual_joint import TO_Z, with_virtual_joint

__all__ = ["AxisRow", "CanonicalFrame", "Invariants", "Tip", "invariants"]

_ORIGIN: Ball = (arb(0), arb(0), arb(0))


@dataclass(frozen=True, slots=True)
class CanonicalFrame:
    """A canonical frame in that of a joint: ``z`` the axis, ``x`` the common normal."""

    x: Ball
    z: Ball
    origin: Ball


@dataclass(frozen=True, slots=True)
class AxisRow:
    """How one axis lies to the one before, in the canonical frame of that one.

    Attributes:
        form: "skew", "parallel" or "tilted".
        a: the distance along x.
        b: the distance along y, None where x is the common normal.
        alpha: the turn about x (rad); of a parallel row the angle between the axes.
        beta: the turn about y after it (rad), of a tilted row.
        d: the offset along the first axis; None where it moves no axis.
        zero: the turn about the second axis at which its joint begins (rad).
        is_turned: whether the second axis of a parallel row points the other way.
        moved: by how much parallel axes have to be moved to be so (rad), and
        lever: how far that carries.
        since: the axis, counted from 1, from which ``d`` is measured: the first of a
            run of parallel ones.
    """

    form: Form
    a: arb
    b: arb | None
    alpha: arb
    beta: arb | None
    d: arb | None
    zero: arb
    is_turned: bool
    moved: float
    lever: float
    since: int


@dataclass(frozen=True, slots=True)
class Tip:
    """The tip from the last axis: distance ``a``, offset ``d`` as in `AxisRow`."""

    a: arb
    d: arb | None
    since: int


@dataclass(frozen=True, slots=True)
class Invariants:
    """What of a chain decides, with the errors of its numbers.

    Attributes:
        chain: the chain, with its virtual joint if its task has one.
        rows: one for each pair of axes in a row, base to tip.
        tip: of a task that needs the tip's point, else None.
        first: the canonical frame of joint 1, in the base.
        last: that of the last joint, in the joint's own frame.
        printed: the errors of the printed numbers.
        floor: what counts as 0 beyond them.
    """

    chain: Chain
    rows: tuple[AxisRow, ...]
    tip: Tip | None
    first: CanonicalFrame
    last: CanonicalFrame
    printed: Printed
    floor: Floor


def invariants(chain: Chain, policy: SnapPolicy) -> Invariants:
    """The invariants of ``chain``, base to tip, all joints at value 0.

    Args:
        chain: with any number of joints.
        policy: what counts as parallel beyond the errors of the numbers, and whether a
            printed 1.5708 is pi/2.
    """
    with ctx.workprec(BITS):
        return _Walk(with_virtual_joint(chain), policy).result()


class _Walk:
    """The passes along the axes; each ball is in the frame of the joint at hand."""

    def __init__(self, chain: Chain, policy: SnapPolicy) -> None:
        self.chain = chain
        unit_of_length = 1000.0 if chain.unit == "mm" else 1.0
        self.floor = Floor(
            float(policy.length) * unit_of_length, float(policy.angle), unit_of_length
        )
        self.printed = printed_errors(chain, policy.printed)
        steps = [self._step(j.before, policy) for j in chain.joints]
        self.base, self.steps = steps[0], steps[1:]
        self.tool = self._step(chain.tool, policy)
        self.axes = [axis_ball(joint, self.printed) for joint in chain.joints]
        self.count = len(self.axes)
        self.slides = [joint.kind == "prismatic" for joint in chain.joints]
        self.points, self.anchor = self._points()

    def result(self) -> Invariants:
        """The rows: meetings, then common normals, then the turns between those."""
        ref = dot(minus(self.anchor, self.points[0]), self.axes[0])
        start, pairs, meetings = ref, list[Pair](), list[CommonNormal]()
        for i in range(self.count - 1):
            pair = self._pair(i)
            pairs.append(pair)
            meetings.append(pair.meeting(ref))
            ref = meetings[-1].after
        tip, tip_normal = self._tip(ref, pairs)
        normals = self._normals(meetings, tip_normal)
        rows = tuple(
            self._row(i, pairs, meetings, normals) for i in range(self.count - 1)
        )
        return Invariants(
            self.chain,
            rows,
            tip,
            self._first(normals[0], start),
            CanonicalFrame(
                normals[-1], self.axes[-1], self._on_axis(self.count - 1, ref)
            ),
            self.printed,
            self.floor,
        )

    def _step(self, motions: tuple[Motion, ...], policy: SnapPolicy) -> FixedStep:
        return placed(motions, self.printed, policy.printed)

    def _pair(self, i: int) -> Pair:
        step = self.steps[i]
        v = matrix_times(step.turn, self.axes[i + 1])
        p = minus(step.apply(self.points[i + 1]), self.points[i])
        return Pair.of(self.axes[i], v, p, self.floor)

    def _points(self) -> tuple[list[Ball], Ball]:
        """The zero of each axis's coordinate, and the reference point of the first.

        It is the origin of the joint's frame, for a slide the reference point of what
        follows. Found from the tip to the base.
        """
        self.points = [_ORIGIN] * self.count
        anchor = self.tool.move
        if self.chain.task == "pose" and not self.slides[-1]:
            anchor = _ORIGIN
        for i in range(self.count - 1, -1, -1):
            if i < self.count - 1:
                anchor = self.steps[i].apply(anchor)
            if self.slides[i]:
                self.points[i] = anchor
                continue
            along = dot(anchor, self.axes[i])
            if i < self.count - 1:
                pair = self._pair(i)
                if pair.form == "skew":
                    along = pair.feet()[0]
            anchor = scaled(self.axes[i], along)
        return self.points, anchor

    def _on_axis(self, i: int, ref: arb) -> Ball:
        x, y, z = (
            p + ref * u for p, u in zip(self.points[i], self.axes[i], strict=True)
        )
        return x, y, z

    def _tip(self, ref: arb, pairs: list[Pair]) -> tuple[Tip | None, Ball | None]:
        """The tip from the last axis, and the direction in which it lies."""
        if self.chain.task == "pose":
            return None, self._x_of_tool()
        u = self.axes[-1]
        p = minus(self.tool.move, self.points[-1])
        h = dot(p, u)
        across = minus(p, scaled(u, h))
        a = length_of(across)
        x = None if self.floor.is_zero_length(a) else unit(across)
        if not all(entry.is_finite() for entry in x or ()):
            x = None
        d = h - ref if _has_started(pairs) or self.slides[-1] else None
        return Tip(a, d, self._since(self.count - 1, pairs)), x

    def _x_of_tool(self) -> Ball | None:
        """The x axis before the turn that carries z to the tool axis, if any."""
        last = self.chain.joints[-1]
        if not last.is_virtual:
            return None
        turn = placed(TO_Z[last.axis], self.printed, False)
        return turn.back((arb(1), arb(0), arb(0)))

    def _since(self, i: int, pairs: list[Pair]) -> int:
        while i > 0 and pairs[i - 1].form == "parallel":
            i -= 1
        return i + 1

    def _normals(self, meetings: list[CommonNormal], tip: Ball | None) -> list[Ball]:
        """The x direction at each axis; where axes coincide, that of a neighbour.

        It is the next one that is known, so that the turn between the two falls to the
        joint at hand, whose zero it is. A slide has no zero and keeps the one before.
        """
        known = [*(m.x for m in meetings), tip]
        self.after = [*(m.x_after for m in meetings), None]
        normals: list[Ball] = []
        for i in range(self.count):
            x = known[i]
            if x is None and not self.slides[i]:
                x = self._next_normal(i, known)
            if x is None and i > 0:
                x = self._carried(i, normals)
            if x is None and i < self.count - 1:
                x = self._next_normal(i, known)
            normals.append(_square(x, self.axes[i]))
        return normals

    def _next_normal(self, i: int, known: list[Ball | None]) -> Ball | None:
        """The next known normal through axes that coincide, in the frame of joint i."""
        k = i + 1
        while k < self.count and known[k] is None and not self.slides[k]:
            k += 1
        if k >= self.count:
            return None
        x = known[k]
        for step in reversed(self.steps[i:k]):
            x = matrix_times(step.turn, x) if x is not None else None
        return x

    def _carried(self, i: int, normals: list[Ball]) -> Ball:
        """The normal before axis ``i``, in the frame of its joint."""
        before = self.after[i - 1] or normals[i - 1]
        return self.steps[i - 1].back(before)

    def _row(
        self,
        i: int,
        pairs: list[Pair],
        meetings: list[CommonNormal],
        normals: list[Ball],
    ) -> AxisRow:
        pair, meeting = pairs[i], meetings[i]
        axis, before, here = (
            self.axes[i + 1],
            self._carried(i + 1, normals),
            normals[i + 1],
        )
        zero = turn_angle(dot(before, here), dot(axis, cross(before, here)))
        d = meeting.d
        if not self.slides[i] and not _has_started(pairs[:i]):
            d = None
        return AxisRow(
            pair.form,
            meeting.a,
            meeting.b,
            meeting.alpha,
            meeting.beta,
            d,
            zero,
            pair.is_turned,
            pair.moved,
            pair.lever,
            self._since(i, pairs),
        )

    def _first(self, normal: Ball, ref: arb) -> CanonicalFrame:
        """The canonical frame of joint 1, in the base."""
        turn = self.base.turn
        origin = self.base.apply(self._on_axis(0, ref))
        return CanonicalFrame(
            matrix_times(turn, normal), matrix_times(turn, self.axes[0]), origin
        )


def _has_started(pairs: list[Pair]) -> bool:
    """Whether a common normal that is well known has been met."""
    return any(pair.form == "skew" for pair in pairs)


def _square(x: Ball | None, axis: Ball) -> Ball:
    """The unit vector of the part of ``x`` across ``axis``, or any across it."""
    if x is None:
        least = min(range(3), key=lambda k: abs(float(axis[k].mid())))
        parts = [arb(int(k == least)) for k in range(3)]
        x = (parts[0], parts[1], parts[2])
    return unit(minus(x, scaled(axis, dot(x, axis))))
