"""What is known of a tool path: its runs, its births, and how a closed one permutes.

**Theorem (T6).** A run of a closed path that ends in another posture, not the same
modulo whole turns, is a nonsingular path between two postures of one pose: the arm is
cuspidal, within its limits if the run is. *Proof.* That is the definition; its ends are
in one aspect, and the run keeps det J away from 0. QED.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from cuspaudit.toolpath.following.runs import FreeRun
from cuspaudit.toolpath.following.starts import Solved
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import ToolPath

__all__ = ["Birth", "End", "Run", "TracedPath"]

Array = NDArray[np.float64]
End = Literal["reached", "singular", "limit", "undecided"]


@dataclass(frozen=True, eq=False)
class Run:
    """A posture of the first pose in one winding, and what becomes of it.

    Attributes:
        posture: the number of the posture among those of the first pose, from 0.
        start: joint values of the robot, rad or the chain's unit.
        sign: of det J along the run; 0 where the posture is singular.
        inside: whether the winding lies within the limits; a run that does not is
            followed without them.
        end: "reached", or of what it dies; "undecided" where that is not proved.
        at: where, in waypoints: 1.37 is 37 % of the second leg.
        joint: the joint whose limit it meets, or None.
        last: joint values there.
        proved: whether all of this is.
        free: the run without limits; None where the posture is singular.
        turns: whole turns added to the free run, one a joint.
        ends_in: the posture of the last pose that it reaches, or None.
    """

    posture: int
    start: tuple[float, ...]
    sign: int | None
    inside: bool
    end: End
    at: float
    joint: str | None
    last: tuple[float, ...]
    proved: bool
    free: FreeRun | None
    turns: tuple[int, ...]
    ends_in: int | None = None

    def points(self, scales: Array) -> Array:
        """Joint values of the robot and the parameter along it, (m, n + 1)."""
        n = len(self.start)
        if self.free is None:
            return np.array([[*self.start, 0.0]])
        rows = self.free.points
        keep = rows[:, -1] < self.at if self.end != "reached" else rows[:, -1] >= 0
        values = rows[keep][:, :n] * scales[:n] + 2 * np.pi * np.array(self.turns)
        found = np.column_stack([values, rows[keep][:, -1]])
        return np.vstack([found, [*self.last, self.at]])


@dataclass(frozen=True, eq=False)
class Birth:
    """A run that begins on the way.

    Attributes:
        at: where, in waypoints.
        sign: of det J.
        end: "reached", "singular" or "undecided", limits left out of account.
        until: where it ends.
        first: joint values near its birth.
    """

    at: float
    sign: int | None
    end: str
    until: float
    first: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class TracedPath:
    """What becomes of every posture of the first pose of a tool path.

    Attributes:
        arm: the arm.
        path: the tool path.
        limited: whether limits counted.
        runs: in the order of the postures, a run for each winding inside the limits,
            or one outside them.
        born: the runs that begin on the way.
        first: the postures of the first pose.
        last: those of the last pose.
        permutation: for each run of a closed path the run in whose posture and
            winding it ends, or None; None for an open path.
        turns: the whole turns that are left, for each run, or None.
        births_complete: whether no other run is born on the way, proved.
        remarks: what a reader should know.
    """

    arm: TracedArm
    path: ToolPath
    limited: bool
    runs: tuple[Run, ...]
    born: tuple[Birth, ...]
    first: Solved
    last: Solved
    permutation: tuple[int | None, ...] | None
    turns: tuple[tuple[int, ...] | None, ...] | None
    births_complete: bool
    remarks: tuple[str, ...]

    @property
    def closed(self) -> bool:
        """Whether the path ends where it begins."""
        return self.path.is_closed

    @property
    def changing(self) -> list[int]:
        """The runs that end in another posture: witnesses of cuspidality."""
        if self.permutation is None:
            return []
        return [
            k
            for k, to in enumerate(self.permutation)
            if to is not None
            and self.runs[to].posture != self.runs[k].posture
            and self.runs[k].proved
            and _apart(self.arm, self.runs[to].start, self.runs[k].start)
        ]

    @property
    def verdict_from_path(self) -> str | None:
        """``cuspidal`` where a run changes its posture, proved; else None."""
        return "cuspidal" if self.changing else None


def _apart(arm: TracedArm, a: Sequence[float], b: Sequence[float]) -> bool:
    """Whether two postures, known to 1e-10, are not the same up to whole turns."""
    gap = np.array(a) - np.array(b)
    turns = np.where(arm.turning[: arm.joints], np.round(gap / (2 * np.pi)), 0.0)
    return bool(
        np.abs((gap - 2 * np.pi * turns) / arm.scales[: arm.joints]).max() > 1e-9
    )
