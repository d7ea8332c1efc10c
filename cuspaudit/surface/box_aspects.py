"""The aspects of a surface within joint limits: components in an open box.

Over V = fiber x base lies a plane: an angle and the same angle a turn later are two
points of it. A box is a product of open intervals there; a factor without limits stays
the circle or the line that it is. Counted are the components of {Delta != 0} in it.

The pieces of the fiber over a point of the base (``surface.fiber_pieces``) change only
at the *events*: the real zeros of D, where zeros of Delta meet, and of Delta(l, .) and
Delta(u, .), where one passes a limit of the fiber. Between neighbouring events the
pieces move without a break; they are the vertices of a graph, once for every winding
of the base. Over an event, each piece of {Delta(., x) != 0} has a neighbourhood that
lies in one piece on either side, and joins the two. Conversely a path in {Delta != 0}
meets an event inside such pieces. So the components of the graph are those of the box.

A limit of the base cuts the interval between two events, not the pieces over it; and
where the chart of a base circle ends nothing happens, as the chart is chosen so that no
event is there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from flint import arb, ctx, fmpq

from cuspaudit.algebra.rationals import rationals_between
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.univariate import (
    PRECISIONS,
    RealRoot,
    Univariate,
    disjoint_balls,
    real_roots,
)
from cuspaudit.errors import PrecisionError, RetryableError, UnableError
from cuspaudit.surface.box_edges import Edge, Range, edge_of
from cuspaudit.surface.box_events import gates, strips_of
from cuspaudit.surface.fiber_pieces import (
    AtRational,
    AtRoot,
    FiberPieces,
    Interval,
    Stand,
)
from cuspaudit.surface.graph_isotop import components
from cuspaudit.surface.surface import ROTATIONS, Factor, Surface

__all__ = [
    "Box",
    "BoxAspects",
    "Place",
    "box_aspects",
    "charted_box",
    "of_factors",
]

Place = tuple[int, int, int]
Ranges = tuple[Range | None, Range | None]


@dataclass(frozen=True, eq=False)
class Box:
    """A box over V, rational in the charts.

    Attributes:
        fiber: limits of the fiber, or None.
        base: limits of the base, or None.
    """

    fiber: Interval | None
    base: Interval | None


@dataclass(frozen=True, eq=False)
class BoxAspects:
    """The components of {Delta != 0} in a box.

    Attributes:
        pieces: of the fiber.
        box: its limits.
        events: increasing in the chart of the base.
        samples: a rational point between each two neighbours, and beyond the ends.
        neighbors: vertices (turn of the base, interval between events, piece), each
            with those it has an edge to.
        aspects: for every vertex the number of its component.
    """

    pieces: FiberPieces
    box: Box
    events: tuple[RealRoot, ...]
    samples: tuple[fmpq, ...]
    neighbors: dict[Place, list[Place]]
    aspects: dict[Place, int]

    @property
    def number_of_aspects(self) -> int:
        """The number of components."""
        return len(set(self.aspects.values()))

    def places(
        self, at: Stand, angle: Callable[[int], arb], sign: int
    ) -> list[tuple[Place, int]]:
        """Where a point of V lies in the box, in each of its windings.

        Args:
            at: its place on the base, at no event and no limit.
            angle: balls of its angle (or coordinate) on the fiber, by the bits; at no
                limit, and Delta is not 0.
            sign: of Delta there.

        Returns:
            The vertex and the turns of the fiber, for each winding in the box.
        """
        turns = self.turns(at)
        if not turns:
            return []
        interval = _below(at, lambda bits: [e.enclosure(bits) for e in self.events])
        if self.pieces.limits is None:
            names = [(sign, 0)]
        else:
            names = [
                (self.pieces.place_of(at, angle, k), k)
                for k in self.pieces.turns(angle)
            ]
        return [((k, interval, name), around) for k in turns for name, around in names]

    def place_at(self, fiber: Edge, base: Edge, sign: int) -> Place | None:
        """The vertex that a rational point lies in, turns counted; None outside.

        Args:
            fiber: its place on the fiber, at no limit, and Delta is not 0.
            base: its place on the base, at no event and no limit.
            sign: of Delta there.
        """
        at, limits = AtRational(base.t), self.pieces.limits
        turn = 0 if self.box.base is None else base.turn
        if turn not in self.turns(at):
            return None
        name = sign
        if limits is not None:
            low, here, high = ((e.turn, e.t) for e in (limits[0], fiber, limits[1]))
            if not low < here < high:
                return None
            name = self.pieces.place(at, fiber)
        balls = _below(at, lambda bits: [e.enclosure(bits) for e in self.events])
        return (turn, balls, name)

    def turns(self, at: Stand) -> range:
        """The windings in the box of a point of the base, which is at no limit."""
        if self.box.base is None:
            return range(1)
        low, high = self.box.base
        if isinstance(at, AtRational):
            return range(low.turn + (at.x < low.t), high.turn + (at.x < high.t))
        past_low, past_high = (_below(at, _at_edge(edge)) for edge in (low, high))
        return range(low.turn + 1 - past_low, high.turn + 1 - past_high)


def _at_edge(edge: Edge) -> Callable[[int], list[arb]]:
    return lambda bits: [arb(edge.t)]


def _below(at: Stand, balls: Callable[[int], list[arb]]) -> int:
    """How many points lie below another, all different."""
    saved = ctx.prec
    try:
        for ctx.prec in PRECISIONS:
            here, others = at.ball(), balls(ctx.prec)
            if not any(other.overlaps(here) for other in others):
                return sum(other < here for other in others)
    finally:
        ctx.prec = saved
    raise PrecisionError("order of points of the base", PRECISIONS[-1])


def charted_box(
    surface: Surface, delta: Polynomial, ranges: Ranges
) -> tuple[Surface, Box, Box | None]:
    """V with charts in which the box is rational, and boxes a hair apart.

    Args:
        surface: Delta is affine along its fiber.
        delta: in the ring of V.
        ranges: of fiber and base.

    Returns:
        V, its charts missing no limit, no zero of D and no zero of Delta at a limit of
        the fiber; a box that contains the given one; and one inside it, None when the
        given one is thinner than a hair.

    Raises:
        RetryableError: every chart misses one of them.
    """
    for base in _charts(surface.base):
        for fiber in _charts(surface.fiber):
            candidate = Surface(surface.ring, fiber, base)
            try:
                outer, inner = (
                    _box(candidate, ranges, outward) for outward in (True, False)
                )
            except RetryableError:
                continue
            assert outer is not None, "a range is not empty"
            boxes = [box for box in (outer, inner) if box is not None]
            if all(_misses_nothing(candidate, delta, box) for box in boxes):
                return candidate, outer, inner
    raise RetryableError("every chart misses an event of the joint limits")


def of_factors(surface: Surface, ranges: Ranges) -> Ranges:
    """Ranges of the factors in the order of the ring, for fiber and base."""
    place = surface.ring.variables.index
    if place(surface.fiber.names[0]) > place(surface.base.names[0]):
        return ranges[1], ranges[0]
    return ranges


def box_aspects(surface: Surface, delta: Polynomial, box: Box) -> BoxAspects:
    """The components of {Delta != 0} in a box, exactly.

    Args:
        surface: as returned by `charted_box`.
        delta: not identically zero on V.
        box: in the charts of ``surface``.

    Raises:
        UnableError: Delta is not affine along the fiber.
    """
    pieces = _pieces(surface, delta, box)
    lines = [pieces.change, *pieces.at_limits]
    if pieces.change.is_zero:
        lines[0] = pieces.parts[-1]
    events = real_roots(*(line for line in lines if not line.is_zero))
    balls = disjoint_balls(events)
    samples = tuple(
        next(rationals_between(low, high))
        for low, high in zip([None, *balls], [*balls, None], strict=True)
    )
    names = [pieces.names(AtRational(x)) for x in samples]
    joints = [list(_joined(pieces, events, k)) for k in range(len(events))]
    strips = list(strips_of(box.base, events))
    neighbors: dict[Place, list[Place]] = {
        (k, interval, name): [] for k, interval in strips for name in names[interval]
    }
    for first, second in pairwise(strips):
        same_turn = first[0] == second[0]
        pairs = joints[first[1]] if same_turn else _same(names[first[1]])
        _join(neighbors, first, second, pairs)
    last = len(events)
    if surface.base.kind == "circle" and box.base is None and last:
        _join(neighbors, (0, last), (0, 0), _same(names[last]))
    return BoxAspects(
        pieces, box, tuple(events), samples, neighbors, components(neighbors)
    )


def _join(
    neighbors: dict[Place, list[Place]],
    first: tuple[int, int],
    second: tuple[int, int],
    pairs: list[tuple[int, int]],
) -> None:
    """Edges between the pieces of two strips."""
    for a, b in pairs:
        neighbors[(*first, a)].append((*second, b))
        neighbors[(*second, b)].append((*first, a))


def _same(names: list[int]) -> list[tuple[int, int]]:
    return [(name, name) for name in names]


def _charts(factor: Factor) -> list[Factor]:
    if factor.kind == "line":
        return [factor]
    return [replace(factor, rotation=rotation) for rotation in ROTATIONS]


def _box(surface: Surface, ranges: Ranges, outward: bool) -> Box | None:
    found: list[Interval | None] = []
    for factor, limits in zip((surface.fiber, surface.base), ranges, strict=True):
        if limits is None:
            found.append(None)
            continue
        low = edge_of(limits.lower, factor, up=not outward)
        high = edge_of(limits.upper, factor, up=outward)
        if (low.turn, low.t) >= (high.turn, high.t):
            return None
        found.append((low, high))
    return Box(*found)


def _pieces(surface: Surface, delta: Polynomial, box: Box) -> FiberPieces:
    parts = surface.affine_parts(delta)
    if parts is None:
        raise UnableError("limits", "Delta is not affine along the fiber")
    ring = surface.chart_ring
    numerators, _ = surface.on_base(parts)
    squares = [n * n for n in numerators]
    change = squares[0]
    if surface.fiber.kind == "circle":
        change = squares[0] + squares[1] - squares[2]
    lines = [Univariate.from_polynomial(ring, n, "x") for n in numerators]
    whole = Univariate.from_polynomial(ring, change, "x")
    return FiberPieces(surface.fiber, tuple(lines), whole, box.fiber)


def _misses_nothing(surface: Surface, delta: Polynomial, box: Box) -> bool:
    """Whether no event of the box lies at the point that the base chart misses."""
    if surface.base.kind == "line":
        return True
    parts = surface.affine_parts(delta)
    if parts is None:
        raise UnableError("limits", "Delta is not affine along the fiber")
    _, below = surface.on_base(parts)
    degree = int(below.degrees()[surface.chart_ring.context.variable_to_index("x")])
    pieces = _pieces(surface, delta, box)
    lines = [(line, degree) for line in pieces.at_limits]
    if pieces.change.is_zero:
        lines.append((pieces.parts[-1], degree))
    else:
        lines.append((pieces.change, 2 * degree))
    return all(line.is_zero or line.degree == most for line, most in lines)


def _joined(
    pieces: FiberPieces, events: list[RealRoot], k: int
) -> Iterator[tuple[int, int]]:
    """The names of the pieces left and right of an event that are one over it."""
    if pieces.limits is None:
        yield from _same(list(pieces.signs(AtRoot(events[k]))))
        return
    for gate in gates(pieces, events, k):
        yield gate.names
