from __future__ import annotations

import contextlib
import dataclasses
import json
import os
import random
import resource
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import psutil
import pyarrow.parquet as pq
import pytest
import small_families as families

from cuspaudit.errors import InvalidInputError
from cuspaudit.family.family import Family
from cuspaudit.family.family_file import read_family
from cuspaudit.family.pool import LocalPool
from cuspaudit.family.row import decide_member
from cuspaudit.family.store import Store, read_rows
from cuspaudit.family.sweep import sweep
from cuspaudit.robot.robot import Robot
from cuspaudit.runtime.alarm import TimeUp, alarm

QUICK = families.ur_family(40)


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str], Path]:
    """A writer of family files."""

    def written(text: str) -> Path:
        file = tmp_path / "family.yaml"
        file.write_text(text)
        return file

    return written


def stored(folder: Path, family: Family) -> Store:
    """A store for a family."""
    return Store(folder, family, {"cuspaudit": "test"})


def test_a_row_has_the_counts_and_the_exact_numbers(write: Callable[..., Path]) -> None:
    """The row of the paper's arm: cuspidal, 4 cusps, 0 nodes, 2 aspects, 4 postures."""
    family = read_family(
        write(
            families.ORTHOGONAL + "record: [cusps, nodes, aspects, max_postures, "
            "clearance]\nparameters: {a2: {values: [2]}, a3: {values: [3/2]}, "
            "d2: {values: [1]}}\n"
        )
    )
    row = decide_member(family, 0)
    assert row.pop("seconds") > 0
    assert 0 < row.pop("clearance") < 1
    assert row == {
        **{"index": 0, "a2": 2.0, "a2_exact": "2", "a3": 1.5, "a3_exact": "1.5"},
        **{"d2": 1.0, "d2_exact": "1", "verdict": "cuspidal", "proof": "exact"},
        **{"exact": True, "cusps": 4, "nodes": 0, "aspects": 2, "max_postures": 4},
        "why": None,
    }


def test_a_bad_member_is_a_row(write: Callable[..., Path], tmp_path: Path) -> None:
    """Where an expression divides by zero, or det J vanishes, the row says so."""
    text = families.ORTHOGONAL.replace("a: a3", 'a: "a3/(a2 - 1)"')
    file = write(
        text + "parameters: {a2: {values: [2, 1, 3]}, a3: {values: [0, 1/2]}, "
        "d2: {values: [1]}}\nconstraints: [a2 < 3]\n"
    )
    done = sweep(file, tmp_path / "out", 1)
    assert (done.added, done.errors) == (4, 3)
    rows = {row["index"]: row for row in read_rows(tmp_path / "out")}
    assert list(rows) == [0, 1, 2, 3]
    assert rows[1]["verdict"] == "cuspidal"
    assert "divides by zero" in rows[2]["error"]
    assert "det J" in rows[0]["error"]
    again = sweep(file, tmp_path / "out", 1)
    assert (again.kept, again.added) == (4, 0)


def test_derived_numbers_are_columns(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """A derived number stands in the table; a member without one is an error row."""
    text = families.ORTHOGONAL.replace("a: a3", "a: outer")
    file = write(
        text + "parameters: {a2: {values: [2, 1]}, d2: {values: [1]}}\n"
        "derived: {outer: 3/2/(a2 - 1)}\n"
    )
    sweep(file, tmp_path / "out", 1)
    good, bad = families.table(tmp_path / "out")
    assert (good["outer"], good["outer_exact"]) == (1.5, "1.5")
    assert (good["verdict"], good["cusps"]) == ("cuspidal", 4)
    assert (bad["a2"], bad["outer"], bad["verdict"]) == (1.0, None, None)
    assert "divides by zero" in str(bad["error"])


def test_the_table_says_where_it_is_from(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """Hash, seed and versions stand in the table and in family.yaml; readers agree."""
    pandas = pytest.importorskip("pandas")
    file = write(QUICK)
    family = read_family(file)
    with stored(tmp_path / "out", family) as store:
        assert len(pandas.read_parquet(store.parts)) == 0
        for index in range(5):
            store.add(decide_member(family, index))
    frame = pandas.read_parquet(tmp_path / "out" / "results.parquet")
    assert frame["index"].tolist() == [0, 1, 2, 3, 4]
    part = next((tmp_path / "out" / "results.parquet").glob("*1.parquet"))
    about = json.loads(pq.read_schema(part).metadata[b"cuspaudit"])
    assert (about["hash"], about["seed"]) == (family.hash, 0)
    assert read_family(tmp_path / "out" / "family.yaml").hash == family.hash


def test_polars_and_duckdb_open_the_table(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """Both read the folder of parts: the same members with the same verdicts."""
    polars, duckdb = pytest.importorskip("polars"), pytest.importorskip("duckdb")
    family = read_family(write(QUICK))
    with stored(tmp_path / "out", family) as store:
        for index in range(3):
            store.add(decide_member(family, index))
        store.fold()
        store.add(decide_member(family, 3))
    parts = tmp_path / "out" / "results.parquet"
    wanted = [(k, "noncuspidal") for k in range(4)]
    frame = polars.read_parquet(parts).sort("index")
    assert frame.select("index", "verdict").rows() == wanted
    query = f"SELECT index, verdict FROM '{parts}/*.parquet' ORDER BY index"
    assert duckdb.sql(query).fetchall() == wanted


def peak_memory() -> dict[int, int]:
    """The most memory, in kB, that this process and its children have ever held."""
    here = psutil.Process()
    peaks = {}
    for process in (here, *here.children(recursive=True)):
        status = Path(f"/proc/{process.pid}/status").read_text()
        peaks[process.pid] = int(status.split("VmHWM:")[1].split()[0])
    return peaks


@pytest.mark.slow
def test_memory_does_not_grow_with_the_members(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """The last 300 of 400 members raise no worker's peak by 1 MB, nor ours by 5 MB."""
    peaks: dict[int, dict[int, int]] = {}

    def note(done: int, size: int) -> None:
        if done in (100, 400):
            peaks[done] = peak_memory()

    sweep(write(families.ur_family(400)), tmp_path / "out", 2, note)
    grown = {k: peaks[400][k] - peaks[100][k] for k in peaks[100] if k in peaks[400]}
    assert len(grown) >= 4, "this process, two workers, and where they come from"
    assert grown.pop(os.getpid()) < 5000, "a part is written now and then"
    assert max(grown.values()) < 1000, grown


def test_a_changed_family_does_not_mix(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """Rows of another family are refused and stay; a comment is no change."""
    out = tmp_path / "out"
    with stored(out, read_family(write(QUICK))):
        pass
    with stored(out, read_family(write("# a remark\n" + QUICK))):
        pass
    changed = read_family(write(QUICK.replace("0.7", "0.8")))
    with pytest.raises(InvalidInputError, match="another family"), stored(out, changed):
        pass


def test_a_torn_journal_loses_its_torn_row_only(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """Rows in the journal become a part, once; half a line is decided again."""
    family, out = read_family(write(QUICK)), tmp_path / "out"
    with stored(out, family) as store:
        store.add(decide_member(family, 0))
    rows = [decide_member(family, index) for index in (0, 1, 2)]
    lines = "\n".join(json.dumps(row) for row in rows)
    (out / "journal.jsonl").write_text(lines[:-30])
    with stored(out, family) as store:
        assert [k for k in range(5) if k in store.done] == [0, 1]
    assert [row["index"] for row in read_rows(out)] == [0, 1]


def test_two_runs_on_one_folder(write: Callable[..., Path], tmp_path: Path) -> None:
    """The second run says who holds the folder, and exits with 2."""
    file = write(QUICK)
    with stored(tmp_path / "out", read_family(file)):
        second = families.swept(file, tmp_path / "out")
    assert second.returncode == 2
    assert f"another sweep (process {os.getpid()})" in second.stderr
    assert second.stderr.count("\n") == 1


def test_a_full_disk_is_one_line_and_loses_nothing(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """When a file cannot grow, the sweep ends in one line; with room it goes on."""
    file, out = write(QUICK), tmp_path / "out"

    def small_files() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000))

    full = subprocess.run(
        families.command(file, out),
        preexec_fn=small_files,
        capture_output=True,
        text=True,
        check=False,
    )
    assert full.returncode == 2
    assert "rows so far are kept" in full.stderr
    assert full.stderr.count("\n") == 1
    done = sweep(file, out, 1)
    assert done.kept > 5
    assert done.kept + done.added == 40
    assert [row["index"] for row in read_rows(out)] == list(range(40))


class Deadly(Family):
    """A family one of whose members kills the process that tries it."""

    def robot(self, index: int) -> Robot:
        """The robot, except for member 5."""
        if index == 5:
            os.kill(os.getpid(), signal.SIGKILL)
        return super().robot(index)


def test_a_dying_worker_costs_its_member_only(write: Callable[..., Path]) -> None:
    """A member that kills its process twice is a row with an error."""
    plain = read_family(write(families.ur_family(12)))
    fields = {f.name: getattr(plain, f.name) for f in dataclasses.fields(plain)}
    with LocalPool(Deadly(**fields), 2) as pool:
        rows = {row["index"]: row for row in pool.rows(range(12))}
    assert sorted(rows) == list(range(12))
    assert [k for k, row in rows.items() if row.get("error")] == [5]
    assert "died" in rows[5]["error"]


class Endless(Family):
    """A family whose member 2 never ends."""

    def robot(self, index: int) -> Robot:
        """The robot, except for member 2."""
        while index == 2:
            with contextlib.suppress(Exception):
                time.sleep(0.01)
        return super().robot(index)


class Deaf(Family):
    """A family whose member 2 cannot be interrupted."""

    def robot(self, index: int) -> Robot:
        """The robot, except for member 2."""
        if index == 2:
            signal.signal(signal.SIGALRM, signal.SIG_IGN)
        while index == 2:
            pass
        return super().robot(index)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "words"),
    [
        (Endless, "member: the time limit of 3 s has passed"),
        (Deaf, "at twice its time limit"),
    ],
)
def test_a_slow_member_is_a_row(
    write: Callable[..., Path], kind: type[Family], words: str
) -> None:
    """A member beyond its time is a row with this error, and the others are decided."""
    plain = read_family(write(families.ur_family(6)))
    fields = {f.name: getattr(plain, f.name) for f in dataclasses.fields(plain)}
    with LocalPool(kind(**fields), 2, timeout=3) as pool:
        rows = {row["index"]: row for row in pool.rows(range(6))}
    assert sorted(rows) == list(range(6))
    errors = {k: row["error"] for k, row in rows.items() if row.get("error")}
    assert list(errors) == [2], errors
    assert words in errors[2]


def test_a_member_beyond_its_time_is_a_row(write: Callable[..., Path]) -> None:
    """The paper's arm in a millisecond: an error, and no verdict."""
    file = write(
        families.ORTHOGONAL + "parameters: {a2: {values: [2]}, a3: {values: [3/2]}, "
        "d2: {values: [1]}}\n"
    )
    row = decide_member(read_family(file), 0, timeout=0.001)
    assert row["error"] == "member: the time limit of 0.001 s has passed"
    assert row["a2"] == 2.0
    assert "verdict" not in row


def test_no_limit_is_left_running() -> None:
    """After a block that ends in time nothing rings."""
    with alarm(0.5):
        pass
    time.sleep(0.6)
    with pytest.raises(TimeUp), alarm(0.05):
        time.sleep(10)


def test_a_cluster_keeps_no_limit(write: Callable[..., Path], tmp_path: Path) -> None:
    """A time limit asked of a cluster is refused before anything is written."""
    with pytest.raises(InvalidInputError, match="leave out --timeout"):
        sweep(write(QUICK), tmp_path / "out", scheduler="tcp://x:1", timeout=1)
    assert not (tmp_path / "out").exists()


def killed_and_resumed(file: Path, folder: Path, kills: int, longest: float) -> None:
    """Sweep, killed ``kills`` times at random moments after it began to write."""
    moments = random.Random(7)
    for _ in range(kills):
        process = subprocess.Popen(families.command(file, folder, "-j", "2"))
        until = time.monotonic() + 30
        journal = folder / "journal.jsonl"
        held = f"{process.pid}\n"
        while time.monotonic() < until and process.poll() is None:
            lock = folder / ".lock"
            if journal.exists() and lock.exists() and lock.read_text() == held:
                break
            time.sleep(0.01)
        time.sleep(moments.uniform(0, longest))
        workers = psutil.Process(process.pid).children(recursive=True)
        process.kill()
        process.wait()
        gone, alive = psutil.wait_procs(workers, timeout=10)
        assert not alive, f"workers outlived their parent: {alive}; {gone} went"
    sweep(file, folder, 2)


def test_killed_and_resumed_is_the_undisturbed_table(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """Two SIGKILLs in a sweep of 60 leave the table of an undisturbed run."""
    file = write(families.ur_family(60))
    killed_and_resumed(file, tmp_path / "killed", 2, 2.0)
    sweep(file, tmp_path / "whole", 2)
    assert families.table(tmp_path / "killed") == families.table(tmp_path / "whole")
    assert len(families.table(tmp_path / "whole")) == 60


@pytest.mark.slow
def test_killed_twenty_times_in_five_hundred(
    write: Callable[..., Path], tmp_path: Path
) -> None:
    """Twenty SIGKILLs in a sweep of 500: no row lost, none twice, all the same."""
    file = write(families.ur_family(500))
    killed_and_resumed(file, tmp_path / "killed", 20, 1.5)
    sweep(file, tmp_path / "whole", 2)
    assert families.table(tmp_path / "killed") == families.table(tmp_path / "whole")
    assert len(families.table(tmp_path / "whole")) == 500
