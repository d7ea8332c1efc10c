"""Which sheets of a map continue each other across a zero of its atypical values.

Two cells of the complement of the atypical values touch in a contact. Over each of them
the points of V form numbered sheets (``geometry.fibers.generic_fiber``). A point of V
with Delta != 0 over the contact lies on one sheet of either side, because R is a local
diffeomorphism there; all other sheets end on the contact, in a point with Delta = 0 or
at infinity.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count

from flint import arb, ctx, fmpq

from cuspaudit.errors import UnableError
from cuspaudit.geometry.cells.open_cells import Contact
from cuspaudit.geometry.fibers.generic_fiber import GenericFiber
from cuspaudit.geometry.lifts.continuation import follow, square_chart

__all__ = ["cross", "only_met"]

_BITS = 96
#: every round, twice those by which the contact shrinks
_MORE_BITS = 10
_ROUNDS = 30
#: after so many rounds the points over the contact are counted
_PATIENCE = 12
_SHRINK = fmpq(1, 32)
_SMALLEST_STEP = fmpq(1, 4)

Point = tuple[arb, ...]


def cross(
    fiber: GenericFiber, contact: Contact, regular_points: Callable[[], int]
) -> list[tuple[int, int]]:
    """The pairs (i, j) of sheets that continue each other across ``contact``.

    Sheets are continued by certified steps from ends that come closer and closer to
    the contact. All pairs are found when one side has no sheet left, or when there
    are as many as points of V with Delta != 0 over the contact.

    Args:
        fiber: the sheets.
        contact: a wall between two cells of {lc disc != 0}.
        regular_points: counts the real points of V with Delta != 0 over the contact,
            exactly; called only if needed.

    Raises:
        UnableError: some of these points were not reached.
    """
    pairs: dict[int, int] = {}
    width = contact.ends[1][contact.axis] - contact.ends[0][contact.axis]
    expected = None
    for done in count(1):
        width *= _SHRINK
        contact = contact.shrunk(width)
        with ctx.workprec(_BITS + _MORE_BITS * done):
            below, above = (fiber.sheets(end) for end in contact.ends)
            for i, point in enumerate(below):
                if i not in pairs:
                    j = _across(fiber, contact, point, above)
                    if j is not None:
                        pairs[i] = j
        if len(pairs) == min(len(below), len(above)):
            break
        if done >= _PATIENCE and expected is None:
            expected = regular_points()
        if len(pairs) == expected:
            break
        if done == _ROUNDS:
            raise UnableError(
                "roadmap", f"{len(pairs)} of {expected} sheets continued over a contact"
            )
    return sorted(pairs.items())


def _across(
    fiber: GenericFiber, contact: Contact, point: Point, above: Sequence[Point]
) -> int | None:
    """The number of the sheet above that ``point``, over the lower end, leads to.

    The end of the continuation is a point of V over the upper end, so it is one of
    ``above``; it is the only one that its box meets.
    """
    y0, y1 = (tuple(map(arb, end)) for end in contact.ends)
    chart = square_chart(fiber.variety, fiber.mapping, point)
    if chart is None:
        return None
    way = follow(chart, point, y0, y1, smallest=_SMALLEST_STEP)
    return None if way is None else only_met(way.end, above)


def only_met(box: Sequence[arb], points: Sequence[Point]) -> int | None:
    """The number of the only one of disjoint balls that ``box`` meets, or None."""
    met = [
        j
        for j, point in enumerate(points)
        if all(a.overlaps(b) for a, b in zip(box, point, strict=True))
    ]
    return met[0] if len(met) == 1 else None
