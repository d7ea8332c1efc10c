"""One audit run for the terminal: the step under way, the proof, the page."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

if TYPE_CHECKING:
    from cuspaudit.auditing.audit import Audit
    from cuspaudit.robot.chain import Chain
    from cuspaudit.robot.robot import Robot

__all__ = ["STEPS", "certificate_text", "page_text", "progress_bar", "run_audit"]

#: of an audit, in their order; an arm has some of them
STEPS = (
    *("import", "reductions", "crit", "atypical_values", "roadmap"),
    *("sample_points_rational", "sample_points", "graph_isotop", "cusps and nodes"),
    *("certificate", "search", "pairs", "aspects", "literal", "crosscheck"),
)


def run_audit(
    robot: Robot,
    locked: Mapping[str, str],
    seed: int,
    timeout: float | None,
    snap: str,
    engine: str = "auto",
) -> Audit:
    """The audit of a robot, its steps shown on a terminal.

    Raises:
        CuspauditError: no audit of this robot, or no such policy of numbers.
    """
    from cuspaudit.auditing.audit import Options, audit
    from cuspaudit.robot.snap_policy import policy_from_name

    policy = policy_from_name(snap)
    with progress_bar(STEPS) as step:
        return audit(robot, Options(seed, timeout, locked, step, policy, engine))


def certificate_text(result: Audit) -> str | None:
    """The certificate of the verdict, if it has one."""
    from cuspaudit.auditing.certificates import certificate_of_audit
    from cuspaudit.certificate import text_from_certificate

    certificate = certificate_of_audit(result)
    return None if certificate is None else text_from_certificate(certificate)


def page_text(record: Mapping[str, Any], result: Audit, proof: str | None) -> str:
    """The offline page: the witness path, or the postures of one pose."""
    from cuspaudit.pictures.postures import shown_postures
    from cuspaudit.robot.formats.urdf.visuals import visuals
    from cuspaudit.robot.library import example_robot_data
    from cuspaudit.viz import build_scene, render_page, sample_path, sample_postures

    chain: Chain = result.shown_chain
    own = len(chain.joints)
    if result.witness is not None:
        frames = sample_path(chain, result.witness.path[:, :own].tolist())
    else:
        shown = shown_postures(result.answer, result.seed)
        rows = [posture[:own] for posture in shown.postures]
        frames = sample_postures(chain, rows, shown.aspects)
    share = example_robot_data()
    shapes = (
        visuals(result.robot, [share] if share else []) if result.robot.urdf else ()
    )
    scene = build_scene(chain, frames, shapes)
    return render_page(record, scene, certificate=proof)


@contextmanager
def progress_bar(steps: Sequence[str]) -> Iterator[Callable[[str], None]]:
    """A bar over ``steps`` with the name and time of the one under way.

    On a terminal only. A step that is left out is passed over; one that comes again, or
    is not among ``steps``, moves nothing. What follows a colon is detail.
    """
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda step: None
        return
    columns = (BarColumn(20), TimeElapsedColumn(), TextColumn("{task.description}"))
    with Progress(*columns, console=console, transient=True) as bar:
        task, done = bar.add_task(steps[0], total=len(steps)), 0

        def show(step: str) -> None:
            nonlocal done
            name = step.partition(":")[0]
            done = max(done, steps.index(name)) if name in steps else done
            bar.update(task, description=step, completed=done)

        yield show
