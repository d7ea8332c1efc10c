from __future__ import annotations

import pytest

from cuspaudit.algebra.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.algebra.zero_dimensional import solve_zero_dimensional
from cuspaudit.errors import NotZeroDimensionalError

RING = Ring(["x", "y"])
X, Y = RING.gens


def solved(
    *equations: Polynomial, nonzero: Polynomial | None = None
) -> ZeroDimensionalParametrization:
    """All solutions of the equations where ``nonzero`` does not vanish."""
    return solve_zero_dimensional(PolynomialSystem(RING, equations), nonzero=nonzero)


@pytest.mark.parametrize(
    ("equations", "degree", "real"),
    [
        ((X**2 + Y**2 - 25, 3 * X + 4 * Y), 2, 2),
        ((X**2 + Y**2 + 1, X - Y), 2, 0),
        ((X**2, X * Y, Y**2), 1, 1),
        ((X**3 - Y**2, X * Y), 1, 1),
        (((X - 1) ** 2, (Y**2 - 3 * Y) ** 3), 2, 2),
        ((X**2 - 1, Y**2 - 1), 4, 4),
        ((X**4 - 2, Y**2 - X), 8, 2),
        ((X, X - 1), 0, 0),
        ((X - Y, RING.constant(1)), 0, 0),
        ((X, Y), 1, 1),
    ],
)
def test_points_counted_by_hand(
    equations: tuple[Polynomial, ...], degree: int, real: int
) -> None:
    """Distinct points, complex and real; multiple ones once; the empty set."""
    found = solved(*equations)
    assert (found.degree, len(found.real_points())) == (degree, real)
    assert all(found.vanishes(RING, p) for p in equations)
    assert found.grounds


def test_nonzero_removes_a_curve() -> None:
    """On {xy = 0, x(x-1) = 0, x != 0} only (1, 0) is left of a line and a point."""
    found = solved(X * Y, X * (X - 1), nonzero=X)
    assert found.degree == 1 and found.contains((1, 0))
    assert found.variables == ("x", "y")


def test_infinitely_many_points_are_an_error() -> None:
    """A line, the plane, and a line left by ``nonzero``."""
    for equations, nonzero in (((X * Y,), None), ((), None), ((X * Y,), X)):
        with pytest.raises(NotZeroDimensionalError) as caught:
            solved(*equations, nonzero=nonzero)
        assert caught.value.dimension == (1 if equations else 2)
