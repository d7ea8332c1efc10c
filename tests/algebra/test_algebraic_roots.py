from __future__ import annotations

import random

import pytest
from flint import arb, fmpq_poly, fmpz_poly

from cuspaudit.algebra import algebraic_roots
from cuspaudit.algebra.algebraic_roots import real_roots_over
from cuspaudit.algebra.univariate import RealRoot

SQRT2 = RealRoot(fmpz_poly([-2, 0, 1]), 1)
W = fmpq_poly([0, 1])
ONE = fmpq_poly([1])


def middles(polynomials: list[list[fmpq_poly]], root: RealRoot = SQRT2) -> list[float]:
    """Midpoints of the zeros found."""
    return [float(ball.mid()) for ball in real_roots_over(polynomials, root)]


def times(p: list[fmpq_poly], q: list[fmpq_poly]) -> list[fmpq_poly]:
    """The product of two polynomials in z."""
    product = [fmpq_poly([0])] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            product[i + j] += a * b
    return product


def test_square_root_of_an_irrational_root() -> None:
    """z^2 = sqrt 2 has the two real zeros +-2^(1/4)."""
    low, high = middles([[-W, fmpq_poly([0]), ONE]])
    assert abs(high - 2**0.25) < 1e-12
    assert abs(low + 2**0.25) < 1e-12


def test_a_zero_that_is_double_over_the_root_only_counts_once() -> None:
    """z^2 - 2 w z + 2 = (z - sqrt 2)^2 at w = sqrt 2 has one zero."""
    assert len(middles([[fmpq_poly([2]), -2 * W, ONE]])) == 1


def test_a_zero_common_to_two_polynomials_counts_once() -> None:
    """The polynomials z - w and z^2 - 2 share a zero at w = sqrt 2."""
    found = middles([[-W, ONE], [fmpq_poly([-2]), fmpq_poly([0]), ONE]])
    assert len(found) == 2


def test_a_leading_coefficient_that_vanishes_at_the_root_is_dropped() -> None:
    """(w^2 - 2) z^2 + z - 1 is z - 1 at w = sqrt 2."""
    assert middles([[fmpq_poly([-1]), ONE, W * W - 2]]) == [1.0]


def test_zeros_that_are_not_real_are_left_out() -> None:
    """z^2 + w has no real zero at w = sqrt 2, two at w = -sqrt 2."""
    row = [W, fmpq_poly([0]), ONE]
    assert middles([row]) == []
    assert len(middles([row], RealRoot(fmpz_poly([-2, 0, 1]), 0))) == 2


def test_nearly_equal_zeros_are_told_apart() -> None:
    """The zeros w and w + 10^-40 are two."""
    far = -W - fmpq_poly([1]) / 10**40
    assert len(real_roots_over([times([-W, ONE], [far, ONE])], SQRT2)) == 2


def test_random_products_have_their_factors_zeros() -> None:
    """A product of powers of z - a_i(w) has exactly the distinct a_i(alpha)."""
    chance = random.Random(5)
    cubic = RealRoot(fmpz_poly([-1, -3, 0, 1]), 2)
    for _ in range(20):
        zeros = [
            fmpq_poly([chance.randint(-3, 3) for _ in range(chance.randint(1, 3))])
            for _ in range(chance.randint(1, 4))
        ]
        row = [ONE]
        for zero in zeros:
            for _ in range(chance.randint(1, 3)):
                row = times(row, [-zero, ONE])
        balls = real_roots_over([row, [-zeros[0], ONE]], cubic)
        alpha = cubic.enclosure(128)
        wanted = {tuple(zero.coeffs()): zero for zero in zeros}
        assert len(balls) == len(wanted)
        for zero in wanted.values():
            value = sum((arb(c) * alpha**k for k, c in enumerate(zero)), arb(0))
            assert sum(ball.overlaps(value) for ball in balls) == 1


def test_a_quadratic_on_which_the_iteration_stands_still() -> None:
    """4 z^2 + 73 z + 333 has the zeros -37/4 and -9."""
    row = [fmpq_poly([333]), fmpq_poly([73]), fmpq_poly([4])]
    low, high = middles([row])
    assert abs(low + 9.25) < 1e-12
    assert abs(high + 9) < 1e-12


def test_both_routes_give_the_same_zeros() -> None:
    """Double zeros found from facts about discriminants are those of Euclid."""
    chance = random.Random(2)
    m = fmpq_poly(SQRT2.polynomial)
    quick = 0
    for _ in range(20):
        rows = [
            times(
                [fmpq_poly([chance.randint(-2, 2), chance.randint(-1, 1)]), ONE],
                [fmpq_poly([chance.randint(-2, 2) for _ in range(2)]), -W, ONE],
            )
            for _ in range(2)
        ]
        rows.append([m * chance.randint(0, 1) - W, fmpq_poly([0]), fmpq_poly([3])])
        fast = algebraic_roots._with_double_zeros(rows, SQRT2)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(algebraic_roots, "_with_double_zeros", lambda *_: None)
            slow = real_roots_over(rows, SQRT2)
        if fast is not None:
            quick += 1
            assert len(fast) == len(slow)
            assert all(a.overlaps(b) for a, b in zip(fast, slow, strict=True))
    assert quick > 10


def test_double_zeros_close_together_are_separated_by_precision() -> None:
    """(z - w)^2 (z - w - 10^-40) has two zeros, found without a gcd."""
    near = -W - fmpq_poly([1]) / 10**40
    row = times(times([-W, ONE], [-W, ONE]), [near, ONE])
    found = algebraic_roots._with_double_zeros([row], SQRT2)
    assert found is not None
    assert len(found) == 2
