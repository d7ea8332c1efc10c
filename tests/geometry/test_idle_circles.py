from __future__ import annotations

import numpy as np
import pytest

from cuspaudit.algebra.polynomial_text import parse_polynomial
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.idle_circles import Essential, without_idle_circles
from cuspaudit.geometry.routing import morse_graph


def reduced(variables: str, equations: list[str], mapping: list[str]) -> Essential:
    """V of the text without idle circles."""
    ring = Ring(variables.split())
    f = tuple(parse_polynomial(ring, text) for text in equations)
    r = tuple(parse_polynomial(ring, text) for text in mapping)
    variety = PolynomialSystem(ring, f)
    minors = crit(variety, PolynomialMap(ring, r))
    return without_idle_circles(variety, len(r), minors)


def test_the_turn_of_a_first_joint_is_left_out() -> None:
    """A turned Whitney cusp: the turn goes, and the components stay two."""
    turned = reduced(
        "a b x y",
        ["2*a^2 + 2*b^2 - 6"],
        ["a*(x^3 + x*y)", "b*(x^3 + x*y)", "y"],
    )
    assert turned.circles == (("a", "b"),)
    assert turned.variety.ring.variables == ("x", "y")
    assert turned.dimension == 2
    assert len(turned.minors) == 1


@pytest.mark.parametrize(
    ("variables", "equations", "mapping"),
    [
        ("c s x", ["c^2 + s^2 - 1"], ["c", "x"]),
        ("c s x", ["c^2 + s^2 + x^2 - 1"], ["c", "s"]),
        ("c s x", ["c^2 + s^2 - 1", "x - c"], ["x"]),
        ("c s x", ["c^2 - s^2 - 1"], ["c*x", "s*x"]),
        ("c s x", ["2*c^2 + s^2 - 1"], ["c*x", "s*x"]),
        ("x y", [], ["x^2", "y"]),
    ],
)
def test_what_is_no_idle_circle_stays(
    variables: str, equations: list[str], mapping: list[str]
) -> None:
    """Circles on which Delta or an equation depends, hyperbolas and ellipses stay."""
    found = reduced(variables, equations, mapping)
    assert found.variety is found.whole
    assert found.circles == ()


def test_components_are_those_of_the_rest() -> None:
    """The polar map has Delta = x up to the circle: two components, either way."""
    polar = reduced("c s x", ["c^2 + s^2 - 1"], ["c*x", "s*x"])
    assert polar.circles
    count = morse_graph(polar.variety, polar.dimension, polar.minors)
    assert count.number_of_components == 2


def test_a_path_goes_along_and_then_round() -> None:
    """A lifted path begins and ends at the points and stays on the circle."""
    polar = reduced("c s x", ["c^2 + s^2 - 4"], ["c*x", "s*x"])
    first, last = np.array([2.0, 0, 1]), np.array([0, -2.0, 3])
    path = polar.lifted(np.array([[1.0], [2.0], [3.0]]), first, last)
    assert np.allclose(path[0], first)
    assert np.allclose(path[-1], last)
    assert np.allclose(path[:, 0] ** 2 + path[:, 1] ** 2, 4)
    assert np.abs(np.diff(path, axis=0)).max() < 1.1
