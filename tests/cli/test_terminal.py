"""What an audit prints on a terminal, and what in a pipe."""

from __future__ import annotations

import os
import pty
import re
import subprocess
import sys
from pathlib import Path

import pytest

from cuspaudit.cli.decide import STEPS

CUSPAUDIT = (sys.executable, "-m", "cuspaudit")
COMMAND = (*CUSPAUDIT, "audit", "--exit-zero")
ESCAPE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
ROWS = ("robot", "verdict", "why", "proof", "literal", "page", "JSON", "time")


def on_terminal(*command: str, folder: Path) -> str:
    """What a command that ends well writes to a terminal."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        command,
        cwd=folder,
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "100"},
    )
    os.close(theirs)
    written = b""
    while True:
        try:
            piece = os.read(ours, 65536)
        except OSError:  # the other end is closed
            break
        if not piece:
            break
        written += piece
    os.close(ours)
    assert process.wait() == 0
    return written.decode()


@pytest.mark.slow
def test_a_terminal_sees_colour_steps_and_where_the_files_went(tmp_path: Path) -> None:
    """The verdict is red and bold, the step under way has a name, the rows align."""
    files = ("--html", "a.html", "--json", "a.json")
    text = on_terminal(*COMMAND, "chablat-2022-3r", *files, folder=tmp_path)
    assert "\x1b[1;31mcuspidal" in text
    assert re.search(r"roadmap|sample_points|certificate|crosscheck", text)
    rows = [line for line in ESCAPE.sub("", text).splitlines() if line[:1] > " "]
    found = {line.split()[0]: line for line in rows if line.split()[0] in ROWS}
    assert set(found) == set(ROWS)
    starts = {line.index(line.split()[1]) for line in found.values()}
    assert len(starts) == 1
    assert (tmp_path / "a.html").exists() and (tmp_path / "a.json").exists()


@pytest.mark.slow
def test_a_decision_has_a_bar_over_its_steps(tmp_path: Path) -> None:
    """The bar of a terminal goes through the routines of the paper in their order."""
    system = tmp_path / "cusp.yaml"
    system.write_text("variables: [x, y]\nequations: []\nmap: [x^3 + x*y, y]\n")
    decide = (*CUSPAUDIT, "decide", "--exit-zero", str(system))
    text = ESCAPE.sub("", on_terminal(*decide, folder=tmp_path))
    bars = [line for line in re.split(r"[\r\n]+", text) if "\u2501" in line]
    shown = list(dict.fromkeys(line.split()[-1] for line in bars))
    assert shown and shown == [step for step in STEPS if step in shown]


@pytest.mark.slow
def test_a_pipe_gets_plain_text_and_no_progress(tmp_path: Path) -> None:
    """No escape sequence on either stream, nothing at all on standard error."""
    done = subprocess.run(
        [*COMMAND, "chablat-2022-3r"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert "\x1b" not in done.stdout
    assert done.stderr == ""
    assert "verdict      cuspidal" in done.stdout
