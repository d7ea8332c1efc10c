"""Long work in a process of its own, with a limit of time and of memory.

A kernel cannot be asked to stop: what takes too long, or too much memory, is ended
from outside, together with every program it has started, and the step it was at is
named. So a decision that is too large ends as an answer, not as a hang or a kill.
"""

from __future__ import annotations

import faulthandler
import os
import resource
import signal
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import current_process, get_context
from multiprocessing.connection import Connection
from multiprocessing.context import ForkProcess
from typing import Any

from cuspaudit.errors import TimeLimitError, UnableError
from cuspaudit.runtime.clock import Clock, Progress, time_limit

__all__ = ["run_in_own_process"]

_PATIENCE = 0.2


def run_in_own_process(
    work: Callable[[Progress], Any],
    *,
    timeout: float | None = None,
    memory: int | None = None,
    progress: Progress = lambda step: None,
) -> Any:
    """What ``work`` returns, from a process of its own.

    A worker of a `multiprocessing.Pool` may have no process of its own: there the work
    is done in place, and stops where it asks for the time.

    Args:
        work: called with a function that takes the name of each step before it runs;
            what it returns must pickle.
        timeout: in s, or None.
        memory: the largest address space of the process, in bytes, or None.
        progress: called here with each step's name, and again while it lasts.

    Raises:
        UnableError: a limit was met, or the process died; it names the last step.
        Exception: whatever ``work`` raised.
    """
    if current_process().daemon:
        with time_limit(timeout):
            return work(progress)
    context = get_context("fork")
    here, there = context.Pipe(duplex=False)
    child = context.Process(target=_run, args=(work, there, memory))
    clock = Clock(timeout)
    step = "start"
    child.start()
    there.close()
    try:
        while True:
            if here.poll(_PATIENCE):
                kind, value = here.recv()
                if kind == "step":
                    step = value
                elif kind == "error":
                    raise value
                else:
                    return value
            progress(step)
            if timeout is not None and not clock.left:
                raise TimeLimitError(step, timeout)
    except EOFError:
        why = "its process died"
        if memory is not None:
            why += f", most likely at the memory limit of {memory / 2**30:.1f} GiB"
        raise UnableError(step, why) from None
    finally:
        _end(child)
        child.join()
        here.close()


def _run(
    work: Callable[[Progress], Any], there: Connection, memory: int | None
) -> None:
    """In the child: a group of its own, so that all it starts ends with it."""
    os.setsid()
    faulthandler.disable()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if memory is not None:
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 2)
    step = "start"

    def report(name: str) -> None:
        nonlocal step
        step = name
        there.send(("step", name))

    try:
        there.send(("value", work(report)))
    except MemoryError:
        there.send(("error", UnableError(step, "out of memory")))
    except Exception as error:
        there.send(("error", error))


def _end(child: ForkProcess) -> None:
    with suppress(ProcessLookupError, PermissionError):
        assert child.pid is not None, "it was started"
        os.killpg(child.pid, signal.SIGKILL)
    child.kill()
