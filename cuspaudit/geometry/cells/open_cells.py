"""The open cells of R^d - {g_1 ... g_t = 0} and where they touch.

Open cylindrical decomposition: g is projected along y_d, y_{d-1}, ... by leading
coefficients, discriminants and pairwise resultants. Over an open cell of R^{k-1} the
zeros of level k in y_k are finitely many disjoint graphs, which cut the cylinder over
it into a *stack* of open cells; a cell is named by its places (i_1, ..., i_d) in the
stacks, counted from below.

Two cells touch where a segment parallel to an axis y_k crosses from one to the other
over a zero alpha of level k, all other coordinates rational: a *contact*. It is a
*wall* when g vanishes at the crossing, else a *passage*: then both cells lie in one
component of {g != 0}. Contacts are found from the bottom: two neighbours in a stack of
level k touch over alpha; in every gap between the zeros of the next level over alpha
(polynomials over Q(alpha)) a rational coordinate is chosen, and so on up.

Complete up to codimension 2: the zeros of all levels form a hypersurface; a path in
R^d, moved a little, avoids its parts of codimension 2 and crosses the rest one zero at
a time; such a crossing over alpha of level k can be moved along the zero, over the cell
below and within the gaps above, to the chosen one, because the gaps above do not change
along the zero S: a polynomial of a higher level is delineable over S when its
discriminant has constant order on S and its degree is constant there [McCallum 1988,
theorem 2]. The first holds, discriminants being projected. For the second a factor p of
the leading coefficient brings along the first coefficient that p does not divide.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from flint import arb, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.algebraic_roots import real_roots_over
from cuspaudit.algebra.elimination import square_free_factors
from cuspaudit.algebra.rationals import rationals_between
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import (
    PRECISIONS,
    RealRoot,
    Univariate,
    real_roots,
)
from cuspaudit.errors import PrecisionError, UnableError
from cuspaudit.geometry.sample_points_rational import project
from cuspaudit.runtime.clock import check_time

__all__ = ["Cell", "Contact", "OpenCells", "Point", "open_cells"]

Cell = tuple[int, ...]
Point = tuple[fmpq, ...]


@dataclass(frozen=True)
class Contact:
    """A segment along one axis from one cell into another.

    Attributes:
        cells: the two cells, the lower first.
        ends: rational points of the two; they differ in the coordinate ``axis`` only.
        axis: k - 1 for the axis of y_k.
        root: y_k where the segment leaves one cell for the other, the only zero of
            any level on it.
        is_wall: whether g vanishes there.
    """

    cells: tuple[Cell, Cell]
    ends: tuple[Point, Point]
    axis: int
    root: RealRoot
    is_wall: bool

    def shrunk(self, width: fmpq) -> Contact:
        """The same contact with ends closer to the root than ``width``."""
        between = self.ends[0][self.axis], self.ends[1][self.axis]
        low, high = _window([], self.root, between, width)
        return replace(self, ends=(self.at(low), self.at(high)))

    def at(self, coordinate: fmpq) -> Point:
        """The point of the axis with this coordinate."""
        point = self.ends[0]
        return (*point[: self.axis], coordinate, *point[self.axis + 1 :])


@dataclass(frozen=True, eq=False)
class OpenCells:
    """The open cells of the complement of a hypersurface.

    Attributes:
        ring: Q[..], with y_1..y_d among its variables.
        variables: y_1..y_d.
        levels: level k: polynomials in y_1..y_k that use y_k, coprime in pairs.
        samples: a rational point of every cell.
        contacts: where two cells touch; passages only one for each pair of cells.
    """

    ring: Ring
    variables: tuple[str, ...]
    levels: tuple[tuple[Polynomial, ...], ...]
    samples: dict[Cell, Point] = field(default_factory=dict)
    contacts: list[Contact] = field(default_factory=list)

    def cell(self, point: Sequence[fmpq]) -> Cell:
        """The cell that a rational point lies in.

        Raises:
            PrecisionError: it lies on a zero of some level.
        """
        return tuple(_place(self.stack(point[:k]), point[k]) for k in range(len(point)))

    def stack(self, point: Sequence[fmpq]) -> list[RealRoot]:
        """The zeros of the next level over a rational point of a cell."""
        return _zeros(self.ring, self.special(point), self.variables[len(point)])

    def special(self, point: Sequence[fmpq]) -> list[Polynomial]:
        """The polynomials of the next level over a rational point."""
        at = dict(zip(self.variables, point, strict=False))
        return [self.ring.substitute(p, at) for p in self.levels[len(point)]]


def open_cells(
    ring: Ring, polynomials: Sequence[Polynomial], variables: Sequence[str]
) -> OpenCells:
    """The open cells of R^d - {g_1 ... g_t = 0} and their contacts.

    Args:
        ring: Q[..], which may have more variables than are used.
        polynomials: g_1..g_t in Q[variables], none of them zero.
        variables: y_1..y_d, projected away from the last to the first.

    Raises:
        UnableError: a polynomial vanishes on a whole line over a chosen point.
        PrecisionError: two roots were not separated.
    """
    polynomials = square_free_factors(ring, polynomials)
    cells = OpenCells(ring, tuple(variables), _levels(ring, polynomials, variables))
    base: list[tuple[Cell, Point]] = [((), ())]
    contacts: list[Contact] = []
    for level in range(len(variables)):
        contacts = [up for contact in contacts for up in _raised(cells, contact)]
        stacked = []
        for cell, point in base:
            check_time("open_cells")
            roots = cells.stack(point)
            accept = _Generic(cells, point)
            stack = [(*point, y) for y in _between(roots, accept)]
            stacked += [((*cell, i), sample) for i, sample in enumerate(stack)]
            for i, root in enumerate(roots):
                names, ends = ((*cell, i), (*cell, i + 1)), (stack[i], stack[i + 1])
                is_wall = _is_zero(cells, polynomials, point, root)
                contacts.append(Contact(names, ends, level, root, is_wall))
        base = stacked
    cells.samples.update(base)
    cells.contacts.extend(contacts)
    return cells


def _levels(
    ring: Ring, polynomials: Sequence[Polynomial], variables: Sequence[str]
) -> tuple[tuple[Polynomial, ...], ...]:
    levels: list[tuple[Polynomial, ...]] = []
    rest = list(polynomials)
    for k, name in reversed(list(enumerate(variables))):
        own = [p for p in rest if p.derivative(name) != 0]
        levels.append(tuple(own))
        projected = project(ring, rest, name)
        if k > 1:  # over a zero of the first level, a point, degrees are constant
            projected += [c for p in own for c in _after_drops(ring, p, name)]
        rest = square_free_factors(ring, projected)
    return tuple(reversed(levels))


def _after_drops(ring: Ring, p: Polynomial, name: str) -> Iterator[Polynomial]:
    """The coefficients that lead ``p`` where factors of its leading one vanish."""
    (_, leading), *lower = sorted(ring.coefficients(p, [name]).items(), reverse=True)
    for factor in square_free_factors(ring, [leading]):
        rest = (c for _, c in lower if divmod(c, factor)[1] != 0)
        yield from itertools.islice(rest, 1)


@dataclass(frozen=True)
class _Generic:
    """Whether a next coordinate keeps the level after the next from vanishing.

    Over (point, y) a polynomial of that level must vanish on no line; with a ``root``,
    on no line over the root of the axis ``axis``.
    """

    cells: OpenCells
    point: Point
    axis: int | None = None
    root: RealRoot | None = None

    def __call__(self, y: fmpq) -> bool:
        level = len(self.point) + (1 if self.root else 2)
        if level >= len(self.cells.levels):
            return True
        ring, names = self.cells.ring, self.cells.variables
        axis = level - 1 if self.axis is None else self.axis
        at = dict(zip(names, (*self.point, y), strict=False))
        at.pop(names[axis], None)
        return all(
            _is_proper(
                _row(ring, ring.substitute(p, at), names[axis], names[level]), self.root
            )
            for p in self.cells.levels[level]
        )


def _is_proper(row: list[fmpq_poly], root: RealRoot | None) -> bool:
    """Whether a polynomial vanishes on no line, or on none over the root."""
    if root is None:
        common = fmpq_poly([0])
        for c in row:
            common = common.gcd(c)
        return bool(common.degree() == 0)
    return any(c % fmpq_poly(root.polynomial) != 0 for c in row)


def _between(
    roots: Sequence[RealRoot], accept: Callable[[fmpq], bool] = lambda y: True
) -> list[fmpq]:
    """A rational in every gap between distinct roots."""
    for bits in PRECISIONS:
        balls = [root.enclosure(bits) for root in roots]
        if all(a < b for a, b in pairwise(balls)):
            return _chosen(balls, accept)
    raise PrecisionError("order of distinct real roots", PRECISIONS[-1])


def _chosen(balls: Sequence[arb], accept: Callable[[fmpq], bool]) -> list[fmpq]:
    """The first accepted rational in every gap between disjoint balls."""
    found = []
    for low, high in pairwise([None, *balls, None]):
        y = next(filter(accept, rationals_between(low, high)), None)
        if y is None:
            raise UnableError(
                "sample_points_rational", "a polynomial vanishes on too many lines"
            )
        found.append(y)
    return found


def _is_zero(
    cells: OpenCells, polynomials: Sequence[Polynomial], point: Point, root: RealRoot
) -> bool:
    """Whether some g_i, in y_1..y_k only, vanishes at (point, root)."""
    ring, defining = cells.ring, fmpq_poly(root.polynomial)
    name, above = cells.variables[len(point)], cells.variables[len(point) + 1 :]
    at = dict(zip(cells.variables, point, strict=False))
    for p in polynomials:
        if any(p.derivative(other) != 0 for other in above):
            continue
        special = Univariate.from_polynomial(ring, ring.substitute(p, at), name)
        if special.rational % defining == 0:
            return True
    return False


def _raised(cells: OpenCells, contact: Contact) -> Iterator[Contact]:
    """The contacts of the next level over ``contact``, one in every gap over its root.

    A rational b of a gap is no zero over the root, so none over a neighbourhood of it.
    """
    check_time("open_cells")
    ring, level, axis = cells.ring, len(contact.ends[0]), contact.axis
    w, z = cells.variables[axis], cells.variables[level]
    at = dict(zip(cells.variables, contact.ends[0], strict=False))
    del at[w]
    special = [ring.substitute(p, at) for p in cells.levels[level]]
    rows = [_row(ring, p, w, z) for p in special]
    accept = _Generic(cells, contact.ends[0], axis, contact.root)
    chosen = _chosen(real_roots_over(rows, contact.root), accept)
    along = [ring.substitute(p, {z: b}) for p in special for b in chosen]
    between = contact.ends[0][axis], contact.ends[1][axis]
    window = _window(_zeros(ring, along, w), contact.root, between)
    ends = [contact.at(y) for y in window]
    stacks = [cells.stack(end) for end in ends]
    seen = set()
    for b in chosen:
        places = tuple(_place(stack, b) for stack in stacks)
        if contact.is_wall or places not in seen:
            seen.add(places)
            first, second = (
                (*cell, i) for cell, i in zip(contact.cells, places, strict=True)
            )
            yield replace(
                contact, cells=(first, second), ends=((*ends[0], b), (*ends[1], b))
            )


def _row(ring: Ring, p: Polynomial, w: str, z: str) -> list[fmpq_poly]:
    """The coefficients of the powers of z, polynomials in w."""
    parts = ring.coefficients(p, [z])
    row = [parts.get((k,), ring.constant(0)) for k in range(max(parts)[0] + 1)]
    return [Univariate.from_polynomial(ring, c, w).rational for c in row]


def _window(
    zeros: Sequence[RealRoot],
    root: RealRoot,
    between: tuple[fmpq, fmpq],
    width: fmpq | None = None,
) -> tuple[fmpq, fmpq]:
    """Rationals on both sides of ``root``, inside ``between``, no zero in between."""
    for bits in PRECISIONS:
        with ctx.workprec(bits):
            here = root.enclosure(bits)
            ends = [*(zero.enclosure(bits) for zero in zeros), *map(arb, between)]
            if width is not None:
                ends += [here - arb(width), here + arb(width)]
            if any(end.overlaps(here) for end in ends):
                continue
            low = max((e for e in ends if e < here), key=lambda e: e.upper())
            high = min((e for e in ends if e > here), key=lambda e: e.lower())
            return next(rationals_between(low, here)), next(
                rationals_between(here, high)
            )
    raise PrecisionError("a way past a root", PRECISIONS[-1])


def _place(roots: Sequence[RealRoot], value: fmpq) -> int:
    """How many roots lie below ``value``, which is none of them."""
    return sum(_is_below(root, value) for root in roots)


def _is_below(root: RealRoot, value: fmpq) -> bool:
    saved = ctx.prec
    try:
        for ctx.prec in PRECISIONS:
            ball, other = root.enclosure(ctx.prec), arb(value)
            if ball < other or ball > other:
                return bool(ball < other)
    finally:
        ctx.prec = saved
    raise PrecisionError("a point on a wall", PRECISIONS[-1])


def _zeros(ring: Ring, polynomials: Sequence[Polynomial], name: str) -> list[RealRoot]:
    """The distinct real zeros, in ``name``, of nonzero polynomials; increasing."""
    return real_roots(*(Univariate.from_polynomial(ring, p, name) for p in polynomials))
