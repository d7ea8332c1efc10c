"""The circles of values as trigonometric functions of the angle of the base.

Where V is a product of two circles and the values over the point t of the base form
the circle <p - C(t), p - C(t)> = N(t) (``surface.value_circles``), p_2 is multiplied by
sqrt(mu), so that the metric is the usual one. Then the entries of C are of the form
x + y cos t + z sin t, and N is a trigonometric polynomial of degree 2. A value p over t
belongs to the point

    u = (q_1 k_1 + q_2 k_2) / N,    q = p - C(t),

of the fiber, as the rows k_1, k_2 of K are orthogonal and of squared length N. With
g = <q, C'> + N' / 2, half the derivative by t of the equation of the circle at p, Delta
is a constant times g (``surface.pair_sheets``); this is checked, and gives its sign.
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb, ctx

from cuspaudit.algebra.elimination import exact_quotient
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap
from cuspaudit.errors import UnableError
from cuspaudit.surface.surface import Surface

__all__ = ["Swing", "ValueWaves", "value_waves"]

BITS = 128
Swing = tuple[arb, arb]
"""The coefficients of cos t and sin t."""


@dataclass(frozen=True, eq=False)
class ValueWaves:
    """Centers and squared radii, exact and in balls.

    Attributes:
        surface: V; its fiber and its base are circles.
        rows: k_1 and k_2, the second without its factor sqrt(mu), on the base.
        stretch: sqrt(mu).
        first: of the first entry of C.
        second: of the second one.
        radius: of N: the constant, then the coefficients of cos t, sin t, cos 2t and
            sin 2t.
        is_line: whether C moves on a line, exactly.
        sign: that of Delta / g.
    """

    surface: Surface
    rows: tuple[tuple[Polynomial, Polynomial], tuple[Polynomial, Polynomial]]
    stretch: arb
    first: Swing
    second: Swing
    radius: tuple[arb, arb, arb, arb, arb]
    is_line: bool
    sign: int

    def aligned(self) -> tuple[Swing, Swing]:
        """The swings; on a line, in coordinates along it and across, which are 0.

        Raises:
            UnableError: C is not proved to move.
        """
        if not self.is_line:
            return self.first, self.second
        lengths = [a * a + b * b for a, b in (self.first, self.second)]
        total = lengths[0] + lengths[1]
        for (a, b), length in zip((self.first, self.second), lengths, strict=True):
            if length > 0:
                factor = (total / length).sqrt()
                return (a * factor, b * factor), (arb(0), arb(0))
        raise _unable("the centers of the circles stand still")

    def center(self, c: arb, s: arb) -> tuple[arb, arb]:
        """C, up to a constant, over the point (c, s) of the base."""
        (a, b), (x, y) = self.first, self.second
        return a * c + b * s, x * c + y * s

    def squared_radius(self, c: arb, s: arb) -> arb:
        """N over the point (c, s) of the base."""
        x0, y1, z1, y2, z2 = self.radius
        return x0 + y1 * c + z1 * s + y2 * (1 - 2 * s * s) + z2 * (2 * s * c)

    def on_fiber(
        self, c: arb, s: arb, q: tuple[arb, arb], square: arb
    ) -> tuple[arb, arb]:
        """The point of the fiber over (c, s) whose value is C + q; ``square`` is N."""
        ring, names = self.surface.ring, self.surface.base.names
        at = dict(zip(names, (c, s), strict=True))
        (k11, k12), (k21, k22) = (
            tuple(ring.evaluate(p, at) for p in row) for row in self.rows
        )
        first, second = q[0] / square, q[1] * self.stretch / square
        return first * k11 + second * k21, first * k12 + second * k22


def value_waves(
    surface: Surface, mapping: PolynomialMap, delta: Polynomial
) -> ValueWaves | None:
    """The circles of ``mapping``, the conditions of ``value_circles`` checked exactly.

    None for a triangular map, mu = 0.

    Args:
        surface: its fiber is the circle along which R is affine.
        mapping: R = (r_1, r_2).
        delta: det jac(f, R), reduced on V, not 0.

    Raises:
        UnableError: a factor of V is a line, the centers move on another curve, or
            the values form no circles.
    """
    parts = [surface.affine_parts(component) for component in mapping.components]
    if surface.base.kind != "circle" or surface.fiber.kind != "circle":
        raise _unable("a factor of the surface is a line")
    if None in parts:
        raise _unable("the map is not affine along a circle")
    first, second = (list(part) for part in parts if part is not None)
    if not any(second[:2]):
        first, second = second, first
    return _waves(surface, first, second, delta)


def _waves(
    surface: Surface,
    first: list[Polynomial],
    second: list[Polynomial],
    delta: Polynomial,
) -> ValueWaves | None:
    ring = surface.ring
    own = _dot(surface, second, second)
    slant = _constant_ratio(ring, _dot(surface, first, second), own)
    first = [ring.reduce(p - slant * q) for p, q in zip(first, second, strict=True)]
    square = _dot(surface, first, first)
    metric = _constant_ratio(ring, square, own)
    if metric == 0:
        return None
    center = [_swing(surface, p) for p in (first[2], second[2])]
    ratio = _constant_ratio(ring, delta, _slope(surface, first, second, square, metric))
    (a, b), (x, y) = center
    is_line = bool(ring.reduce(a * y - b * x) == 0)
    saved, ctx.prec = ctx.prec, BITS
    try:
        stretch = _ball(ring, metric).sqrt()
        swings = (
            (_ball(ring, a), _ball(ring, b)),
            (_ball(ring, x) * stretch, _ball(ring, y) * stretch),
        )
        radius = _radius(surface, square)
        sign = _sign(_ball(ring, ratio))
    finally:
        ctx.prec = saved
    rows = (first[0], first[1]), (second[0], second[1])
    return ValueWaves(surface, rows, stretch, *swings, radius, is_line, sign)


def _dot(surface: Surface, p: list[Polynomial], q: list[Polynomial]) -> Polynomial:
    return surface.reduce(p[0] * q[0] + p[1] * q[1])


def _constant_ratio(ring: Ring, p: Polynomial, q: Polynomial) -> Polynomial:
    """The constant c of K with p = c q, q != 0, both reduced on V.

    Raises:
        UnableError: there is none.
    """
    names = ring.variables
    above, below = (ring.coefficients(part, names) for part in (p, q))
    key = max(below)
    constant = exact_quotient(ring, above.get(key, ring.constant(0)), below[key])
    if ring.reduce(p - constant * q) != 0:
        raise _unable("the values over points of the base form no circles")
    return constant


def _slope(
    surface: Surface,
    first: list[Polynomial],
    second: list[Polynomial],
    square: Polynomial,
    metric: Polynomial,
) -> Polynomial:
    """G on V, by rows (k_1, C_1), (k_2, C_2) and N = ``square``."""
    c, s = (surface.ring.gen(name) for name in surface.base.names)
    u, v = (surface.ring.gen(name) for name in surface.fiber.names)

    def moved(p: Polynomial) -> Polynomial:
        return c * p.derivative(str(s)) - s * p.derivative(str(c))

    k11, k12, own1 = first
    k21, k22, own2 = second
    along = (k11 * u + k12 * v) * moved(own1)
    along += metric * (k21 * u + k22 * v) * moved(own2)
    return surface.reduce(along + moved(square) / 2)


def _swing(surface: Surface, center: Polynomial) -> tuple[Polynomial, Polynomial]:
    """The coefficients of the base's cosine and sine.

    Raises:
        UnableError: the degree is above 1.
    """
    ring = surface.ring
    parts = ring.coefficients(center, surface.base.names)
    if set(parts) - {(0, 0), (1, 0), (0, 1)}:
        raise _unable("the centers move on a curve of too high degree")
    zero = ring.constant(0)
    return parts.get((1, 0), zero), parts.get((0, 1), zero)


def _radius(surface: Surface, square: Polynomial) -> tuple[arb, arb, arb, arb, arb]:
    """The waves of x + y c + z s + v s^2 + w c s.

    Raises:
        UnableError: the degree is above 2.
    """
    ring = surface.ring
    parts = ring.coefficients(square, surface.base.names)
    keys = ((0, 0), (1, 0), (0, 1), (0, 2), (1, 1))
    if set(parts) - set(keys):
        raise _unable("the radii of the circles vary with too high a degree")
    x, y, z, v, w = (_ball(ring, parts.get(key, ring.constant(0))) for key in keys)
    return x + v / 2, y, z, -v / 2, w / 2


def _ball(ring: Ring, constant: Polynomial) -> arb:
    return ring.evaluate(constant, {})


def _sign(ball: arb) -> int:
    """The sign of a ball about a number that is not 0.

    Raises:
        UnableError: it is not told.
    """
    if ball.contains(0):
        raise _unable("a constant of the map is too near 0")
    return 1 if ball > 0 else -1


def _unable(why: str) -> UnableError:
    return UnableError("pair tiles", why)
