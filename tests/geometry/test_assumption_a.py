from __future__ import annotations

import random
from itertools import combinations_with_replacement

import pytest

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import (
    AssumptionError,
    NotEquidimensionalError,
    NotRadicalError,
    RealPartSingularError,
    UnableError,
)
from cuspaudit.geometry.assumption_a import check_assumption_a

SPACE = Ring(["x", "y", "z"])
X, Y, Z = SPACE.gens
PLANE = Ring(["x", "y"])
U, V = PLANE.gens
NORM = X**2 + Y**2 + Z**2
CUBIC = (Y - X**2, Z - X**3, X * Z - Y**2)


@pytest.mark.parametrize(
    ("system", "dimension"),
    [
        (PolynomialSystem(PLANE), 2),
        (PolynomialSystem(SPACE, (NORM - 1,)), 2),
        (PolynomialSystem(SPACE, ((NORM + 3) ** 2 - 16 * (X**2 + Y**2),)), 2),
        (PolynomialSystem(SPACE, (X**2 + Y**2 - Z**2,)), 2),
        (PolynomialSystem(SPACE, (X**2 - Z * Y**2,)), 2),
        (PolynomialSystem(PLANE, (V**2 - U**2 * (U + 1),)), 1),
        (PolynomialSystem(PLANE, (V**2 - U**2 * (U - 1),)), 1),
        (PolynomialSystem(PLANE, (V**2 - U**3,)), 1),
        (PolynomialSystem(PLANE, (100 * U**2 + 100 * V**2 - 1,)), 1),
        (PolynomialSystem(SPACE, CUBIC), 1),
        (PolynomialSystem(SPACE, (NORM - 1, 2 * NORM - 2)), 2),
        (PolynomialSystem(PLANE, (U**2 - 2, V**2 - 3)), 0),
        (PolynomialSystem(PLANE, (U**2 - 2, V**2 - 3, (V**2 - 3) * U)), 0),
        (PolynomialSystem(PLANE, (U * V,)), 1),
    ],
)
def test_what_satisfies_it_passes(system: PolynomialSystem, dimension: int) -> None:
    """R^2, sphere, torus, cone, umbrella, node, isolated point, cusp, twisted cubic."""
    check_assumption_a(system, dimension)


@pytest.mark.parametrize(
    ("system", "dimension"),
    [
        (PolynomialSystem(PLANE, (U**2,)), 1),
        (PolynomialSystem(PLANE, (U**2 * V,)), 1),
        (PolynomialSystem(SPACE, ((NORM - 1) ** 2,)), 2),
        (PolynomialSystem(SPACE, (X**2 + Y**2 - 1, X - 1)), 1),
        (PolynomialSystem(PLANE, (U**2, V)), 0),
        (PolynomialSystem(PLANE, (U**2, U * V, V**2)), 0),
        (PolynomialSystem(PLANE, (U**2, U**2 * V)), 1),
    ],
)
def test_multiple_components_are_not_radical(
    system: PolynomialSystem, dimension: int
) -> None:
    """Double lines, spheres and points, a tangent plane of a cylinder."""
    with pytest.raises(NotRadicalError, match="not reduced"):
        check_assumption_a(system, dimension)


@pytest.mark.parametrize(
    ("system", "dimension", "found"),
    [
        (PolynomialSystem(SPACE, (X * Y, X * Z)), 2, None),
        (PolynomialSystem(SPACE, (X * Y, X * Z)), 1, 2),
        (PolynomialSystem(PLANE, (U * (U - 1), U * V)), 1, None),
        (PolynomialSystem(PLANE, (U * (U - 1), (U - 1) * V**2)), 1, None),
        (PolynomialSystem(PLANE, (U, U - 1)), 0, -1),
        (PolynomialSystem(PLANE, (PLANE.constant(1),)), 1, -1),
        (PolynomialSystem(PLANE), 1, 2),
        (PolynomialSystem(PLANE, (U,)), 0, 1),
        (PolynomialSystem(SPACE, CUBIC), 2, 1),
    ],
)
def test_other_dimensions_are_named(
    system: PolynomialSystem, dimension: int, found: int | None
) -> None:
    """A plane and a line, a line and a point (simple or fat), nothing, too much."""
    with pytest.raises(NotEquidimensionalError) as caught:
        check_assumption_a(system, dimension)
    assert (caught.value.expected, caught.value.found) == (dimension, found)
    assert isinstance(caught.value, AssumptionError)


@pytest.mark.parametrize(
    ("system", "dimension"),
    [
        (PolynomialSystem(PLANE, (U**2 + V**2,)), 1),
        (PolynomialSystem(PLANE, (U**2 + V**2 + 1,)), 1),
        (PolynomialSystem(PLANE, ((U**2 + V**2) ** 2 + (U - V) ** 2,)), 1),
        (PolynomialSystem(SPACE, (X**2 + Y**2,)), 2),
        (PolynomialSystem(PLANE, (U**2 + 1, V)), 0),
    ],
)
def test_no_regular_real_point(system: PolynomialSystem, dimension: int) -> None:
    """Complex curves through one real point or none; a line that is all singular."""
    with pytest.raises(RealPartSingularError, match="no regular real point"):
        check_assumption_a(system, dimension)


def test_a_singular_cone_given_by_too_many_equations_is_not_decided() -> None:
    """The cone over the twisted cubic fits (A); it is undecided, by name."""
    ring = Ring(["a", "b", "c", "d"])
    a, b, c, d = ring.gens
    cone = PolynomialSystem(ring, (a * c - b**2, a * d - b * c, b * d - c**2))
    with pytest.raises(UnableError, match="embedded components are not excluded"):
        check_assumption_a(cone, 2)


def test_the_sign_of_the_square_root_matters() -> None:
    """Over Q(sqrt 2), x^2 = sqrt2 y^2 + 1 is a curve; x^2 = -sqrt2 (y^2 + 1) is empty.

    The conjugate of the second is a real hyperbola: only sqrt 2 > 0 counts.
    """
    ring = Ring(["x", "y"], radicand=2)
    x, y = ring.gens
    check_assumption_a(PolynomialSystem(ring, (x**2 - ring.surd * y**2 - 1,)), 1)
    with pytest.raises(RealPartSingularError):
        check_assumption_a(PolynomialSystem(ring, (x**2 + ring.surd * (y**2 + 1),)), 1)


def test_linkages_satisfy_it() -> None:
    """A five-bar by its loop equations (d = 2) and three joints' torus (d = 3)."""
    ring = Ring(["c", "s", "C", "S", "x", "y"])
    c, s, big_c, big_s, x, y = ring.gens
    circles = (c**2 + s**2 - 1, big_c**2 + big_s**2 - 1)
    legs = (
        (x - c) ** 2 + (y - s) ** 2 - 3,
        (x - 2 - big_c) ** 2 + (y - big_s) ** 2 - 3,
    )
    check_assumption_a(PolynomialSystem(ring, (*circles, *legs)), 2)
    check_assumption_a(PolynomialSystem(ring, (*circles, x**2 + y**2 - 1)), 3)


def test_a_five_bar_that_folds_flat_is_only_singular_there() -> None:
    """Legs that can align make V singular at real points and regular at others."""
    ring = Ring(["c", "s", "C", "S"])
    c, s, big_c, big_s = ring.gens
    loop = (c + 2 - big_c) ** 2 + (s - big_s) ** 2 - 4
    circles = (c**2 + s**2 - 1, big_c**2 + big_s**2 - 1)
    check_assumption_a(PolynomialSystem(ring, (*circles, loop)), 1)


@pytest.mark.slow
def test_a_curve_of_four_quadrics_in_five_dimensions() -> None:
    """Dense equations: that no point is singular needs no Groebner basis."""
    ring = Ring(["a", "b", "c", "d", "e"])
    chance = random.Random(1)
    quadrics = []
    for _ in range(4):
        terms = [p * q for p, q in combinations_with_replacement(ring.gens, 2)]
        terms += [*ring.gens, ring.constant(1)]
        quadrics.append(ring.total(chance.randint(-3, 3) * term for term in terms))
    check_assumption_a(PolynomialSystem(ring, tuple(quadrics)), 1)
    with pytest.raises(NotEquidimensionalError):
        check_assumption_a(PolynomialSystem(ring, tuple(quadrics)), 2)
