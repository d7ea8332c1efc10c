from __future__ import annotations

import numpy as np
import pytest
from flint import arb, fmpq
from surfaces import arm_map, cylinder, decided, plane

from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.geometry.crit import crit


@pytest.mark.parametrize("alpha", [(-90, 90, 0), (-30, 90, 0), (70, 110, 0)])
def test_critical_values_are_atypical(alpha: tuple[int, ...]) -> None:
    """At values of critical postures, found numerically, the product of g vanishes."""
    pair = arm_map((1, 2, "3/2"), (0, 1, 0), alpha)
    variety, mapping = pair
    decision = decided(pair)
    ring = decision.fibers.ring
    (delta,) = crit(*pair)
    theta3 = np.linspace(-3, 3, 41)

    def at(theta2: np.ndarray, polynomials: object) -> np.ndarray:
        columns = (np.cos(theta2), np.sin(theta2), np.cos(theta3), np.sin(theta3))
        return numeric_values(variety.ring, polynomials, np.stack(columns, axis=1))

    ahead, back, side = (
        at(np.full(41, t), [delta])[:, 0] for t in (0, np.pi, np.pi / 2)
    )
    P, S = (ahead - back) / 2, (ahead + back) / 2
    Q = side - S
    inside = np.abs(S) < 0.99 * np.hypot(P, Q)
    turn = np.arccos(np.where(inside, -S / np.hypot(P, Q), 0))
    values = at(np.arctan2(Q, P) + turn, mapping.components)[inside]
    assert len(values) > 10
    for u, v in values:
        here, beside = (
            min(_relative(ring, g, u + du, v) for g in decision.atypical)
            for du in (0.0, 0.05)
        )
        assert here < 1e-9
        assert here < 1e-4 * max(beside, 1e-300) or beside < 1e-9


def _relative(ring: object, g: object, u: float, v: float) -> float:
    """The value of g over the sum of the sizes of its terms."""
    value = float(ring.evaluate(g, {"u": arb(u), "v": arb(v)}).mid())
    sizes = ring.context.from_dict({k: abs(c) for k, c in g.to_dict().items()})
    scale = ring.evaluate(sizes, {"u": arb(abs(u)), "v": arb(abs(v))})
    return abs(value) / float(scale.mid())


def test_values_where_the_map_is_not_proper() -> None:
    """(x, x y^2) is not proper over u = 0; v = 0 is critical."""
    decision = decided(plane(lambda x, y: (x, x * y**2)))
    ring = decision.fibers.ring
    zeros = [
        [fmpq(0), fmpq(3)],
        [fmpq(2), fmpq(0)],
    ]
    for u, v in zeros:
        values = [ring.substitute(g, {"u": u, "v": v}) for g in decision.atypical]
        assert any(value == 0 for value in values)
    assert all(ring.substitute(g, {"u": 1, "v": 1}) != 0 for g in decision.atypical)


def test_atypical_values_of_a_slider() -> None:
    """(c q, s q) is critical at q = 0: the origin, and nothing else, is atypical."""
    decision = decided(cylinder(lambda c, s, q: (c * q, s * q)))
    ring = decision.fibers.ring
    for g in decision.atypical:
        origin = ring.substitute(g, {"u": 0, "v": 0})
        assert origin == 0
