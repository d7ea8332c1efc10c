"""Discriminants of plane curves by evaluation and interpolation over Z."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, count

from flint import fmpz, fmpz_poly

__all__ = ["discriminant_degree", "interpolated_discriminant"]


def interpolated_discriminant(rows: Sequence[fmpz_poly]) -> list[fmpz]:
    """The discriminant in v of sum_j rows[j](u) v^j.

    Exact: its degree in u is bounded by `discriminant_degree`, and it is interpolated
    from its values at one integer more.

    Args:
        rows: coefficients of 1, v, v^2, ..., v^n, the last one not 0, n >= 1.

    Returns:
        Coefficients of 1, u, u^2, ...
    """
    wanted = discriminant_degree(rows) + 1
    points: list[int] = []
    values: list[fmpz] = []
    for k in count():
        u = (k + 1) // 2 * (1 if k % 2 else -1)
        special = fmpz_poly([row(u) for row in rows])
        if special.degree() < len(rows) - 1:
            continue
        points.append(u)
        values.append(special.discriminant())
        if len(points) == wanted:
            return _newton(points, values)
    raise AssertionError("unreachable: there are infinitely many integers")


def discriminant_degree(rows: Sequence[fmpz_poly]) -> int:
    """A bound on the degree in u of the discriminant in v.

    Every term of it is a product of 2n - 2 coefficients whose indices add up to
    n (n - 1). If deg rows[j] <= a - b j for all j, its degree is at most
    (2n - 2) a - n (n - 1) b; the best line (a, b) is taken.
    """
    n = len(rows) - 1
    degrees = {j: row.degree() for j, row in enumerate(rows) if row != 0}
    slopes = {Fraction(0)}
    slopes |= {
        Fraction(degrees[i] - degrees[j], j - i) for i, j in combinations(degrees, 2)
    }
    bounds = (
        (2 * n - 2) * max(d + b * j for j, d in degrees.items()) - n * (n - 1) * b
        for b in slopes
    )
    return max(int(min(bounds)), 0)


def _newton(points: Sequence[int], values: Sequence[fmpz]) -> list[fmpz]:
    """The polynomial over Z through the points, by divided differences.

    The differences of an integer polynomial at integer points are integers, so every
    division is exact.
    """
    table = list(values)
    for order in range(1, len(points)):
        for i in range(len(points) - 1, order - 1, -1):
            table[i] = (table[i] - table[i - 1]) // (points[i] - points[i - order])
    result = fmpz_poly([table[-1]])
    for point, value in zip(points[-2::-1], table[-2::-1], strict=True):
        result = result * fmpz_poly([-point, 1]) + value
    return list(result.coeffs())
