"""Critical locus of a polynomial map on a variety (the paper's ``Crit``).

V = {f_1 = ... = f_s = 0} in R^n has dimension d and R maps V to R^d. R fails to be a
local diffeomorphism exactly where all minors of size n of jac(f, R) vanish. For a
robot these points are its singularities; the decision works on the complement.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from flint import fmpq

from cuspaudit.algebra.matrix import determinant, jacobian
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import NotSquareError

__all__ = ["crit", "without_units"]


def crit(variety: PolynomialSystem, mapping: PolynomialMap) -> tuple[Polynomial, ...]:
    """Return the minors of size n of jac(f, R), whose zeros on V are the locus.

    [Paper, section 1 and routine Crit]. When V is given by n - d equations there is
    one minor, Delta = det jac(f, R), rows f_1..f_s then r_1..r_d, columns in ring
    order.

    Args:
        variety: V = {f = 0}, s equations in n variables over K. Assumption (A) of the
            paper (radical, equidimensional of dimension d) is not checked here but by
            ``geometry.assumption_a``.
        mapping: R = (r_1, ..., r_d), same ring, s + d >= n. The row of an angle
            (c, s) is c ds - s dc, its differential on V.

    Returns:
        The nonzero minors, each once, in the lexicographic order of their rows; none
        when every point of V is critical or singular.

    Raises:
        NotSquareError: s + d < n.

    A slider of length x turned by an angle (c, s) is singular at x = 0 only:

    >>> from cuspaudit.algebra.ring import Ring
    >>> ring = Ring(["c", "s", "x"])
    >>> c, s, x = ring.gens
    >>> circle = PolynomialSystem(ring, (c**2 + s**2 - 1,))
    >>> crit(circle, PolynomialMap(ring, (c * x, s * x)))
    (-2*c^2*x - 2*s^2*x,)
    """
    ring = variety.ring
    rows = jacobian(ring, (*variety.equations, *mapping.components))
    for c, s in mapping.angles:
        rows.append([c * s.derivative(x) - s * c.derivative(x) for x in ring.variables])
    size = len(ring.variables)
    if len(rows) < size:
        raise NotSquareError(rows=len(rows), variables=size)
    found: list[Polynomial] = []
    for chosen in combinations(rows, size):
        minor = determinant(ring, chosen)
        if minor != 0 and minor not in found:
            found.append(minor)
    return tuple(found)


def without_units(
    variety: PolynomialSystem, minors: Sequence[Polynomial]
) -> tuple[Polynomial, ...]:
    """The minors without factors that are constant on circles of V.

    Where a (c^2 + s^2 - r) is an equation of V, r > 0, a factor c^2 + s^2 of a minor is
    r on V: the same function on V up to a positive constant, and shorter.

    >>> from cuspaudit.algebra.ring import Ring
    >>> ring = Ring(["c", "s", "x"])
    >>> c, s, x = ring.gens
    >>> circle = PolynomialSystem(ring, (c**2 + s**2 - 1,))
    >>> without_units(circle, (-2 * c**2 * x - 2 * s**2 * x,))
    (-2*x,)
    """
    squares = list(_squares(variety))
    found: list[Polynomial] = []
    for minor in minors:
        for square in squares:
            quotient, rest = divmod(minor, square)
            while rest == 0:
                minor = quotient
                quotient, rest = divmod(minor, square)
        if minor not in found:
            found.append(minor)
    return tuple(found)


def _squares(variety: PolynomialSystem) -> Iterator[Polynomial]:
    """c^2 + s^2 of every equation a (c^2 + s^2 - r), r > 0 in Q."""
    ring = variety.ring
    for equation in variety.equations:
        names = [x for x in ring.variables if equation.derivative(x) != 0]
        if len(names) != 2:
            continue
        square = ring.total(ring.gen(x) ** 2 for x in names)
        lead = equation.derivative(names[0]).derivative(names[0]) / 2
        if not lead.is_constant() or lead == 0:
            continue
        rest = equation - lead * square
        if rest.is_constant() and rest != 0 and _number(rest) / _number(lead) < 0:
            yield square


def _number(constant: Polynomial) -> fmpq:
    """A constant over Q."""
    (value,) = constant.to_dict().values()
    return value
