"""Atypical values of a polynomial map on a variety (``AtypicalValues``)."""

from __future__ import annotations

from dataclasses import dataclass

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.geometry.fibers.generic_fiber import GenericFiber, generic_fiber

__all__ = ["AtypicalValues", "atypical_values"]


@dataclass(frozen=True, eq=False)
class AtypicalValues:
    """Polynomials whose zeros contain every atypical value of R on V.

    Attributes:
        fiber: the generic fiber of R, from which they come.
    """

    fiber: GenericFiber

    @property
    def polynomials(self) -> list[Polynomial]:
        """The polynomials g_1, g_2 in Q[y_1..y_d]; neither is 0."""
        return [self.fiber.leading, self.fiber.discriminant]


def atypical_values(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    timeout: float = 60.0,
    seed: int = 1,
) -> AtypicalValues:
    """A proper algebraic set that contains the atypical values of R on V.

    [Paper, section 3.1, routine AtypicalValues]: the closure of the critical values,
    and of the values over which R is not proper [Jelonek 1999]. By the theorem of
    ``geometry.fibers.generic_fiber``, over a value that is no zero of lc disc the map R
    is proper and jac(f, R) has full rank.

    Args:
        variety: V = {f = 0} over Q, of dimension d; assumption (A) is not checked.
        mapping: R: V -> R^d.
        timeout: of each elimination, in s.
        seed: of the linear form that tells the points of a fiber apart.

    Raises:
        DegenerateMapError: R is singular everywhere on V, or its image has a smaller
            dimension.
        UnableError: the coefficients are not rational, or an elimination is too large.
    """
    return AtypicalValues(generic_fiber(variety, mapping, timeout, seed))
