"""Whether an arm moves with the full freedom of its task, at every value of a lock.

At a fixed posture of the other joints det J is a trigonometric polynomial in the value
t of the lock, of degree at most 3: written in a frame whose z axis is the axis of the
lock, the screws of the joints on one side of it do not depend on t, and those on the
other side turn with it, each entry of degree 1; on one of the sides there are three at
most. (For a position the columns are velocities of the tip: three of degree 1.) So its
values at seven values of t in equal steps determine it, in balls, and it is then
evaluated over a whole span.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb, ctx, fmpq

from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.fact import fact
from cuspaudit.kinematics.locked.locked_arm import LockedArm
from cuspaudit.kinematics.locked.span import Span, ball_of_angle
from cuspaudit.kinematics.regular import POSTURES, determinant_at

__all__ = ["is_regular", "is_singular_everywhere"]

_BITS = 128
_DEGREE = 3
_NODES = 2 * _DEGREE + 1
_ORDER = 3


def is_regular(held: LockedArm, span: Span) -> bool:
    """Whether det J is not identically 0 at any value in ``span``, for certain.

    One posture is to show it for all values: a shorter span may do where this fails.
    """
    with ctx.workprec(_BITS):
        middle = ball_of_angle(span.middle + held.zero)
        step = span.ball() - ball_of_angle(span.middle)
        at, over = _waves(middle), _waves(middle + step)
        return any(
            not _value(each, at, over, step).contains(0) for each in _series(held)
        )


def _value(
    series: Sequence[arb], at: Sequence[arb], over: Sequence[arb], step: arb
) -> arb:
    """The sum over a span, by Taylor's theorem with the last derivative enclosed.

    Args:
        series: coefficients as `_series` has them.
        at: the waves in the middle of the span.
        over: the waves on all of it.
        step: what the span adds to its middle.
    """
    total, power = arb(0), arb(1)
    for order in range(_ORDER):
        total += _sum(series, at) * power
        series, power = _slope(series), power * step / (order + 1)
    return total + _sum(series, over) * power


def _waves(angle: arb) -> list[arb]:
    """1, cos t, sin t, cos 2t, ..."""
    waves = [arb(1)]
    for k in range(1, _DEGREE + 1):
        sine, cosine = (angle * k).sin_cos()
        waves += [cosine, sine]
    return waves


def _sum(series: Sequence[arb], waves: Sequence[arb]) -> arb:
    return sum((a * w for a, w in zip(series, waves, strict=True)), arb(0))


def _slope(series: Sequence[arb]) -> list[arb]:
    """The coefficients of the derivative."""
    result = [arb(0)]
    for k in range(1, _DEGREE + 1):
        cosine, sine = series[2 * k - 1 : 2 * k + 1]
        result += [sine * k, cosine * -k]
    return result


@fact
def _series(held: LockedArm) -> list[list[arb]]:
    """The coefficients of 1, cos t, sin t, cos 2t, ... of det J at some postures."""
    turns = [fmpq(2 * j, _NODES) for j in range(_NODES)]
    with ctx.workprec(_BITS):
        return _expanded(held, turns)


def _expanded(held: LockedArm, turns: list[fmpq]) -> list[list[arb]]:
    points = [(arb.cos_pi_fmpq(x), arb.sin_pi_fmpq(x)) for x in turns]
    return [
        _coefficients(
            [
                determinant_at(
                    held.arm, start, dict(zip(held.variables, point, strict=True))
                )
                for point in points
            ]
        )
        for start in range(POSTURES)
    ]


def _coefficients(values: list[arb]) -> list[arb]:
    result = [sum(values, arb(0)) / _NODES]
    for k in range(1, _DEGREE + 1):
        for wave in (arb.cos_pi_fmpq, arb.sin_pi_fmpq):
            terms = (
                value * wave(fmpq(2 * j * k, _NODES)) for j, value in enumerate(values)
            )
            result.append(2 * sum(terms, arb(0)) / _NODES)
    return result


def is_singular_everywhere(held: LockedArm) -> bool:
    """Whether det J vanishes at every posture and value of the lock, exactly."""
    if any(not a.contains(0) for each in _series(held) for a in each):
        return False
    return held.vanishes(jacobian_determinant(held.arm))
