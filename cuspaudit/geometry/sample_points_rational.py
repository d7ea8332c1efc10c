"""Rational points in every cell of the complement of a hypersurface.

The paper's ``SamplePointsRational``, by open cylindrical decomposition: project the
polynomials along the last variable by leading coefficient, discriminant and pairwise
resultants; over a rational point of every cell below, the roots of the specialised
polynomials keep their order, so one rational between neighbours meets every cell.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations

from flint import fmpq

from cuspaudit.algebra.elimination import (
    deflated,
    discriminant,
    leading_coefficient,
    rational_factors,
    resultant,
    square_free_factors,
)
from cuspaudit.algebra.rationals import rationals_between
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.univariate import Univariate, real_root_balls
from cuspaudit.errors import UnableError

__all__ = ["project", "sample_points_rational"]

Point = tuple[fmpq, ...]


def sample_points_rational(
    ring: Ring,
    polynomials: Sequence[Polynomial],
    variables: Sequence[str],
    accept: Callable[[Point], bool] = lambda point: True,
    wanted: Callable[[fmpq], bool] = lambda first: True,
) -> list[Point]:
    """Points of Q^d that meet every connected component of R^d - V(h_1 ... h_t).

    [Paper, Corollary 3 and routine SamplePointsRational].

    Args:
        ring: K[..], which may have more variables than are used.
        polynomials: h_1..h_t in K[variables], none of them zero.
        variables: x_1..x_d, projected away from the last to the first.
        accept: a further condition, true outside a proper algebraic set; points that
            fail it are replaced by others of the same cell.
        wanted: of x_1; the same on each interval between zeros of an h_i in x_1 alone.
            Cells over intervals where it is false are left out.

    Raises:
        UnableError: ``accept`` refused every candidate of a cell.
    """
    return list(_lift(ring, list(polynomials), tuple(variables), accept, wanted))


def _lift(
    ring: Ring,
    polynomials: list[Polynomial],
    variables: tuple[str, ...],
    accept: Callable[[Point], bool],
    wanted: Callable[[fmpq], bool],
) -> Iterator[Point]:
    *below, last = variables
    if not below:
        for x in _between(ring, polynomials, last, accept, ()):
            if wanted(x):
                yield (x,)
        return
    projected = project(ring, polynomials, last)
    if any(p == 0 for p in projected):
        polynomials = rational_factors(ring, polynomials)
        projected = project(ring, polynomials, last)
    projected = square_free_factors(ring, projected)
    above: list[fmpq] = []

    def lifts(point: Point) -> bool:
        if not wanted(point[0]):
            return True
        values = dict(zip(below, point, strict=True))
        fiber = [ring.substitute(p, values) for p in polynomials]
        try:
            above[:] = _between(ring, fiber, last, accept, point)
        except UnableError:
            return False
        return True

    for point in _lift(ring, projected, tuple(below), lifts, wanted):
        yield from ((*point, x) for x in above)


def project(ring: Ring, polynomials: list[Polynomial], name: str) -> list[Polynomial]:
    """The zeros of the result contain every place where the roots change order.

    One of them is 0 exactly when the input has a multiple or a common factor. The
    roots of q(x^k) change where those of q do or one of them is 0, and those of
    q(x^k) and r(x^k) meet where those of q and r do.
    """
    projected = []
    vertical = [p for p in polynomials if p.derivative(name) == 0]
    rest = [p for p in polynomials if p.derivative(name) != 0]
    for p in rest:
        (q,), k = deflated(ring, [p], name)
        projected.append(leading_coefficient(ring, p, name))
        projected.append(discriminant(ring, q, name))
        if k > 1:
            projected.append(ring.substitute(p, {name: 0}))
    for pair in combinations(rest, 2):
        (p, q), _ = deflated(ring, pair, name)
        projected.append(resultant(ring, p, q, name))
    return projected + vertical


def _between(
    ring: Ring,
    polynomials: list[Polynomial],
    name: str,
    accept: Callable[[Point], bool],
    below: Point,
) -> Iterator[fmpq]:
    """One accepted rational in every gap between the real roots in ``name``."""
    roots = real_root_balls(
        [Univariate.from_polynomial(ring, p, name) for p in polynomials]
    )
    for low, high in zip([None, *roots], [*roots, None], strict=True):
        candidates = rationals_between(low, high)
        for candidate in candidates:
            if accept((*below, candidate)):
                yield candidate
                break
        else:
            raise UnableError(
                "sample_points_rational", f"no generic point found in {low}, {high}"
            )
