from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from cuspaudit.algebra.evaluation import Evaluator
from cuspaudit.auditing.systems.file import SystemFile, read_system, system_of
from cuspaudit.cuspidality.decision import decide
from cuspaudit.cuspidality.decision_result import Decision
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.parallel.drawing import drawn
from cuspaudit.parallel.equations import loops
from cuspaudit.parallel.reading import mechanism_from_entries

OWN = Path(__file__).parents[2] / "mechanisms"
CRANK = {"kind": "crank", "base": ["0", "0"], "arm": "2", "rod": "3"}
FIVE_BAR = [CRANK, {**CRANK, "base": ["3", "0"]}]


def system(legs: list[dict[str, object]], **entries: str) -> SystemFile:
    """The system of a planar mechanism, its platform a point unless said."""
    given = {"mechanism": "planar", "platform": "point", "legs": legs} | entries
    return system_of(loops(mechanism_from_entries("m.yaml", given)))


def run(read: SystemFile) -> Decision:
    """Its decision."""
    return decide(read.variety, read.mapping)


def values(read: SystemFile, point: list[float]) -> tuple[list[float], list[float]]:
    """Equations and map at a point."""
    ring = read.variety.ring
    equations = Evaluator(ring, read.variety.equations).floats(point)
    return equations, Evaluator(ring, read.mapping.functions).floats(point)


def test_a_configuration_by_hand_satisfies_the_loops_of_a_crank() -> None:
    """A crank of 2 turned up, and a rod of 3 along x: the platform is at (3, 2)."""
    up = {**CRANK, "base": ["6", "0"], "arm": "2"}
    read = system([CRANK, up])
    assert read.variety.ring.variables == ("x", "y", "c1", "s1", "c2", "s2")
    equations, found = values(read, [3, 2, 0, 1, 0, 1])
    assert np.allclose(equations, 0)
    assert found == [0, 1, 0, 1]


def test_a_configuration_by_hand_satisfies_the_loops_of_a_body() -> None:
    """A turned body: its anchor (1, 2) goes to (x - 2, y + 1) under a right angle."""
    legs = [
        {"kind": "length", "base": ["0", "0"], "anchor": ["1", "2"]},
        {"kind": "slider", "base": ["0", "0"], "anchor": ["0", "0"]}
        | {"along": ["2", "0"], "rod": "5"},
        {"kind": "length", "base": ["1", "1"], "anchor": ["0", "0"], "rod": "5"},
    ]
    read = system(legs, platform="body")
    assert read.variety.ring.variables == ("x", "y", "c", "s", "q2")
    equations, found = values(read, [4, 5, 0, 1, 2])
    assert np.allclose(equations, 0)
    assert found == [2**2 + 6**2, 2]


def test_the_inverse_problem_maps_to_the_platform() -> None:
    """Variables for actuated lengths, and the pose as value."""
    leg = {"kind": "length", "base": ["0", "0"], "anchor": ["0", "1"]}
    legs = [{**leg, "base": [b, "0"], "anchor": [b, "1"]} for b in ("0", "1", "3")]
    read = system(legs, platform="body", problem="inverse")
    assert read.variety.ring.variables == ("x", "y", "c", "s", "q1", "q2", "q3")
    assert [str(r) for r in read.mapping.components] == ["x", "y"]
    assert len(read.mapping.angles) == 1
    equations, _ = values(read, [0, 0, 1, 0, -1, 1, 1])
    assert np.allclose(equations, 0)


@pytest.mark.parametrize("name", ["3-rpr", "3-rpr-slice"])
def test_planar_platforms_are_cuspidal(name: str) -> None:
    """3-RPR: cuspidal, at most six assembly modes, two aspects where counted."""
    found = run(read_system(OWN / f"{name}.yaml"))
    assert found.verdict is Verdict.CUSPIDAL
    assert found.most_points is not None
    assert found.most_points <= 6
    assert found.components in (None, 2)


@pytest.mark.slow
def test_a_platform_on_cranks_is_cuspidal() -> None:
    """3-RRR: two assembly modes over one posture of the cranks lie in one aspect."""
    read = read_system(OWN / "3-rrr.yaml")
    found = decide(read.variety, read.mapping, timeout=120)
    assert found.verdict is Verdict.CUSPIDAL
    assert found.couple is not None
    assert found.most_points is not None
    assert 4 <= found.most_points <= 6


def test_the_orthoglide_has_two_assembly_modes_and_no_couple() -> None:
    """Two modes in two aspects: noncuspidal."""
    found = run(read_system(OWN / "orthoglide.yaml"))
    assert found.verdict is Verdict.NONCUSPIDAL
    assert (found.components, found.most_points) == (2, 2)


@pytest.mark.slow
def test_a_five_bar_has_four_working_and_two_assembly_modes() -> None:
    """Neither its direct nor its inverse problem is cuspidal."""
    direct, inverse = (run(system(FIVE_BAR, problem=p)) for p in ("direct", "inverse"))
    assert direct.verdict is inverse.verdict is Verdict.NONCUSPIDAL
    assert (direct.most_points, inverse.most_points) == (2, 4)
    assert inverse.components == 4


def test_a_mechanism_is_drawn_where_its_points_are() -> None:
    """Base, end of the crank and anchor of both legs at a configuration by hand."""
    read = system([CRANK, {**CRANK, "base": ["6", "0"]}])
    assert read.loops is not None
    shown = drawn(read.loops, np.array([[3.0, 2, 0, 1, 0, 1]]))
    assert shown.bases.tolist() == [[0, 0], [6, 0]]
    assert shown.ends.tolist() == [[[0, 2], [6, 2]]]
    assert shown.anchors.tolist() == [[[3, 2], [3, 2]]]
