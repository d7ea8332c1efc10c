"""Critical points of a product, in the unknowns of its factors."""

from __future__ import annotations

from dataclasses import replace

from flint import fmpq

from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.heights.factored_system import factored_system
from cuspaudit.geometry.heights.height import Height, critical_system, plain_height


def height_of(ring: Ring, base: Polynomial, decay: int) -> Height:
    """Log P^2 - decay log W, with a weight about a skew center."""
    weight = 1 + ring.total((x - fmpq(k, 7)) ** 2 for k, x in enumerate(ring.gens, 1))
    return replace(plain_height(ring, [base]), weight=weight, decay=decay)


def test_it_has_the_points_of_the_numerators() -> None:
    """A sphere, a plane twice and two slabs: as many points as with P inverted."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    base = (x**2 + y**2 - 4) * (x + y - 1) ** 2 * (2 - x) * (x + 1)
    height = height_of(ring, base, 8)
    system = factored_system(height)
    assert system is not None
    assert system.ring.variables == ("x", "y", "u0", "u1", "w")
    plain = critical_system(PolynomialSystem(ring), 2, height)
    found = solve_zero_dimensional(system, variables=("x", "y"))
    other = solve_zero_dimensional(plain, nonzero=base)
    assert found.variables == ("x", "y")
    assert found.degree == other.degree > 10
    places = [
        sorted(tuple(float(p.ball(64)[n].mid()) for n in "xy") for p in s.real_points())
        for s in (found, other)
    ]
    assert all(
        abs(a - b) < 1e-12
        for first, second in zip(*places, strict=True)
        for a, b in zip(first, second, strict=True)
    )


def test_one_factor_gains_nothing() -> None:
    """A power of an irreducible polynomial has no factored system."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    assert factored_system(height_of(ring, (x**2 + y**2 - 1) ** 2, 3)) is None


def test_names_in_use_are_left_alone() -> None:
    """A variable w of the space keeps its name."""
    ring = Ring(["w", "u0"])
    w, u = ring.gens
    system = factored_system(height_of(ring, (w + u) * (w * u - 1), 3))
    assert system is not None
    assert len(set(system.ring.variables)) == 5
