"""Pairs of points of one value where the fiber is a line, as a sheet over base points.

The second joint slides by s. Let R = (r_1, r_2) with

    r_1 = a s^2 + b(x) s + c(x),    r_2 = beta s + g(x),    a, beta constant,

as for a chain whose joint 2 slides, up to the order of the two: R is (|p|^2, <z, p>) or
two coordinates of p, and p is affine in s with a constant direction. Let beta != 0.
Over a point x of the base s = (v - g(x)) / beta for the value v of r_2, and

    beta^2 r_1 - a v^2 = L(x) v + M(x),
    L = beta b - 2 a g,    M = a g^2 - beta b g + beta^2 c:

up to a change of coordinates of the plane of values, those over x form a *line*. Lines
over x and w, x != w, with L(x) != L(w) meet in one value, v = -m / l, where l and m are
the differences of L and M, divided by x - w. At fixed v the derivative by x is
Delta up to a nonzero constant: Delta = const (L'(x) v + M'(x)).

**Theorem.** Let L have degree at most 1 in the coordinates of the base. Then the pairs
over a point of every cell of {l != 0}, further walls added, decide as those of
``cuspidality.pair_decision`` do; where beta = 0, or L is constant, nothing is cuspidal.

*Proof.* Let X be a component of pairs with Delta != 0 at both ends. x != w on X: at
fixed v and x there is one s. If somewhere on X the map to (x, w) has rank 2, then X
meets the sheet over a cell, l != 0 there, and the argument of ``pair_decision`` holds.
Else (x, w) moves on a curve while v moves too, the two lines are equal along it:
L(x) = L(w), M(x) = M(w). If L is not constant, w is the mirror image of x on a circle
(on a line x = w), dx and dw have opposite signs, and differentiating both equations
Delta dx = Delta' dw up to one constant: Delta has opposite signs at the two ends. If L
is constant, Delta is M'(x) times a constant: along a path in an aspect x moves where M
is monotone, and M(x) = M(w) excludes x != w. If beta = 0, then r_2 = g depends on x
alone and Delta is g'(x) (2 a s + b) up to a constant: x moves where g is monotone, so
x = w, and r_1 has its two values s on different sides of the zero of its derivative.
(If a = 0, there is one.) QED.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from flint import arb, ctx, fmpq

from cuspaudit.algebra.elimination import exact_quotient
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap
from cuspaudit.errors import UnableError
from cuspaudit.surface.box_aspects import Box
from cuspaudit.surface.first_joint import LongestMotion
from cuspaudit.surface.surface import Surface

__all__ = ["SlideSheets", "slide_sheets"]


@dataclass(frozen=True, eq=False)
class SlideSheets:
    """The pairs over (x, w), by numerators in K[x, w].

    Attributes:
        ring: K[x, w].
        surface: V; its fiber is the line of s, its base has a chart.
        spread: a multiple of l, symmetric in x and w.
        slide: over ``spread`` it is s at the end over x; with x and w exchanged, s at
            the end over w.
    """

    ring: Ring
    surface: Surface
    spread: Polynomial
    slide: Polynomial

    @property
    def are_empty(self) -> bool:
        """Whether there is no pair off a set without inner points."""
        return bool(self.spread == 0)

    def over(self, x: fmpq, w: fmpq) -> tuple[int, ...]:
        """The one sheet over a point off the walls."""
        return (1,)

    def fiber_point(
        self, x: fmpq | arb, w: fmpq | arb, sheet: int, bits: int
    ) -> tuple[arb, ...]:
        """A ball of s at the end over ``x`` of the pair over (x, w)."""
        saved, ctx.prec = ctx.prec, bits
        try:
            at = {"x": arb(x), "w": arb(w)}
            above, under = (
                self.ring.evaluate(p, at) for p in (self.slide, self.spread)
            )
            return (above / under,)
        finally:
            ctx.prec = saved

    def exchanged(self, polynomial: Polynomial) -> Polynomial:
        """The polynomial with x and w exchanged."""
        return _swap(self.ring, polynomial)

    def walls(self, delta: Polynomial) -> Iterator[Polynomial]:
        """Off their zeros the sheet exists, and Delta != 0 at both ends."""
        x, w = self.ring.gens
        yield x - w
        yield self.spread
        wall = self.at_end(delta)
        yield wall
        yield self.exchanged(wall)

    def at_end(self, function: Polynomial) -> Polynomial:
        """The numerator of a function on V, affine in s, at the end over x.

        Over ``spread`` times a positive function of x.
        """
        parts = self.surface.affine_parts(function)
        if parts is None:
            raise UnableError("limits", "a function is not affine along the slide")
        (slope, constant), _ = self.surface.on_base(parts)
        steep, level = (
            self.ring.from_other(p, self.surface.chart_ring) for p in (slope, constant)
        )
        return self.ring.reduce(steep * self.slide + level * self.spread)

    def box_walls(self, box: Box) -> Iterator[Polynomial]:
        """Zeros where an end is at a limit."""
        for edge in box.base or ():
            for gen in self.ring.gens:
                yield gen - edge.t
        for edge in box.fiber or ():
            wall = self.ring.reduce(self.slide - edge.t * self.spread)
            yield wall
            yield self.exchanged(wall)

    def first_walls(
        self, bound: LongestMotion, across: tuple[Polynomial, ...]
    ) -> Iterator[Polynomial]:
        """Zeros where joint 1 has to go exactly as far as a bound.

        Args:
            bound: of joint 1.
            across: `FirstJoint.across`.

        Raises:
            UnableError: over all (x, w) a pair asks for exactly this motion.
        """
        walls = list(self._first_walls(bound, across))
        if any(wall == 0 for wall in walls):
            why = "pairs of postures ask for exactly the range of joint 1"
            raise UnableError("limits", why)
        yield from walls

    def _first_walls(
        self, bound: LongestMotion, across: tuple[Polynomial, ...]
    ) -> Iterator[Polynomial]:
        _, below = self.surface.on_base(
            [part for p in across for part in self.surface.affine_parts(p) or ()]
        )
        under = self.ring.from_other(below, self.surface.chart_ring)
        here = [self._numerator(p, below) for p in across]
        there = [self.exchanged(p) for p in here]
        other = self.exchanged(under)
        if bound.kind == "line":
            gap = here[0] * other - there[0] * under
            most = bound.point[0] * self.spread * under * other
            yield self.ring.reduce(gap - most)
            yield self.ring.reduce(gap + most)
            return
        (a, b), (c, d) = here, there
        both = (a * c + b * d) * under - bound.point[0] * (a * a + b * b) * other
        wall = self.ring.reduce(both)
        yield wall
        yield self.exchanged(wall)

    def _numerator(self, function: Polynomial, below: Polynomial) -> Polynomial:
        """As `at_end`, over ``spread`` times ``below``."""
        parts = self.surface.affine_parts(function)
        assert parts is not None, "a coordinate of the tip is affine in a slide"
        numerators = []
        for part in parts:
            (numerator,), own = self.surface.on_base([part])
            numerators.append(numerator * divmod(below, own)[0])
        steep, level = (
            self.ring.from_other(p, self.surface.chart_ring) for p in numerators
        )
        return self.ring.reduce(steep * self.slide + level * self.spread)


def slide_sheets(surface: Surface, mapping: PolynomialMap) -> SlideSheets | None:
    """The pairs of a map whose fiber is a line; None where nothing is cuspidal.

    Args:
        surface: its fiber is the line of the second joint.
        mapping: R, polynomial in s as above.

    Raises:
        UnableError: R has another form.
    """
    ring, name = surface.ring, surface.fiber.names[0]
    (a, b, c), (a2, beta, g) = (
        _powers(ring, surface.reduce(p), name) for p in mapping.components
    )
    if a2 != 0:
        (a, b, c), (a2, beta, g) = (a2, beta, g), (a, b, c)
    if a2 != 0 or not _is_constant(ring, a) or not _is_constant(ring, beta):
        raise UnableError("pairs", "the second joint does not slide along a line")
    if beta == 0 or (a == 0 and _is_constant(ring, b)):
        # one value, or one combination of the two, depends on the base alone
        return None
    steep = surface.reduce(beta * b - 2 * a * g)
    level = surface.reduce(a * g * g - beta * b * g + beta * beta * c)
    most = max(int(part.total_degree()) for part in ring.parts(steep))
    if most > 1:
        raise UnableError("pairs", "the lines of values turn too often")
    if _is_constant(ring, steep):
        return None
    return _sheets(surface, steep, level, beta, g)


def _sheets(
    surface: Surface,
    steep: Polynomial,
    level: Polynomial,
    beta: Polynomial,
    offset: Polynomial,
) -> SlideSheets:
    """From L, M, beta and g.

    With t the denominator of a chart, L = L_n / t^i, M = M_n / t^j, g = g_n / t^k and
    f = j - i: l and m have the numerators l_n over (t t')^i and m_n over (t t')^j, t'
    the same in w, so v = -m_n / (l_n (t t')^f), and where f >= k

        s = (-m_n - g_n t^(f - k) t'^f l_n) / (beta l_n (t t')^f).
    """
    ring = Ring(("x", "w"), surface.ring.radicand)
    x, w = ring.gens
    t = surface.base.denominator(x)

    def on_base(function: Polynomial) -> tuple[Polynomial, int]:
        (numerator,), below = surface.on_base([function])
        return ring.from_other(numerator, surface.chart_ring), _half(ring, below, t)

    def divided(p: Polynomial, power: int) -> Polynomial:
        """(p / t^power (x) - p / t^power (w)) / (x - w), over (t t')^power."""
        gap = p * _swap(ring, t) ** power - _swap(ring, p) * t**power
        return exact_quotient(ring, ring.reduce(gap), x - w)

    (top, i), (height, j), (side, k) = map(on_base, (steep, level, offset))
    if j < i + k:
        height, j = height * t ** (i + k - j), i + k
    f = j - i
    spread, rise = divided(top, i), divided(height, j)
    other = _swap(ring, t) ** f
    slide = ring.reduce(-rise - side * t ** (f - k) * other * spread)
    constant = ring.from_other(beta, surface.ring)
    return SlideSheets(
        ring, surface, ring.reduce(constant * spread * t**f * other), slide
    )


def _half(ring: Ring, below: Polynomial, t: Polynomial) -> int:
    """The power of t that a denominator is; 0 on a line, where t is 1."""
    size = int(t.total_degree())
    return int(below.total_degree()) // size if size else 0


def _swap(ring: Ring, polynomial: Polynomial) -> Polynomial:
    x, w, *surd = ring.context.gens()
    return polynomial.compose(w, x, *surd, ctx=ring.context)


def _is_constant(ring: Ring, polynomial: Polynomial) -> bool:
    return all(polynomial.derivative(name) == 0 for name in ring.variables)


def _powers(
    ring: Ring, polynomial: Polynomial, name: str
) -> tuple[Polynomial, Polynomial, Polynomial]:
    """The coefficients of s^2, s and 1.

    Raises:
        UnableError: there are higher powers.
    """
    found = ring.coefficients(polynomial, (name,))
    if any(power > 2 for (power,) in found):
        raise UnableError("pairs", "the map is of degree over 2 in the slide")
    square, line, plain = (found.get((power,), ring.constant(0)) for power in (2, 1, 0))
    return square, line, plain
