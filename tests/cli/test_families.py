"""The commands on families: sweep, plot DIR, and their errors."""

from __future__ import annotations

import contextlib
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from cuspaudit.cli import main

FAMILY = """\
family: ur-pattern
robot:
  convention: standard
  units: m
  joints:
    - {type: revolute, a: 0,    alpha: pi/2,  d: 0.09}
    - {type: revolute, a: -a2,  alpha: 0,     d: 0}
    - {type: revolute, a: -a3,  alpha: 0,     d: 0}
    - {type: revolute, a: 0,    alpha: pi/2,  d: 0.11}
    - {type: revolute, a: 0,    alpha: -pi/2, d: 0.1}
    - {type: revolute, a: 0,    alpha: 0,     d: 0.08}
parameters: {a2: {range: [0.2, 0.7], steps: 4}, a3: {values: [0.3, 0.4]}}
"""


def run(*arguments: object, capsys: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    """The exit code and both outputs of a command, run in this process."""
    saved, sys.argv = sys.argv, ["cuspaudit", *map(str, arguments)]
    try:
        with pytest.raises(SystemExit) as end:
            main()
    finally:
        sys.argv = saved
    output = capsys.readouterr()
    return int(end.value.code or 0), output.out, output.err


def test_sweep_then_plot(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A family is swept, swept again without work, and drawn as a page."""
    file, out, page = tmp_path / "f.yaml", tmp_path / "out", tmp_path / "map.html"
    file.write_text(FAMILY)
    status, text, _ = run("sweep", file, "-o", out, capsys=capsys)
    assert (status, text.split()[0], text.split()[-5]) == (0, "8", "new,")
    assert "8 new" in text
    assert "0 new" in run("sweep", file, "-o", out, capsys=capsys)[1]
    status, text, _ = run("plot", out, "-o", page, capsys=capsys)
    assert (status, text) == (0, f"figure: {page}, 8 members\n")
    assert page.read_text().count("<title>member") == 8


def test_a_member_is_audited_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`plot --audit` keeps robot file and page of a member, and the map leads there."""
    file, out, page = tmp_path / "f.yaml", tmp_path / "out", tmp_path / "map.html"
    file.write_text(FAMILY)
    run("sweep", file, "-o", out, capsys=capsys)
    status, _, err = run("plot", out, "-o", page, "--audit", 5, capsys=capsys)
    assert (status, err) == (0, "")
    kept = out / "audits" / "5.html"
    assert "noncuspidal" in kept.read_text()
    assert kept.with_suffix(".yaml").read_text().startswith("name: ur-pattern-5")
    assert '"5": "out/audits/5.html"' in page.read_text()
    made = kept.stat().st_mtime_ns
    run("plot", out, "-o", page, "--audit", 5, capsys=capsys)
    assert kept.stat().st_mtime_ns == made
    for words in ((page, "--audit", 99), (tmp_path / "map.svg", "--audit", 5)):
        status, _, err = run("plot", out, "-o", *words, capsys=capsys)
        assert (status, err.count("\n")) == (2, 1)


@pytest.mark.parametrize("command", ["sweep", "plot"])
def test_help_shows_an_example(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """The help of each command teaches by an example."""
    status, out, _ = run(command, "--help", capsys=capsys)
    assert status == 0
    assert f"Example: cuspaudit {command}" in " ".join(out.split())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["sweep", "no-such.yaml", "-o", "out"], "no-such.yaml"),
        (["sweep", "f.yaml", "-o", "f.yaml"], "f.yaml"),
        (["plot", ".", "-o", "map.html"], "not a folder of a sweep"),
        (["plot", ".", "-o", "map.jpg"], "end the name in"),
    ],
)
def test_bad_input_gives_one_line_and_exit_code_2(
    arguments: list[str],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Bad input: one line on stderr that says what to do, code 2."""
    monkeypatch.chdir(tmp_path)
    Path("f.yaml").write_text(FAMILY)
    status, out, err = run(*arguments, capsys=capsys)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    assert words in err


@pytest.mark.slow
def test_interrupt_keeps_the_rows(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Ctrl-C ends a sweep in one line; the rows so far are there for the next run."""
    file, out = tmp_path / "f.yaml", tmp_path / "out"
    file.write_text(FAMILY.replace("steps: 4", "steps: 2000"))
    process = subprocess.Popen(
        [sys.executable, "-m", "cuspaudit", "sweep", str(file), "-o", str(out)],
        stderr=subprocess.PIPE,
        text=True,
        # a background shell hands down an ignored SIGINT
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    journal, until = out / "journal.jsonl", time.monotonic() + 60
    while time.monotonic() < until and process.poll() is None:
        if journal.exists() and journal.stat().st_size > 0:
            break
        time.sleep(0.02)
    for _ in range(4):
        process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(timeout=20)
            break
    _, err = process.communicate(timeout=20)
    assert process.returncode == 130
    kept = "what was finished is kept, and no file is half written"
    assert err == f"cuspaudit: interrupted; {kept}\n"
    from cuspaudit.family.store import read_rows

    assert len(read_rows(out)) > 0
