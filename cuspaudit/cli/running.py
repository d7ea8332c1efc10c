"""One audit run for the terminal, with the step under way."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cuspaudit.auditing.record import FinishedAudit
    from cuspaudit.robot.robot import Robot

__all__ = ["STEPS", "progress_bar", "run_audit"]

#: of an audit, in their order; an arm has some of them
STEPS = (
    *("import", "reductions", "crit", "atypical_values", "roadmap"),
    *("sample_points_rational", "sample_points", "graph_isotop", "cusps and nodes"),
    *(
        "certificate",
        "search",
        "pairs",
        "aspects",
        "literal",
        "tolerance",
        "crosscheck",
    ),
)


def run_audit(
    robot: Robot,
    seed: int,
    timeout: float | None,
    snap: str,
    engine: str = "auto",
    tolerance: Path | None = None,
) -> FinishedAudit:
    """The audit of a robot, its steps shown on a terminal.

    Raises:
        CuspauditError: no audit of this robot, or no such policy of numbers.
    """
    from cuspaudit.auditing.audit import Options, audit
    from cuspaudit.robot.snap_policy import policy_from_name
    from cuspaudit.robot.tolerance import tolerance_from_file

    policy = policy_from_name(snap)
    allowed = None if tolerance is None else tolerance_from_file(str(tolerance))
    with progress_bar(STEPS) as step:
        return audit(robot, Options(seed, timeout, step, policy, engine, allowed))


@contextmanager
def progress_bar(steps: Sequence[str]) -> Iterator[Callable[[str], None]]:
    """A bar over ``steps`` with the name and time of the one under way.

    On a terminal only. A step that is left out is passed over; one that comes again, or
    is not among ``steps``, moves nothing. What follows a colon is detail.
    """
    if not sys.stderr.isatty():
        yield lambda step: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    columns = (BarColumn(20), TimeElapsedColumn(), TextColumn("{task.description}"))
    with Progress(*columns, console=console, transient=True) as bar:
        task, done = bar.add_task(steps[0], total=len(steps)), 0

        def show(step: str) -> None:
            nonlocal done
            name = step.partition(":")[0]
            done = max(done, steps.index(name)) if name in steps else done
            bar.update(task, description=step, completed=done)

        yield show
