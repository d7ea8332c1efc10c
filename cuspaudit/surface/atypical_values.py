"""Atypical values of a map from a surface to the plane (``AtypicalValues``)."""

from __future__ import annotations

from cuspaudit.algebra.elimination import leading_coefficient, square_free_factors
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.surface.fibers import FiberPolynomials

__all__ = ["atypical_values"]


def atypical_values(fibers: FiberPolynomials) -> list[Polynomial]:
    """Polynomials g of K[u, v] whose zeros contain every atypical value of R on V_R.

    [Paper, routine AtypicalValues]. Two kinds of values are atypical:

    - critical values: F has a multiple root over them (proved when ``fibers`` was
      made), so its discriminant vanishes;
    - values where R is not proper. V is bounded along a circle. Along a line, the
      coordinate t satisfies an equation F_t(t; R) = 0; where the leading coefficient
      of F_t does not vanish, t stays bounded [Jelonek 1999, Prop. 7].

    Returns:
        Square-free polynomials without common factor over Q; their union is proper.
    """
    ring, surface = fibers.ring, fibers.surface
    found = [fibers.discriminant]
    for name, factor in (("y", surface.fiber), ("x", surface.base)):
        if factor.kind == "line":
            found.append(leading_coefficient(ring, fibers.eliminant(name), name))
    return square_free_factors(ring, found)
