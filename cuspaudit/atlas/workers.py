"""Robots audited by this process, by several of this machine, or on a Dask cluster."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from multiprocessing import active_children, get_context
from pathlib import Path

from cuspaudit.atlas.arm import AtlasArm, Made, make_arm
from cuspaudit.atlas.entry import failed_entry
from cuspaudit.errors import InvalidInputError
from cuspaudit.runtime.interruption import end_processes

__all__ = ["made_here", "made_on_cluster"]

Work = tuple[AtlasArm, str]
Make = Callable[[AtlasArm, str], list[Made]]

_PATIENCE = "10s"


def made_here(
    work: Sequence[Work], workers: int = 1, make: Make = make_arm
) -> Iterator[list[Made]]:
    """The arms of each robot, as they are ready.

    A robot whose process dies is an entry with that error, and so are those beside it
    that were not finished: run again to go on with them.
    """
    if workers <= 1 or len(work) <= 1:
        yield from (make(arm, key) for arm, key in work)
        return
    others = active_children()
    context = get_context("forkserver")
    with ProcessPoolExecutor(
        min(workers, len(work)), context, initializer=_quiet
    ) as pool:
        try:
            running = {pool.submit(make, arm, key): arm for arm, key in work}
            for future in as_completed(running):
                try:
                    yield future.result()
                except BrokenProcessPool:
                    yield _died(running[future])
        except BaseException:
            end_processes(others)
            raise


def made_on_cluster(
    work: Sequence[Work], address: str, make: Make = make_arm
) -> Iterator[list[Made]]:
    """Those of each robot, as a worker behind the scheduler is ready with them.

    The workers read the same files under the same names.

    Raises:
        InvalidInputError: distributed is not installed, or nobody answers there.
    """
    try:
        from distributed import Client
        from distributed import as_completed as completed
    except ImportError:
        raise InvalidInputError(
            file=address,
            found="distributed is not installed",
            expected="pip install 'cuspaudit[cluster]'",
        ) from None
    try:
        client = Client(address, timeout=_PATIENCE)
    except (OSError, ValueError) as error:
        raise InvalidInputError(
            file=address,
            found=f"no scheduler answers ({type(error).__name__})",
            expected="start one with: dask scheduler; and give its address, "
            "tcp://HOST:8786",
        ) from None
    try:
        running = {client.submit(make, a, k, pure=False): a for a, k in work}
        for future in completed(list(running)):
            arm = running[future]
            yield future.result() if future.status == "finished" else _died(arm)
    finally:
        client.close()


def _died(arm: AtlasArm) -> list[Made]:
    why = "the process of its audit died (killed, or out of memory); run again"
    entry = replace(failed_entry(arm.slug, Path(arm.source).name, why), group=arm.slug)
    return [Made(entry)]


def _quiet() -> None:
    """Leave an interruption to the process that began this one."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
