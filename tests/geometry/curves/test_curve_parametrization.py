"""Parametrizations of curves: degrees, identities, what is refused."""

from __future__ import annotations

import pytest
from flint import fmpq

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import UnableError
from cuspaudit.geometry.curves.parametrization import one_dimensional_parametrization
from cuspaudit.geometry.fibers.generic_fiber import generic_fiber

SPACE = Ring(["x", "y", "z"])
X, Y, Z = SPACE.gens
TWISTED = PolynomialSystem(SPACE, (Y - X**2, Z - X**3))
VIVIANI = PolynomialSystem(SPACE, (X**2 + Y**2 + Z**2 - 4, (X - 1) ** 2 + Y**2 - 1))


@pytest.mark.parametrize(("system", "degree"), [(TWISTED, 3), (VIVIANI, 4)])
def test_the_degree_is_that_of_the_curve(system: PolynomialSystem, degree: int) -> None:
    """A twisted cubic and two quadrics: 3 and 4 points on a plane in general position.

    The image has the same degree, and the equations vanish on the parametrization.
    """
    found = one_dimensional_parametrization(system)
    assert found.degree == found.omega.total_degree() == degree
    assert all(found.numerator(SPACE, f) == 0 for f in system.equations)


def test_points_over_a_value_solve_the_equations() -> None:
    """Over mu = 1/3 all points are on the curve, and as many as the degree."""
    found = one_dimensional_parametrization(VIVIANI, seed=4)
    points = found.over(fmpq(1, 3))
    assert points.degree == 4
    assert all(points.vanishes(SPACE, f) for f in VIVIANI.equations)
    mu = SPACE.total(w * x for w, x in zip(found.forms[1], SPACE.gens, strict=True))
    assert points.vanishes(SPACE, mu - fmpq(1, 3))
    assert found.contains(points)


def test_seeds_choose_other_forms_for_the_same_curve() -> None:
    """The points of one parametrization belong to another."""
    first, second = (one_dimensional_parametrization(TWISTED, s) for s in (1, 2))
    assert first.forms != second.forms
    assert second.contains(first.over(fmpq(2, 7)))


def test_isolated_points_beside_a_curve_are_refused() -> None:
    """The z axis and the point (1, 0, 0): no curve alone."""
    system = PolynomialSystem(SPACE, (X * (X - 1), Y, X * Z))
    with pytest.raises(UnableError):
        one_dimensional_parametrization(system)


def test_a_form_that_does_not_separate_is_passed_over() -> None:
    """On the three axes (1, 1, 2) takes one value at two points of every plane."""
    axes = PolynomialSystem(SPACE, (X * Y, Y * Z, X * Z))
    mapping = PolynomialMap(SPACE, (X + Y - Z,))
    with pytest.raises(UnableError, match="apart"):
        generic_fiber(axes, mapping, forms=[(1, 1, 2)])
    for seed in (8, 11):
        assert one_dimensional_parametrization(axes, seed).degree == 3
