"""The elements of an SDF file that place links and move them.

What an <include> would bring may be part of the arm, so the file is refused. Visuals,
collisions, sensors and plugins are passed over.
"""

from __future__ import annotations

from cuspaudit.robot.formats.elements import Kinds

__all__ = ["SDF_KINDS"]

SDF_KINDS = Kinds(
    root="sdf",
    model="an SDF model",
    kept=frozenset(
        {
            *("sdf", "world", "model", "link", "joint", "frame", "pose"),
            *("parent", "child", "axis", "axis2", "xyz", "use_parent_model_frame"),
            *("limit", "lower", "upper", "mimic", "multiplier", "offset", "reference"),
        }
    ),
    refused={
        "include": ("an <include>", "write the model that it names in its place"),
    },
)
