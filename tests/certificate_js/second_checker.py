"""The checker in JavaScript, run by Node in a process of its own."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import cuspaudit

FOLDER = Path(cuspaudit.__file__).parent / "certificate_js"
NODE = shutil.which("node")

needs_node = pytest.mark.skipif(NODE is None, reason="no Node on this machine")


@dataclass(frozen=True)
class Answer:
    """What the second checker says of a file."""

    accepted: bool
    reason: str
    milliseconds: int


def second_answers(files: Sequence[Path]) -> dict[Path, Answer]:
    """The answer for each file, from one run of Node."""
    assert NODE is not None
    run = subprocess.run(
        [NODE, str(FOLDER / "run.mjs"), *map(str, files)],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert not run.stderr, run.stderr
    answers = map(json.loads, run.stdout.splitlines())
    found = {
        Path(each["file"]): Answer(
            each["accepted"], each["reason"], each["milliseconds"]
        )
        for each in answers
    }
    assert run.returncode == (0 if all(a.accepted for a in found.values()) else 1)
    assert set(found) == set(files)
    return found


def evaluated(calls: Sequence[tuple[Any, ...]]) -> list[Any]:
    """Results of calls of the interval arithmetic, through `evaluate.mjs`."""
    assert NODE is not None
    run = subprocess.run(
        [NODE, str(Path(__file__).with_name("evaluate.mjs")), str(FOLDER)],
        input=json.dumps(calls),
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    return list(json.loads(run.stdout))
