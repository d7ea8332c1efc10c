"""One true cusp of a map next to a point, in ball arithmetic.

Let J be the Jacobian matrix of a map between manifolds of one dimension n, h = det J,
and let k be a smooth field with J k = h v for a fixed vector v, here k = adj(J) v. At a
point q suppose

    (1) h = 0,  (2) k . grad h = 0,  (3) k != 0,  (4) grad h != 0,
    (5) k . grad(k . grad h) != 0.

**Theorem.** Then the map has a cusp at q: in suitable coordinates it is
(x, y, ...) -> (x^3 + x y, y, ...).

*Proof.* By (3) an entry of adj(J) is not 0, so J has rank n - 1 at q, and near q k
spans the kernel of J along {h = 0}. By (1), (4) this set is a smooth hypersurface. By
(2) and (5) the derivatives of h and of k . grad h at q are independent: along k the
first is 0 and the second is not. These are the conditions under which a map of corank
1 has the Morin singularity A_2 [Morin 1965; Saji, Umehara, Yamada 2009, theorem A.1].
QED.

It is k differentiated as a field that counts: with a constant vector in its place (5)
would hold at 0 for (u^4 + u y, y), y = v + u^2, which has no cusp there.

**A true cusp.** Two variables are free, the others stay as they are. Krawczyk's test
(`krawczyk`) for F = (h, k . grad h) in a box of the two proves exactly one zero of F in
it, and (3), (4), (5) are proved on the whole box.

**Derivatives.** Along a direction d the power series h(q + t d) = h + h_d t + h_dd t^2
has h_dd = <d, H d> / 2, H the Hessian, so H_ij = h_(i+j) - h_(i) - h_(j) for unit
vectors. k is differentiated once, along unit vectors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Protocol

from flint import arb, arb_mat, arb_series, ctx

from cuspaudit.certificate.balls import working_precision

__all__ = ["LARGEST_RADIUS_EXPONENT", "CuspBox", "Field", "no_cusp", "true_cusp"]

LARGEST_RADIUS_EXPONENT = -24
"""Boxes reach at most 2^-24 (about 6e-8) to each side of the point."""
_LOOSE_RADIUS_EXPONENT = -1
"""So far where the map is one of many, and each has its cusp elsewhere."""

_SECOND = 3
_FIRST = 2


class Field(Protocol):
    """A map near a point, by the determinant of its Jacobian matrix and a field."""

    @property
    def variables(self) -> Sequence[int]:
        """The variables on which h and k depend, at least two."""

    def determinant(self, q: Sequence[arb_series]) -> arb_series:
        """H = det J."""

    def kernel(self, q: Sequence[arb_series]) -> list[arb_series]:
        """The entries of k in the order of ``variables``."""


@dataclass(frozen=True, slots=True)
class Jet:
    """h and k with their derivatives over a box.

    Attributes:
        h: the determinant.
        slope: grad h.
        bend: its Hessian, by rows.
        k: the field.
        turn: turn[j][i], the derivative of k_i by variable j.
    """

    h: arb
    slope: list[arb]
    bend: list[list[arb]]
    k: list[arb]
    turn: list[list[arb]]

    @property
    def along(self) -> arb:
        """G = k . grad h."""
        return _dot(self.k, self.slope)

    @property
    def along_slope(self) -> list[arb]:
        """Grad g."""
        return [
            _dot(turn, self.slope) + _dot(self.k, bend)
            for turn, bend in zip(self.turn, self.bend, strict=True)
        ]


@dataclass(frozen=True, slots=True)
class CuspBox:
    """A box that holds a true cusp.

    Attributes:
        values: one ball a variable of the map.
        radius: half its side in the two free variables.
        clear: a lower bound of |k . grad(k . grad h)| on it.
    """

    values: tuple[arb, ...]
    radius: float
    clear: arb


def true_cusp(
    field: Field, point: Sequence[arb], bits: int, is_loose: bool = False
) -> CuspBox | str:
    """Prove that a true cusp lies next to ``point``; else why not.

    Args:
        field: of the map, or enclosing those of many maps: then each of them has one
            true cusp in the box.
        point: exact, as balls of radius 0 at the working precision.
        bits: of the working precision.
        is_loose: whether the maps are many.
    """
    largest = _LOOSE_RADIUS_EXPONENT if is_loose else LARGEST_RADIUS_EXPONENT
    with working_precision(bits, _SECOND):
        at = jet(field, point)
        reason = "no cusp is proved near the posture: "
        pair = _free(field, at)
        if pair is None:
            return f"{reason}the conditions on it are not independent there"
        slopes = (at.slope, at.along_slope)
        try:
            inverse = _square(slopes, pair).mid().inv().mid()
        except ZeroDivisionError:
            return f"{reason}the conditions on it are not independent there"
        newton = inverse * arb_mat(2, 1, [at.h, at.along])
        for exponent in _exponents(newton, largest):
            side = arb(0, arb(2) ** exponent)
            box = list(point)
            for k in pair:
                box[field.variables[k]] = point[field.variables[k]] + side
            over = jet(field, box)
            slopes = (over.slope, over.along_slope)
            left = arb_mat(2, 2, [1, 0, 0, 1]) - inverse * _square(slopes, pair)
            moved = left * arb_mat(2, 1, [side, side]) - newton
            if all(e.abs_upper() < arb(2) ** exponent for e in moved.entries()):
                flaw = no_cusp(over)
                if flaw is None:
                    clear = arb(_dot(over.k, over.along_slope).abs_lower())
                    return CuspBox(tuple(box), 2.0**exponent, clear)
                return flaw
    return (
        f"{reason}no common zero of det J and of its derivative along the kernel "
        f"within {2.0**largest:.1g}"
    )


def no_cusp(over: Jet) -> str | None:
    """The first of the conditions (3), (4), (5) that is not proved on a box."""
    if all(entry.contains(0) for entry in over.k):
        return "the rank of J is not proved to drop by one only"
    if all(entry.contains(0) for entry in over.slope):
        return "the gradient of det J is not proved to be different from 0"
    if _dot(over.k, over.along_slope).contains(0):
        return (
            "the second derivative of det J along the kernel is not proved to be "
            "different from 0: this is no simple cusp"
        )
    return None


def jet(field: Field, q: Sequence[arb]) -> Jet:
    """H and k with their derivatives at every point of the balls ``q``.

    The cap of power series is at least 3.
    """
    size = len(field.variables)
    straight = [_along(field, q, (i,)) for i in range(size)]
    bend = [[2 * each[2]] * size for each in straight]
    for i, j in combinations(range(size), 2):
        both = _along(field, q, (i, j))
        bend[i][j] = bend[j][i] = both[2] - straight[i][2] - straight[j][2]
    saved, ctx.cap = ctx.cap, _FIRST
    try:
        fields = [field.kernel(_moved(field, q, (j,))) for j in range(size)]
    finally:
        ctx.cap = saved
    for i in range(size):
        bend[i][i] = 2 * straight[i][2]
    return Jet(
        h=straight[0][0],
        slope=[each[1] for each in straight],
        bend=bend,
        k=[entry[0] for entry in fields[0]],
        turn=[[entry[1] for entry in each] for each in fields],
    )


def _along(field: Field, q: Sequence[arb], directions: tuple[int, ...]) -> arb_series:
    return field.determinant(_moved(field, q, directions))


def _moved(
    field: Field, q: Sequence[arb], directions: tuple[int, ...]
) -> list[arb_series]:
    """The series q + t d, d the sum of some unit vectors."""
    where = {field.variables[i] for i in directions}
    return [arb_series([a, int(k in where)]) for k, a in enumerate(q)]


def _free(field: Field, at: Jet) -> tuple[int, int] | None:
    """The two variables in which the two conditions are most independent."""
    a, b = at.slope, at.along_slope

    def volume(pair: tuple[int, int]) -> arb:
        i, j = pair
        return abs((a[i] * b[j] - a[j] * b[i]).mid())

    pairs = list(combinations(range(len(field.variables)), 2))
    best = max(pairs, key=volume)
    return best if volume(best) > 0 else None


def _square(slopes: tuple[list[arb], list[arb]], pair: tuple[int, int]) -> arb_mat:
    return arb_mat([[slope[k] for k in pair] for slope in slopes])


def _exponents(newton: arb_mat, largest: int) -> range:
    """Exponents of the radii to try: from twice the Newton step upwards."""
    reach = max(float(entry.abs_upper()) for entry in newton.entries())
    if not math.isfinite(reach):
        return range(0)
    start = -ctx.prec // 2
    if reach > 0:
        start = max(start, math.frexp(reach)[1] + 1)
    return range(start, largest + 1)


def _dot(a: Sequence[arb], b: Sequence[arb]) -> arb:
    return sum((x * y for x, y in zip(a, b, strict=True)), arb(0))
