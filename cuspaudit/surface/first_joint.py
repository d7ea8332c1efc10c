"""What the first joint of an arm must do between two postures of one pose.

The map R of three joints forgets joint 1 (`kinematics.reduced_map`): two points of one
value are two postures of one pose once joint 1 has moved by some delta, which the two
points determine, modulo whole turns if it turns. The first joint is free of det J, so
both postures fit into its range if and only if the range is longer than |delta|, the
shortest representative of an angle. A turn by more than half a turn is never needed.

Let P be the tip at the one point and P' at the other, from a point of axis 1 with
direction z. As joint 2 turns, P moves on a circle about its axis: with n the direction
of that axis, o a point of it, and Q = P - o,

    <n, Q> = h(x),    <Q, Q> = g(x),

h and g functions of joint 3 alone. Where joint 1 turns by delta, P' = T P, and with
n' = T^-1 n, d = T^-1 o - o the other posture gives <n', Q> = h(w) + <n', d> and
<d, Q> = (g(x) - g(w) + <d, d>) / 2. For a given T these are three linear equations for
Q, so pairs with this delta lie over the curve

    | h(x) n' x d + (h(w) + <n', d>) d x n + (g(x) - g(w) + <d, d>) / 2 n x n' |^2
        = [n, n', d]^2 g(x),

a *wall*; for -delta with x and w exchanged. Where the triple product is 0, as it is for
square axes 1 and 2, the three vectors are parallel, and the vector on the left is 0
only if the equations have a solution: its part along them makes the wall. Where joint 1
slides by s, <n, z> s = h(w) - h(x).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from flint import arb, fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import UnableError
from cuspaudit.surface.box_edges import Limit, edge_of
from cuspaudit.surface.surface import Factor, Surface

__all__ = ["FirstJoint", "FirstMotion", "LongestMotion", "bounds_of", "first_walls"]

Vector = tuple[Polynomial, Polynomial, Polynomial]
_HAIR = fmpq(1, 2**30)


@dataclass(frozen=True, eq=False, kw_only=True)
class FirstMotion:
    """How far joint 1 may go, and what tells how far it has to.

    Attributes:
        kind: "circle" if it turns, "line" if it slides.
        across: polynomials on V: two coordinates of P across z, in units of one length;
            for a slide <z, P> alone.
        width: the length of its range, as a limit; None without limits.
    """

    kind: Literal["circle", "line"]
    across: tuple[Polynomial, ...]
    width: Limit | None


@dataclass(frozen=True, eq=False, kw_only=True)
class FirstJoint(FirstMotion):
    """Joint 1 and the circles that joint 2 moves the tip on.

    Attributes:
        axis: z, a unit vector; constants in the ring of V.
        second: n, a unit vector.
        origin: o, from the point of axis 1.
        height: h, in the variables of joint 3.
        square: g, likewise.
    """

    axis: Vector
    second: Vector
    origin: Vector
    height: Polynomial
    square: Polynomial


@dataclass(frozen=True)
class LongestMotion:
    """The longest motion of joint 1, rational.

    Attributes:
        kind: "circle" or "line".
        point: (cosine, sine) of the largest turn; the largest slide.
    """

    kind: Literal["circle", "line"]
    point: tuple[fmpq, ...]

    def allows(self, here: list[arb], there: list[arb]) -> arb:
        """Positive where the motion between two ends is shorter than the bound.

        Args:
            here: `FirstJoint.across` at one end, in balls.
            there: at the other.
        """
        if self.kind == "line":
            return self.point[0] - abs(there[0] - here[0])
        (a, b), (c, d) = here, there
        return a * c + b * d - self.point[0] * (a * a + b * b)


def bounds_of(
    first: FirstMotion | None,
) -> tuple[LongestMotion | None, LongestMotion | None]:
    """Bounds a hair longer and a hair shorter than the range; None for no bound."""
    if first is None or first.width is None:
        return None, None
    width = first.width
    if first.kind == "line":
        outer, inner = (
            edge_of(width, Factor("line", ("q",)), up) for up in (True, False)
        )
        return LongestMotion("line", outer.point), LongestMotion("line", inner.point)
    half = Limit(fmpq(1), -_HAIR)
    ball, most = width.ball(256), half.ball(256)
    if ball > arb.pi() + arb(_HAIR):
        return None, None
    if ball < most:
        return _turn(width, up=True), _turn(width, up=False)
    return None, _turn(half, up=False)


def _turn(width: Limit, up: bool) -> LongestMotion:
    # measured from a quarter turn the chart misses no width up to half a turn
    factor = Factor("circle", ("c", "s"), (fmpq(0), fmpq(1)))
    return LongestMotion("circle", edge_of(width, factor, up).point)


def first_walls(
    first: FirstJoint, bound: LongestMotion, surface: Surface, ring: Ring
) -> list[Polynomial]:
    """The walls of a bound, in K[x, w].

    Raises:
        UnableError: over all (x, w) a pair asks for exactly this motion.
    """
    numerators, below = surface.on_base((first.height, first.square))
    height, square, below = (
        ring.from_other(p, surface.chart_ring) for p in (*numerators, below)
    )
    constants = [
        [ring.from_other(p, surface.ring) for p in vector]
        for vector in (first.axis, first.second, first.origin)
    ]
    both = (height, square, below)
    if bound.kind == "line":
        z, n, _ = constants
        walls = list(_slides(ring, both, ring.reduce(_dot(z, n)) * bound.point[0]))
    else:
        wall = _turned(ring, both, constants, bound)
        walls = [wall, _exchanged(ring, wall)]
    if any(wall == 0 for wall in walls):
        why = "pairs of postures ask for exactly the range of joint 1"
        raise UnableError("limits", why)
    return walls


Base = tuple[Polynomial, Polynomial, Polynomial]


def _slides(ring: Ring, base: Base, most: Polynomial) -> Iterator[Polynomial]:
    """Zeros of h(w) - h(x) -+ the bound."""
    height, _, below = base
    other, under = _exchanged(ring, height), _exchanged(ring, below)
    for sign in (1, -1):
        gap = other * below - height * under - sign * most * below * under
        yield ring.reduce(gap)


def _turned(
    ring: Ring, base: Base, constants: list[list[Polynomial]], bound: LongestMotion
) -> Polynomial:
    """Zero where a pair asks for the turn of the bound."""
    height, square, below = base
    z, n, origin = constants
    turned = _turn_back(z, n, bound.point)
    d = [a - b for a, b in zip(_turn_back(z, origin, bound.point), origin, strict=True)]
    h, g, under = (_exchanged(ring, p) for p in base)
    both = below * under
    sides = (
        (height * under, _cross(turned, d)),
        (h * below + _dot(turned, d) * both, _cross(d, n)),
        ((square * under - g * below + _dot(d, d) * both) / 2, _cross(n, turned)),
    )
    place = [
        ring.reduce(ring.total(side * vector[i] for side, vector in sides))
        for i in range(3)
    ]
    volume = ring.reduce(_dot(n, _cross(turned, d)))
    if volume == 0:
        normal = next((v for _, v in sides if any(map(ring.reduce, v))), place)
        return ring.reduce(_dot(place, normal))
    return ring.reduce(_dot(place, place) - volume**2 * square * below * under**2)


def _turn_back(
    z: list[Polynomial], v: list[Polynomial], point: tuple[fmpq, ...]
) -> list[Polynomial]:
    """``v`` turned about the unit vector ``z`` by minus the angle of ``point``."""
    c, s = point
    along, beside = _dot(z, v), _cross(z, v)
    return [z[i] * along * (1 - c) + v[i] * c - beside[i] * s for i in range(3)]


def _exchanged(ring: Ring, polynomial: Polynomial) -> Polynomial:
    x, w, *surd = ring.context.gens()
    return polynomial.compose(w, x, *surd, ctx=ring.context)


def _dot(a: list[Polynomial], b: list[Polynomial]) -> Polynomial:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: list[Polynomial], b: list[Polynomial]) -> list[Polynomial]:
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
