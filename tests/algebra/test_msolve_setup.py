"""msolve missing is a fault of the set-up, and one command mends it."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from cuspaudit.algebra import msolve, msolve_setup
from cuspaudit.algebra.msolve_setup import check_msolve, install_command, install_msolve
from cuspaudit.cli import main
from cuspaudit.errors import SetUpError, UnableError

SYSTEMS = Path(__file__).parents[1] / "systems"


@pytest.fixture
def _without_msolve(monkeypatch: pytest.MonkeyPatch) -> None:
    """No msolve anywhere."""
    monkeypatch.delenv(msolve.ENVIRONMENT, raising=False)
    monkeypatch.setattr(msolve, "_in_wheel", lambda: None)
    monkeypatch.setattr(msolve.shutil, "which", lambda name: None)


@pytest.mark.usefixtures("_without_msolve")
def test_a_missing_msolve_is_no_limit_of_ours() -> None:
    """It is no UnableError, which a decision would turn into `undecided`."""
    assert not issubclass(SetUpError, UnableError)
    with pytest.raises(SetUpError, match="cuspaudit setup"):
        msolve.run_msolve("x\n0\nx-1\n")


@pytest.mark.usefixtures("_without_msolve")
@pytest.mark.parametrize("engine", ["roadmap", "routing"])
def test_a_run_that_needs_it_names_the_command_and_exits_2(
    engine: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """One line, no verdict, although the decision runs in a process of its own."""
    words = ["cuspaudit", "decide", str(SYSTEMS / "torus-side.yaml")]
    monkeypatch.setattr(sys, "argv", [*words, "--engine", engine])
    monkeypatch.setattr(import_module("signal"), "signal", lambda *_: None)
    with pytest.raises(SystemExit) as end:
        main()
    out, err = capsys.readouterr()
    assert (end.value.code, out, err.count("\n")) == (2, "", 1)
    assert "type: cuspaudit setup" in err


def test_what_is_there_is_kept_and_works(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is installed over an msolve that is found; it solves x^2 = 2."""
    monkeypatch.setattr(msolve_setup, "_install", pytest.fail)
    assert install_msolve() == msolve.find_msolve()
    check_msolve()


@pytest.mark.usefixtures("_without_msolve")
def test_pip_is_asked_for_the_wheel_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command takes no dependencies, and its failure is passed on in one line."""
    asked: list[list[str]] = []

    def run(command: list[str], **options: Any) -> subprocess.CompletedProcess[bytes]:
        asked.append(command)
        assert options["timeout"] > 0
        return subprocess.CompletedProcess(command, 1, b"", b"first\nNo matching wheel")

    monkeypatch.setattr(msolve_setup.subprocess, "run", run)
    with pytest.raises(SetUpError, match="No matching wheel"):
        install_msolve()
    assert asked[0][: len(install_command())] == install_command()
    assert {"--no-deps", msolve.WHEEL} <= set(asked[0])


def test_an_msolve_that_answers_nonsense_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Set-up ends with a system whose solution is known."""
    program = tmp_path / "msolve"
    loop = 'while [ "$1" != -o ]; do shift; done; echo no > "$2"'
    program.write_text(f"#!/bin/sh\n{loop}\n")
    program.chmod(0o755)
    monkeypatch.setenv(msolve.ENVIRONMENT, str(program))
    with pytest.raises(SetUpError, match="answers 'no"):
        check_msolve()
