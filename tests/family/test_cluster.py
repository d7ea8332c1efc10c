from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
import small_families as families

from cuspaudit.errors import InvalidInputError
from cuspaudit.family.sweep import sweep

pytest.importorskip("distributed")


def start(*words: str, log: Path) -> subprocess.Popen[bytes]:
    """A Dask process on loopback, its output in ``log``."""
    with log.open("wb") as stream:
        return subprocess.Popen(
            [sys.executable, "-m", "distributed.cli." + words[0], *words[1:]],
            stdout=stream,
            stderr=stream,
        )


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A scheduler and two workers as separate processes."""
    log = tmp_path / "scheduler.log"
    words = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    processes = [start("dask_scheduler", *words, log=log)]
    address = None
    until = time.monotonic() + 60
    while address is None and time.monotonic() < until:
        address = re.search(r"tcp://127\.0\.0\.1:\d+", log.read_text())
        time.sleep(0.1)
    assert address, log.read_text()
    options = ("--nthreads", "1", "--no-dashboard", "--no-nanny")
    for number in range(2):
        options_here = (*options, "--local-directory", str(tmp_path))
        worker_log = tmp_path / f"worker-{number}.log"
        processes.append(
            start("dask_worker", address[0], *options_here, log=worker_log)
        )
    try:
        yield address[0], processes[1:]
    finally:
        for process in processes:
            process.kill()
            process.wait()


def test_nobody_answers_is_one_line(tmp_path: Path) -> None:
    """A wrong address says what to start."""
    file = tmp_path / "family.yaml"
    file.write_text(families.ur_family(3))
    with pytest.raises(InvalidInputError, match="tcp://HOST"):
        sweep(file, tmp_path / "out", scheduler="nonsense://127.0.0.1:1")


@pytest.mark.slow
def test_the_cluster_gives_the_same_table(
    tmp_path: Path, cluster: tuple[str, list[subprocess.Popen[bytes]]]
) -> None:
    """On Dask, one worker killed in the middle, the table is that of one process."""
    address, workers = cluster
    file = tmp_path / "family.yaml"
    file.write_text(
        families.ORTHOGONAL + "parameters: {a2: {range: [0.25, 2.5], steps: 10}, "
        "a3: {range: [0.2, 2.9], steps: 10}, d2: {values: [1]}}\n"
    )
    command = families.command(file, tmp_path / "dask", "--scheduler", address)
    process = subprocess.Popen(command)
    journal = tmp_path / "dask" / "journal.jsonl"
    until = time.monotonic() + 120
    while time.monotonic() < until and process.poll() is None:
        if journal.exists() and journal.stat().st_size > 0:
            break
        time.sleep(0.02)
    assert process.poll() is None, "it ended before a worker could be killed"
    psutil.Process(workers[0].pid).send_signal(signal.SIGKILL)
    assert process.wait(timeout=170) == 0
    sweep(file, tmp_path / "local", 1)
    assert families.table(tmp_path / "dask") == families.table(tmp_path / "local")
    assert len(families.table(tmp_path / "dask")) == 100
