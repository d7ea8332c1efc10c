"""The rows of the hostile corpus that the command line answers otherwise: none may.

    python tests/hostile_table.py [-j N] [FILE...]

Each file goes through `cuspaudit` in a process of its own, in an empty folder, with a
limit on memory. A row differs when the answer is not the one that EXPECT.csv asks for;
when a refusal is not one line and exit code 2; when a note is missing; when it takes
more than 5 s of processor time or 500 MB; when a file other than the input and Python's
own is opened, one is written, or a socket is touched (Python's audit events see these).
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

CORPUS = Path(__file__).parents[2] / "shared" / "corpus"
SECONDS, MEGABYTES = 5.0, 500
PWNED = Path("/tmp/CUSPAUDIT_PWNED")
#: what a user states when a table does not
OPTIONS = {
    ".csv": ("--convention", "standard", "--angle-unit", "rad"),
    ".json": ("--angle-unit", "rad"),
    ".yaml": ("--angle-unit", "rad"),
}


@dataclass(frozen=True)
class Row:
    """One file: what is expected, what came, and what is wrong with that.

    Attributes:
        file: its name.
        expected: the answer in EXPECT.csv.
        answer: OK, OK + note, REFUSED, or what else happened.
        seconds: of processor time, with the start of Python.
        megabytes: largest resident memory.
        differs: what is wrong; "" when nothing is.
        said: the first line of the answer.
    """

    file: str
    expected: str
    answer: str
    seconds: float
    megabytes: float
    differs: str
    said: str


def examine(path: Path, expected: str) -> Row:
    """Run the command line on one file.

    A file that may be accepted is imported; one that must be refused is audited, which
    refuses what `import` would still show, such as one joint for a pose.
    """
    word = "import" if "OK" in expected else "audit"
    command = [word, str(path), *OPTIONS.get(path.suffix, ())]
    with tempfile.TemporaryDirectory() as folder:
        out, err, status, seconds, (peak, touched) = _run(command, Path(folder))
        touched += [f"wrote {name}" for name in os.listdir(folder)]
    noted = any(_is_note(line) for line in out)
    answer = {0: "OK + note" if noted else "OK", 2: "REFUSED"}.get(
        status, f"exit code {status}"
    )
    faults = [*touched]
    if not _fits(answer, expected):
        faults.append(f"answered {answer}")
    if status == 2 and (out or len(err) != 1 or str(path) not in err[0]):
        faults.append("not one line that names the file")
    if any("Traceback" in line for line in [*out, *err]):
        faults.append("a traceback")
    if seconds > SECONDS:
        faults.append(f"{seconds:.1f} s")
    if peak > MEGABYTES:
        faults.append(f"{peak:.0f} MB")
    if PWNED.exists():
        faults.append(f"{PWNED} exists")
    said = (err or out or [""])[0].replace(str(path.parent) + "/", "")
    differs = "; ".join(dict.fromkeys(faults))
    return Row(path.name, expected, answer, seconds, peak, differs, said)


def _is_note(line: str) -> bool:
    """Whether a line states an assumption that the control arm does not need."""
    if line.startswith("snapped: "):
        return "-> " in line and "1.5707963267948966" not in line
    return line.startswith(("note: ", "approximated: "))


def _fits(answer: str, expected: str) -> bool:
    if answer == "REFUSED":
        return "REJECT" in expected or "ASK" in expected
    return answer == "OK + note" or (answer == "OK" and expected != "OK + note")


def _run(
    command: Sequence[str], folder: Path
) -> tuple[list[str], list[str], int, float, tuple[float, list[str]]]:
    """Output and error lines, exit code, processor time, and the child's own report."""
    reader, writer = os.pipe()
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "COLUMNS": "200"}
    process = subprocess.Popen(
        [sys.executable, __file__, "--child", str(writer), *command],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=(folder.parent / f"{folder.name}.out").open("w+b"),
        stderr=(folder.parent / f"{folder.name}.err").open("w+b"),
        pass_fds=(writer,),
    )
    os.close(writer)
    begun = time.perf_counter()
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            break
        if time.perf_counter() - begun > 12 * SECONDS:
            process.kill()
        time.sleep(0.01)
    process.returncode = os.waitstatus_to_exitcode(status)
    with os.fdopen(reader) as stream:
        peak, touched = json.loads(stream.read() or "[0, []]")
    seconds = usage.ru_utime + usage.ru_stime
    lines = []
    for ending in (".out", ".err"):
        file = folder.parent / f"{folder.name}{ending}"
        lines.append(file.read_text(errors="replace").splitlines())
        file.unlink()
    return lines[0], lines[1], process.returncode, seconds, (peak, touched)


def _child(descriptor: int, command: Sequence[str]) -> None:
    """Run the command line, watched by an audit hook, its memory limited."""
    limit = 4 * MEGABYTES * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    resource.setrlimit(resource.RLIMIT_CPU, (round(2 * SECONDS),) * 2)
    import cuspaudit

    root = Path(cuspaudit.__file__).parent.parent
    own = [sys.prefix, sys.base_prefix, str(root), "/dev/null", "/usr/lib", command[1]]
    own += [str(Path(sys.prefix).resolve()), str(Path(sys.base_prefix).resolve())]
    touched: list[str] = []

    def watch(event: str, arguments: tuple[object, ...]) -> None:
        if event == "open" and isinstance(arguments[0], str | bytes):
            name, mode = os.fsdecode(arguments[0]), str(arguments[1] or "")
            if any(letter in mode for letter in "wax+"):
                touched.append(f"wrote {name}")
            elif not name.startswith(tuple(own)):
                touched.append(f"opened {name}")
        elif event.startswith(("socket.connect", "socket.bind", "socket.getaddr")):
            touched.append(event)
        elif event in ("subprocess.Popen", "os.system", "os.exec"):
            touched.append(f"ran {arguments[0]}")

    from cuspaudit.cli import main

    sys.argv = ["cuspaudit", *command]
    sys.addaudithook(watch)
    try:
        main()
    finally:
        seen = sorted(set(touched))
        os.write(descriptor, json.dumps([_peak_megabytes(), seen]).encode())


def _peak_megabytes() -> float:
    """The peak resident size of this process since it began its own program.

    A child's ru_maxrss starts from its parent's, which may be a large test process.
    """
    status = Path("/proc/self/status")
    if status.exists():
        line = next(x for x in status.read_text().splitlines() if "VmHWM" in x)
        return int(line.split()[1]) / 2**10
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20


def table(corpus: Path, names: Sequence[str] = (), workers: int = 1) -> list[Row]:
    """All rows of EXPECT.csv, or those of the named files."""
    folder = corpus / "hostile"
    with (folder / "EXPECT.csv").open(newline="") as stream:
        entries = list(csv.DictReader(stream))
    chosen = [row for row in entries if not names or row["file"] in names]
    with ThreadPoolExecutor(workers) as pool:
        return list(
            pool.map(lambda row: examine(folder / row["file"], row["answer"]), chosen)
        )


def show(rows: Sequence[Row]) -> None:
    """Print the rows that differ, and what the slowest and largest took."""
    for row in rows:
        if row.differs:
            print(f"{row.file}\n  expected  {row.expected}\n  differs   {row.differs}")
            print(f"  said      {row.said}")
    slow = max(rows, key=lambda row: row.seconds)
    large = max(rows, key=lambda row: row.megabytes)
    print(
        f"{len(rows)} files, {sum(bool(row.differs) for row in rows)} differ; "
        f"slowest {slow.file} {slow.seconds:.1f} s, "
        f"largest {large.file} {large.megabytes:.0f} MB"
    )


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        _child(int(sys.argv[2]), sys.argv[3:])
        sys.exit()
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*")
    parser.add_argument("-j", type=int, default=1)
    parser.add_argument("-v", action="store_true", help="show every answer")
    chosen = parser.parse_args()
    found = table(
        Path(os.environ.get("CUSPAUDIT_CORPUS", CORPUS)), chosen.files, chosen.j
    )
    if chosen.v:
        for row in found:
            print(f"{row.file:42} {row.answer:10} {row.seconds:4.1f} s  {row.said}")
    show(found)
    sys.exit(any(row.differs for row in found))
