"""A finite set over Q from the approximate coordinates of its points.

For omega with the roots theta_j the numerator of a coordinate x is
rho = sum_j x(theta_j) omega / (t - theta_j), which has rational coefficients when the
set is defined over Q. They are proposed from enclosures; that they are right has to be
proved by whoever asks.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import acb, acb_mat, arb, ctx, fmpq, fmpq_poly, fmpz

from cuspaudit.algebra.rationals import exact_rational, simplest_between
from cuspaudit.errors import PrecisionError

__all__ = ["proposed_numerators"]

_WIDE = 1e-20


def proposed_numerators(
    omega: fmpq_poly, roots: Sequence[acb], values: Sequence[Sequence[acb]]
) -> list[fmpq_poly]:
    """The simplest rho_1..rho_n whose enclosures are met; not proved.

    A denominator is looked for beside that of omega, which holds most of it.

    Args:
        omega: monic.
        roots: all its roots, enclosed.
        values: for every root the values of the n coordinates, enclosed.

    Raises:
        PrecisionError: the enclosures are too wide to tell.

    >>> t = fmpq_poly([0, 1])
    >>> proposed_numerators(t**2 - 4, [acb(2), acb(-2)], [[acb(1)], [acb(3)]])
    [4*x + (-4)]
    """
    degree = int(omega.degree())
    quotients = acb_mat([_quotient(omega, root) for root in roots])
    rows = (quotients.transpose() * acb_mat([list(v) for v in values])).entries()
    width, below = len(values[0]), omega.denom()
    found = []
    for i in range(width):
        coefficients = []
        for k in range(degree):
            number, below = _rational(rows[k * width + i].real, below)
            coefficients.append(number)
        found.append(fmpq_poly(coefficients))
    return found


def _quotient(omega: fmpq_poly, root: acb) -> list[acb]:
    """The coefficients of omega / (t - root), by Horner's scheme."""
    value, found = acb(0), []
    for k in range(int(omega.degree()), 0, -1):
        value = value * root + omega[k]
        found.append(value)
    return found[::-1]


def _rational(ball: arb, below: fmpz) -> tuple[fmpq, fmpz]:
    """The number meant by ``ball``, and a multiple of ``below`` to be over.

    Raises:
        PrecisionError: the ball is too wide to tell.
    """
    scaled = ball * below
    if not scaled.rad() < _WIDE:
        raise PrecisionError("coefficients of a parametrization", ctx.prec)
    middle, radius = exact_rational(scaled), exact_rational(arb(scaled.rad()))
    number = simplest_between(middle - radius, middle + radius)
    return number / below, below * number.denom()
