from __future__ import annotations

from dataclasses import replace

from cuspaudit.toolpath.joint_pose import pose_of_joints
from cuspaudit.toolpath.recorded import Recorded, recorded_motion
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_path import TracedPath
from cuspaudit.toolpath.waypoints import ToolPath
from tests.toolpath.traced_arms import exact, fact, mirror, places

JOINTS = [("0.1", "0.4", "0.7"), ("0.2", "0.5", "0.6"), ("0.3", "0.5", "0.5")]


def traced(rows: list[tuple[str, str, str]]) -> TracedPath:
    """The trace of the tool path that joint vectors make."""
    poses = [pose_of_joints(mirror(), [exact(x) for x in row]) for row in rows]
    positions = tuple(replace(pose, quaternion=None) for pose in poses)
    joints = tuple(tuple(float(x) for x in row) for row in rows)
    return trace_path(mirror(), ToolPath(positions, joints))


def test_a_recorded_motion_is_found_among_the_runs() -> None:
    """It follows the run that it begins in to the end."""
    trace = traced(JOINTS)
    found = recorded_motion(trace)
    assert found is not None and found.run is not None and found.leaves_after is None
    run = trace.runs[found.run]
    assert abs(run.start[1] - 0.4) < 1e-9 and abs(run.last[1] - 0.5) < 1e-9


def test_a_jump_of_a_recorded_motion_is_placed() -> None:
    """Another posture of the third pose in its place: it leaves after the second."""
    trace = traced(JOINTS)
    found = recorded_motion(trace)
    assert found is not None and found.run is not None
    other = next(
        run
        for k, run in enumerate(trace.runs)
        if k != found.run and run.end == "reached"
    )
    joints = trace.path.joints
    assert joints is not None
    jumped = replace(trace.path, joints=(*joints[:2], other.last))
    assert recorded_motion(replace(trace, path=jumped)) == Recorded(found.run, 1)


def test_a_path_of_places_has_no_recorded_motion() -> None:
    """Only joint vectors are a motion."""
    path = places(*fact("feasible in none")["path"])
    assert recorded_motion(trace_path(mirror(), path)) is None
