"""A bound on the number of points of all fibers of a map, from one of them.

**Theorem.** Let q in Q^d be such that no r_j - q_j has lost its constant term, and let
`algebra.points.macaulay.multiples_bound` prove from multiples of f and r_j - q_j that
dim Q[x] / <f, R - q> <= N. Then every fiber of R on V has at most N points at which
jac(f, R) has rank n.

*Proof.* The multiples are those of f and r_j - y_j over Q[y], specialised at y = q
(of an angle, over the functions on the circle); they have the same monomials, as only
constant terms depend on y. A minor of their matrix that is not 0 at q modulo a prime is
not 0, so the lemma of that module holds over the field of these functions with the
same sets of monomials: a generic fiber has N points at
most. Points where jac(f, R) has rank n are isolated and simple; each goes on to the
fibers over nearby values, complex ones too, and so to generic ones. QED
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from cuspaudit.algebra.points.macaulay import multiples_bound
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem

__all__ = ["has_degree_at_most"]


def has_degree_at_most(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    value: Sequence[fmpq],
    points: int,
    seconds: float,
) -> bool:
    """Whether it was proved that no fiber of R has more regular points than so many.

    Args:
        variety: V = {f = 0} over Q.
        mapping: R.
        value: q, whose fiber has finitely many points.
        points: N.
        seconds: for the proof; it may take somewhat longer.
    """
    moved = mapping.over(value)
    constant = (0,) * len(variety.ring.context.names())
    if variety.ring.radicand is not None:
        return False
    if any(constant not in p.to_dict() for p in moved):
        return False
    equations = [p for p in variety.equations if p != 0]
    return multiples_bound(variety.ring, [*equations, *moved], points, seconds)
