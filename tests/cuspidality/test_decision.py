"""Algorithm 1, by both routes, on maps whose verdict is known by hand."""

from __future__ import annotations

from pathlib import Path

import pytest

from cuspaudit.algebra.polynomial_text import parse_polynomial
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.auditing.systems.file import SystemFile, read_system
from cuspaudit.cuspidality.decision import decide
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    AssumptionError,
    DegenerateMapError,
    NotEquidimensionalError,
    NotRadicalError,
    NotSquareError,
    RealPartSingularError,
)

SYSTEMS = sorted((Path(__file__).parents[1] / "systems").glob("*.yaml"))
SLOW = {"issac-2022", "issac-2022-printed", "two-spheres", "five-bar"}

#: systems that the routing takes minutes for
LONG = {"five-bar"}


def system(
    variables: str, equations: list[str], mapping: list[str]
) -> tuple[PolynomialSystem, PolynomialMap]:
    """V and R from text."""
    ring = Ring(variables.split())
    f = tuple(parse_polynomial(ring, text) for text in equations)
    r = tuple(parse_polynomial(ring, text) for text in mapping)
    return PolynomialSystem(ring, f), PolynomialMap(ring, r)


def marked(path: Path) -> object:
    """The file, marked slow where it is."""
    marks = [pytest.mark.slow] if path.stem in SLOW else []
    return pytest.param(path, marks=marks, id=path.stem)


def hold(read: SystemFile, engine: str) -> None:
    """The run by ``engine`` is what the file expects, and its couple is one."""
    run = decide(read.variety, read.mapping, engine, timeout=900)
    assert run.failure is None
    found = {
        "verdict": run.verdict.value,
        "aspects": str(run.components),
        "max_postures": str(run.most_points),
    }
    assert found == found | dict(read.expect)
    if run.couple is not None:
        a, b = run.couple.points
        assert a != b
        ring = read.variety.ring
        for r, q in zip(read.mapping.components, run.couple.value, strict=True):
            assert a.sign(r - q, ring) == b.sign(r - q, ring) == 0
        assert run.couple.path.shape[1] == len(ring.variables)


def test_there_are_more_than_forty_systems() -> None:
    """The family of systems with a known verdict was found."""
    assert len(SYSTEMS) >= 60


@pytest.mark.parametrize("path", [marked(p) for p in SYSTEMS if p.stem not in LONG])
@pytest.mark.parametrize("engine", ["roadmap", "routing"])
def test_both_routes_decide_what_is_known_by_hand(path: Path, engine: str) -> None:
    """Verdict, components and largest fiber are those of the file, by either route."""
    hold(read_system(path), engine)


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(LONG))
def test_the_roadmap_decides_what_the_routing_takes_minutes_for(name: str) -> None:
    """The same by the roadmap alone."""
    hold(read_system(SYSTEMS[0].with_name(f"{name}.yaml")), "roadmap")


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (("x y", ["x^2"], ["y"]), NotRadicalError),
        (("x y z", ["x*y", "x*z"], ["y"]), NotEquidimensionalError),
        (("x y", ["x^2 + y^2"], ["x"]), RealPartSingularError),
        (("x y", ["x^2 + y^2 + 1"], ["x"]), AssumptionError),
        (("x y", ["x", "x - 1"], ["y"]), NotEquidimensionalError),
        (("x y z", ["x^2 + y^2 - 1"], ["x"]), NotSquareError),
        (("x y", [], ["x + y", "2*x + 2*y"]), DegenerateMapError),
        (("x y", ["x^2 + y^2 - 1"], ["x^2 + y^2"]), DegenerateMapError),
    ],
    ids=lambda value: str(value)[:40],
)
def test_violated_hypotheses_are_named(
    arguments: tuple[str, list[str], list[str]], error: type[AssumptionError]
) -> None:
    """Each way in which assumption (A), or full rank, fails has its own error."""
    variety, mapping = system(*arguments)
    with pytest.raises(error):
        decide(variety, mapping)


def test_no_time_is_undecided_at_a_step() -> None:
    """A run without time ends undecided and says at which step."""
    variety, mapping = system("x y", [], ["x^3 + x*y", "y"])
    run = decide(variety, mapping, timeout=0.0)
    assert run.verdict is Verdict.UNDECIDED
    assert run.failure is not None
    assert run.failure.step == "crit"


def test_steps_are_the_papers_with_time_and_memory() -> None:
    """A run lists the routines in the paper's order, each with time and memory."""
    variety, mapping = system("x y", [], ["x^2", "y"])
    seen: list[str] = []
    run = decide(variety, mapping, "routing", progress=seen.append)
    assert seen == [step.name for step in run.steps]
    assert seen[2:5] == ["atypical_values", "sample_points_rational", "sample_points"]
    assert all(step.seconds >= 0 for step in run.steps)
    assert all(step.megabytes and step.megabytes > 1 for step in run.steps)
