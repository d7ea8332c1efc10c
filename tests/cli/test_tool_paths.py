from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from importlib.resources import files
from pathlib import Path
from typing import Any

import jsonschema
import pytest

FLIP = "x,y,z\n2.5,0,0.37\n1.2,0,0.37\n1.2,0,2.2\n3.2,0,2.2\n3.2,0,0.37\n2.5,0,0.37\n"


def run(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """The command line in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "cuspaudit", *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        cwd=folder,
        env=dict(os.environ),
        check=False,
    )


def held(name: str, text: str) -> Any:
    """The record, held to its schema."""
    schema = (files("cuspaudit.toolpath") / "schemas" / f"{name}.json").read_text()
    record = json.loads(text)
    jsonschema.validate(record, json.loads(schema))
    return record


def test_trace_writes_its_record_and_the_certificate_of_a_flip(tmp_path: Path) -> None:
    """Exit 1, a record that its schema accepts, and a certificate that verifies."""
    (tmp_path / "flip.csv").write_text(FLIP)
    name = "chablat-2022-3r"
    done = run(
        *("trace", name, "flip.csv", "--json", "-", "--laps", "3"),
        *("--certificate", "flip.json", "--html", "flip.html"),
        folder=tmp_path,
    )
    assert done.returncode == 1, done.stderr
    record = held("trace", done.stdout)
    assert record["permutation"] == [3, 2, None, None]
    assert record["turns"] == [[0, 0, 0], [0, 0, -1], None, None]
    assert [one["kind"] for one in record["laps"]].count("changes posture") == 2
    assert record["complete"] == {"postures": True, "births": True}
    assert (tmp_path / "flip.html").stat().st_size > 10_000
    assert run("verify", "flip.json", folder=tmp_path).returncode == 0


def test_an_interrupted_trace_leaves_no_file(tmp_path: Path) -> None:
    """Ctrl-C ends a long trace with one line and exit code 130."""
    turn = [(k % 7) / 10 for k in range(4000)]
    rows = "".join(f"{2 + x},{x},0.3\n" for x in turn)
    (tmp_path / "long.csv").write_text("x,y,z\n" + rows)
    command = [sys.executable, "-m", "cuspaudit", "trace", "chablat-2022-3r"]
    command += ["long.csv", "--json", "long.json", "--html", "long.html"]
    with subprocess.Popen(
        command,
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
        env=dict(os.environ),
        # a background shell hands down an ignored SIGINT
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as running:
        with pytest.raises(subprocess.TimeoutExpired):
            running.wait(timeout=4)
        running.send_signal(signal.SIGINT)
        _, said = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "interrupted" in said and said.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["long.csv"]


def test_a_path_that_repeats_exits_0(tmp_path: Path) -> None:
    """Every posture comes back to itself; --closed adds the way home."""
    (tmp_path / "out.csv").write_text("x,y,z\n2,0,0\n1.9,0.1,0.1\n")
    done = run("trace", "chablat-2022-3r", "out.csv", "--closed", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("reaches the end") == 4


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("x,y,z\n1,0,nan\n2,0,0\n", "row 1 z"),
        ("x,y,z\n1,0,0\n", "one waypoint"),
        ("x,y,q\n1,0,0\n", "a header of"),
    ],
)
def test_bad_paths_exit_2_in_one_line(tmp_path: Path, text: str, words: str) -> None:
    """Nothing is written, and the line names the row."""
    (tmp_path / "bad.csv").write_text(text)
    done = run(
        *("trace", "chablat-2022-3r", "bad.csv", "--json", "out.json"), folder=tmp_path
    )
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.count("\n") == 1 and words in done.stderr
    assert not (tmp_path / "out.json").exists()


def test_postures_and_same_write_their_records(tmp_path: Path) -> None:
    """Both hold to their schemas, and their exit codes say what they found."""
    name = "chablat-2022-3r"
    done = run(
        "postures", name, "--position", "2.5,0,0.37", "--json", "-", folder=tmp_path
    )
    assert done.returncode == 0, done.stderr
    found = held("postures", done.stdout)
    assert [posture["aspect"] for posture in found["postures"]] == [1, 1, 2, 2]
    first, second, third = (
        ",".join(repr(x) for x in found["postures"][k]["values"]) for k in (0, 1, 2)
    )
    done = run(
        "same", name, "--from", first, "--to", second, "--json", "-", folder=tmp_path
    )
    assert done.returncode == 0 and held("same", done.stdout)["answer"] == "same"
    done = run(
        "same", name, "--from", first, "--to", third, "--json", "-", folder=tmp_path
    )
    assert done.returncode == 1 and held("same", done.stdout)["answer"] == "different"
    done = run("same", name, "--from", "1,2", "--to", third, folder=tmp_path)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
