from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from cuspaudit.robot.chain import Angle
from cuspaudit.toolpath.joint_pose import pose_of_joints
from cuspaudit.toolpath.laps import laps_of
from cuspaudit.toolpath.record import exit_code, trace_record
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import traced_arm
from cuspaudit.toolpath.traced_path import Run, TracedPath
from cuspaudit.toolpath.waypoints import ToolPath
from tests.toolpath.traced_arms import FACTS, crx, exact, fact, mirror, places

THREE = [path["name"] for path in FACTS if "path" in path]


def reversed_path(path: ToolPath) -> ToolPath:
    """The same poses, last to first."""
    return replace(path, poses=path.poses[::-1])


def match(trace: TracedPath, start: list[float]) -> Run:
    """The run that begins in a posture, up to whole turns."""
    [found] = [
        run
        for run in trace.runs
        if np.abs(np.sin((np.array(run.start) - start) / 2)).max() < 1e-5
    ]
    return found


@pytest.mark.parametrize("name", THREE)
def test_published_paths_of_three_joints(name: str) -> None:
    """Runs, ends, events to 1e-6 and signs (up to one for all) are the published."""
    known = fact(name)
    trace = trace_path(mirror(), places(*known["path"]))
    assert len(trace.runs) == len(known["runs"]) == len(trace.first.postures)
    assert trace.first.complete and trace.births_complete
    signs = set()
    for entry in known["runs"]:
        run = match(trace, entry["start"])
        assert run.proved
        assert (run.end, run.at) == (entry["end"], pytest.approx(entry["at"], abs=1e-6))
        signs.add(run.sign * entry["sign"] if run.sign else 0)
    assert signs in ({1}, {-1})


def test_a_published_path_changes_posture() -> None:
    """Its permutation and its turns are the published, and it is a witness (T6)."""
    known = fact("changes posture")
    trace = trace_path(mirror(), places(*known["path"]))
    assert trace.closed and trace.permutation is not None and trace.turns is not None
    order = [trace.runs.index(match(trace, entry["start"])) for entry in known["runs"]]
    for entry, k in zip(known["runs"], order, strict=True):
        to = entry.get("to")
        assert trace.permutation[k] == (None if to is None else order[to])
        turns = entry.get("turns")
        if turns is not None:
            start = np.array(known["runs"][to]["start"])
            own = np.round((np.array(trace.runs[k].last) - start) / (2 * np.pi))
            assert own.tolist() == turns
    assert trace.verdict_from_path == "cuspidal"
    assert exit_code(trace) == 1
    assert [one.kind for one in laps_of(trace)].count("changes posture") == 2


@pytest.mark.slow
def test_the_published_line_of_the_crx() -> None:
    """12 postures, 4 reach the end, 4 die at .412225 and 4 at .730395, all proved."""
    known = fact("CRX-10iA/L straight line, 4 of 12 feasible")
    arm = crx()
    ends = (known["from_posture"], known["to_posture"])
    poses = [pose_of_joints(arm, [exact(x) for x in q]) for q in ends]
    trace = trace_path(arm, ToolPath(tuple(poses)))
    assert trace.first.complete and trace.last.complete
    assert len(trace.runs) == 12 and len(trace.last.postures) == 4
    for entry in known["runs"]:
        run = match(trace, entry["start"])
        assert run.proved
        assert (run.end, run.at) == (entry["end"], pytest.approx(entry["at"], abs=1e-6))
    back = trace_path(arm, ToolPath(tuple(poses[::-1])))
    assert_inverse(trace, back)


def assert_inverse(there: TracedPath, back: TracedPath) -> None:
    """A joint of over a turn gives a run a winding, ended where it leaves."""
    reached = {(run.posture, run.ends_in) for run in there.runs if run.end == "reached"}
    returned = {(run.ends_in, run.posture) for run in back.runs if run.end == "reached"}
    assert reached == returned


@pytest.mark.parametrize("name", THREE)
def test_the_reversed_path_undoes_what_the_path_does(name: str) -> None:
    """The reverse of a path gives the inverse partial permutation, and its births."""
    path = places(*fact(name)["path"])
    there, back = (trace_path(mirror(), p) for p in (path, reversed_path(path)))
    assert_inverse(there, back)
    deaths = sorted(round(run.at, 6) for run in back.runs if run.end == "singular")
    births = sorted(round(path.legs - birth.at, 6) for birth in there.born)
    assert deaths == births


def test_runs_end_at_the_limits_of_their_winding() -> None:
    """A joint of more than a turn gives a run a winding, ended where it leaves."""
    limits = Angle(radians=Fraction(-3)), Angle(radians=Fraction(5))
    chain = mirror().robot_chain
    joints = [replace(joint, limits=limits) for joint in chain.joints]
    arm = traced_arm(chain.with_joints(joints))
    path = places(*fact("changes posture")["path"])
    trace = trace_path(arm, path)
    free = trace_path(mirror(), path)
    assert len(trace.runs) == 9
    for run in trace.runs:
        own = match(free, list(run.start))
        assert run.inside and run.proved
        if run.end == "limit":
            assert run.at < own.at
            k = [joint.name for joint in chain.joints].index(run.joint or "")
            assert run.last[k] == pytest.approx(-3) or run.last[k] == pytest.approx(5)
        else:
            assert (run.end, run.at) == (own.end, pytest.approx(own.at))
            assert all(-3 < x < 5 for x in run.last)
    unlimited = trace_path(arm, path, limited=False)
    assert [run.end for run in unlimited.runs] == [run.end for run in free.runs]


def test_a_posture_outside_the_limits_is_listed_so() -> None:
    """It is no start inside, and does not count for the exit code."""
    chain = mirror().robot_chain
    narrow = Angle(radians=Fraction(1, 10)), Angle(radians=Fraction(2, 10))
    joints = [*chain.joints[:2], replace(chain.joints[2], limits=narrow)]
    trace = trace_path(
        traced_arm(chain.with_joints(joints)), places((2, 0, 0), (1, 0, 0))
    )
    assert len(trace.runs) == 4 and not any(run.inside for run in trace.runs)
    assert exit_code(trace) == 1


def test_standing_still_is_no_event() -> None:
    """Two equal waypoints change nothing."""
    trace = trace_path(mirror(), places((2, 0, 0), (2, 0, 0), (1, 0, 0)))
    ends = [(run.end, round(run.at, 4)) for run in trace.runs]
    assert sorted(ends) == [("reached", 2.0)] * 2 + [("singular", 1.3377)] * 2


def test_a_waypoint_out_of_reach_is_named_with_its_distance() -> None:
    """The record says which waypoint has no posture, and how far away it is."""
    trace = trace_path(mirror(), places((2, 0, 0), (1, 0, 0), (60, 0, 0)))
    record: dict[str, Any] = trace_record(trace, "arm", "arm.yaml")
    assert record["unreachable"]["waypoint"] == 2
    assert record["unreachable"]["proved"]
    assert record["unreachable"]["distance"] == pytest.approx(55.4, abs=0.5)
    assert exit_code(trace) == 1


def test_the_way_back_along_itself_repeats() -> None:
    """A path that returns on itself leaves every posture that survives where it was."""
    rows = [(2, 0, 0), ("1.9", "0.1", "0.1"), (2, 0, 0)]
    trace = trace_path(mirror(), places(*rows))
    assert trace.permutation == (0, 1, 2, 3)
    assert exit_code(trace) == 0
    assert {one.kind for one in laps_of(trace)} == {"repeatable"}


def test_legs_of_any_length_are_followed() -> None:
    """A leg of 1e-12 of the unit, and one a million times the arm, are both proved."""
    tiny = trace_path(mirror(), places((2, 0, 0), ("2.000000000001", 0, 0)))
    assert [run.end for run in tiny.runs] == ["reached"] * 4
    huge = trace_path(mirror(), places((2, 0, 0), (1000000, 0, 0)))
    assert all(run.proved and run.end == "singular" for run in huge.runs)


def test_a_run_that_is_born_and_dies_on_the_way_is_found() -> None:
    """To and fro and far away: the pair that lives between is born and dies."""
    trace = trace_path(mirror(), places((1, 0, 0), (60, 0, 0)))
    assert trace.births_complete
    assert [birth.end for birth in trace.born] == ["singular"] * 2
    first, second = trace.born
    assert first.at == pytest.approx(second.at, abs=1e-9)
    assert first.until > first.at and {first.sign, second.sign} == {1, -1}
