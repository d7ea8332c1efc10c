"""An arm from its links, in numbers that hold their relations exactly.

Between two axes stands a translation (a, b, d) and a turn by alpha about x, where z is
the axis and x across both axes. Axes that meet have a = 0, parallel ones alpha = 0 or
pi and b = 0, square ones alpha = pi/2: exact numbers of the file, so that nothing is
left to rounding. Where axes stand well apart, their frames slide to the feet of the
common normal, and b and the last part of d are 0 (Denavit and Hartenberg); where they
are nearly parallel these feet are far away, and b stays. Every other number is the
shortest decimal within 1e-9 of the reach, or of a radian.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from cuspaudit.kinematics.nearest.links import Link, Vector, reach_of
from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Motion,
    Rotation,
    Translation,
)
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = ["exact_arm"]

_NEAR = 1e-9
_LEVEL = 1e-9
_WELL_APART = 0.1
_MULTIPLES = sorted({Fraction(n, d) for d in (4, 6) for n in range(d + 1)})
"""The parts of half a turn that an angle between axes is taken for."""


@dataclass(frozen=True)
class _Step:
    """Tz(start) T(a, b, d) Rx(alpha) Tz(-end), and x in the frame of the link."""

    a: float
    b: float
    d: float
    alpha: float
    end: float
    x: Vector


def exact_arm(chain: Chain, links: Sequence[Link]) -> Chain:
    """The chain of ``links``, with the joints of ``chain``.

    Turns about the axes are lost: they shift the zeros of joints that turn. The limits
    go with them.

    Args:
        chain: any chain, of which the names, kinds and the task are kept.
        links: base to tip, as `links_of` gives them.
    """
    chain = with_virtual_joint(chain)
    size = _NEAR * reach_of(links)
    befores: list[tuple[Motion, ...]] = [()]
    end, side = 0.0, None
    for joint, link in zip(chain.joints, links, strict=False):
        step = _step(link)
        turn = _slide_turn(link, side, step) if joint.kind == "prismatic" else ()
        move = tuple(_length(x, size) for x in (step.a, step.b, step.d - end))
        befores.append((*turn, *_moved(move), *_bent(step.alpha)))
        end, side = step.end, step.x
    tool = befores.pop() if links and links[-1].is_last else ()
    joints = [
        replace(joint, before=before, axis=Z_AXIS, limits=None)
        for joint, before in zip(chain.joints, befores, strict=True)
    ]
    return replace(chain.with_joints(joints), tool=tool)


def _step(link: Link) -> _Step:
    u, w, v = link.axis, link.next, link.step
    normal = np.cross(u, w)
    sine, rise = float(np.linalg.norm(normal)), float(v @ u)
    if sine < _LEVEL:
        out = v - rise * u
        x = out / np.linalg.norm(out) if np.any(out) else _across(u)
        alpha = 0.0 if u @ w > 0 else math.pi
        return _Step(float(out @ x), 0.0, rise, alpha, 0.0, x)
    x = normal / sine
    a, b = float(v @ x), float(v @ np.cross(u, x))
    alpha = math.atan2(sine, float(u @ w))
    if sine < _WELL_APART:
        return _Step(a, b, rise, alpha, 0.0, x)
    end = b / sine
    return _Step(a, 0.0, rise + end * float(u @ w), alpha, end, x)


def _slide_turn(link: Link, side: Vector | None, step: _Step) -> tuple[Motion, ...]:
    """The turn about the axis of a slide, which no joint makes up for."""
    if side is None:
        return ()
    u = link.axis
    angle = math.atan2(float(u @ np.cross(side, step.x)), float(side @ step.x))
    return (Rotation(Z_AXIS, _angle(angle)),)


def _moved(vector: tuple[Fraction, ...]) -> tuple[Motion, ...]:
    a, b, d = vector
    return (Translation((a, b, d)),) if any(vector) else ()


def _bent(alpha: float) -> tuple[Motion, ...]:
    angle = _angle(alpha)
    return () if angle.is_zero else (Rotation(X_AXIS, angle),)


def _angle(value: float) -> Angle:
    for part in _MULTIPLES:
        for sign in (1, -1):
            if abs(value - sign * float(part) * math.pi) < _NEAR:
                return Angle(sign * part)
    return Angle(radians=_length(value, _NEAR))


def _length(value: float, size: float) -> Fraction:
    """The shortest decimal within ``size`` of a number."""
    for digits in range(-3, 18):
        shortest = Fraction(round(value * 10.0**digits)) / Fraction(10) ** digits
        if abs(float(shortest) - value) <= size:
            return shortest
    return Fraction(value)


def _across(axis: Vector) -> Vector:
    side = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    return np.asarray(side / np.linalg.norm(side))
