"""Joint vectors and poses from the texts of options."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from flint import ctx

from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.numbers import parse_angle, parse_length
from cuspaudit.robot.place import Place
from cuspaudit.toolpath.ball_arm import angle_ball
from cuspaudit.toolpath.joint_pose import JointValue, pose_of_joints, simplest_near
from cuspaudit.toolpath.reading import unit_quaternion, within_reason
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import Pose, Quaternion

__all__ = ["asked_pose", "joint_vector", "quaternion_of_rpy"]

_MOST = 4 * math.pi


def joint_vector(text: str, chain: Chain, option: str) -> tuple[JointValue, ...]:
    """The joint values Q1,Q2,...: bare numbers are rad, of a slide the robot's unit.

    Raises:
        InvalidInputError: not one value a joint, or an angle that is likely degrees.
    """
    place = Place(option)
    cells, count = text.split(","), len(chain.joints)
    if len(cells) != count:
        names = ",".join(joint.name for joint in chain.joints)
        raise place.error(f"{len(cells)} joint values", f"write {count}: {names}")
    values: list[JointValue] = []
    for joint, cell in zip(chain.joints, cells, strict=True):
        here = place.at(joint.name)
        if joint.kind == "prismatic":
            values.append(parse_length(cell, here))
            continue
        angle = parse_angle(cell, here, "rad")
        bare = not cell.strip().endswith(("deg", "rad")) and "pi" not in cell
        if bare and abs(angle_value(angle)) > _MOST:
            raise here.error(
                f"{cell.strip()} rad is more than two turns",
                f"write {cell.strip()} deg",
            )
        values.append(angle)
    return tuple(values)


def asked_pose(
    arm: TracedArm,
    joints: str | None,
    position: str | None,
    quaternion: str | None,
    rpy: str | None,
) -> Pose:
    """The pose that options give: that of a joint vector, or a place and orientation.

    Raises:
        InvalidInputError: both or neither, a part is missing, or none of it is a pose.
    """
    place = Place("postures")
    if (joints is None) == (position is None):
        found = "no pose" if joints is None else "a joint vector and a position"
        raise place.error(found, "give --joints Q1,... or --position X,Y,Z")
    if joints is not None:
        chain = arm.robot_chain
        return pose_of_joints(arm, joint_vector(joints, chain, "--joints"))
    cells = _cells(position or "", 3, "--position")
    here = Place("--position")
    x, y, z = (within_reason(parse_length(cell, here), here) for cell in cells)
    turn: Quaternion | None = None
    if arm.task == "position" and (quaternion is not None or rpy is not None):
        option = "--rpy" if quaternion is None else "--quaternion"
        raise place.error(
            f"{option} for the task position, which asks for no orientation",
            f"leave out {option}",
        )
    if quaternion is not None and rpy is not None:
        raise place.error("--quaternion and --rpy", "give one of them")
    if quaternion is not None:
        here = Place("--quaternion")
        entries = [
            parse_length(cell, here) for cell in _cells(quaternion, 4, "--quaternion")
        ]
        turn = unit_quaternion(entries, here)
    if rpy is not None:
        here = Place("--rpy")
        turn = quaternion_of_rpy(
            [parse_angle(cell, here, "rad") for cell in _cells(rpy, 3, "--rpy")]
        )
    if turn is None and arm.task != "position":
        task = arm.robot_chain.task
        raise place.error(
            f"no orientation, which the task {task} needs",
            "add --quaternion W,X,Y,Z or --rpy R,P,Y",
        )
    return Pose((x, y, z), None if arm.task == "position" else turn)


def quaternion_of_rpy(angles: Sequence[Angle]) -> Quaternion:
    """The turn by roll, pitch, yaw about the fixed x, y, z axes, as URDF has it.

    Each half angle's tangent is rounded to the simplest rational within 1e-15.
    """
    result: Quaternion = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))
    for axis, angle in enumerate(angles):
        w, own = _half(angle)
        step = [w, Fraction(0), Fraction(0), Fraction(0)]
        step[axis + 1] = own
        result = _product((step[0], step[1], step[2], step[3]), result)
    return result


def _half(angle: Angle) -> tuple[Fraction, Fraction]:
    """A multiple of (cos, sin) of half the angle."""
    with ctx.workprec(128):
        sine, cosine = (angle_ball(angle) / 2).sin_cos()
        if abs(cosine) > abs(sine) or not abs(sine) > abs(cosine):
            return Fraction(1), simplest_near(sine / cosine)
        return simplest_near(cosine / sine), Fraction(1)


def _product(p: Quaternion, q: Quaternion) -> Quaternion:
    a, b, c, d = p
    e, f, g, h = q
    return (
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    )


def _cells(text: str, count: int, option: str) -> list[str]:
    cells = text.split(",")
    if len(cells) != count:
        raise Place(option).error(f"{len(cells)} numbers", f"write {count}, by commas")
    return cells
