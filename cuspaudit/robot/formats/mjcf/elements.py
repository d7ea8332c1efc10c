"""The elements of an MJCF file that place bodies and move them.

What an <include> or a plugin would bring may be part of the arm, so the file is
refused. Meshes, contacts, actuators and the like are passed over.
"""

from __future__ import annotations

from cuspaudit.robot.formats.elements import Kinds

__all__ = ["MJCF_KINDS"]

_SAVE = (
    'let MuJoCo save it whole: python -c "import mujoco as m; m.mj_saveLastXML('
    "'whole.xml', m.MjModel.from_xml_path('FILE'))\", and give whole.xml"
)

MJCF_KINDS = Kinds(
    root="mujoco",
    model="an MJCF model",
    kept=frozenset(
        {
            *("mujoco", "compiler", "default", "joint", "freejoint", "worldbody"),
            *("body", "frame", "site", "equality", "connect", "weld", "tendon"),
        }
    ),
    refused={
        "include": ("an <include>", _SAVE),
        "attach": ("an <attach>", _SAVE),
        "replicate": ("a <replicate>", _SAVE),
        "composite": ("a <composite>", "leave it out: an arm has none"),
        "flexcomp": ("a <flexcomp>", "leave it out: an arm has none"),
    },
)
