from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import cuspaudit
from cuspaudit.auditing.expectation import annotation, write_expectation
from cuspaudit.errors import InvalidInputError
from cuspaudit.robot.formats.dh.read import read_dh

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
FOUND = {"verdict": "cuspidal", "aspects": 2, "cusps": 4}
BARE = """\
# a comment that stays
convention: standard   # and this one
units: m
joints:
  - {type: R, a: 1,   alpha: pi/2,  d: 0}
  - {type: R, a: 2,   alpha: -pi/2, d: 1}
  - {type: R, a: 3/2, alpha: 0,     d: 0}"""


def run(*command: str, **env: str) -> subprocess.CompletedProcess[str]:
    """A module run as a command."""
    return subprocess.run(
        [sys.executable, "-m", *command],
        env={**os.environ, **env},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("tail", ["", "\n", "\nexpect:\n", "\nexpect: null # later\n"])
def test_the_expectation_is_added_and_the_text_stays(tmp_path: Path, tail: str) -> None:
    """One line is added, or fills an empty key; every other character stays."""
    file = tmp_path / "robot.yaml"
    file.write_text(BARE + tail)
    assert write_expectation(file, FOUND)
    assert file.read_text().startswith(BARE)
    assert file.read_text().count("expect") == 1
    assert read_dh(file).expect == FOUND


def test_windows_line_ends_stay(tmp_path: Path) -> None:
    """A file with CRLF gets its line with CRLF."""
    file = tmp_path / "robot.yaml"
    file.write_bytes(BARE.replace("\n", "\r\n").encode())
    assert write_expectation(file, FOUND)
    assert b"\n" not in file.read_bytes().replace(b"\r\n", b"")


def test_an_expectation_is_never_replaced(tmp_path: Path) -> None:
    """A file that expects anything, right or wrong, is left byte for byte."""
    file = tmp_path / "robot.yaml"
    file.write_text(BARE + "\nexpect: {verdict: noncuspidal}\n")
    before = file.read_bytes()
    assert not write_expectation(file, FOUND)
    assert file.read_bytes() == before


def test_a_file_that_cannot_hold_it_is_refused(tmp_path: Path) -> None:
    """A CSV, and a YAML of another style, are refused with the line to add."""
    table = tmp_path / "robot.csv"
    table.write_text("# convention=standard\ntype,a,alpha,d\nR,1,0,0\n")
    with pytest.raises(InvalidInputError, match="by hand"):
        write_expectation(table, FOUND)
    file = tmp_path / "robot.yaml"
    file.write_text("{convention: standard, joints: [{type: R, a: 1, alpha: 0, d: 0}]}")
    with pytest.raises(InvalidInputError, match="by hand"):
        write_expectation(file, FOUND)
    assert "expect" not in file.read_text()


def test_an_annotation_names_the_line(tmp_path: Path) -> None:
    """An annotation points at the expectation and escapes what GitHub would read."""
    file = tmp_path / "robot.yaml"
    file.write_text(BARE + "\nexpect: {verdict: noncuspidal}\n")
    line = annotation(str(file), "mismatch", "100%\nwrong") or ""
    assert line.startswith("::error file=")
    assert ",line=8," in line
    assert line.endswith("::100%25%0Awrong")
    assert annotation(str(file), "ok", "") is None


def test_check_updates_and_annotates(tmp_path: Path) -> None:
    """`check --update` fills what is empty; CI gets annotations without being asked."""
    bare, wrong = tmp_path / "bare.yaml", tmp_path / "wrong.yaml"
    bare.write_text(BARE)
    wrong.write_text(BARE + "\nexpect: {verdict: noncuspidal}\n")
    before = wrong.read_bytes()
    command = ["cuspaudit", "check", str(tmp_path), "--update"]
    first = run(*command, GITHUB_ACTIONS="true")
    assert first.returncode == 1
    assert f"::error file={wrong}" in first.stdout
    assert read_dh(bare).expect == {
        **{"verdict": "cuspidal", "aspects": 2, "max_postures": 4},
        **{"cusps": 4, "nodes": 0},
    }
    assert wrong.read_bytes() == before


def test_pytest_makes_one_test_of_a_robot(tmp_path: Path) -> None:
    """`pytest --cuspaudit`: right passes, wrong fails in one line, other files not."""
    (tmp_path / "right.yaml").write_text(BARE + "\nexpect: {verdict: cuspidal}\n")
    (tmp_path / "wrong.yaml").write_text(BARE + "\nexpect: {aspects: 3}\n")
    (tmp_path / "settings.yaml").write_text("some: {other: yaml}\n")
    result = run("pytest", "--cuspaudit", str(tmp_path), "-p", "no:cacheprovider", "-q")
    assert "1 failed, 1 passed" in result.stdout, result.stdout + result.stderr
    assert "aspects 2 where 3 is recorded" in result.stdout
    assert "Traceback" not in result.stdout
