"""A robot and its polynomial map: chains, D-H tables, URDF, reductions."""

from cuspaudit.kinematics.chain import (
    Angle,
    Chain,
    Joint,
    Rotation,
    Translation,
)
from cuspaudit.kinematics.reading import read_robot
from cuspaudit.kinematics.robot import Robot
from cuspaudit.kinematics.snapping import Snapped, snap
from cuspaudit.kinematics.task import check_task, lock
from cuspaudit.kinematics.urdf import read_urdf

__all__ = [
    "Angle",
    "Chain",
    "Joint",
    "Robot",
    "Rotation",
    "Snapped",
    "Translation",
    "check_task",
    "lock",
    "read_robot",
    "read_urdf",
    "snap",
]
