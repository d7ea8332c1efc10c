"""A chain as a robot file: D-H rows where they are exact, motions elsewhere.

The file reads back as a chain with the same forward kinematics, number for number: no
length and no angle is computed in floating point. A frame with its z along each axis is
chosen; where the fixed transform between two axes is a D-H step (`dh_step`), the row
holds it, and where it is not, the next row begins with the motions as they are. The two
conventions have the same frames: a twist and its length stand in the row of the joint
before them (standard) or after them (modified).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

import yaml

from cuspaudit.robot.axes import scaled_axis
from cuspaudit.robot.chain import (
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
from cuspaudit.robot.formats.dh.settings import Convention
from cuspaudit.robot.formats.dh.step import DhStep, dh_step, z_screw
from cuspaudit.robot.formats.motion_text import format_motion, format_vector
from cuspaudit.robot.numbers import format_angle, format_rational

__all__ = ["table_text"]

_WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]*")
_QUARTER = Angle(Fraction(1, 2))
#: the rotation that takes z to each axis of the frame
_ONTO: dict[Vector, tuple[Motion, ...]] = {
    Z_AXIS: (),
    X_AXIS: (Rotation(Y_AXIS, _QUARTER),),
    Y_AXIS: (Rotation(X_AXIS, -_QUARTER),),
}


@dataclass
class _Row:
    """A row being filled.

    Attributes:
        joint: whose row it is.
        before: the motions that come first.
        lead: the step that ends at the joint's axis; its a and alpha are meant.
        step: theta and d about the joint's axis, then a and alpha.
    """

    joint: Joint
    before: tuple[Motion, ...] = ()
    lead: DhStep = field(default_factory=DhStep)
    step: DhStep = field(default_factory=DhStep)

    @property
    def onto(self) -> tuple[Motion, ...] | None:
        """The rotation of z to the joint's axis but for its sign; None off x, y, z."""
        x, y, z = scaled_axis(self.joint.axis)
        return _ONTO.get((abs(x), abs(y), abs(z)))

    @property
    def is_negated(self) -> bool:
        """Whether the joint turns about the opposite of that direction."""
        return sum(self.joint.axis) < 0


def table_text(
    chain: Chain,
    title: str = "",
    source: str = "",
    convention: Convention = "standard",
) -> str:
    """The robot file of ``chain``.

    Args:
        chain: any chain.
        title: one line about the robot.
        source: where the numbers come from.
        convention: of its D-H rows.
    """
    rows, tool = _rows(chain, convention)
    head = {
        "name": chain.name,
        "title": title,
        "source": source,
        "convention": convention,
        "units": chain.unit,
        "task": chain.task,
        "base": chain.base,
        "tip": chain.tip,
    }
    lines = [f"{key}: {_word(value)}" for key, value in head.items() if value]
    cells = [", ".join(_cells(row, convention)) for row in rows]
    lines += ["joints:", *(f"  - {{{row}}}" for row in cells)]
    if tool:
        lines.append(f"tool: {_list(tool)}")
    return "\n".join(lines) + "\n"


def _rows(
    chain: Chain, convention: Convention
) -> tuple[list[_Row], tuple[Motion, ...]]:
    """The rows, and the motions after the last one."""
    rows = [_Row(joint) for joint in chain.joints]
    pending = _begin(rows[0], convention)
    for last, row in pairwise(rows):
        fixed = row.joint.before + (row.onto or ())
        step = None if row.onto is None else _step(last, fixed, pending)
        row.lead = step or row.lead
        pending = _fill(last, pending, step)
        if step is None:
            row.before = _back(last) + fixed
    step = _step(rows[-1], chain.tool, pending)
    rest = _fill(rows[-1], pending, step)
    if step is None:
        return rows, _back(rows[-1]) + chain.tool
    ahead = _along_x(rows[-1].step) if convention == "modified" else ()
    return rows, ahead + _along_z(rest.psi, rest.rise)


def _begin(row: _Row, convention: Convention) -> DhStep:
    """Write what stands before the first axis; return what is left about it.

    A standard row has no twist before its joint.
    """
    fixed = row.joint.before + (row.onto or ())
    step = z_screw(fixed)
    if step is None and convention == "modified":
        step = dh_step(fixed)
    if row.onto is None or step is None or not step.is_plain:
        row.before = fixed
        return DhStep()
    row.lead, row.before = step, _along_z(step.theta, step.d)
    return DhStep(psi=step.psi, rise=step.rise)


def _along_z(angle: Angle, length: Fraction) -> tuple[Motion, ...]:
    """The motions Rz(angle) Tz(length), without those that are 0."""
    turn = () if angle.is_zero else (Rotation(Z_AXIS, angle),)
    move = Translation((Fraction(0), Fraction(0), length))
    return (*turn, move) if length else turn


def _along_x(step: DhStep) -> tuple[Motion, ...]:
    """The motions Tx(a) Rx(alpha), without those that are 0."""
    turn = () if step.alpha.is_zero else (Rotation(X_AXIS, step.alpha),)
    move = Translation((step.a, Fraction(0), Fraction(0)))
    return (move, *turn) if step.a else turn


def _step(row: _Row, fixed: tuple[Motion, ...], pending: DhStep) -> DhStep | None:
    """The step from the axis of ``row`` over ``fixed`` to the next z, if exact.

    Numbers in rad are not added up, so that they are snapped as in the chain.
    """
    step = None if row.onto is None else dh_step(_back(row) + fixed)
    if step is None or (step.theta.radians and pending.psi.radians):
        return None
    return step if step.between(pending, DhStep()).is_plain else None


def _fill(row: _Row, pending: DhStep, step: DhStep | None) -> DhStep:
    """Write what is pending about the row's z, and the step; return what is left."""
    whole = (step or DhStep()).between(pending, DhStep())
    row.step = whole
    return DhStep(psi=whole.psi, rise=whole.rise)


def _back(row: _Row) -> tuple[Motion, ...]:
    """From the frame with z along the row's axis back to that of the chain."""
    return tuple(
        Rotation(motion.axis, -motion.angle)
        for motion in row.onto or ()
        if isinstance(motion, Rotation)
    )


def _cells(row: _Row, convention: Convention) -> list[str]:
    joint, step = row.joint, row.step
    link = row.lead if convention == "modified" else step
    cells = [f"name: {_word(joint.name)}", f"type: {joint.kind}"]
    if row.before:
        cells.append(f"before: {_list(row.before)}")
    if row.onto is None:
        cells.append(f"axis: {format_vector(joint.axis)}")
    else:
        cells.append(f"a: {format_rational(link.a)}")
        cells.append(f"alpha: {format_angle(link.alpha)}")
        cells.append(f"d: {format_rational(step.d)}")
        if not step.theta.is_zero:
            cells.append(f"theta: {format_angle(step.theta)}")
        if row.is_negated:
            cells.append("sign: -1")
    if joint.limits is not None:
        lower, upper = (
            format_angle(limit) if isinstance(limit, Angle) else format_rational(limit)
            for limit in joint.limits
        )
        cells.append(f"limits: [{lower}, {upper}]")
    return cells


def _list(motions: Sequence[Motion]) -> str:
    return f"[{', '.join(format_motion(motion) for motion in motions)}]"


def _word(text: str) -> str:
    """``text`` as a YAML scalar on one line, quoted unless it is a plain word."""
    if _WORD.fullmatch(text):
        return text
    quoted = yaml.safe_dump(
        text, default_style='"', width=float("inf"), allow_unicode=True
    )
    return str(quoted).strip()
