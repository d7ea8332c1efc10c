"""The values that a map takes over one point of the base form a circle.

Let R = (r_1, r_2) be affine along a circle, the fiber: over a point x of the base
R = C + K u, with u = (c, s) on the fiber and K a matrix with rows k_1, k_2. Suppose
that for constants alpha and mu, with r_1 - alpha r_2 in place of r_1,

    k_1 . k_2 = 0,    |k_1|^2 = mu |k_2|^2.

If mu > 0, the values over x form the circle <p - C, p - C> = N, N = |k_1|^2, in the
metric <p, q> = p_1 q_1 + mu p_2 q_2; a value p of it belongs to one point of the
fiber only, u = K^T (p_1 - C_1, mu (p_2 - C_2)) / N, unless N = 0 and K = 0. If mu = 0,
then r_1 depends on x alone, and R is *triangular*.

This is so wherever Delta is affine on the fiber as well, hence for a chain of three
joints with joint 2 revolute. *Proof.* Delta is a multiple of det(K u', K_x u + C_x), u'
the point u turned by a right angle, whose part of degree 2 in u must be a multiple of
<u, u>. Where det K != 0, it is one of <u, K^-1 K_x u>; so K^-1 K_x is a multiple of a
turn, and K is K_0 times a multiple of a turn, K_0 constant: k_i . k_j are constants
times one function. If det K = 0 everywhere, K = a b^T, the part is <a', a_x> <b, u>
<b', u>, and so the direction of a is constant. QED. All the same it is checked.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count

from cuspaudit.algebra.elimination import exact_quotient
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap
from cuspaudit.errors import UnableError
from cuspaudit.surface.surface import Surface

__all__ = ["ValueCircles", "value_circles"]

Row = tuple[Polynomial, Polynomial]


@dataclass(frozen=True, eq=False)
class ValueCircles:
    """The circles of a map, by the chart coordinate of the base.

    Attributes:
        ring: K[x, w], two coordinates of the base.
        metric: mu, a constant.
        center: numerators of C in K[x], over ``below``.
        rows: numerators of k_1 and k_2, over ``below``.
        square: the numerator of N, over the square of ``below``.
        below: a polynomial without real zeros, positive.
    """

    ring: Ring
    metric: Polynomial
    center: Row
    rows: tuple[Row, Row]
    square: Polynomial
    below: Polynomial

    @property
    def is_triangular(self) -> bool:
        """Whether mu = 0: the first component depends on the base alone."""
        return bool(self.metric == 0)

    def exchanged(self, polynomial: Polynomial) -> Polynomial:
        """The polynomial with x and w exchanged."""
        x, w, *surd = self.ring.context.gens()
        return polynomial.compose(w, x, *surd, ctx=self.ring.context)


def value_circles(surface: Surface, mapping: PolynomialMap) -> ValueCircles:
    """The circles of ``mapping``, the conditions above checked exactly.

    Args:
        surface: its fiber is the circle along which R is affine.
        mapping: R = (r_1, r_2), of rank 2 somewhere.

    Guarantee: C has degree at most 1 in (c, s) of a base circle, 2 on a base line.

    Raises:
        UnableError: the values over a point of the base form no such circles.
    """
    parts = [surface.affine_parts(component) for component in mapping.components]
    if surface.fiber.kind != "circle" or None in parts:
        raise _unable("the map is not affine along a circle")
    first, second = (part for part in parts if part is not None)
    if not any(second[:2]):
        first, second = second, first
    most = 1 if surface.base.kind == "circle" else 2
    if any(int(p.total_degree()) > most for p in _over_q(surface.ring, first, second)):
        raise _unable("the centers move on a curve of too high degree")
    numerators, below = surface.on_base((*first, *second))
    ring = Ring(("x", "w"), surface.ring.radicand)
    *entries, below = (
        ring.from_other(p, surface.chart_ring) for p in (*numerators, below)
    )
    return _normalised(ring, entries, below)


def _normalised(
    ring: Ring, entries: list[Polynomial], below: Polynomial
) -> ValueCircles:
    """The circles of the rows (k_11, k_12, C_1, k_21, k_22, C_2) / below, k_2 != 0."""
    *second, own_second = entries[3:]
    slant = _ratio(ring, _dot(ring, entries[:2], second), _dot(ring, second, second))
    *first, own_first = (
        ring.reduce(p - slant * q)
        for p, q in zip(entries[:3], entries[3:], strict=True)
    )
    square = _dot(ring, first, first)
    metric = _ratio(ring, square, _dot(ring, second, second))
    rows = (first[0], first[1]), (second[0], second[1])
    return ValueCircles(ring, metric, (own_first, own_second), rows, square, below)


def _dot(ring: Ring, p: list[Polynomial], q: list[Polynomial]) -> Polynomial:
    return ring.reduce(p[0] * q[0] + p[1] * q[1])


def _ratio(ring: Ring, p: Polynomial, q: Polynomial) -> Polynomial:
    """The constant c with p = c q, q != 0, both in K[x].

    Raises:
        UnableError: there is none.
    """
    values = ([ring.substitute(r, {"x": k}) for r in (p, q)] for k in count())
    above, under = next(pair for pair in values if pair[1] != 0)
    constant = exact_quotient(ring, above, under)
    if ring.reduce(p - constant * q) != 0:
        raise _unable(
            "the values over points of the base form ellipses of several shapes"
        )
    return constant


def _over_q(ring: Ring, *rows: tuple[Polynomial, ...]) -> list[Polynomial]:
    """The constant parts of the rows, split into their rational halves."""
    return [half for row in rows for half in ring.parts(row[-1])]


def _unable(why: str) -> UnableError:
    return UnableError("pairs", why)
