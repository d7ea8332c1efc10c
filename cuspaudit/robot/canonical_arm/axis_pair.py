"""How the second of two axes lies to the first, in balls.

A pair takes one of three forms, and each says where the axes meet their common normal:

- *skew*: the common normal is well known.
- *parallel*: |u x v| is 0 within the errors of the numbers and the floor of the policy.
- *tilted*: nearly parallel: within 1e-3 rad, or so that the feet of the common normal
  are known worse than to 0.1 mm. The second axis is met in the plane square to the
  first through a given point instead, and a turn about y takes up the tilt (Hayati): no
  offsets of kilometers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from flint import arb, fmpq

from cuspaudit.algebra.rationals import exact_rational, simplest_between
from cuspaudit.robot.canonical_arm.links import scaled, unit
from cuspaudit.robot.lines import Ball, cross, dot, minus

__all__ = [
    "CAP_ANGLE",
    "CAP_LENGTH",
    "CommonNormal",
    "Floor",
    "Form",
    "Pair",
    "length_of",
    "simple_fraction",
    "turn_angle",
]

CAP_LENGTH, CAP_ANGLE = 2e-4, 5e-4
"""m and rad: no more than this is ever put down to the rounding of a file.

A genuine offset of 0.35 mm stays, however few digits the file has.
"""

_TYPED = Fraction(1, 10**40)
_SIMPLE = 10**15
_NEARLY = 1e-3
_FLAT = 0.1
_FOOT = 1e-4
Form = Literal["skew", "parallel", "tilted"]


@dataclass(frozen=True, slots=True)
class Floor:
    """What counts as 0 beyond the errors of the numbers.

    Attributes:
        length: in the unit of the chain.
        angle: in rad.
        unit: the chain's units in a meter.
    """

    length: float
    angle: float
    unit: float

    def is_zero_length(self, ball: arb, extra: float = 0.0) -> bool:
        """Whether a length is taken for 0, ``extra`` being what moved it."""
        cap = CAP_LENGTH * self.unit
        reach = min(float(ball.rad()), cap) + self.length + min(extra, cap)
        return abs(float(ball.mid())) <= reach


@dataclass(frozen=True, slots=True)
class CommonNormal:
    """The way from the reference point of one axis to that of the next.

    Attributes:
        a: the distance along ``x``.
        alpha: the turn about ``x`` (rad); of parallel axes the angle between them.
        b: the distance along y, where ``x`` is not the common normal: of parallel axes
            whose distance is irrational, and its parts along two axes of a frame not.
        beta: the turn about y after it (rad), or None.
        d: from the reference point along the first axis; None where it stays.
        after: the coordinate of the next reference point along the second axis.
        x: the direction of the common normal; None where the axes coincide.
        x_after: ``x`` after both turns.
    """

    a: arb
    alpha: arb
    beta: arb | None
    d: arb | None
    after: arb
    x: Ball | None
    x_after: Ball | None
    b: arb | None = None


@dataclass(frozen=True, slots=True)
class Pair:
    """Two axes: unit vectors ``u``, ``v``, and ``p`` from a point of one to the other.

    Attributes:
        u: along the first axis.
        v: along the second.
        p: from the zero of the first's coordinate to that of the second's.
        form: as above.
        tilt: |u x v|.
        floor: what counts as 0.
    """

    u: Ball
    v: Ball
    p: Ball
    form: Form
    tilt: arb
    floor: Floor

    @classmethod
    def of(cls, u: Ball, v: Ball, p: Ball, floor: Floor) -> Pair:
        """The pair, with the form that its numbers allow."""
        tilt = length_of(cross(u, v))
        size, error = float(tilt.mid()), float(tilt.rad())
        pair = cls(u, v, p, "skew", tilt, floor)
        if size <= min(error, CAP_ANGLE) + floor.angle:
            return cls(u, v, p, "parallel", tilt, floor)
        if size < _NEARLY or (size < _FLAT and not pair.knows_feet()):
            return cls(u, v, p, "tilted", tilt, floor)
        return pair

    @property
    def is_turned(self) -> bool:
        """Whether the second axis points against the first."""
        return float(dot(self.u, self.v).mid()) < 0

    @property
    def lever(self) -> float:
        """How far the second frame is: what a moved twist moves is as much times it."""
        return math.hypot(*(float(x.mid()) for x in self.p))

    @property
    def moved(self) -> float:
        """By how much a twist has to be moved to be parallel, beyond its error."""
        size, error = float(self.tilt.mid()), float(self.tilt.rad())
        return size if self.form == "parallel" and size > error else 0.0

    def knows_feet(self) -> bool:
        """Whether the ends of the common normal are known to 0.1 mm."""
        feet = self.feet()
        widest = max(float(foot.rad()) for foot in feet)
        return all(foot.is_finite() for foot in feet) and widest < _FOOT * (
            self.floor.unit
        )

    def feet(self) -> tuple[arb, arb]:
        """The coordinates of the common normal of skew axes along each of them."""
        w = cross(self.u, self.v)
        square = dot(w, w)
        first = dot(cross(self.p, self.v), w) / square
        return first, dot(cross(self.p, self.u), w) / square

    def meeting(self, ref: arb) -> CommonNormal:
        """The way from the point ``ref`` of the first axis to the second axis."""
        match self.form:
            case "skew":
                return self._skew(ref)
            case "parallel":
                return self._parallel(ref)
            case _:
                return self._tilted(ref)

    def _skew(self, ref: arb) -> CommonNormal:
        w = cross(self.u, self.v)
        size = dot(w, w).sqrt()
        x = scaled(w, 1 / size)
        first, second = self.feet()
        alpha = arb.atan2(size, dot(self.u, self.v))
        return CommonNormal(dot(self.p, x), alpha, None, first - ref, second, x, x)

    def _parallel(self, ref: arb) -> CommonNormal:
        """The distance is taken across both directions, which differ by an error."""
        sense = -1 if self.is_turned else 1
        both = [a.union(b * sense) for a, b in zip(self.u, self.v, strict=True)]
        along: Ball = (both[0], both[1], both[2])
        h = dot(self.p, along)
        across = minus(self.p, scaled(along, h))
        a, after = length_of(across), sense * (ref - h)
        if self.floor.is_zero_length(a, self.moved * self.lever):
            return CommonNormal(a, self.tilt, None, None, after, None, None)
        x = self._frame_axis()
        if x is not None and simple_fraction(a) is None:
            parts = dot(across, x), dot(across, cross(self.u, x))
            if None not in map(simple_fraction, parts):
                return CommonNormal(
                    parts[0], self.tilt, None, None, after, x, x, parts[1]
                )
        x = _middle(across)
        return CommonNormal(a, self.tilt, None, None, after, x, x)

    def _frame_axis(self) -> Ball | None:
        """An axis of the frame across ``u``, if ``u`` is one."""
        for k in range(3):
            if all(u.contains(0) for j, u in enumerate(self.u) if j != k):
                parts = [arb(int(j == (k + 1) % 3)) for j in range(3)]
                return parts[0], parts[1], parts[2]
        return None

    def _tilted(self, ref: arb) -> CommonNormal:
        u, v = self.u, self.v
        cosine = dot(u, v)
        after = (ref - dot(self.p, u)) / cosine
        point = tuple(
            p + after * b - ref * a for p, a, b in zip(self.p, u, v, strict=True)
        )
        across = minus(
            (point[0], point[1], point[2]),
            scaled(u, dot((point[0], point[1], point[2]), u)),
        )
        a = length_of(across)
        if float(a.mid()) > 10 * (float(a.rad()) + self.floor.length):
            x = scaled(across, 1 / a)
        else:
            x = _middle(cross(u, v))
        y = cross(u, x)
        rest = minus(v, scaled(u, cosine))
        beta = dot(rest, x).asin()
        alpha = turn_angle(cosine, -dot(rest, y))
        s, c = alpha.sin_cos()
        sb, cb = beta.sin_cos()
        turned = tuple(
            cb * e + s * sb * f - c * sb * g for e, f, g in zip(x, y, u, strict=True)
        )
        x_after: Ball = (turned[0], turned[1], turned[2])
        return CommonNormal(a, alpha, beta, None, after, x, x_after)


def simple_fraction(ball: arb) -> Fraction | None:
    """The simple fraction that a typed number is, by its ball of about 1e-90."""
    if not float(ball.rad()) < float(_TYPED):
        return None
    middle, width = exact_rational(ball), fmpq(1, _TYPED.denominator)
    simple = simplest_between(middle - width, middle + width)
    return Fraction(int(simple.p), int(simple.q)) if simple.q <= _SIMPLE else None


def turn_angle(c: arb, s: arb) -> arb:
    """The angle of the direction (c, s), in a ball that crosses no cut.

    Its middle lies in (-pi, pi] but for the error.
    """
    if float(c.mid()) >= 0 or abs(float(s.mid())) > abs(float(c.mid())):
        return arb.atan2(s, c)
    half = arb.pi() if float(s.mid()) >= 0 else -arb.pi()
    return half + arb.atan2(-s, -c)


def length_of(vector: Ball) -> arb:
    """The length of a vector, as a ball even where it may be 0."""
    middle = math.hypot(*(float(x.mid()) for x in vector))
    error = math.hypot(*(float(x.rad()) for x in vector))
    if middle > 4 * error:
        return dot(vector, vector).sqrt()
    return arb(middle, error)


def _middle(vector: Ball) -> Ball:
    """The unit vector of the midpoint."""
    x, y, z = (x.mid() for x in vector)
    return unit((x, y, z))
