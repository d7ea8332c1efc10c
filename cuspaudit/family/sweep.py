"""A sweep: every member of a family decided and kept, taken up where it stopped."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Protocol

from cuspaudit.errors import InvalidInputError
from cuspaudit.family.adaptive import waves
from cuspaudit.family.cluster import DaskCluster
from cuspaudit.family.family import Family
from cuspaudit.family.family_file import read_family
from cuspaudit.family.pool import LocalPool
from cuspaudit.family.row import Row
from cuspaudit.family.store import Store
from cuspaudit.runtime.versions import versions

__all__ = ["Swept", "sweep"]

_PACKAGES = ("python-flint", "sympy", "networkx", "numpy", "pyarrow")


class Runner(Protocol):
    """What decides members: processes here, or a cluster."""

    def rows(self, indices: Iterable[int]) -> Iterator[Row]:
        """The rows of the members, in any order."""


@dataclass(frozen=True)
class Swept:
    """What a sweep did.

    Attributes:
        kept: rows that were there before.
        added: rows of this run.
        errors: of those, rows with an error.
    """

    kept: int
    added: int
    errors: int

    def to_dict(self) -> dict[str, int]:
        """The numbers as JSON has them."""
        return asdict(self)


def sweep(
    path: Path,
    folder: Path,
    workers: int = 1,
    progress: Callable[[int, int], None] = lambda done, size: None,
    scheduler: str | None = None,
    timeout: float | None = None,
) -> Swept:
    """Decide every member of the family in ``path`` that ``folder`` lacks.

    Args:
        path: the family file.
        folder: where the table is, or will be.
        workers: processes.
        progress: called with how many indices are dealt with, of how many.
        scheduler: the address of a Dask scheduler that runs already; its workers are
            used instead of processes here.
        timeout: seconds a member may take; one that takes longer is a row with this
            as its error. For processes here only.

    Raises:
        InvalidRobotError: the family cannot be read.
        InvalidInputError: the folder belongs to another family or run, the disk is
            full, or a time limit is asked of a cluster.
    """
    family = read_family(path)
    runner = _runner(family, workers, scheduler, timeout)
    with Store(folder, family, versions(_PACKAGES)) as store, runner as run:
        return _swept(family, store, run, progress)


def _runner(
    family: Family, workers: int, scheduler: str | None, timeout: float | None
) -> AbstractContextManager[Runner]:
    if scheduler is None:
        return LocalPool(family, workers, timeout)
    if timeout is not None:
        raise InvalidInputError(
            file=scheduler,
            found="a time limit for members, which a cluster does not keep",
            expected="leave out --timeout, or leave out --scheduler",
        )
    return DaskCluster(family, scheduler)


def _swept(
    family: Family, store: Store, run: Runner, progress: Callable[[int, int], None]
) -> Swept:
    kept = len(store.done)
    added = errors = 0
    values = store.values(family.adaptive.on) if family.adaptive else {}
    for wave in waves(family, values) if family.adaptive else [family.indices()]:
        missing = (k for k in wave if k not in store.done and k not in values)
        for row in run.rows(missing):
            store.add(row)
            if family.adaptive:
                values[row["index"]] = tuple(map(row.get, family.adaptive.on))
            added += 1
            errors += row.get("error") is not None
            progress(kept + added, 0 if family.adaptive else family.size)
    return Swept(kept, added, errors)
