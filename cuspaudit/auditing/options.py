"""How an audit is made."""

from __future__ import annotations

from dataclasses import dataclass

from cuspaudit.robot.snap_policy import DEFAULT_POLICY, SnapPolicy
from cuspaudit.robot.tolerance import AxisTolerance
from cuspaudit.runtime.clock import Progress

__all__ = ["Options"]


@dataclass(frozen=True)
class Options:
    """How an audit is made.

    Attributes:
        seed: of every random choice; it is kept in the result.
        timeout: seconds after which the next step is not begun, or None.
        progress: called with the name of each step before it runs.
        snap: which numbers are taken for others.
        engine: the route to connectivity, "auto", "roadmap" or "routing"; or "pairs",
            which decides three joints, and gives a witness or evidence for six.
        tolerance: how far the axes may be off; None for that of the robot's file, and
            where it has none for no question about it.
    """

    seed: int = 0
    timeout: float | None = None
    progress: Progress = lambda step: None
    snap: SnapPolicy = DEFAULT_POLICY
    engine: str = "auto"
    tolerance: AxisTolerance | None = None
