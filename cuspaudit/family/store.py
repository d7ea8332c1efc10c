"""The table of a sweep on disk: a folder that can be read, killed and continued.

::

    DIR/family.yaml              the family, with its hash, versions and seed
    DIR/results.parquet/         parts, each one complete: pandas, polars, DuckDB
    DIR/journal.jsonl            rows that are in no part yet
    DIR/.lock                    held by the run that writes

A finished row is appended to the journal at once; now and then the rows of the journal
become a part, written beside and renamed. So a reader sees whole parts only, and a
process killed at any moment loses nothing but the members it was working on.
"""

from __future__ import annotations

import fcntl
import json
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import yaml

from cuspaudit.errors import InvalidInputError
from cuspaudit.family.family import Family
from cuspaudit.family.family_file import read_family
from cuspaudit.family.index_set import IndexSet
from cuspaudit.family.row import Row
from cuspaudit.runtime.writing import write_text

__all__ = ["Store", "read_rows"]

_MOST_ROWS = 1000
_SECONDS = 10.0
_TYPES = {
    "cusps": pa.int64(),
    "nodes": pa.int64(),
    "aspects": pa.int64(),
    "max_postures": pa.int64(),
    "clearance": pa.float64(),
    "tolerance": pa.float64(),
    "within_limits": pa.string(),
}


class Store:
    """The folder of one sweep, held by one run at a time (a context manager)."""

    def __init__(self, folder: Path, family: Family, versions: dict[str, Any]) -> None:
        """Name the folder; nothing is touched before ``with``."""
        self.folder, self._family = folder, family
        self.parts = folder / "results.parquet"
        self.done = IndexSet()
        self._about = {"hash": family.hash, "seed": family.seed, "versions": versions}
        self._schema = _schema(family, self._about)
        self._waiting: list[Row] = []
        self._folded = time.monotonic()
        self._lock = self._journal = -1

    def __enter__(self) -> Store:
        """Lock the folder, hold it to the family, and take up what is there.

        Raises:
            InvalidInputError: another run holds it, it belongs to another family, or
                it cannot be written.
        """
        with _disk_errors(self.folder):
            self.folder.mkdir(parents=True, exist_ok=True)
            self._take_lock()
            try:
                self._hold_family()
                self._take_up()
            except BaseException:
                os.close(self._lock)
                raise
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Write the last part, unless writing is what failed, and let go."""
        try:
            if not isinstance(error, InvalidInputError):
                self.fold()
        finally:
            os.close(self._journal)
            os.close(self._lock)

    def add(self, row: Row) -> None:
        """Keep ``row``.

        Raises:
            InvalidInputError: the disk is full or the folder cannot be written.
        """
        line = json.dumps(row).encode() + b"\n"
        with _disk_errors(self.folder):
            while line:
                line = line[os.write(self._journal, line) :]
        self._waiting.append(row)
        late = time.monotonic() - self._folded > _SECONDS
        if late or len(self._waiting) >= _MOST_ROWS:
            self.fold()

    def fold(self) -> None:
        """Make a part of the rows in the journal.

        Raises:
            InvalidInputError: as in `add`.
        """
        with _disk_errors(self.folder):
            if self._waiting:
                self._write_part(self._waiting)
            os.ftruncate(self._journal, 0)
        self._waiting, self._folded = [], time.monotonic()

    def values(self, columns: tuple[str, ...]) -> dict[int, tuple[Any, ...]]:
        """Index to the values of ``columns``, of every row there is."""
        names = ["index", *columns]
        found = {}
        for path in sorted(self.parts.glob("*.parquet")):
            for row in pq.read_table(path, columns=names).to_pylist():
                found[row["index"]] = tuple(row[name] for name in columns)
        for row in self._waiting:
            found[row["index"]] = tuple(row.get(name) for name in columns)
        return found

    def _take_lock(self) -> None:
        """The lock is the system's: it goes with its process, however that ends."""
        path = self.folder / ".lock"
        self._lock = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            pid = os.read(self._lock, 20).decode("ascii", "replace").strip()
            os.close(self._lock)
            raise InvalidInputError(
                file=str(self.folder),
                found=f"another sweep (process {pid}) is writing there",
                expected="wait for it, or name another folder with -o",
            ) from None
        os.ftruncate(self._lock, 0)
        os.write(self._lock, f"{os.getpid()}\n".encode())

    def _hold_family(self) -> None:
        path = self.folder / "family.yaml"
        if path.exists():
            if read_family(path).hash != self._family.hash:
                raise InvalidInputError(
                    file=str(self.folder),
                    found=f"holds rows of another family than {self._family.file}",
                    expected="name another folder with -o, or sweep its family.yaml",
                )
        elif self.parts.exists() or (self.folder / "journal.jsonl").exists():
            raise InvalidInputError(
                file=str(self.folder),
                found="holds rows and no family.yaml",
                expected="name another folder with -o",
            )
        else:
            said = json.loads(self._family.text) | {"provenance": self._about}
            write_text(path, yaml.safe_dump(said, sort_keys=False, allow_unicode=True))
        if not any(self.parts.glob("*.parquet")):
            self.parts.mkdir(exist_ok=True)
            self._write_part([])

    def _take_up(self) -> None:
        """Note what the parts hold, then make a part of what only the journal holds."""
        for path in sorted(self.parts.glob("*.parquet")):
            indices = pq.read_table(path, columns=["index"])["index"]
            self.done.update(indices.to_numpy())
        journal = self.folder / "journal.jsonl"
        flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC
        self._journal = os.open(journal, flags, 0o644)
        rows = {row["index"]: row for row in _journal_rows(journal)}
        self._waiting = [row for k, row in rows.items() if k not in self.done]
        self.done.update(list(rows))
        self.fold()

    def _write_part(self, rows: list[Row]) -> None:
        numbers = [int(p.stem[5:]) for p in self.parts.glob("part-*.parquet")]
        name = f"part-{max(numbers, default=-1) + 1:08d}.parquet"
        table = pa.Table.from_pylist(rows, schema=self._schema)
        beside = self.folder / f".{name}"
        try:
            with beside.open("wb") as stream:
                pq.write_table(table, stream)
                stream.flush()
                os.fsync(stream.fileno())
            os.replace(beside, self.parts / name)
        finally:
            beside.unlink(missing_ok=True)


def read_rows(folder: Path) -> list[Row]:
    """The rows of a sweep, by index; of one that runs, those in its parts.

    Raises:
        InvalidInputError: the folder is not one of a sweep.
    """
    parts = folder / "results.parquet"
    if not (folder / "family.yaml").is_file() or not parts.is_dir():
        raise InvalidInputError(
            file=str(folder),
            found="not a folder of a sweep",
            expected="name the DIR of cuspaudit sweep FAMILY.yaml -o DIR",
        )
    rows: list[Row] = pq.read_table(parts).to_pylist()
    return sorted(rows, key=lambda row: int(row["index"]))


def _schema(family: Family, about: dict[str, Any]) -> pa.Schema:
    fields = [("index", pa.int64())]
    for name in (*(p.name for p in family.parameters), *family.derived):
        fields += [(name, pa.float64()), (f"{name}_exact", pa.string())]
    fields += [("verdict", pa.string()), ("proof", pa.string()), ("exact", pa.bool_())]
    fields += [(name, _TYPES[name]) for name in family.record]
    fields += [("seconds", pa.float64()), ("why", pa.string()), ("error", pa.string())]
    return pa.schema(fields).with_metadata({"cuspaudit": json.dumps(about)})


def _journal_rows(path: Path) -> Iterator[Row]:
    """The rows of a journal; what a full disk or a kill cut off is left out."""
    for line in path.read_bytes().split(b"\n"):
        try:
            row = json.loads(line)
        except ValueError:
            continue
        if isinstance(row, dict) and isinstance(row.get("index"), int):
            yield row


@contextmanager
def _disk_errors(folder: Path) -> Iterator[None]:
    """Turn an error of the disk into one line; what was kept stays kept."""
    try:
        yield
    except (OSError, pa.ArrowException) as error:
        reason = getattr(error, "strerror", None) or str(error).splitlines()[0]
        raise InvalidInputError(
            file=str(folder),
            found=f"cannot be written ({reason})",
            expected="make room and run again: the rows so far are kept",
        ) from error
