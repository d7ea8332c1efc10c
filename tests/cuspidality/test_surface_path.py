from __future__ import annotations

import math
from functools import cache
from itertools import islice

import numpy as np
import pytest
from short_tables import Number, arm

from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import SurfaceDecision, decide_surface
from cuspaudit.cuspidality.surface_path import (
    SurfacePath,
    posture_angles,
    propose_path,
    propose_paths,
)
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map

Row = tuple[Number, ...]
ARMS: dict[str, tuple[Row, Row, Row, str]] = {
    "ISSAC": ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0), ""),
    "WT5": ((1, 3, 4), (0, 3, 0), (-90, 90, 0), ""),
    "sqrt 3": ((1, 2, 1), (0, 1, 0), (-30, 90, 0), ""),
    "8 cusps": ((1, ".7", ".7"), (0, ".3", ".9"), (-90, 90, 0), ""),
    "RRP": ((-1, 2, -1), (0, -2, 1), (90, -60, 0), "RRP"),
    "PRR": ((1, "1.2", 1), (0, "0.5", "0.3"), (60, 90, 0), "PRR"),
}


@cache
def decided(name: str) -> tuple[SurfaceDecision, PolynomialSystem, PolynomialMap]:
    """The decision of an arm and its map."""
    a, d, alpha, kinds = ARMS[name]
    variety, mapping = reduced_map(exact_model(arm(a, d, alpha, kinds)))
    return decide_surface(variety, mapping), variety, mapping


def variables(decision: SurfaceDecision, points: np.ndarray) -> np.ndarray:
    """The coordinates of R^n of (m, 2) points in the order of V's factors."""
    surface = decision.surface
    ring = surface.ring
    factors = sorted(
        (surface.fiber, surface.base), key=lambda f: ring.variables.index(f.names[0])
    )
    columns: list[np.ndarray] = []
    for factor, values in zip(factors, points.T, strict=True):
        circle = factor.kind == "circle"
        columns += [np.cos(values), np.sin(values)] if circle else [values]
    return np.stack(columns, axis=1)


def dense(path: SurfacePath) -> np.ndarray:
    """The path with 200 points on each of its segments."""
    steps = np.linspace(0, 1, 200)[:, None]
    pairs = zip(path.points[:-1], path.points[1:], strict=True)
    return np.vstack([a + steps * (b - a) for a, b in pairs])


@pytest.mark.parametrize("name", ARMS)
def test_proposed_paths_join_couples_in_their_aspect(name: str) -> None:
    """Both ends have one value and Delta keeps its sign on a dense sample."""
    decision, variety, mapping = decided(name)
    assert decision.couples
    for path in islice(propose_paths(decision), 5):
        ends = variables(decision, path.points[[0, -1]])
        values = numeric_values(variety.ring, mapping.components, ends)
        assert np.allclose(values[0], values[1], atol=1e-7)
        assert np.abs(ends[0] - ends[1]).max() > 1e-6
        along = numeric_values(
            variety.ring, [decision.delta], variables(decision, dense(path))
        )
        assert (path.sign * along > 0).all()
        assert path.smallest > 0
        assert path.smallest <= path.first * (1 + 1e-9)


@pytest.mark.parametrize("name", ["ISSAC", "WT5"])
def test_clearance_is_a_fraction_of_the_largest(name: str) -> None:
    """On a torus the clearance is in (0, 1]; paths come best ends first."""
    decision, _, _ = decided(name)
    paths = list(propose_paths(decision))
    assert len(paths) == len(decision.couples)
    assert all(0 < path.clearance <= 1 for path in paths)


def test_clearance_is_zero_where_the_joint_space_has_no_end() -> None:
    """With a sliding joint |Delta| has no largest value."""
    decision, _, _ = decided("RRP")
    path = next(propose_paths(decision))
    assert path.largest == math.inf
    assert path.clearance == 0


def test_posture_angles_are_the_coordinates() -> None:
    """The angles of a posture give its coordinates back."""
    for name in ("ISSAC", "RRP"):
        decision, variety, _ = decided(name)
        for fiber in decision.samples[:8]:
            for posture in fiber.postures:
                angles = posture_angles(decision, posture)
                point = variables(decision, angles[None, :])[0]
                exact = posture.coordinates(128)
                wanted = [float(exact[n].mid()) for n in variety.ring.variables]
                assert np.allclose(point, wanted, atol=1e-9)


def test_paths_of_a_map_that_is_no_robot() -> None:
    """The Whitney cusp: from one outer sheet to the other round the cusp."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    for mapping in ((x**3 + x * y, y), (y, x**3 + x * y), (x, y**3 + x * y)):
        decision = decide_surface(PolynomialSystem(ring), PolynomialMap(ring, mapping))
        for couple in decision.couples:
            path = propose_path(decision, couple)
            along = numeric_values(ring, [decision.delta], dense(path))
            assert (path.sign * along > 0).all()
            ends = numeric_values(ring, mapping, path.points[[0, -1]])
            assert np.allclose(ends[0], ends[1], atol=1e-9)


def test_a_path_may_go_round_the_circle() -> None:
    """Way points are not reduced modulo 2 pi: some path of some arm turns the base."""
    turned = 0
    for name in ("ISSAC", "WT5", "sqrt 3", "8 cusps"):
        decision, _, _ = decided(name)
        for couple in decision.couples:
            turned += decision.graph.turns(*couple.postures) != 0
    assert turned > 0
