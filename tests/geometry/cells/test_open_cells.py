from __future__ import annotations

import random
from collections.abc import Sequence
from itertools import permutations

import networkx as nx
import pytest
from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.geometry.cells.open_cells import OpenCells, open_cells

PLANE = Ring(["x", "y"])
X, Y = PLANE.gens
SPACE = Ring(["x", "y", "z"])
A, B, C = SPACE.gens

CURVES: dict[str, tuple[list[Polynomial], int]] = {
    "nothing": ([], 1),
    "a constant": ([PLANE.constant(3)], 1),
    "circle": ([X**2 + Y**2 - 1], 2),
    "cross": ([X, Y], 4),
    "cross as one product": ([X * Y], 4),
    "three lines": ([X, Y, X + Y - 1], 7),
    "nodal cubic": ([Y**2 - X**2 * (X + 1)], 3),
    "cuspidal cubic": ([Y**2 - X**3], 2),
    "two ovals": ([Y**2 + (X**2 - 1) * (X**2 - 4)], 3),
    "hyperbola": ([X * Y - 1], 3),
    "two branches that meet at infinity": ([Y * X**2 - 1], 3),
    "vertical line and circle": ([X, X**2 + Y**2 - 1], 4),
    "a point": ([X**2 + Y**2], 1),
    "cubic with an isolated point": ([Y**2 - X**2 * (X - 1)], 2),
    "lemniscate": ([(X**2 + Y**2) ** 2 - X**2 + Y**2], 3),
    "repeated": ([(X**2 + Y**2 - 1) ** 2 * X], 4),
    "tangent circles": ([X**2 + Y**2 - 1, (X - 2) ** 2 + Y**2 - 1], 3),
    "osculating parabolas": ([Y - X**2, Y - X**2 - X**4], 4),
    "two circles, 1e-6 apart": (
        [X**2 + Y**2 - 1, (X**2 + Y**2 - 1) * 10**6 - 1],
        3,
    ),
}
SURFACES: dict[str, tuple[list[Polynomial], int]] = {
    "sphere": ([A**2 + B**2 + C**2 - 1], 2),
    "coordinate planes": ([A * B * C], 8),
    "cone": ([A**2 + B**2 - C**2], 3),
    "cylinder along y": ([C**2 - A], 2),
    "cylinder along z": ([B**2 - A], 2),
    "a line": ([A**2 + B**2], 1),
    "two surfaces that touch along every line over x = 0": (
        [(C - B) ** 2 - A, (C + B) ** 2 - A],
        6,
    ),
    "Whitney umbrella": ([A**2 - B**2 * C], 3),
    "hyperboloid of two sheets": ([C**2 - A**2 - B**2 - 1], 3),
    "x y z = 1": ([A * B * C - 1], 5),
}


def at(p: Polynomial, names: Sequence[str], point: Sequence[fmpq]) -> fmpq:
    """The value of a polynomial at a rational point."""
    value = PLANE.substitute(p, dict(zip(names, point, strict=True)))
    return value.leading_coefficient() if value != 0 else fmpq(0)


def components(cells: OpenCells) -> int:
    """The number of components of the complement: passages join cells."""
    graph: nx.Graph[tuple[int, ...]] = nx.Graph()
    graph.add_nodes_from(cells.samples)
    graph.add_edges_from(c.cells for c in cells.contacts if not c.is_wall)
    return nx.number_connected_components(graph)


@pytest.mark.parametrize("name", CURVES)
def test_complements_of_plane_curves(name: str) -> None:
    """Passages join exactly the cells of one component, along either axis."""
    polynomials, count = CURVES[name]
    for order in permutations(("x", "y")):
        assert components(open_cells(PLANE, polynomials, order)) == count


@pytest.mark.parametrize("name", SURFACES)
def test_complements_of_surfaces(name: str) -> None:
    """Passages join exactly the cells of one component, in every order of axes."""
    polynomials, count = SURFACES[name]
    for order in permutations(("x", "y", "z")):
        assert components(open_cells(SPACE, polynomials, order)) == count


@pytest.mark.parametrize("order", [("x", "y"), ("y", "x")])
def test_the_trap_of_a_section_that_runs_to_infinity(order: tuple[str, str]) -> None:
    """{D > 0} has three components, where a published decomposition counts five."""
    curve = X**2 * Y**2 + 2 * X**2 * Y - X**2 - Y**2 - 6 * Y + 1
    cells = open_cells(PLANE, [curve], order)
    graph: nx.Graph[tuple[int, ...]] = nx.Graph()
    graph.add_nodes_from(
        cell for cell, point in cells.samples.items() if at(curve, order, point) > 0
    )
    passages = (c.cells for c in cells.contacts if not c.is_wall)
    graph.add_edges_from(pair for pair in passages if pair[0] in graph)
    assert nx.number_connected_components(graph) == 3


@pytest.mark.parametrize("seed", range(12))
def test_random_curves_have_one_number_of_components_in_both_orders(seed: int) -> None:
    """The number of components does not depend on the axis projected along."""
    chance = random.Random(seed)
    curves = []
    for _ in range(chance.randint(1, 2)):
        p = PLANE.total(
            chance.randint(-2, 2) * X**i * Y**j for i in range(4) for j in range(4 - i)
        )
        curves.append(p + X ** chance.randint(1, 3) - Y**2)
    counts = {
        components(open_cells(PLANE, curves, o)) for o in permutations(("x", "y"))
    }
    assert len(counts) == 1


def test_contacts_lead_from_cell_to_cell() -> None:
    """The ends of every contact lie in its cells; g changes sign at simple walls."""
    curve = Y**2 - X**2 * (X + 1)
    cells = open_cells(PLANE, [curve], ("x", "y"))
    assert any(not c.is_wall for c in cells.contacts)
    for contact in cells.contacts:
        assert tuple(map(cells.cell, contact.ends)) == contact.cells
        values = [at(curve, ("x", "y"), end) for end in contact.ends]
        assert (values[0] * values[1] < 0) == contact.is_wall
        near = contact.shrunk(fmpq(1, 100))
        assert tuple(map(cells.cell, near.ends)) == contact.cells


def test_samples_lie_in_their_cells() -> None:
    """Every sample is found in the cell that it stands for."""
    cells = open_cells(SPACE, [A**2 + B**2 + C**2 - 1], ("x", "y", "z"))
    assert all(cells.cell(point) == cell for cell, point in cells.samples.items())


def test_a_contact_shrinks_to_any_width() -> None:
    """Past the 53 bits of a double too, its root stays between its ends."""
    contact = next(c for c in open_cells(PLANE, [Y**2 - 2], ("x", "y")).contacts)
    ends = [end[contact.axis] for end in contact.shrunk(fmpq(1, 2**200)).ends]
    assert 0 < ends[1] - ends[0] < fmpq(1, 2**199)
    assert ends[0] ** 2 < 2 < ends[1] ** 2 or ends[1] ** 2 < 2 < ends[0] ** 2
