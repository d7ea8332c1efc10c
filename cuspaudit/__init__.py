"""Decide, with a proof, whether a robot arm is cuspidal.

    >>> import cuspaudit as cu
    >>> audit = cu.audit(cu.load("ur5"))
    >>> audit.verdict == "noncuspidal"
    True

The names below are the whole public interface, and each is loaded when it is first
used: importing the package costs next to nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cuspaudit.api.calls import audit, check, decide, load, sweep, verify
    from cuspaudit.api.results import Audit, SystemAudit
    from cuspaudit.api.tool_paths import (
        Connection,
        Postures,
        Trace,
        postures,
        same_aspect,
        trace,
    )
    from cuspaudit.auditing.check import Checked
    from cuspaudit.certificate.checker import Verification
    from cuspaudit.cuspidality.verdict import Verdict
    from cuspaudit.errors import CuspauditError
    from cuspaudit.family.sweep import Swept
    from cuspaudit.robot.robot import Robot

__version__ = "0.2.0"

#: where each public name lives
_PLACES = {
    **dict.fromkeys(
        ("audit", "check", "decide", "load", "sweep", "verify"), "api.calls"
    ),
    **dict.fromkeys(("Audit", "SystemAudit"), "api.results"),
    **dict.fromkeys(
        ("Connection", "Postures", "Trace", "postures", "same_aspect", "trace"),
        "api.tool_paths",
    ),
    "Checked": "auditing.check",
    "CuspauditError": "errors",
    "Robot": "robot.robot",
    "Swept": "family.sweep",
    "Verdict": "cuspidality.verdict",
    "Verification": "certificate.checker",
}

__all__ = [
    "Audit",
    "Checked",
    "Connection",
    "CuspauditError",
    "Postures",
    "Robot",
    "Swept",
    "SystemAudit",
    "Trace",
    "Verdict",
    "Verification",
    "__version__",
    "audit",
    "check",
    "decide",
    "load",
    "postures",
    "same_aspect",
    "sweep",
    "trace",
    "verify",
]


def __getattr__(name: str) -> Any:
    """A public name, loaded from where it lives."""
    if name not in _PLACES:
        raise AttributeError(f"module 'cuspaudit' has no attribute {name!r}")
    value = getattr(import_module(f"cuspaudit.{_PLACES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
