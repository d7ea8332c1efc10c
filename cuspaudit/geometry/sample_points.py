"""Points in every component of {g_1 = ... = g_s = 0, h_1 > 0, ..., h_t > 0}.

[Paper, proposition 1, routine SamplePoints], by critical points of a height.

**Theorem.** Let V = {g = 0} have dimension d everywhere, P = h_1 ... h_t, and G = 2
log|P| - k log(1 + |x - a|^2) with k > deg P, or k >= 0 when V is bounded. Every
component X of {g = 0, h > 0} contains a point where jac g has rank < n - d, or a
critical point of G on V.

Proof. On V - {P = 0} no h_j changes its sign along a path, so X is a component of it.
X is closed there and G tends to minus infinity at {P = 0} and at infinity, so G has a
maximum on X. If jac g has rank n - d at it, V is a manifold near it and X an open part;
so it is a critical point. QED

Hence the finitely many complex solutions of both systems, where they are finitely many,
contain a sample; those with all h_j > 0 are chosen exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from operator import mul

from cuspaudit.algebra.matrix import determinant, jacobian
from cuspaudit.algebra.points.ideal import groebner_basis
from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
)
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import (
    NotZeroDimensionalError,
    RealPartSingularError,
    UnableError,
)
from cuspaudit.geometry.assumption_a import check_assumption_a
from cuspaudit.geometry.heights.height import critical_system, heights

__all__ = ["Sample", "sample_points"]

_STEP = "sample_points"


@dataclass(frozen=True, eq=False)
class Sample:
    """Finitely many points that meet every component of {g = 0, h > 0}.

    Attributes:
        parametrizations: sets of points whose union contains the sample, with the
            grounds on which they are complete.
        points: the real ones with all h_j > 0; none exactly when the set is empty.
    """

    parametrizations: tuple[ZeroDimensionalParametrization, ...]
    points: tuple[RealPoint, ...]


def sample_points(
    variety: PolynomialSystem,
    conditions: Sequence[Polynomial] = (),
    *,
    timeout: float = 60.0,
    seed: int = 1,
) -> Sample:
    """A point in every connected component of {g = 0, h > 0}.

    Args:
        variety: {g = 0} over Q, of one dimension everywhere (checked), with finitely
            many complex points where h != 0 and jac g drops rank; s = 0 for R^n.
        conditions: h_1..h_t.
        timeout: of each system, in s.
        seed: of the centre a, and of the solver's linear forms.

    Raises:
        NotEquidimensionalError: V has components of several dimensions.
        NotRadicalError: g vanishes to a higher order on V.
        UnableError: infinitely many singular points, every height tried has
            infinitely many critical points, or a system is too large.
    """
    ring = variety.ring
    if ring.radicand is not None:
        raise UnableError(_STEP, "coefficients outside Q")
    equations = tuple(g for g in variety.equations if g != 0)
    variety, product = (
        PolynomialSystem(ring, equations),
        reduce(mul, conditions, ring.constant(1)),
    )
    dimension = len(ring.variables)
    if equations:
        dimension = groebner_basis(ring, equations).dimension
    if dimension < 0 or product == 0:
        return Sample((), ())
    _check_dimension(variety, dimension, seed)
    sets = (
        _singular(variety, dimension, product, timeout, seed),
        _critical(variety, dimension, product, timeout, seed),
    )
    points = (p for each in sets for p in each.real_points())
    inside = (p for p in points if all(p.sign(h, ring) > 0 for h in conditions))
    return Sample(sets, tuple(inside))


def _check_dimension(variety: PolynomialSystem, dimension: int, seed: int) -> None:
    """V has dimension d everywhere: no component is smaller than n - s."""
    if len(variety.equations) + dimension > len(variety.ring.variables):
        with suppress(RealPartSingularError):
            check_assumption_a(variety, dimension, seed)


def _singular(
    variety: PolynomialSystem,
    dimension: int,
    product: Polynomial,
    timeout: float,
    seed: int,
) -> ZeroDimensionalParametrization:
    """The points of V with P != 0 where jac g has rank less than n - d."""
    ring, rank = variety.ring, len(variety.ring.variables) - dimension
    rows = jacobian(ring, variety.equations)
    minors = [
        determinant(ring, [[row[j] for j in columns] for row in chosen])
        for chosen in combinations(rows, rank)
        for columns in combinations(range(len(ring.variables)), rank)
    ]
    system = PolynomialSystem(ring, (*variety.equations, *minors))
    try:
        return _solved(system, product, timeout, seed)
    except NotZeroDimensionalError:
        raise UnableError(_STEP, "V has infinitely many singular points") from None


def _critical(
    variety: PolynomialSystem,
    dimension: int,
    product: Polynomial,
    timeout: float,
    seed: int,
) -> ZeroDimensionalParametrization:
    """The critical points of a height that has finitely many."""
    for height in heights(variety, [product], seed):
        system = critical_system(variety, dimension, height)
        with suppress(NotZeroDimensionalError):
            return _solved(system, product, timeout, seed)
    raise UnableError(_STEP, "every height has infinitely many critical points")


def _solved(
    system: PolynomialSystem, product: Polynomial, timeout: float, seed: int
) -> ZeroDimensionalParametrization:
    nonzero = None if product.is_constant() else product
    return solve_zero_dimensional(system, nonzero=nonzero, timeout=timeout, seed=seed)
