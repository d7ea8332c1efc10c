"""A couple found first: what it rests on, and that it changes no verdict."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from cuspaudit.algebra.evaluation import Evaluator
from cuspaudit.auditing.systems.file import SystemFile, read_system
from cuspaudit.cuspidality import couple_first
from cuspaudit.cuspidality.couple_first import Found, find_couple
from cuspaudit.cuspidality.decision import decide
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.idle_circles import without_idle_circles

SYSTEMS = Path(__file__).parents[1] / "systems"
READ = {path.stem: read_system(path) for path in sorted(SYSTEMS.glob("*.yaml"))}
CUSPIDAL = [n for n, read in READ.items() if read.expect["verdict"] == "cuspidal"]
NAMES = [
    pytest.param(n, marks=[pytest.mark.slow] if n.startswith("issac") else [])
    for n in CUSPIDAL
]
OTHERS = ["fold", "prrrp-inverse", "two-folds", "space-folds", "lips-closed", "polar"]


def searched(read: SystemFile) -> Found:
    """What a search meets without a limit of time."""
    minors = crit(read.variety, read.mapping)
    essential = without_idle_circles(read.variety, len(read.mapping.components), minors)
    return find_couple(essential, read.mapping, minors, lambda: 100.0)


def test_many_systems_are_cuspidal() -> None:
    """The family with a couple to be found is not empty."""
    assert len(CUSPIDAL) > 12


@pytest.mark.parametrize("name", NAMES)
def test_every_cuspidal_system_has_its_couple_found(name: str) -> None:
    """Verdict as the file says; nothing else that is known contradicts it."""
    read = READ[name]
    run = decide(read.variety, read.mapping)
    if len(read.variety.ring.variables) > 3:
        assert run.engine == "couple"
    assert run.verdict is Verdict.CUSPIDAL
    expected = read.expect
    if run.components is not None and "aspects" in expected:
        assert str(run.components) == expected["aspects"]
    if "max_postures" in expected:
        assert run.most_points is not None
        most = int(expected["max_postures"])
        assert (
            run.most_points == most if run.most_is_proved else run.most_points <= most
        )


@pytest.mark.parametrize("name", NAMES)
def test_a_couple_is_one(name: str) -> None:
    """Two different points of V over the value, and a path on V between them."""
    read = READ[name]
    couple = searched(read).couple
    assert couple is not None
    ring = read.variety.ring
    a, b = couple.points
    assert a != b
    for point in couple.points:
        assert all(point.sign(f, ring) == 0 for f in read.variety.equations)
        pairs = zip(read.mapping.components, couple.value, strict=True)
        assert all(point.sign(r - q, ring) == 0 for r, q in pairs)
    minors = crit(read.variety, read.mapping)
    if len(minors) == 1:
        assert a.sign(minors[0], ring) == b.sign(minors[0], ring) == couple.sign
    for place, point in zip(couple.path[[0, -1]], couple.points, strict=True):
        balls = point.ball(64)
        true = [float(balls[x].mid()) for x in ring.variables]
        assert np.allclose(place, true, atol=1e-6)
    values = Evaluator(ring, read.variety.equations)
    for row in couple.path:
        assert np.abs(values.floats(row)).max(initial=0) < 1e-6


@pytest.mark.parametrize("name", OTHERS)
def test_no_couple_is_found_where_there_is_none(name: str) -> None:
    """The whole run goes on and says noncuspidal, as before."""
    read = READ[name]
    run = decide(read.variety, read.mapping)
    assert run.verdict is Verdict.NONCUSPIDAL
    assert run.engine == "roadmap"


def test_no_couple_without_a_proof_of_its_path(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A way that is guessed but not proved makes no couple."""
    monkeypatch.setattr(couple_first, "prove_path", lambda *_: None)
    found = searched(READ["whitney-cusp"])
    assert found.couple is None
    assert max(len(fiber.real_points()) for fiber in found.fibers.values()) == 3


def test_a_straight_way_through_the_singularity_is_not_proved() -> None:
    """Two points of a fold, one on each side of x = 0, are not joined."""
    read = READ["fold"]
    minors = crit(read.variety, read.mapping)
    search = couple_first._Search(
        without_idle_circles(read.variety, 2, minors), read.mapping, minors, 1
    )
    fiber = next(f for f in searched(read).fibers.values() if len(f.real_points()) == 2)
    first, last = fiber.real_points()
    places = np.linspace(search._middle(first), search._middle(last), 9)
    assert search._is_proved(first, places[[0, 0]], first)
    assert not search._is_proved(first, places, last)


def test_the_whole_run_is_made_on_request() -> None:
    """With ``complete`` a cuspidal system has samples in every cell and its counts."""
    read = READ["whitney-cusp"]
    run = decide(read.variety, read.mapping, complete=True)
    assert run.engine == "roadmap"
    assert (run.components, run.most_points) == (2, 3)
    assert run.most_is_proved


def test_a_slice_of_the_planar_platform_is_cuspidal(tmp_path: Path) -> None:
    """The direct map of a 3-RPR with one leg of fixed length: 2 aspects, 6 postures."""
    path = tmp_path / "slice.yaml"
    path.write_text(
        "variables: [u, v, c, s]\n"
        "equations: [u^2 + v^2 - 1, c^2 + s^2 - 1]\n"
        "map: [(u + c - 2)^2 + (v + s)^2, (u - s)^2 + (v + c - 1)^2]\n"
    )
    read = read_system(path)
    run = decide(read.variety, read.mapping)
    assert run.verdict is Verdict.CUSPIDAL
    assert run.components == 2
    assert run.most_points == 6
