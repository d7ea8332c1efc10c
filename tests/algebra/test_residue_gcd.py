from __future__ import annotations

import random

import pytest
from flint import fmpq, fmpq_poly

from cuspaudit.algebra import residue_gcd
from cuspaudit.algebra.residue_gcd import Row, common_degree, divided, monic_gcd

CUBIC = fmpq_poly([-1, -3, 0, 1])
ONE = fmpq_poly([1])


def times(p: Row, q: Row, m: fmpq_poly = CUBIC) -> Row:
    """The product over Q(alpha)."""
    product = [fmpq_poly([0])] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            product[i + j] = (product[i + j] + a * b) % m
    return product


def monic(chance: random.Random, degree: int, size: int) -> Row:
    """A random monic polynomial."""
    return [
        *(
            fmpq_poly(
                [fmpq(chance.randint(-size, size), chance.randint(1, 9))] * k
                + [chance.randint(-size, size)]
            )
            for k in (chance.randint(0, 2) for _ in range(degree))
        ),
        ONE,
    ]


@pytest.mark.parametrize("size", [3, 10**12, 10**90])
def test_the_common_factor_comes_back(size: int) -> None:
    """gcd(g a, g b) = g for random a, b, whatever the length of the coefficients."""
    chance = random.Random(size)
    for degree in (0, 1, 2, 4):
        g, a, b = (monic(chance, d, size) for d in (degree, 3, 2))
        lead = [fmpq_poly([0, fmpq(2, 3), 5])]
        p, q = times(times(g, a), lead), times(g, b)
        assert common_degree(p, q, CUBIC) == degree
        assert monic_gcd(p, q, CUBIC) == g


def test_zero_has_the_other_as_gcd() -> None:
    """gcd(p, 0) = p made monic."""
    p = [fmpq_poly([2]), fmpq_poly([0, 2])]
    assert times(monic_gcd(p, [], CUBIC), [fmpq_poly([0, 2])]) == p


def test_division_is_exact() -> None:
    """Here p = q * quotient + rest with a rest of smaller degree."""
    chance = random.Random(3)
    q, a, rest = (monic(chance, d, 9) for d in (3, 4, 1))
    p = times(q, a)
    for k, c in enumerate(rest):
        p[k] = (p[k] + c) % CUBIC
    assert divided(p, q, CUBIC) == (a, rest)


def test_primes_on_which_euclid_goes_wrong_are_left_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Small primes, which divide denominators and split m, give the same gcd."""
    monkeypatch.setattr(residue_gcd, "_LARGEST", 4001)
    chance = random.Random(7)
    g, a, b = (monic(chance, d, 50) for d in (2, 2, 1))
    a[0] += fmpq_poly([fmpq(1, 4001), fmpq(1, 3989)])
    assert monic_gcd(times(g, a), times(g, b), CUBIC) == g


def test_a_prime_with_a_larger_gcd_is_found_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Coprime z and z + 4001 are told apart, though equal modulo the first prime."""
    monkeypatch.setattr(residue_gcd, "_LARGEST", 4001)
    p, q = [fmpq_poly([0]), ONE], [fmpq_poly([4001]), ONE]
    assert common_degree(p, q, CUBIC) == 1
    assert monic_gcd(p, q, CUBIC) == [ONE]
