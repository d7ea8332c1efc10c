"""Whether a variety has a real point that is not singular.

V = {f = 0} has dimension d everywhere, c = n - d, and h is the sum of the squares of
the c-minors of jac f: it is 0 at the singular real points and at no other.

Points are sought on random sections and nearest to random points; a solution
set found is known exactly, so that a real point of it with h != 0 is a proof. Failing
these, h / (1 + |x - a|^2)^k with 2k > deg h tends to 0 at infinity, and so has a
maximum on every component of V_R - {h = 0}: when all its critical points with h != 0
are known and none is real, every real point is singular.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from itertools import combinations

from flint import fmpq

from cuspaudit.algebra.matrix import determinant, jacobian
from cuspaudit.algebra.points.ideal import GroebnerBasis, groebner_basis
from cuspaudit.algebra.points.localization import with_inverse
from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import NotZeroDimensionalError, RealPartSingularError, UnableError

__all__ = ["check_real_part"]

_TRIES = 3
_SECONDS = 5
#: sines and cosines of rational angles among them
_FIFTHS = (-4, -3, -1, 0, 1, 2, 3, 4)


def check_real_part(
    basis: GroebnerBasis,
    equations: list[Polynomial],
    minors: list[Polynomial],
    positive: Sequence[str],
    seed: int,
) -> None:
    """Return when V has a regular real point; raise when it has none.

    Args:
        basis: of <f>.
        equations: f, whose zero set has dimension d in C^n everywhere.
        minors: the minors of size n - d of jac f, generators of its singular set.
        positive: variables that must be positive at a point that counts: sqrt m.
        seed: of the search.

    Raises:
        RealPartSingularError: proved: every real point is singular.
        UnableError: no such point was found, nor excluded.
    """
    ring, dimension = basis.ring, basis.dimension
    height = ring.total(minor * minor for minor in minors)
    chosen = random.Random(seed)
    unable = None
    for system in _searches(basis, equations, chosen):
        try:
            found = solve_zero_dimensional(
                PolynomialSystem(ring, tuple(system)), timeout=_SECONDS
            )
            if _has_real_point(ring, found, height, positive):
                return
        except (UnableError, NotZeroDimensionalError) as error:
            unable = error
    try:
        if _vanishes_on(ring, equations, height):
            raise RealPartSingularError(dimension)
        complete = _peaks(ring, equations, height, dimension, _point(ring, chosen))
        found = solve_zero_dimensional(
            PolynomialSystem(ring, tuple(complete)), nonzero=height, timeout=_SECONDS
        )
        if _has_real_point(ring, found, height, positive):
            return
    except (UnableError, NotZeroDimensionalError) as error:
        unable = error
    else:
        raise RealPartSingularError(dimension)
    raise UnableError(
        "check_real_part", f"no regular real point found, nor excluded ({unable})"
    )


def _searches(
    basis: GroebnerBasis, equations: list[Polynomial], chosen: random.Random
) -> Iterator[list[Polynomial]]:
    """Systems with finitely many solutions, points of V: sections, nearest points."""
    ring, dimension, sets = basis.ring, basis.dimension, basis.free_sets()
    for _ in range(_TRIES):
        fixed = [ring.gen(name) for name in chosen.choice(sets)]
        yield [*equations, *(x - fmpq(chosen.choice(_FIFTHS), 5) for x in fixed)]
    for _ in range(_TRIES):
        planes = [_plane(ring, chosen) for _ in range(dimension)]
        yield [*equations, *planes]
    for _ in range(_TRIES):
        centre = _point(ring, chosen)
        away = [x - a for x, a in zip(ring.gens, centre, strict=True)]
        yield _critical(ring, equations, away, dimension)


def _peaks(
    ring: Ring,
    equations: list[Polynomial],
    height: Polynomial,
    dimension: int,
    centre: list[fmpq],
) -> list[Polynomial]:
    """The critical points on V of height / (1 + |x - a|^2)^k, 2k > deg height."""
    away = [x - a for x, a in zip(ring.gens, centre, strict=True)]
    distance = ring.total([ring.constant(1), *(x * x for x in away)])
    k = int(height.total_degree()) // 2 + 1
    gradient = [
        distance * height.derivative(name) - 2 * k * height * x
        for name, x in zip(ring.variables, away, strict=True)
    ]
    return _critical(ring, equations, gradient, dimension)


def _critical(
    ring: Ring,
    equations: list[Polynomial],
    gradient: list[Polynomial],
    dimension: int,
) -> list[Polynomial]:
    """The system f = 0 with the (c+1)-minors of jac f and one more row."""
    rows = [*jacobian(ring, equations), gradient]
    size = len(ring.variables) - dimension + 1
    own = range(len(equations))
    minors = (
        determinant(ring, [[rows[i][j] for j in columns] for i in (*chosen, -1)])
        for chosen in combinations(own, size - 1)
        for columns in combinations(range(len(ring.variables)), size)
    )
    return [*equations, *(minor for minor in minors if minor != 0)]


def _has_real_point(
    ring: Ring,
    found: ZeroDimensionalParametrization,
    height: Polynomial,
    positive: Sequence[str],
) -> bool:
    """Whether a real point that counts has height != 0."""
    return any(
        all(point.sign(ring.gen(name), ring) > 0 for name in positive)
        and point.sign(height, ring) != 0
        for point in found.real_points()
    )


def _plane(ring: Ring, chosen: random.Random) -> Polynomial:
    weights = [chosen.randint(-3, 3) for _ in ring.gens]
    constant = fmpq(chosen.randint(-8, 8), 8)
    return ring.total(w * x for w, x in zip(weights, ring.gens, strict=True)) - constant


def _point(ring: Ring, chosen: random.Random) -> list[fmpq]:
    return [fmpq(chosen.randint(-20, 20), 7) for _ in ring.gens]


def _vanishes_on(ring: Ring, equations: list[Polynomial], p: Polynomial) -> bool:
    """Whether p is 0 on V: 1 is in <f, v p - 1>."""
    larger, lifted = with_inverse(ring, equations, p)
    return groebner_basis(larger, lifted).dimension == -1
