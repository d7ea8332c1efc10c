from __future__ import annotations

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem


def test_dimensions() -> None:
    """A complete intersection of s equations in n variables has dimension n - s."""
    ring = Ring(["c", "s", "x"])
    c, s, x = ring.gens
    assert PolynomialSystem(ring).dimension == 3
    assert PolynomialSystem(ring, (c**2 + s**2 - 1,)).dimension == 2
    assert PolynomialMap(ring, (x,)).components == (x,)
