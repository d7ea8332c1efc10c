"""A robot: its chain, its task, its numbers, and the files it is read from."""

from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Joint,
    Rotation,
    Translation,
)
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.library import library, open_robot
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import Snapped, snap
from cuspaudit.robot.task import check_task, lock

__all__ = [
    "Angle",
    "Chain",
    "Joint",
    "Robot",
    "Rotation",
    "Snapped",
    "Translation",
    "check_task",
    "library",
    "lock",
    "open_robot",
    "read_robot",
    "read_urdf",
    "snap",
]
