"""Complete solving of polynomial systems with finitely many complex solutions.

Two routes, the cheaper first; each result names the ground of its completeness.

- An exact Groebner basis by FLINT, within limits: the quotient algebra is known, and
  linear algebra in it gives the points, multiple ones included.
- msolve, whose answer is probabilistic. That its points are solutions is proved by
  substitution modulo omega; that none is missing, by a bound on the dimension of the
  quotient algebra: the leading monomials of the exact basis, or the rank of a matrix
  of multiples of the equations modulo a prime (`algebra.points.macaulay`), or elements
  of the ideal over Q, of bounded degree (`algebra.points.border_bound`), or for two
  curves in a plane a resultant and gcds (`algebra.points.plane_bound`).
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

from cuspaudit.algebra.matrix import determinant, jacobian
from cuspaudit.algebra.msolve_points import msolve_points
from cuspaudit.algebra.points.border_bound import border_bound
from cuspaudit.algebra.points.dependent_variables import without_dependents
from cuspaudit.algebra.points.finite_algebra import (
    FiniteAlgebra,
    parametrization_of,
    quotient_algebra,
    staircase,
)
from cuspaudit.algebra.points.ideal import groebner_basis, ideal_elements
from cuspaudit.algebra.points.localization import with_inverse
from cuspaudit.algebra.points.macaulay import bezout_number, multiples_bound
from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.points.plane_bound import plane_bound
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import NotZeroDimensionalError, SetUpError, UnableError
from cuspaudit.runtime.clock import check_time, seconds_left, time_limit

__all__ = ["solve_zero_dimensional"]

BASIS = "exact Groebner basis"
BEZOUT = "Bezout number met"
PLANE = "resultant, and gcds modulo 62-bit primes"
MULTIPLES = "rank of multiples modulo 2^61 - 1"
BORDER = "elements of the ideal of bounded degree"
_SMALL = 30
_STEP = "solve_zero_dimensional"
_PARTIAL = (100, 1000, 1000)


def solve_zero_dimensional(
    system: PolynomialSystem,
    *,
    nonzero: Polynomial | None = None,
    variables: Sequence[str] | None = None,
    timeout: float = 60,
    seed: int = 1,
) -> ZeroDimensionalParametrization:
    """All the points of C^n where the system vanishes and ``nonzero`` does not.

    Where ``nonzero`` = h is given, the system solved is f = 0, v h = 1 in one more
    variable v; its points are those asked for with v = 1/h added.

    Args:
        system: f in Q[x_1..x_n], any number of equations.
        nonzero: h in the same ring.
        variables: coordinates of the ring that are wanted, which separate the points;
            all of them by default. Not together with ``nonzero``.
        timeout: of msolve, in s; the exact route has limits of its own.
        seed: of the linear forms.

    Returns:
        The points, each once, complete on the grounds it names; omega = 1 when there
        is none.

    Raises:
        NotZeroDimensionalError: there are infinitely many.
        UnableError: completeness was not proved, or the system is too large.
    """
    if system.ring.radicand is not None:
        raise UnableError(
            "solve_zero_dimensional", f"coefficients in {system.ring}, not in Q"
        )
    equations = [p for p in system.equations if p != 0]
    if nonzero is not None:
        equations = [_without_factors_of(nonzero, p) for p in equations]
    wanted = system.ring.variables if variables is None else tuple(variables)
    plain = Posed(system.ring, tuple(equations), wanted)
    if nonzero is None:
        return (
            _exact(plain, timeout, seed)
            or _by_dependents(plain, timeout, seed)
            or _by_msolve(plain, timeout, seed)
        )
    ring, lifted = with_inverse(plain.ring, plain.equations, nonzero)
    saturated = Posed(ring, tuple(lifted), plain.variables)
    found = _exact(saturated, timeout, seed)
    return (
        found
        or _in_the_plane(plain, saturated, nonzero, timeout, seed)
        or _wider(plain, nonzero, timeout, seed)
        or _by_msolve(saturated, timeout, seed)
    )


@dataclass(frozen=True, eq=False)
class Posed:
    """A system whose zeros are wanted in some of its coordinates.

    Attributes:
        ring: Q[x_1..x_m].
        equations: nonzero.
        variables: coordinates that separate the zeros.
    """

    ring: Ring
    equations: tuple[Polynomial, ...]
    variables: tuple[str, ...]


def _exact(
    posed: Posed, timeout: float, seed: int
) -> ZeroDimensionalParametrization | None:
    """The zeros by an exact Groebner basis, None when that is too large."""
    try:
        left = seconds_left()
        with time_limit(None if left is None else left / 4):
            basis = groebner_basis(posed.ring, posed.equations)
    except UnableError:
        check_time(_STEP)
        return None
    bound = len(staircase(basis))
    if bound > _SMALL:
        with suppress(UnableError, SetUpError):  # a quicker way, and not the only
            found = _points(posed, timeout, seed)
            if found.degree == bound:
                return replace(found, grounds=(BASIS,))
    return parametrization_of(_kept(quotient_algebra(basis), posed), (BASIS,), seed)


def _by_dependents(
    posed: Posed, timeout: float, seed: int
) -> ZeroDimensionalParametrization | None:
    """The zeros by those of a system in fewer variables; None when that fails."""
    if posed.variables != posed.ring.variables:
        return None
    smaller = without_dependents(posed.ring, posed.equations)
    if smaller is None:
        return None
    own = Posed(smaller.ring, smaller.equations, smaller.ring.variables)
    found = _exact(own, timeout, seed)
    return None if found is None else smaller.lifted(found)


def _in_the_plane(
    plain: Posed, saturated: Posed, nonzero: Polynomial, timeout: float, seed: int
) -> ZeroDimensionalParametrization | None:
    """The points with h != 0 of two plane curves, when a bound is met; else None."""
    if len(plain.variables) != 2 or len(plain.equations) != 2:
        return None
    try:
        found = _points(saturated, timeout, seed)
        bound = plane_bound(plain.ring, *plain.equations, nonzero)
    except UnableError:
        check_time(_STEP)
        return None
    return replace(found, grounds=(PLANE,)) if found.degree == bound else None


def _wider(
    plain: Posed, nonzero: Polynomial, timeout: float, seed: int
) -> ZeroDimensionalParametrization | None:
    """All zeros of the system without h != 0, then those; None when that fails."""
    try:
        found = _exact(plain, timeout, seed) or _by_msolve(plain, timeout, seed)
    except (NotZeroDimensionalError, UnableError):
        check_time(_STEP)
        return None
    return found.where_nonzero(plain.ring, nonzero)


def _by_msolve(
    posed: Posed, timeout: float, seed: int
) -> ZeroDimensionalParametrization:
    """The zeros msolve finds, when a bound proves that there are no others.

    Raises:
        UnableError: msolve failed, or no bound was met.
    """
    found = _points(posed, timeout, seed)
    if _meets_bezout(posed, found):
        return replace(found, grounds=(BEZOUT,))
    elements, _ = ideal_elements(posed.ring, posed.equations, _PARTIAL)
    for system in (elements, posed.equations):
        if multiples_bound(posed.ring, system, found.degree, timeout / 20):
            return replace(found, grounds=(MULTIPLES,))
    if border_bound(posed.ring, posed.equations, found.degree):
        return replace(found, grounds=(BORDER,))
    raise UnableError(
        "solve_zero_dimensional",
        f"{found.degree} points found; not proved that there are no others",
    )


def _meets_bezout(posed: Posed, found: ZeroDimensionalParametrization) -> bool:
    """Whether the points are as many as there can be components, and isolated."""
    ring, equations = posed.ring, posed.equations
    if ring.variables != found.variables or len(equations) != len(ring.variables):
        return False
    if found.degree != bezout_number(ring, equations):
        return False
    slope = determinant(ring, jacobian(ring, equations))
    return found.vanishes_nowhere(ring, slope)


def _points(posed: Posed, timeout: float, seed: int) -> ZeroDimensionalParametrization:
    return msolve_points(posed.ring, posed.equations, posed.variables, timeout, seed)


def _without_factors_of(h: Polynomial, p: Polynomial) -> Polynomial:
    """The largest divisor of p that has no factor in common with h."""
    common = p.gcd(h)
    while not common.is_constant():
        p = p / common
        common = p.gcd(common)
    return p


def _kept(algebra: FiniteAlgebra, posed: Posed) -> FiniteAlgebra:
    """The same algebra without the matrices of the variables not wanted."""
    own = dict(zip(algebra.variables, algebra.matrices, strict=True))
    matrices = tuple(own[name] for name in posed.variables)
    return FiniteAlgebra(posed.variables, matrices, algebra.one)
