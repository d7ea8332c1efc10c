"""What no command foresees: one line, its own exit code, and never a traceback."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from importlib import import_module
from pathlib import Path

import pytest

from cuspaudit.cli import main
from cuspaudit.cli.exit_codes import INTERRUPTED, UNFORESEEN
from cuspaudit.errors import unforeseen

ROBOTS = Path(__file__).parents[2] / "robots"
#: where the commands take `open_robot` from
MODULES = [
    import_module(f"cuspaudit.{name}") for name in ("robot.library", "auditing.check")
]


@pytest.fixture
def _faulty(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every robot that is opened meets an error that is none of ours."""

    def open_nothing(*arguments: object, **options: object) -> None:
        raise ZeroDivisionError("of a\nlibrary")

    for module in MODULES:
        monkeypatch.setattr(module, "open_robot", open_nothing)


def run(*words: object, monkeypatch: pytest.MonkeyPatch) -> int:
    """The exit code of a command, run in this process."""
    monkeypatch.setattr(sys, "argv", ["cuspaudit", *map(str, words)])
    with pytest.raises(SystemExit) as end:
        main()
    assert isinstance(end.value.code, int)
    return end.value.code


@pytest.mark.usefixtures("_faulty")
@pytest.mark.parametrize("command", ["audit", "import", "show"])
def test_an_error_nobody_foresaw_is_one_line_and_exits_4(
    command: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It never exits 1, which means cuspidal, and says what to report."""
    assert run(command, "ur5", monkeypatch=monkeypatch) == UNFORESEEN
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert "ZeroDivisionError: of a library" in err
    assert "report" in err
    assert "--debug" in err
    assert re.search(r"\(cli/opening\.py:\d+\)", err)


@pytest.mark.usefixtures("_faulty")
@pytest.mark.parametrize("words", [["--debug", "audit"], ["audit", "--debug"]])
def test_debug_adds_the_traceback_wherever_it_stands(
    words: list[str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """With `--debug` the traceback precedes the line; the exit code stays."""
    assert run(*words, "ur5", monkeypatch=monkeypatch) == UNFORESEEN
    err = capsys.readouterr().err
    assert err.startswith("Traceback")
    assert err.splitlines()[-1].startswith("cuspaudit: an error nobody foresaw")


@pytest.mark.usefixtures("_faulty")
def test_check_goes_on_after_such_an_error(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each file has its line, and the exit code is 4, not that of a mismatch."""
    files = [ROBOTS / "ur5.yaml", ROBOTS / "puma-560.yaml"]
    assert run("check", *files, monkeypatch=monkeypatch) == UNFORESEEN
    assert capsys.readouterr().out.count("fault  ") == 2


def test_a_missing_library_is_a_fault_of_the_set_up(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit 2 and the remedy, not a fault of ours to report."""
    missing = ImportError("No module named 'flint'", name="flint")

    def load_nothing(*arguments: object, **options: object) -> None:
        raise missing

    monkeypatch.setattr(MODULES[0], "open_robot", load_nothing)
    assert run("audit", "ur5", monkeypatch=monkeypatch) == 2
    assert "install cuspaudit again" in capsys.readouterr().err


def test_a_long_message_of_a_library_is_cut() -> None:
    """The line stays a line a person can read."""
    assert len(unforeseen(ValueError("x\n" * 5000))) < 700


@pytest.mark.parametrize(
    ("words", "seconds"),
    [
        (("audit", "ark-2022-3r"), 0.05),
        (("audit", "ark-2022-3r"), 1.2),
        (("check", ROBOTS, "-j", 2), 1.6),
        (("sweep", ROBOTS.parent / "families/orthogonal-3r.yaml", "-o", "t"), 1.9),
    ],
)
def test_an_interruption_is_one_line_from_all_processes(
    words: tuple[object, ...], seconds: float, tmp_path: Path
) -> None:
    """Ctrl-C, which a terminal sends to every process, prints no traceback anywhere."""
    process = subprocess.Popen(
        [sys.executable, "-m", "cuspaudit", *map(str, words)],
        cwd=tmp_path,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # a background shell hands down an ignored SIGINT
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    time.sleep(seconds)
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=60)
    if process.returncode == INTERRUPTED:
        assert err.startswith("cuspaudit: interrupted")
        assert err.count("\n") == 1
    else:  # it was not yet Python's to answer, or over
        assert process.returncode in (-signal.SIGINT, 1)
        assert "Traceback" not in err or seconds < 0.1
