"""The open set where a polynomial is not 0, as a closed set in one more variable."""

from __future__ import annotations

from collections.abc import Sequence

from cuspaudit.algebra.ring import Polynomial, Ring

__all__ = ["with_inverse"]


def with_inverse(
    ring: Ring, equations: Sequence[Polynomial], h: Polynomial
) -> tuple[Ring, list[Polynomial]]:
    """The system f = 0, v h = 1 in one more variable v, which comes first.

    Its zeros are those of f with h != 0, each once, with v = 1/h added.

    >>> ring = Ring(["x"])
    >>> larger, system = with_inverse(ring, [], ring.gen("x") + 1)
    >>> larger, system
    (Q[v, x], [v*x + v - 1])
    """
    name = "v"
    while name in ring.variables:
        name += "v"
    larger = Ring([name, *ring.variables], ring.radicand)
    *lifted, other = (larger.from_other(p, ring) for p in (*equations, h))
    return larger, [*lifted, larger.gen(name) * other - 1]
