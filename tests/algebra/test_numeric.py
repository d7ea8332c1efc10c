from __future__ import annotations

import numpy as np
from flint import arb, fmpq

from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.algebra.ring import Ring


def test_values_agree_with_ball_arithmetic() -> None:
    """The vectorised values are those of FLINT's balls, sqrt 3 included."""
    ring = Ring(["c", "s", "q"], radicand=3)
    c, s, q = ring.gens
    p = fmpq(2, 3) * c**2 * s - ring.surd * q**3 + ring.surd * c - 5
    points = np.random.default_rng(0).uniform(-2, 2, (7, 3))
    values = numeric_values(ring, [p, ring.constant(0)], points)
    for point, (value, zero) in zip(points, values, strict=True):
        balls = dict(zip(ring.variables, map(arb, map(float, point)), strict=True))
        assert abs(float(ring.evaluate(p, balls).mid()) - value) < 1e-13
        assert zero == 0
