"""Signs of the factors of det J over boxes."""

from __future__ import annotations

import math

import numpy as np
from flint import arb
from short_tables import arm, with_wrist

from cuspaudit.algebra.numeric import NumericPolynomial
from cuspaudit.kinematics.determinant import determinant_factors
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.factor_signs import factor_signs

SIX = exact_model(with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))))


def test_signs_are_those_of_points_of_the_box() -> None:
    """Where a sign is proved every point has it; points have one of every factor."""
    factors = [NumericPolynomial(SIX.ring, g) for g, _ in determinant_factors(SIX)]
    signs, rng = factor_signs(SIX), np.random.default_rng(2)
    proved = 0
    for _ in range(20):
        q = rng.uniform(-math.pi, math.pi, 6)
        found = signs([arb(v, 0.05) for v in q])
        assert len(found) == len(factors) > 1
        for moved in q + rng.uniform(-0.05, 0.05, (5, 6)):
            angles = moved + SIX.zeros
            point = np.stack([np.cos(angles), np.sin(angles)], 1).reshape(1, -1)
            for sign, factor in zip(found, factors, strict=True):
                assert sign in (0, np.sign(factor(point)[0]))
        proved += sum(map(abs, found))
    assert proved > 20


def test_one_factor_says_no_more_than_det_j() -> None:
    """Where det J does not factor, no signs are given."""
    three = exact_model(arm((1, 2, "3/2"), (0, 1, "1/2"), (-60, 60, 0)))
    assert len(determinant_factors(three)) == 1
    assert factor_signs(three)([arb(0)] * 3) == ()
