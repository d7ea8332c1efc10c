"""Postures and tool paths as functions: what the commands of these names do."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.errors import InvalidInputError
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.numbers import parse_angle, parse_length
from cuspaudit.robot.place import Place
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snap_policy import policy_from_name
from cuspaudit.robot.snapping import snap as snapped
from cuspaudit.runtime.writing import write_text
from cuspaudit.toolpath.joint_pose import JointValue, pose_of_joints
from cuspaudit.toolpath.postures import Posture, held_to, list_postures, postures_record
from cuspaudit.toolpath.reading import (
    checked_path,
    closed_path,
    read_path,
    unit_quaternion,
    within_reason,
)
from cuspaudit.toolpath.record import trace_record
from cuspaudit.toolpath.run_certificate import run_certificate
from cuspaudit.toolpath.same_aspect import FoundConnection, connection_record
from cuspaudit.toolpath.same_aspect import same_aspect as find_connection
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from cuspaudit.toolpath.traced_path import Run, TracedPath
from cuspaudit.toolpath.waypoints import Pose, ToolPath

__all__ = ["Connection", "Postures", "Trace", "postures", "same_aspect", "trace"]

Array = NDArray[np.float64]
Number = float | int | str | Fraction
Numbers = Sequence[Number] | Array
File = str | os.PathLike[str]


class Postures(list[Posture]):
    """The postures of a pose: a list, with what is proved about it.

    Attributes:
        complete: whether no other posture exists, proved.
        whole_curves: whether infinitely many may have this pose.
        why: why the list is not complete, or "".
    """

    def __init__(
        self,
        found: Sequence[Posture],
        complete: bool,
        whole_curves: bool,
        why: str,
        record: dict[str, Any],
    ) -> None:
        super().__init__(found)
        self.complete, self.whole_curves, self.why = complete, whole_curves, why
        self._record = record

    def to_dict(self) -> dict[str, Any]:
        """The record that ``cuspaudit postures --json`` writes."""
        return self._record


@dataclass(frozen=True, eq=False, repr=False)
class Connection:
    """Whether two joint vectors lie in one aspect.

    Attributes:
        answer: ``same``, ``different`` or ``open``.
        why: one sentence.
        path: (m, n) joint values of a proved path, or None.
    """

    answer: str
    why: str
    path: Array | None
    _record: dict[str, Any]

    def __repr__(self) -> str:
        return f"<Connection: {self.answer}: {self.why}>"

    def to_dict(self) -> dict[str, Any]:
        """The record that ``cuspaudit same --json`` writes."""
        return self._record


@dataclass(frozen=True, eq=False, repr=False)
class Trace:
    """What becomes of every posture of the first pose of a tool path."""

    found: TracedPath
    _robot: Robot

    def __repr__(self) -> str:
        reached = sum(run.end == "reached" for run in self.runs)
        return (
            f"<Trace of {self._robot.name}: {reached} of {len(self.runs)} runs reach>"
        )

    @property
    def runs(self) -> tuple[Run, ...]:
        """A run for each posture of the first pose and each winding within limits."""
        return self.found.runs

    @property
    def closed(self) -> bool:
        """Whether the path ends where it begins."""
        return self.found.closed

    @property
    def permutation(self) -> tuple[int | None, ...] | None:
        """For each run of a closed path the run in whose posture it ends."""
        return self.found.permutation

    @property
    def turns(self) -> tuple[tuple[int, ...] | None, ...] | None:
        """The whole turns left over, for each run of a closed path."""
        return self.found.turns

    @property
    def verdict_from_path(self) -> str | None:
        """``cuspidal`` where a run ends in another posture, proved; else None."""
        return self.found.verdict_from_path

    def joint_path(self, run: int) -> Array:
        """Joint values and the path's parameter along a run, (m, n + 1)."""
        return self.runs[run].points(self.found.arm.scales)

    def to_dict(self, laps: int = 1) -> dict[str, Any]:
        """The record that ``cuspaudit trace --json`` writes."""
        return trace_record(self.found, self._robot.name, self._robot.file, laps)

    def save_html(self, file: File) -> None:
        """Write the offline page: the arm on the path, and the joints' curves."""
        from cuspaudit.pictures.tool_path import trace_drawing
        from cuspaudit.viz.tool_path import render_trace

        page = render_trace(self.to_dict(), trace_drawing(self.found))
        write_text(Path(file), page)

    def certificate(self) -> str:
        """The certificate of a run that changes posture, as text.

        Raises:
            UnableError: none does, or none can be certified.
        """
        return run_certificate(self.found)


def postures(
    robot: Robot,
    q: Numbers | None = None,
    *,
    position: Numbers | None = None,
    quaternion: Numbers | None = None,
    snap: File = "default",
    seed: int = 0,
    timeout: float | None = None,
) -> Postures:
    """All postures of a pose, each with det J, sign, aspect and windings.

    Args:
        robot: from `load`.
        q: a joint vector whose pose is meant: rad, or texts as in a robot file.
        position: else the place of the tip, in the robot's unit.
        quaternion: and its orientation (w, x, y, z), where the task has one.
        snap: which rounded numbers are made exact.
        seed: of the exact solver.
        timeout: seconds after which no further step is begun.

    Raises:
        InvalidInputError: not one pose.
    """
    arm = _arm(robot, snap)
    if (q is None) == (position is None):
        raise InvalidInputError(
            file="postures",
            found="no pose" if q is None else "a joint vector and a position",
            expected="give q=... or position=...",
        )
    if q is not None:
        pose = pose_of_joints(arm, _joints(q, arm, "q"))
    else:
        pose = _pose({"position": position, "quaternion": quaternion}, 0)
        if arm.task != "position" and pose.quaternion is None:
            raise InvalidInputError(
                file="postures",
                found=f"no orientation, which the task {robot.chain.task} needs",
                expected="give quaternion=[w, x, y, z]",
            )
    found = list_postures(arm, pose, seed, timeout=timeout)
    if q is not None:
        found = held_to(found, _joints(q, arm, "q"))
    record = postures_record(found, robot.name, robot.file)
    return Postures(
        found.postures, found.complete, found.whole_curves, found.why, record
    )


def same_aspect(
    robot: Robot,
    q1: Numbers,
    q2: Numbers,
    *,
    within_limits: bool = False,
    snap: File = "default",
    seed: int = 0,
    timeout: float | None = None,
) -> Connection:
    """Whether the arm can go from q1 to q2 without meeting a singularity.

    Args:
        robot: from `load`.
        q1: joint values, rad.
        q2: likewise.
        within_limits: whether the way must keep within the joint limits.
        snap: which rounded numbers are made exact.
        seed: of the search for a path.
        timeout: seconds after which no further step is begun.
    """
    arm = _arm(robot, snap)
    ends = _joints(q1, arm, "q1"), _joints(q2, arm, "q2")
    found: FoundConnection = find_connection(
        arm, *ends, within_limits, seed, timeout=timeout
    )
    record = connection_record(found, robot.name, robot.file)
    return Connection(found.answer, found.why, found.path, record)


def trace(
    robot: Robot,
    poses: File | Sequence[Mapping[str, Any] | Numbers],
    *,
    closed: bool = False,
    limits: bool = True,
    snap: File = "default",
    seed: int = 0,
    progress: Callable[[str], None] = lambda step: None,
    timeout: float | None = None,
) -> Trace:
    """Follow a tool path from every posture of its first pose.

    Args:
        robot: from `load`.
        poses: a file, or waypoints: mappings with ``position`` and ``quaternion``
            (w, x, y, z), or joint vectors in rad.
        closed: whether the path returns to its first waypoint.
        limits: whether the joint limits count.
        snap: which rounded numbers are made exact.
        seed: of the exact solvers.
        progress: called with the name of each step.
        timeout: seconds after which no run is followed further.

    Raises:
        InvalidInputError: no tool path; the message names the row.
    """
    arm = _arm(robot, snap)
    if isinstance(poses, str | os.PathLike):
        path = read_path(Path(poses), arm, "rad")
    else:
        path = _path(poses, arm)
    if closed:
        path = closed_path(path, arm)
    return Trace(trace_path(arm, path, limits, seed, progress, timeout), robot)


def _arm(robot: Robot, snap: File) -> TracedArm:
    if not isinstance(robot, Robot):
        raise InvalidInputError(
            file="tool path",
            found=f"{robot!r} is not a robot",
            expected="give what load returns",
        )
    return traced_arm(snapped(robot.chain, policy_from_name(os.fspath(snap)))[0])


def _path(entries: Sequence[Mapping[str, Any] | Numbers], arm: TracedArm) -> ToolPath:
    poses, joints = [], []
    for number, entry in enumerate(entries, 1):
        if isinstance(entry, Mapping):
            poses.append(_pose(entry, number))
            continue
        values = _joints(entry, arm, f"row {number}")
        pose = pose_of_joints(arm, values)
        poses.append(Pose(pose.position, pose.quaternion, number))
        joints.append(tuple(float(x) for x in entry))
    path = checked_path(poses, arm, "poses")
    whole = tuple(joints) if len(joints) == len(poses) else None
    return ToolPath(path.poses, whole, path.file)


def _pose(entry: Mapping[str, Any], number: int) -> Pose:
    place = Place(f"row {number}" if number else "pose")
    position, quaternion = entry.get("position"), entry.get("quaternion")
    if position is None or len(position) != 3:
        raise place.error("no position of three numbers", "give position=[x, y, z]")
    x, y, z = (within_reason(_number(value, place), place) for value in position)
    if quaternion is None:
        return Pose((x, y, z), None, number)
    if len(quaternion) != 4:
        raise place.error("no quaternion of four numbers", "give [w, x, y, z]")
    entries = [_number(value, place) for value in quaternion]
    return Pose((x, y, z), unit_quaternion(entries, place), number)


def _joints(values: Numbers, arm: TracedArm, where: str) -> tuple[JointValue, ...]:
    chain, place = arm.robot_chain, Place(where)
    if len(values) != len(chain.joints):
        names = ", ".join(joint.name for joint in chain.joints)
        raise place.error(f"{len(values)} joint values", f"give one each of {names}")
    result: list[JointValue] = []
    for joint, value in zip(chain.joints, values, strict=True):
        if joint.kind == "prismatic":
            result.append(_number(value, place))
        elif isinstance(value, str):
            result.append(parse_angle(value, place, "rad"))
        else:
            result.append(Angle(radians=_number(value, place)))
    return tuple(result)


def _number(value: Number, place: Place) -> Fraction:
    """The number, a double as the shortest decimal that is it."""
    if isinstance(value, Fraction):
        return value
    return parse_length(value if isinstance(value, str) else repr(float(value)), place)
