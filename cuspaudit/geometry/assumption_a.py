"""The paper's assumption (A), checked exactly.

<f> is radical and equidimensional of dimension d, and V_R is not contained in the
singular set of V. With c = n - d and S = V(f, c-minors of jac f):

- *s = c equations.* If dim V = d, <f> is a complete intersection, hence unmixed
  (Macaulay); it is radical exactly when every component has a point where jac f has
  rank c, that is when dim S < d [Eisenbud, *Commutative Algebra*, theorem 18.15].
- *More equations.* Where a c-minor m of the rows A is not 0, V(f_A) is smooth of
  dimension d; V is there reduced of dimension d exactly when it is open and closed in
  V(f_A), that is when the ideal of V there is its own square. This decides V - S; where
  S is not empty, what may be embedded in it is not decided here, unless c of the
  equations generate <f>.
- *Real part*: `geometry.real_part`.
"""

from __future__ import annotations

from itertools import combinations

from cuspaudit.algebra.matrix import determinant, jacobian
from cuspaudit.algebra.points.border_bound import is_dimension_below
from cuspaudit.algebra.points.ideal import (
    GroebnerBasis,
    dimension_bound,
    groebner_basis,
)
from cuspaudit.algebra.points.localization import with_inverse
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import (
    NotEquidimensionalError,
    NotRadicalError,
    UnableError,
)
from cuspaudit.geometry.real_part import check_real_part
from cuspaudit.runtime.clock import check_time

__all__ = ["check_assumption_a"]

_LIMITS = (1000, 2000, 4000)


def check_assumption_a(
    variety: PolynomialSystem, dimension: int, seed: int = 1
) -> None:
    """Return when assumption (A) holds; raise the error that names its failure.

    [Paper, assumption (A)]. Over Q(sqrt m) the variety is taken with sqrt m as one
    more variable and its equation; that changes neither property of the ideal, and
    real points are those with sqrt m > 0.

    Args:
        variety: V = {f = 0} in C^n; s = 0 stands for C^n.
        dimension: d.
        seed: of the sections and points of the search for a real point.

    Raises:
        NotEquidimensionalError: V is empty or has a component of another dimension.
        NotRadicalError: f vanishes to a higher order on a component.
        RealPartSingularError: no real point of V is regular.
        UnableError: not decided: an exact basis is too large, or V is given by more
            than n - d equations and is singular.
    """
    ring, equations = _over_q(variety)
    codimension = len(ring.variables) - dimension
    if not equations and codimension == 0:
        return
    basis = groebner_basis(ring, equations)
    if basis.dimension != dimension:
        raise NotEquidimensionalError(expected=dimension, found=basis.dimension)
    minors = _on_variety(basis, _minors(ring, jacobian(ring, equations), codimension))
    singular = _singular_dimension(ring, [*equations, *minors], dimension)
    if len(equations) > codimension:
        _check_more_equations(basis, equations, codimension, singular)
    positive = ring.variables[len(variety.ring.variables) :]
    check_real_part(basis, equations, minors, positive, seed)


def _singular_dimension(ring: Ring, singular: list[Polynomial], dimension: int) -> int:
    """An upper bound, less than d, on the dimension of S; attained when it is -1."""
    bound, complete = dimension_bound(ring, singular, _LIMITS)
    if bound < dimension:
        return bound
    if complete:
        raise NotRadicalError("on a component of V, where their Jacobian drops rank")
    if is_dimension_below(ring, singular, dimension):
        return dimension - 1
    raise UnableError("check_assumption_a", "the singular set of V is too large")


def _check_more_equations(
    basis: GroebnerBasis, equations: list[Polynomial], codimension: int, singular: int
) -> None:
    """Refuse or accept V given by more than c equations, or say that it is unable."""
    ring, rows = basis.ring, jacobian(basis.ring, equations)
    expected = len(ring.variables) - codimension
    if _redundant(ring, equations, codimension):
        return
    for chosen in combinations(range(len(equations)), codimension):
        own = [equations[i] for i in chosen]
        for minor in _minors(ring, [rows[i] for i in chosen], codimension):
            if not _open_and_closed(ring, own, equations, minor):
                raise NotEquidimensionalError(expected=expected, found=None)
    if singular >= 0:
        raise UnableError(
            "check_assumption_a",
            f"V is singular and given by {len(equations)} equations where "
            f"{codimension} would do; embedded components are not excluded",
        )


def _redundant(ring: Ring, equations: list[Polynomial], codimension: int) -> bool:
    """Whether c of the equations generate the whole ideal."""
    for own in combinations(equations, codimension):
        basis = groebner_basis(ring, own)
        if all(basis.contains(p) for p in equations):
            return True
    return False


def _open_and_closed(
    ring: Ring, own: list[Polynomial], equations: list[Polynomial], minor: Polynomial
) -> bool:
    """Whether <f> is <f>^2 modulo the equations ``own``, where ``minor`` is not 0."""
    squares = [p * q for p, q in combinations([*equations, *equations], 2)]
    larger, lifted = with_inverse(ring, [*own, *squares], minor)
    basis = groebner_basis(larger, lifted)
    return all(basis.contains(larger.from_other(p, ring)) for p in equations)


def _minors(ring: Ring, rows: list[list[Polynomial]], size: int) -> list[Polynomial]:
    """The nonzero minors of one size, each once."""
    found: list[Polynomial] = []
    for chosen in combinations(rows, size):
        check_time("check_assumption_a")
        for columns in combinations(range(len(ring.variables)), size):
            minor = determinant(ring, [[row[j] for j in columns] for row in chosen])
            if minor != 0 and minor not in found:
                found.append(minor)
    return found


def _on_variety(
    basis: GroebnerBasis, polynomials: list[Polynomial]
) -> list[Polynomial]:
    """The normal forms, zeros and repetitions left out: the same functions on V."""
    found: list[Polynomial] = []
    for polynomial in polynomials:
        check_time("check_assumption_a")
        rest = basis.normal_form(polynomial)
        if rest != 0 and rest not in found:
            found.append(rest)
    return found


def _over_q(variety: PolynomialSystem) -> tuple[Ring, list[Polynomial]]:
    """The ring and the nonzero equations over Q, sqrt m a variable."""
    ring, equations = variety.ring, [p for p in variety.equations if p != 0]
    if ring.radicand is None:
        return ring, equations
    larger = Ring(ring.context.names())
    return larger, [*equations, larger.gens[-1] ** 2 - ring.radicand]
