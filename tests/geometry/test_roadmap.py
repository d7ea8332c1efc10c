from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from flint import fmpq

from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import PrecisionError, UnableError
from cuspaudit.geometry.roadmap import Roadmap, roadmap

LINE, PLANE, SPACE = Ring(["x"]), Ring(["x", "y"]), Ring(["x", "y", "z"])
(W,) = LINE.gens
X, Y = PLANE.gens
A, B, C = SPACE.gens


def roads_of(
    ring: Ring, equations: list[Polynomial], mapping: list[Polynomial]
) -> Roadmap:
    """The roadmap of a variety and a map."""
    return roadmap(
        PolynomialSystem(ring, tuple(equations)), PolynomialMap(ring, tuple(mapping))
    )


def joined_sheets(roads: Roadmap) -> bool:
    """Whether two sheets over one cell are connected: the map is cuspidal."""
    return any(
        roads.components[a] == roads.components[b]
        for cell in roads.cells.samples
        for a, b in combinations(roads.sheets(cell), 2)
    )


MAPS: dict[str, tuple[Ring, list[Polynomial], list[Polynomial], int, bool]] = {
    "cubic on the line": (LINE, [], [W**3 - 3 * W], 3, False),
    "critical without a fold": (LINE, [], [W**3], 2, False),
    "fold": (PLANE, [], [X**2, Y], 2, False),
    "Whitney cusp": (PLANE, [], [X**3 + X * Y, Y], 2, True),
    "complex square": (PLANE, [], [X**2 - Y**2, 2 * X * Y], 1, True),
    "not proper": (PLANE, [], [X, X * Y**2], 4, False),
    "blow-up": (PLANE, [], [X, X * Y], 2, False),
    "hyperbola": (PLANE, [X * Y - 1], [X], 2, False),
    "figure eight": (PLANE, [X**4 - X**2 + Y**2], [X], 4, False),
    "cross": (PLANE, [X * Y], [X + Y], 4, False),
    "cross with a line without rank": (PLANE, [X * Y], [X], 2, False),
    "sphere": (SPACE, [A**2 + B**2 + C**2 - 1], [A, B], 2, False),
    "torus from the side": (
        SPACE,
        [(A**2 + B**2 + C**2 + 3) ** 2 - 16 * (A**2 + B**2)],
        [A, C],
        4,
        False,
    ),
    "no real point": (PLANE, [X**2 + Y**2 + 1], [X], 0, False),
    "umbrella, singular over a wall": (SPACE, [A**2 - B**2 * C], [A, C], 4, False),
    "two planes, singular over walls": (SPACE, [C * (C - A * B)], [A, B], 8, False),
    "cusp in space": (SPACE, [], [A**3 + A * B, B, C], 2, True),
    "square in space": (SPACE, [], [A**2 - B**2, 2 * A * B, C], 1, True),
}


@pytest.mark.parametrize("name", MAPS)
def test_components_and_verdicts_known_by_hand(name: str) -> None:
    """The components of V - {Delta = 0} are counted and told apart."""
    ring, equations, mapping, count, cuspidal = MAPS[name]
    roads = roads_of(ring, equations, mapping)
    assert roads.number_of_components == count
    assert joined_sheets(roads) is cuspidal


@pytest.mark.parametrize("turn", [(1, 1, 0, 1), (2, 1, -1, 1), (0, 1, 1, 0)])
def test_coordinates_of_the_values_do_not_matter(turn: tuple[int, ...]) -> None:
    """A linear change of the values of the Whitney cusp keeps its two components."""
    a, b, c, d = turn
    u, v = X**3 + X * Y, Y
    roads = roads_of(PLANE, [], [a * u + b * v, c * u + d * v])
    assert roads.number_of_components == 2
    assert joined_sheets(roads)


def test_points_are_placed_on_their_components() -> None:
    """In the cusp, 3x^2 + y tells the components apart, at algebraic points too."""
    roads = roads_of(PLANE, [], [X**3 + X * Y, Y])
    inside = [(fmpq(0), fmpq(-1)), (fmpq(1, 10), fmpq(-1, 2))]
    outside = [(fmpq(0), fmpq(1)), (fmpq(2), fmpq(-1)), (fmpq(-2), fmpq(-1))]
    algebraic = solve_zero_dimensional(
        PolynomialSystem(PLANE, (X**2 - 2, Y + 1))
    ).real_points()
    points = [*inside, *outside, *algebraic]
    parts = [roads.component(point) for point in points]
    assert parts == [parts[0]] * 2 + [parts[2]] * 5
    assert parts[0] != parts[2]
    assert roads.connected(outside[1], outside[2])
    assert not roads.connected(inside[0], outside[0])


def test_a_point_over_a_wall_is_placed() -> None:
    """(-2, -3) lies over the curve of critical values and is no critical point."""
    roads = roads_of(PLANE, [], [X**3 + X * Y, Y])
    assert roads.fiber.is_regular((fmpq(-2), fmpq(-3))) is False
    assert roads.connected((fmpq(-2), fmpq(-3)), (fmpq(0), fmpq(1)))


def test_a_critical_point_is_refused() -> None:
    """A point with Delta = 0 has no component."""
    with pytest.raises(PrecisionError):
        roads_of(PLANE, [], [X**2, Y]).component((0, 0))


def test_a_path_goes_round_the_cusp_and_is_proved() -> None:
    """The path between two points of one fiber keeps 3x^2 + y > 0."""
    roads = roads_of(PLANE, [], [X**3 + X * Y, Y])
    first, second = (fmpq(2), fmpq(-4)), (fmpq(-2), fmpq(-4))
    x, y = roads.path(first, second).T
    assert (x[0], y[0], x[-1], y[-1]) == (2, -4, -2, -4)
    assert np.all(3 * x**2 + y > 0)
    steps = roads.continuation(first, second).boxes
    assert all(3 * a * a + b > 0 for a, b in steps)


def test_the_time_limit_names_the_step() -> None:
    """Too little time is an error, not a smaller graph."""
    with pytest.raises(UnableError, match="atypical_values"):
        roadmap(PolynomialSystem(PLANE), PolynomialMap(PLANE, (X**2, Y)), timeout=0)


def test_steps_are_reported() -> None:
    """The names of the steps are given in the order of the paper."""
    seen: list[str] = []
    roadmap(PolynomialSystem(LINE), PolynomialMap(LINE, (W**2,)), progress=seen.append)
    assert seen == [
        *("atypical_values", "sample_points_rational"),
        *("sample_points", "graph_isotop"),
    ]
