"""The positions of a three-joint arm as circles in a plane, up to turns of joint 1.

Three joints turn; t is the value of joint 3. In the frame of link 1 let axis 1 run
along the unit vector e and axis 2 along n through the point o, let o + G(t) be
the tip at theta2 = 0, and v = o - (a point of axis 1). A place of the tip is known, up
to turns of joint 1, from its height along e and its squared distance from that point.
With a' the part of a vector a across n, choose the point so that v' is at a right angle
to e' (both are not 0, as axes 1 and 2 neither meet nor are parallel). Divided by |e'|
and 2 |v'|, height and squared distance are, up to constants, the coordinates p of

    p = c(t) + (the vector g(t), of length |G'|, turned by theta2),
    c = (|G|^2 / (2 |v'|) + (v.n) (n.G) / |v'|, (e.n) (n.G) / |e'|).

So the values over t are the circle with centre c(t) and squared radius N(t) = |G'|^2.
The entries of c are x + y cos t + z sin t; N is one of degree 2. The Jacobian of
(theta2, t) -> p, with q = p - c, is -(q.c' + N'/2) =: -h, and det J is h times a
constant that is not 0.
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb

from cuspaudit.certificate.balls import (
    Row,
    cross,
    dot,
    identity,
    minus,
    plus,
    times,
    turned,
)
from cuspaudit.certificate.cover import Refusal
from cuspaudit.certificate.loose.play import frame_of, steps_of_links
from cuspaudit.certificate.model import Certificate
from cuspaudit.certificate.motions import axis_from_vector

__all__ = ["ValueCircles", "value_circles"]

Wave = tuple[arb, arb, arb]
"""x + y cos t + z sin t."""


@dataclass(frozen=True, slots=True)
class ValueCircles:
    """Centres and squared radii, in balls.

    Attributes:
        first: y and z of the first entry of c.
        second: of the second entry; both exactly 0 where axes 1 and 2 are square.
        radius: the constant term of N, then the coefficients of cos t, sin t, cos 2t,
            sin 2t.
    """

    first: tuple[arb, arb]
    second: tuple[arb, arb]
    radius: tuple[arb, arb, arb, arb, arb]

    def only_sign(self, t: arb) -> int | None:
        """The one sign that h has over ``t``, or None where it is not proved.

        It has one where N |c'|^2 < (N'/2)^2: that of N'.
        """
        s, c = t.sin_cos()
        s2, c2 = (2 * t).sin_cos()
        x0, y1, z1, y2, z2 = self.radius
        slope = z1 * c - y1 * s + 2 * (z2 * c2 - y2 * s2)
        radius = x0 + y1 * c + z1 * s + y2 * c2 + z2 * s2
        (a, b), (x, y) = self.first, self.second
        length = (b * c - a * s) ** 2 + (y * c - x * s) ** 2
        if not 4 * radius * length < slope * slope:
            return None
        return 1 if slope > 0 else -1


def value_circles(certificate: Certificate, is_square: bool) -> ValueCircles:
    """Return the circles at the working precision.

    Args:
        certificate: of three joints that turn; with play the circles enclose those of
            every robot that it allows.
        is_square: whether e.n = 0, exactly.

    Raises:
        Refusal: axes 1 and 2 are not proved to be neither parallel nor meeting.
    """
    one, two, three = certificate.joints
    e, n, m = (axis_from_vector(joint.axis, arb).n for joint in (one, two, three))
    _, to_two, to_three, to_tip = map(frame_of, steps_of_links(certificate))
    frame = identity(arb(1)).then(to_two)
    n, o = turned(frame.R, n), frame.p
    frame = frame.then(to_three)
    m, o3 = turned(frame.R, m), frame.p
    tip = frame.then(to_tip).p
    squared, along = _waves(n, _less(o3, o), m, _less(tip, o3))
    across = _value(minus(arb(1), _squared(dot(e, n))))
    shift = _value(minus(dot(o, e), times(dot(o, n), dot(e, n))))
    if not across > 0:
        raise Refusal("axes 1 and 2 are not proved to be not parallel")
    back = -shift / across
    v = _more(o, _scaled(e, back))
    beside = _value(minus(dot(v, v), _squared(dot(v, n))))
    if not beside > 0:
        raise Refusal("axes 1 and 2 are not proved not to meet")
    length, slope = beside.sqrt(), _value(dot(v, n)) / beside.sqrt()
    slant = arb(0) if is_square else _value(dot(e, n)) / across.sqrt()
    first = [s / (2 * length) + slope * a for s, a in zip(squared, along, strict=True)]
    return ValueCircles(
        (first[1], first[2]),
        (arb(0), arb(0)) if is_square else (slant * along[1], slant * along[2]),
        _radius(squared, along),
    )


def _waves(n: Row[arb], g: Row[arb], m: Row[arb], h: Row[arb]) -> tuple[Wave, Wave]:
    """|G|^2 and n.G for G = g + h turned about m by t."""
    share = dot(m, h)
    still = _scaled(m, share)
    base = _more(g, still)
    swing, side = _less(h, still), cross(m, h)
    squared = (
        _value(plus(dot(base, base), dot(swing, swing))),
        2 * _value(dot(base, swing)),
        2 * _value(dot(base, side)),
    )
    along = _value(dot(n, base)), _value(dot(n, swing)), _value(dot(n, side))
    return squared, along


def _radius(squared: Wave, along: Wave) -> tuple[arb, arb, arb, arb, arb]:
    """N = |G|^2 - (n.G)^2."""
    x, y, z = along
    return (
        squared[0] - x * x - (y * y + z * z) / 2,
        squared[1] - 2 * x * y,
        squared[2] - 2 * x * z,
        (z * z - y * y) / 2,
        -y * z,
    )


def _scaled(a: Row[arb], factor: arb | None) -> Row[arb]:
    return times(a[0], factor), times(a[1], factor), times(a[2], factor)


def _more(a: Row[arb], b: Row[arb]) -> Row[arb]:
    return plus(a[0], b[0]), plus(a[1], b[1]), plus(a[2], b[2])


def _less(a: Row[arb], b: Row[arb]) -> Row[arb]:
    return minus(a[0], b[0]), minus(a[1], b[1]), minus(a[2], b[2])


def _squared(a: arb | None) -> arb | None:
    return times(a, a)


def _value(a: arb | None) -> arb:
    return arb(0) if a is None else a
