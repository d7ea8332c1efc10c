"""What somebody types on a first visit, answered by what they should have typed."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

import pytest

from cuspaudit.cli import main

ROOT = Path(__file__).parents[2]
SYSTEM = ROOT / "tests" / "systems" / "fold.yaml"
FAMILY = ROOT / "families" / "orthogonal-3r.yaml"
ROBOT = ROOT / "robots" / "ur5.yaml"


def run(
    *words: object, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> tuple[int, str, str]:
    """Exit code and both outputs of a command."""
    monkeypatch.setattr(sys, "argv", ["cuspaudit", *map(str, words)])
    with pytest.raises(SystemExit) as end:
        main()
    assert isinstance(end.value.code, int)
    return end.value.code, *capsys.readouterr()


@pytest.fixture
def written(tmp_path: Path) -> dict[str, Path]:
    """Files with the schemas of an audit and of a certificate."""
    files = {name: tmp_path / f"{name}.json" for name in ("audit", "certificate")}
    for name, file in files.items():
        file.write_text(json.dumps({"schema": f"cuspaudit/{name}/2"}))
    return files


@pytest.mark.parametrize(
    ("command", "file", "right"),
    [
        ("audit", SYSTEM, "decide"),
        ("audit", FAMILY, "sweep"),
        ("audit", "audit", "show"),
        ("audit", "certificate", "verify"),
        ("decide", ROBOT, "audit"),
        ("decide", "audit", "show"),
        ("verify", "audit", "show"),
        ("sweep", ROBOT, "audit"),
        ("import", SYSTEM, "decide"),
        ("show", SYSTEM, "decide"),
    ],
)
def test_a_file_given_to_the_wrong_command_names_the_right_one(
    command: str,
    file: Path | str,
    right: str,
    written: dict[str, Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """One line, exit 2, and the command that reads this file."""
    path = written[file] if isinstance(file, str) else file
    more = ["-o", tmp_path / "table"] if command == "sweep" else []
    status, out, err = run(command, path, *more, monkeypatch=monkeypatch, capsys=capsys)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert re.search(rf"type: cuspaudit {right}\b.*{re.escape(str(path))}", err)


def test_a_flat_family_is_told_where_its_robot_goes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Joints beside the parameters: nest them under robot:."""
    family = tmp_path / "family.yaml"
    lines = FAMILY.read_text("utf-8").splitlines()
    flat = [re.sub("^  ", "", line) for line in lines if line != "robot:"]
    family.write_text("\n".join(flat))
    words = ("sweep", family, "-o", tmp_path / "table")
    status, _, err = run(*words, monkeypatch=monkeypatch, capsys=capsys)
    assert status == 2
    assert "below a line robot:" in err


def test_a_folder_is_no_robot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It has no ending to speak of; `check` takes folders."""
    _, _, err = run("audit", tmp_path, monkeypatch=monkeypatch, capsys=capsys)
    assert "this is a folder" in err
    assert f"cuspaudit check {tmp_path}" in err


@pytest.mark.parametrize("name", ["UR5", "Puma_560", "FANUCx"])
def test_a_name_is_known_whatever_its_capitals_and_dashes(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """`UR5` is ur5; a name that is near to nothing is refused."""
    status, out, err = run("import", name, monkeypatch=monkeypatch, capsys=capsys)
    if name == "FANUCx":
        assert status == 2
        assert "no robot of this name" in err
    else:
        assert status == 0
        assert out.startswith(name.lower().replace("_", "-"))


def test_the_list_says_what_each_robot_is(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Joints, task and title; what needs a choice first comes after all arms."""
    _, out, _ = run("import", "--list", monkeypatch=monkeypatch, capsys=capsys)
    lines = out.splitlines()
    assert re.search(r"^ur5 +6 joints, pose +Universal Robots UR5$", out, re.MULTILINE)
    arms = [bool(re.match(r"\S+ +\d joints, p", line)) for line in lines]
    assert arms == sorted(arms, reverse=True)
    assert 31 <= sum(arms) < len(arms)


def test_the_help_of_decide_keeps_its_brackets(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Lists in the example are text, not markup."""
    _, out, _ = run("decide", "--help", monkeypatch=monkeypatch, capsys=capsys)
    text = " ".join(re.sub("[│╭╮╰╯─]", " ", out).split())
    assert "variables: [x, y], equations: [], map: [x^3 + x*y, y]" in text


def test_a_locked_joint_is_named_and_the_time_is_what_was_waited(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The summary names the joint held fixed; its time is not that of a stage."""
    words = ["audit", "ur5_robot", "--tip", "tool0", "--lock", "wrist_3_joint=0"]
    _, out, _ = run(*words, monkeypatch=monkeypatch, capsys=capsys)
    assert re.search(r"^locked +wrist_3_joint = 0", out, re.MULTILINE)
    _, out, _ = run(*words, "--json", "-", monkeypatch=monkeypatch, capsys=capsys)
    seconds = json.loads(out)["seconds"]
    assert seconds["total"] >= sum(v for k, v in seconds.items() if k != "total")
