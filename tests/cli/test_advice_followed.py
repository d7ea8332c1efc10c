"""Each message that gives advice is followed, and gets further."""

from __future__ import annotations

import ast
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import cuspaudit
from cuspaudit.cli.main import main
from tests.cli.advice_rows import ELSEWHERE, FILES, NOTES, ROWS, Row

_ADVISES = re.compile(
    r"(^|[ (])--[a-z]|pip install|type: |xacro FILE|python -c|git lfs"
)
_ROOMS = Path(cuspaudit.__file__).parent
#: texts that name an option and advise nothing
_SAYS = ("beside", "with --json", "{} more", "--json has them", "--to poly", "Example:")


def run(words: list[str], monkeypatch: pytest.MonkeyPatch) -> int:
    """The exit code of a command."""
    monkeypatch.setattr(sys, "argv", ["cuspaudit", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    return int(ended.value.code or 0)


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files of the rows, which is the current one."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


_QUICK = ("audit elbow", "audit two", "audit bare", "audit xacro", "audit five")


def _rows() -> Iterator[object]:
    """All rows; the quick ones are run each time."""
    for row in ROWS:
        marks = [] if row.command.startswith(_QUICK) else [pytest.mark.slow]
        yield pytest.param(row, marks=marks, id=row.command)


@pytest.mark.parametrize("row", _rows())
def test_advice_that_is_followed_gets_further(
    row: Row,
    files: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The command is refused with the advice; the one that it asks for is not."""
    if "swept" in row.command + row.then and "sweep" not in row.then:
        assert run(["sweep", "family.yaml", "-o", "swept"], monkeypatch) == 0
        capsys.readouterr()
    assert run(shlex.split(row.command), monkeypatch) == 2
    said = " ".join(capsys.readouterr().err.split())
    found = re.search(row.advice, said)
    assert found is not None, said
    for name, text in row.writes.items():
        (files / name).write_text(found.expand(text))
    code = run(shlex.split(found.expand(row.then)), monkeypatch)
    assert code in row.code, capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("row", NOTES, ids=lambda row: row.command)
def test_a_note_that_is_followed_gets_further(
    row: Row,
    files: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """What a command says in passing works as it stands."""
    run(shlex.split(row.command), monkeypatch)
    heard = capsys.readouterr()
    said = " ".join((heard.out + heard.err).split())
    found = re.search(row.advice, said)
    assert found is not None, said
    code = run(shlex.split(found.expand(row.then)), monkeypatch)
    assert code in row.code, capsys.readouterr().err


def test_a_xacro_is_read_once_it_is_expanded_by_hand(
    files: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The program that the message names makes a file that is read."""
    program = Path(sys.executable).with_name("xacro")
    if not program.exists():
        pytest.skip("no xacro beside this Python")
    assert run(["audit", "xacro.urdf"], monkeypatch) == 2
    assert "xacro FILE > robot.urdf" in capsys.readouterr().err
    done = subprocess.run(
        [sys.executable, str(program), "xacro.urdf"],
        capture_output=True,
        check=True,
        cwd=files,
        timeout=60,
    )
    (files / "robot.urdf").write_bytes(done.stdout)
    assert run(["audit", "robot.urdf"], monkeypatch) in (0, 1)


def _advice() -> Iterator[tuple[str, str]]:
    """File and text of each message in the code that names an option or a command."""
    for path in sorted(_ROOMS.rglob("*.py")):
        tree = ast.parse(path.read_text())
        skipped: set[int] = set()
        for node in ast.walk(tree):
            if isinstance(node, ast.keyword) and node.arg in ("help", "metavar"):
                skipped |= {id(inner) for inner in ast.walk(node.value)}
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
                skipped.add(id(node.value))  # a docstring
        for node in ast.walk(tree):
            if isinstance(node, ast.JoinedStr) and id(node) not in skipped:
                skipped |= {id(inner) for inner in ast.walk(node)} - {id(node)}
        for node in ast.walk(tree):
            if id(node) in skipped:
                continue
            text = ""
            if isinstance(node, ast.JoinedStr):
                parts = (
                    v.value if isinstance(v, ast.Constant) else "{}"
                    for v in node.values
                )
                text = "".join(str(part) for part in parts)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                text = node.value
            if " " in text and _ADVISES.search(text):
                yield str(path.relative_to(_ROOMS)), text


def test_no_advice_is_left_out() -> None:
    """Every message that names an option has a row that follows it, or its reason."""
    patterns = [re.sub(r"[\\()?]|\\S\+", "", row.advice) for row in ROWS]
    left = []
    for file, text in _advice():
        if file in ("cli/app.py",) or any(word in text for word in _SAYS):
            continue
        if any(word in text for word in ELSEWHERE):
            continue
        options = re.findall(r"--[a-z-]+|type: ", text)
        covered = any(all(o in pattern for o in options) for pattern in patterns)
        if not covered:
            left.append(f"{file}: {text}")
    assert left == []
