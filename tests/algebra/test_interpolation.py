from __future__ import annotations

import random

import pytest
from flint import Ordering, fmpz_mpoly_ctx, fmpz_poly

from cuspaudit.algebra.elimination import discriminant
from cuspaudit.algebra.interpolation import discriminant_degree
from cuspaudit.algebra.ring import Polynomial, Ring


def random_curve(ring: Ring, source: random.Random) -> Polynomial:
    """A random curve of degree at most 5 in v, with small integer coefficients."""
    u, v = ring.gens
    units = (1, ring.surd) if ring.radicand else (1,)
    terms = (
        u ** source.randint(0, 4)
        * v ** source.randint(0, 5)
        * source.randint(-9, 9)
        * source.choice(units)
        for _ in range(8)
    )
    return ring.total(terms) + v ** source.randint(1, 5) * (u + 1)


@pytest.mark.parametrize("radicand", [None, 2, 3])
def test_interpolated_discriminant_is_flints(radicand: int | None) -> None:
    """The interpolated discriminant equals FLINT's multivariate one, on every field."""
    ring = Ring(("u", "v"), radicand)
    context = fmpz_mpoly_ctx.get(ring.context.names(), Ordering.lex)
    source = random.Random(radicand or 1)
    for _ in range(25):
        p = random_curve(ring, source)
        whole = context.from_dict({e: c.p for e, c in p.to_dict().items()})
        expected = ring.context.from_dict(whole.discriminant("v").to_dict())
        assert discriminant(ring, p, "v") == ring.reduce(expected)


def test_degree_bound_uses_the_newton_polygon() -> None:
    """The quartic v^4 + u v^2 + u^2 has a discriminant of degree 6 in u."""
    zero = fmpz_poly([0])
    rows = [fmpz_poly([0, 0, 1]), zero, fmpz_poly([0, 1]), zero, fmpz_poly([1])]
    assert discriminant_degree([(row, zero) for row in rows]) == 6
