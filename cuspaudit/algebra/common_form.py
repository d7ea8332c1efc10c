"""What functions on a product of circles vanish on together, in codimension one.

With t_i = tan(theta_i/2) a function on the circles becomes a form in pairs of
homogeneous coordinates, one pair a circle, and the circles are the real projective
lines of those pairs. Forms factor uniquely. After division by their greatest common
form, functions P and Q are coprime: their common zeros have codimension at least two.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cuspaudit.algebra.elimination import exact_quotient
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import (
    Circle,
    half_angles,
    primitive,
    reduce_on_circles,
)
from cuspaudit.errors import UnableError

__all__ = ["CommonForm", "common_forms"]


@dataclass(frozen=True)
class CommonForm:
    """An irreducible form in the homogeneous coordinates of some circles.

    Attributes:
        polynomial: the form at t_i = tan(theta_i/2), t_i written as s_i.
        used: the numbers of the circles it depends on.
        is_infinite: whether it is the form that vanishes at theta_i = pi only (its
            polynomial is 1).
    """

    polynomial: Polynomial
    used: tuple[int, ...]
    is_infinite: bool = False


def common_forms(
    ring: Ring, circles: Sequence[Circle], p: Polynomial, q: Polynomial
) -> list[CommonForm]:
    """The distinct irreducible factors of the greatest common form of ``p`` and ``q``.

    Forms 1 + t_i^2, which have no real zero, are left out. Over Q(sqrt m) a factor is
    irreducible only while sqrt m is an indeterminate.

    Args:
        ring: K[x_1..x_n].
        circles: (c_i, s_i), pairs of variables of ``ring``.
        p: a polynomial in the variables of the circles.
        q: another one; not both zero on the circles.

    Guarantee: where no factor vanishes, the zeros that p and q share have codimension
    at least two.

    Raises:
        UnableError: over Q(sqrt m), when the norms of the quotients have a common
            factor, so that coprimality is not proved.

    >>> ring = Ring(["c", "s"])
    >>> c, s = ring.gens
    >>> [form.polynomial for form in common_forms(ring, [("c", "s")], s * c, s)]
    [1, s]
    """
    given = [reduce_on_circles(ring, circles, x) for x in (p, q)]
    written = [half_angles(ring, circles, x) for x in given if x != 0]
    common = written[0][0]
    for numerator, _ in written[1:]:
        common = common.gcd(numerator)
    _check_coprime(ring, [exact_quotient(ring, x, common) for x, _ in written])
    found = [
        CommonForm(ring.constant(1), (i,), True)
        for i, (_, s) in enumerate(circles)
        if all(degrees[i] > _degree(x, s) for x, degrees in written)
    ]
    ones = [primitive(ring, 1 + ring.gen(s) ** 2) for _, s in circles]
    for factor, _ in common.factor()[1]:
        used = tuple(i for i, (_, s) in enumerate(circles) if _degree(factor, s))
        if used and primitive(ring, factor) not in ones:
            found.append(CommonForm(factor, used))
    return found


def _check_coprime(ring: Ring, quotients: Sequence[Polynomial]) -> None:
    """A common factor over K of two polynomials makes one over Q of their norms."""
    if ring.radicand is None or len(quotients) < 2:
        return
    first, second = (ring.norm(x) for x in quotients)
    if not first.gcd(second).is_constant():
        raise UnableError("common factor", f"not settled over Q(sqrt{ring.radicand})")


def _degree(polynomial: Polynomial, name: str) -> int:
    index = polynomial.context().variable_to_index(name)
    return int(polynomial.degrees()[index])
