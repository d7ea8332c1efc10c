"""Walls that joint limits add to those of the pairs of one value.

Take the pairs over (x, w) of ``surface.pair_sheets``, p their value. Whether both ends
lie in a box, and in which windings, changes along a sheet only where an end is at a
limit:

- of the base: on the lines x = t and w = t, t the chart coordinate of the limit;
- of the fiber: with u the point of the fiber at the limit, the end over x is there
  where p = R(u, x). That value lies on the circle over w,

      <R(u, x) - C(w), R(u, x) - C(w)> - N(w) = 0,

  which x - w divides, as R(u, x) lies on the circle over x; the end over w is there
  where this holds with x and w exchanged. Where the quotient vanishes identically it is
  left out: then R(u, x) lies on all circles, so it does not depend on x (if all circles
  are equal, pairs decide nothing, see ``cuspidality.pair_decision``); hence Delta = 0
  along the limit, and no end of a pair with Delta != 0 is ever there.
"""

from __future__ import annotations

from collections.abc import Iterator

from cuspaudit.algebra.elimination import exact_quotient
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.surface.box_aspects import Box
from cuspaudit.surface.box_edges import Edge
from cuspaudit.surface.value_circles import ValueCircles

__all__ = ["box_walls"]


def box_walls(circles: ValueCircles, box: Box) -> list[Polynomial]:
    """The walls of a box, nonzero polynomials of K[x, w].

    Args:
        circles: of values, not triangular.
        box: in the charts of their surface; its fiber is a circle.
    """
    found: list[Polynomial] = []
    for wall in (*_of_base(circles, box), *_of_fiber(circles, box)):
        if wall != 0 and wall not in found:
            found.append(wall)
    return found


def _of_base(circles: ValueCircles, box: Box) -> Iterator[Polynomial]:
    for edge in box.base or ():
        for gen in circles.ring.gens:
            yield gen - edge.t


def _of_fiber(circles: ValueCircles, box: Box) -> Iterator[Polynomial]:
    for edge in box.fiber or ():
        wall = _at_limit(circles, edge)
        yield wall
        yield circles.exchanged(wall)


def _at_limit(circles: ValueCircles, edge: Edge) -> Polynomial:
    """Zero where the end over x is at the edge of the fiber."""
    ring, mu, below = circles.ring, circles.metric, circles.below
    x, w = ring.gens
    c, s = edge.point
    under = circles.exchanged(below)
    first, second = (
        (row[0] * c + row[1] * s + center) * under - circles.exchanged(center) * below
        for row, center in zip(circles.rows, circles.center, strict=True)
    )
    square = circles.exchanged(circles.square) * below**2
    gap = ring.reduce(first**2 + mu * second**2 - square)
    return exact_quotient(ring, gap, x - w)
