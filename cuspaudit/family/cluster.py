"""Members decided on an existing Dask cluster, many members a task.

Dask runs a task again when its worker dies, and a member is decided the same way
wherever it runs, so the table is that of a run on one machine.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from types import TracebackType
from typing import Any

from cuspaudit.errors import InvalidInputError
from cuspaudit.family.family import Family
from cuspaudit.family.row import Row, decide_member, failed_member

__all__ = ["DaskCluster"]

_MEMBERS_A_TASK = 16
_TASKS_A_THREAD = 2
_PATIENCE = "20s"


class DaskCluster:
    """The workers behind a scheduler's address (a context manager)."""

    def __init__(self, family: Family, address: str) -> None:
        self._family, self._address = family, address
        self._client: Any = None

    def __enter__(self) -> DaskCluster:
        """Connect.

        Raises:
            InvalidInputError: distributed is not installed, or nobody answers there.
        """
        try:
            from distributed import Client
        except ImportError:
            raise self._error(
                "distributed is not installed", "pip install 'cuspaudit[cluster]'"
            ) from None
        try:
            self._client = Client(self._address, timeout=_PATIENCE)
        except (OSError, ValueError) as error:
            raise self._error(
                f"no scheduler answers ({type(error).__name__})",
                "start one with: dask scheduler; and give its address, tcp://HOST:8786",
            ) from None
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Disconnect; tasks not gathered are dropped by the scheduler."""
        self._client.close()

    def rows(self, indices: Iterable[int]) -> Iterator[Row]:
        """The rows of the members, as their tasks are ready, a few tasks ahead."""
        from distributed import wait

        waiting = iter(indices)
        running: dict[Any, list[int]] = {}
        while True:
            while len(running) < self._ahead():
                members = list(islice(waiting, _MEMBERS_A_TASK))
                if not members:
                    break
                future = self._client.submit(_decide, self._family, members, pure=False)
                running[future] = members
            if not running:
                return
            for future in wait(list(running), return_when="FIRST_COMPLETED").done:
                yield from self._rows(future, running.pop(future))

    def _rows(self, future: Any, members: list[int]) -> list[Row]:
        """The rows of a finished task; of one that killed its workers, error rows."""
        if future.status == "finished":
            rows: list[Row] = future.result()
            return rows
        if future.status != "error":
            raise self._error(
                "the scheduler went away",
                "start it and run again: the rows so far are kept",
            )
        if len(members) > 1:
            halves = (members[: len(members) // 2], members[len(members) // 2 :])
            return [row for half in halves for row in self._again(half)]
        why = f"the task failed on the cluster: {future.exception()!r}"[:400]
        return [failed_member(self._family, members[0], " ".join(why.split()))]

    def _again(self, members: list[int]) -> list[Row]:
        from distributed import wait

        future = self._client.submit(_decide, self._family, members, pure=False)
        wait([future])
        return self._rows(future, members)

    def _ahead(self) -> int:
        threads: int = sum(self._client.nthreads().values())
        return _TASKS_A_THREAD * max(threads, 1)

    def _error(self, found: str, expected: str) -> InvalidInputError:
        return InvalidInputError(file=self._address, found=found, expected=expected)


def _decide(family: Family, members: list[int]) -> list[Row]:
    return [decide_member(family, index) for index in members]
