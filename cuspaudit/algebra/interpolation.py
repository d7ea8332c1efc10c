"""Discriminants of plane curves by evaluation and interpolation over Z."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, count

from flint import Ordering, fmpz, fmpz_mpoly_ctx, fmpz_poly

from cuspaudit.runtime.clock import check_time

__all__ = ["Row", "discriminant_degree", "interpolated_discriminant"]

#: (A, B): a coefficient A(u) + sqrt(m) B(u); B is 0 over Q.
Row = tuple[fmpz_poly, fmpz_poly]


def interpolated_discriminant(
    rows: Sequence[Row], radicand: int | None
) -> tuple[list[fmpz], list[fmpz]]:
    """The discriminant in v of sum_j rows[j](u) v^j.

    Exact: its degree in u is bounded by `discriminant_degree`, and it is interpolated
    from its values at one integer more.

    Args:
        rows: coefficients of 1, v, v^2, ..., v^n, the last one not 0, n >= 1.
        radicand: m, or None over Q.

    Returns:
        The coefficients of 1, u, u^2, ... of A and of B, the discriminant being
        A + sqrt(m) B.
    """
    wanted = discriminant_degree(rows) + 1
    points: list[int] = []
    plain: list[fmpz] = []
    surd: list[fmpz] = []
    for u in _integers():
        special = [(a(u), b(u)) for a, b in rows]
        if special[-1] == (0, 0):
            continue
        check_time("discriminant")
        value = _discriminant_over_z(special, radicand)
        points.append(u)
        plain.append(value[0])
        surd.append(value[1])
        if len(points) == wanted:
            break
    return _newton(points, plain), _newton(points, surd) if radicand else []


def discriminant_degree(rows: Sequence[Row]) -> int:
    """A bound on the degree in u of the discriminant in v.

    Every term of it is a product of 2n - 2 coefficients whose indices add up to
    n (n - 1). If deg rows[j] <= a - b j for all j, its degree is at most
    (2n - 2) a - n (n - 1) b; the best line (a, b) is taken.
    """
    n = len(rows) - 1
    degrees = {
        j: max(part.degree() for part in row)
        for j, row in enumerate(rows)
        if any(part != 0 for part in row)
    }
    slopes = {Fraction(0)}
    slopes |= {
        Fraction(degrees[i] - degrees[j], j - i) for i, j in combinations(degrees, 2)
    }
    bounds = (
        (2 * n - 2) * max(d + b * j for j, d in degrees.items()) - n * (n - 1) * b
        for b in slopes
    )
    return max(int(min(bounds)), 0)


def _discriminant_over_z(
    coefficients: Sequence[tuple[fmpz, fmpz]], radicand: int | None
) -> tuple[fmpz, fmpz]:
    """The discriminant of a polynomial with coefficients a + b sqrt(m), a, b in Z."""
    if radicand is None:
        return fmpz_poly([a for a, _ in coefficients]).discriminant(), fmpz(0)
    context = fmpz_mpoly_ctx.get(("v", "r"), Ordering.lex)
    terms: dict[tuple[int, ...], int | fmpz]
    terms = {(j, 0): a for j, (a, _) in enumerate(coefficients)}
    terms |= {(j, 1): b for j, (_, b) in enumerate(coefficients)}
    value = context.from_dict(terms).discriminant("v")
    halves = [fmpz(0), fmpz(0)]
    for (_, power), coefficient in value.to_dict().items():
        halves[int(power) % 2] += coefficient * fmpz(radicand) ** (int(power) // 2)
    return halves[0], halves[1]


def _integers() -> Iterator[int]:
    """0, 1, -1, 2, -2, ..."""
    for k in count():
        yield (k + 1) // 2 * (1 if k % 2 else -1)


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
