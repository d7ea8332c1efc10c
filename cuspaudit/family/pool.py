"""Members decided by processes of this machine; one that dies takes one member along.

The processes come from a clean server that has loaded the mathematics once, and watch
their parent: when it is killed, they go as well.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from itertools import islice
from multiprocessing import (
    active_children,
    connection,
    forkserver,
    get_context,
    parent_process,
)
from multiprocessing.process import BaseProcess
from types import TracebackType

from cuspaudit.errors import UnableError
from cuspaudit.family.family import Family
from cuspaudit.family.row import Row, decide_member, failed_member
from cuspaudit.runtime.interruption import deaf_children, end_processes, held

__all__ = ["LocalPool"]

_AHEAD = 2
_DIED = (
    "the worker process died on this member, twice (killed, out of memory, or at twice "
    "its time limit)"
)


class LocalPool:
    """A pool of processes for the members of one family (a context manager)."""

    def __init__(
        self, family: Family, workers: int, timeout: float | None = None
    ) -> None:
        self._family, self._workers, self._timeout = family, workers, timeout
        self._pool: ProcessPoolExecutor | None = None
        self._others: Sequence[BaseProcess] = ()

    def __enter__(self) -> LocalPool:
        """Nothing is started before there is work."""
        self._others = active_children()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Let the processes go, at once after an error; no other member is begun."""
        if self._pool is not None:
            if kind is not None:
                end_processes(self._others)
            self._pool.shutdown(cancel_futures=True)

    def rows(self, indices: Iterable[int]) -> Iterator[Row]:
        """The rows of the members, as they are ready, a few taken ahead."""
        waiting = iter(indices)
        running: dict[Future[Row], int] = {}
        while True:
            room = _AHEAD * self._workers - len(running)
            suspects = self._submit(islice(waiting, room), running)
            if not running and not suspects:
                return
            ready = wait(running, return_when=FIRST_COMPLETED).done if running else ()
            for future in ready:
                index = running.pop(future)
                try:
                    row = future.result()
                except BrokenProcessPool:
                    suspects.append(index)
                else:
                    yield row
            if suspects:
                suspects += [k for f, k in running.items() if not _finished(f)]
                yield from (f.result() for f in running if _finished(f))
                running.clear()
                self._drop()
                yield from map(self._alone, sorted(suspects))

    def _submit(
        self, indices: Iterable[int], running: dict[Future[Row], int]
    ) -> list[int]:
        """Hand out ``indices``; return those that a broken pool did not take."""
        refused = []
        for index in indices:
            if self._pool is None:
                self._pool = _pool(self._family, self._workers, self._timeout)
            try:
                with held():
                    future = self._pool.submit(_decide, index)
                running[future] = index
            except BrokenProcessPool:
                refused.append(index)
        return refused

    def _alone(self, index: int) -> Row:
        """The row of a member that ran when a process died: now by itself.

        Raises:
            UnableError: processes die before they are given a member.
        """
        with _pool(self._family, 1, self._timeout) as pool:
            try:
                pool.submit(os.getpid).result()
            except BrokenProcessPool:
                raise UnableError("sweep", "no worker process can be started") from None
            try:
                return pool.submit(_decide, index).result()
            except BrokenProcessPool:
                return failed_member(self._family, index, _DIED)

    def _drop(self) -> None:
        if self._pool is not None:
            self._pool.shutdown(wait=False, cancel_futures=True)
        self._pool = None


def _finished(future: Future[Row]) -> bool:
    return future.done() and not future.cancelled() and future.exception() is None


def _pool(family: Family, workers: int, timeout: float | None) -> ProcessPoolExecutor:
    context = get_context("forkserver")
    context.set_forkserver_preload([__name__])
    with deaf_children():
        forkserver.ensure_running()
    begin = (family, timeout)
    return ProcessPoolExecutor(workers, context, initializer=_begin, initargs=begin)


_family: Family | None = None
_timeout: float | None = None


def _begin(family: Family, timeout: float | None) -> None:
    """Make this process ready: it knows the family, and ends with its parent."""
    global _family, _timeout
    _family, _timeout = family, timeout
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os._exit(1)


def _decide(index: int) -> Row:
    assert _family is not None, "the pool was not begun"
    return decide_member(_family, index, _timeout)
