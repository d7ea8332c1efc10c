"""Random small varieties and maps, by seed: the same seed gives the same system."""

from __future__ import annotations

import random
from itertools import combinations_with_replacement
from math import prod

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem

__all__ = ["KINDS", "random_system"]

KINDS = ("line", "curve", "plane", "graph", "quadric", "space")


def random_system(kind: str, seed: int) -> tuple[PolynomialSystem, PolynomialMap]:
    """V and R of a kind.

    Args:
        kind: "line", polynomials on R; "curve", conics and cubics with a form;
            "plane", pairs of quadratic polynomials; "graph", (p, y) with a cubic p;
            "quadric", quadric surfaces with two forms of degree 1 or 2; "space",
            (p, y, z) with a quadratic p.
        seed: any integer.
    """
    chance = random.Random(f"{kind} {seed}")
    return {
        "line": _line,
        "curve": _curve,
        "plane": _plane,
        "graph": _graph,
        "quadric": _quadric,
        "space": _space,
    }[kind](chance)


def _polynomial(
    chance: random.Random, ring: Ring, degree: int, density: float = 0.7
) -> Polynomial:
    monomials = [
        prod(factors, start=ring.constant(1))
        for d in range(degree + 1)
        for factors in combinations_with_replacement(ring.gens, d)
    ]
    chosen = [m for m in monomials if chance.random() < density]
    return ring.total(chance.choice((-3, -2, -1, 1, 2, 3)) * m for m in chosen)


def _form(chance: random.Random, ring: Ring) -> Polynomial:
    return ring.total(chance.randint(-3, 3) * g for g in ring.gens) + ring.gens[0]


def _line(chance: random.Random) -> tuple[PolynomialSystem, PolynomialMap]:
    ring = Ring(["x"])
    p = _polynomial(chance, ring, chance.randint(2, 7)) + ring.gens[0] ** 2
    return PolynomialSystem(ring), PolynomialMap(ring, (p,))


def _curve(chance: random.Random) -> tuple[PolynomialSystem, PolynomialMap]:
    ring = Ring(["x", "y"])
    x, y = ring.gens
    f = _polynomial(chance, ring, chance.randint(2, 3)) + x * x + y * y - 2
    return PolynomialSystem(ring, (f,)), PolynomialMap(ring, (_form(chance, ring),))


def _plane(chance: random.Random) -> tuple[PolynomialSystem, PolynomialMap]:
    ring = Ring(["x", "y"])
    components = tuple(_polynomial(chance, ring, 2) for _ in range(2))
    return PolynomialSystem(ring), PolynomialMap(ring, components)


def _graph(chance: random.Random) -> tuple[PolynomialSystem, PolynomialMap]:
    ring = Ring(["x", "y"])
    p = _polynomial(chance, ring, 3) + ring.gens[0] ** 3
    return PolynomialSystem(ring), PolynomialMap(ring, (p, ring.gens[1]))


def _quadric(chance: random.Random) -> tuple[PolynomialSystem, PolynomialMap]:
    ring = Ring(["x", "y", "z"])
    x, y, z = ring.gens
    f = x * x + chance.choice((-1, 1, 2)) * y * y + chance.choice((-1, 1, 3)) * z * z
    f += chance.randint(-2, 2) * x * y - chance.choice((1, 2))
    second = _polynomial(chance, ring, 2, 0.3) if chance.random() < 0.3 else z + y
    components = (_form(chance, ring), second)
    return PolynomialSystem(ring, (f,)), PolynomialMap(ring, components)


def _space(chance: random.Random) -> tuple[PolynomialSystem, PolynomialMap]:
    ring = Ring(["x", "y", "z"])
    x, y, z = ring.gens
    p = _polynomial(chance, ring, 2, 0.5) + x * x
    return PolynomialSystem(ring), PolynomialMap(ring, (p, y, z))
