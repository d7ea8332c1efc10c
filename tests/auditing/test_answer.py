from __future__ import annotations

import pytest
from short_tables import Number, arm, ask, numbers, with_wrist

from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, PrecisionError, UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.theorems.registry import looked_for

Row = tuple[Number, ...]

#: arms on which a routine once stopped or crashed: what was wrong, table, answer
HUNTED: tuple[tuple[str, str, Row, Row, Row, Row, str], ...] = (
    # a posture at chart coordinate 0: a power of a ball that meets 0 is nan
    ("RRP", "nan", (-1, 2, -1), (0, -2, 1), (90, -60, 0), (0, 0, 0), "cuspidal"),
    # roots over Q(sqrt m) stayed as wide as isolation needs, at any precision
    ("RRR", "wide", (1, 1, 1), (0, -2, -2), (0, -60, 0), (0, 0, 90), "noncuspidal"),
    ("RRR", "wide", (0, "1/2", -1), (0, "1/2", "1/2"), (45, 90, 0), (), "noncuspidal"),
    # no generic value over the simplest u: another u is taken
    ("PRR", "u", (1, 1, "1/2"), (0, -2, 1), (90, 90, 0), (0, 30, 30), "noncuspidal"),
    # x + sqrt 3 divides dF/dx on the map, x^2 - 3 does not
    ("RRR", "factor", (-1, 1, 2), (0, "1/2", 1), (60, -60, 0), (0, 0, 45), "cuspidal"),
    # a component of the map does not move along the critical curve
    ("PRP", "still", (1, 1, 1), (0, -2, -2), (45, -45, 0), (0, 90, 0), "noncuspidal"),
    ("PPP", "linear", (1, 1, 1), (0, 0, 0), (-30, 45, 0), (0, 30, 30), "noncuspidal"),
    # det J does not depend on the fiber: the count of cusps never ended
    ("PPR", "walls", (0, 2, 2), (0, -2, 0), (-90, -60, 45), (0, 0, 45), "noncuspidal"),
    ("RPR", "walls", (0, "1/2", 1), (0, 1, 1), (0, 30, 0), (0, 0, 90), "noncuspidal"),
    # the point that the chart misses is a wall with one value
    ("RRR", "chart", (1, 1, 1), (0, 0, 0), (-90, 90, 0), (0, 45, 45), "noncuspidal"),
)


@pytest.mark.parametrize(
    ("kinds", "a", "d", "alpha", "theta", "verdict"),
    [(case[0], *case[2:]) for case in HUNTED],
    ids=[f"{case[0]}-{case[1]}-{i}" for i, case in enumerate(HUNTED)],
)
def test_special_arms_are_decided(
    kinds: str, a: Row, d: Row, alpha: Row, theta: Row, verdict: str
) -> None:
    """An arm with special numbers gets its verdict, not an excuse."""
    assert ask(arm(a, d, alpha, kinds, theta)).verdict.value == verdict


def test_the_paper_s_arm() -> None:
    """The ISSAC 2022 arm: cuspidal, 2 aspects, 4 postures, 4 cusps, 0 nodes."""
    found = ask(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))
    assert numbers(found) == ("cuspidal", 2, 4, 4, 0)
    assert found.undecided is None
    assert "FLINT resultants" in found.rests_on


@pytest.mark.parametrize(
    ("a", "d", "alpha"),
    [
        ((1, 1, 1), (0, 0, 0), (0, 0, 0)),  # planar: z never changes
        ((0, 0, 1), (0, 0, 0), (90, 90, 0)),  # spherical: |p| never changes
        ((1, 1, 0), (0, 0, 0), (-90, 90, 0)),  # the tip stands on the last axis
    ],
)
def test_an_arm_without_full_rank_is_an_error(a: Row, d: Row, alpha: Row) -> None:
    """Where det J vanishes identically no verdict exists, and the error says so."""
    with pytest.raises(DegenerateMapError, match="det J vanishes"):
        ask(arm(a, d, alpha))


def test_an_unknown_structure_is_undecided() -> None:
    """A six-joint arm with no known structure is UNDECIDED, and says what it lacks."""
    found = ask(arm((1, 2, 3, 4, 5, 6), (1,) * 6, (60, 60, 60, 60, 60, 60)))
    assert found.verdict is Verdict.UNDECIDED
    assert found.undecided is not None
    assert found.undecided.step == "reductions"
    assert found.undecided.looked_for == looked_for("pose")
    assert found.rests_on == ()
    assert found.aspects is found.postures is found.cusps is found.nodes is None


def test_a_limit_is_undecided_and_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """A step that gives up makes the answer UNDECIDED and keeps its name.

    Where tiles are unable too, no later step makes up for it, since the time is up for
    each.
    """

    def unable(*_: object) -> None:
        raise UnableError("pair tiles", "open")

    monkeypatch.setattr("cuspaudit.cuspidality.tile_decision.decide_by_tiles", unable)
    steps: list[str] = []

    def stop(step: str) -> None:
        steps.append(step)
        if "sample_points" in steps:
            raise UnableError(step, "out of time")

    found = answer(exact_model(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))), stop)
    assert found.verdict is Verdict.UNDECIDED
    assert found.undecided is not None
    assert found.undecided.step == "sample_points"
    assert "out of time" in found.why


def test_too_few_bits_are_undecided() -> None:
    """A question that no precision settled makes the answer UNDECIDED."""

    def stop(step: str) -> None:
        if step == "graph_isotop":
            raise PrecisionError("strip of a posture", 4096)

    found = answer(exact_model(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))), stop)
    assert found.verdict is Verdict.UNDECIDED
    assert found.undecided is not None
    assert found.undecided.step == "precision"
    assert "4096 bits" in found.why


def test_progress_names_the_paper_s_routines() -> None:
    """The steps are announced in the order of Algorithm 1."""
    steps: list[str] = []
    answer(exact_model(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))), steps.append)
    order = ["crit", "atypical_values", "roadmap", "sample_points_rational"]
    assert steps == [*order, "sample_points", "graph_isotop", "cusps and nodes"]


def test_a_wrist_doubles_aspects_and_postures() -> None:
    """A spherical wrist has two postures and two signs: it doubles both counts."""
    regional = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
    three, six = ask(regional), ask(with_wrist(regional))
    assert six.reduction is not None
    assert six.reduction.kind == "spherical wrist"
    assert numbers(six) == ("cuspidal", 4, 8, 4, 0)
    assert numbers(three)[3:] == numbers(six)[3:]
