"""A robot with several serial chains, as a user of the command line meets it."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from cuspaudit.cli import main

JOINT = (
    '<joint name="{0}" type="{3}"><parent link="{1}"/><child link="{2}"/>'
    '<origin xyz="{4}"/><axis xyz="{5}"/><limit lower="-1" upper="1"/></joint>'
)
JAW_ARM = (
    ("pan", "base", "shoulder", "revolute", "0 0 0.06", "0 0 1"),
    ("lift", "shoulder", "upper", "revolute", "0.03 0 0.05", "0 1 0"),
    ("elbow", "upper", "lower", "revolute", "0.03 0 0.1", "0 1 0"),
    ("pitch", "lower", "wrist", "revolute", "0.13 0 0", "0 1 0"),
    ("roll", "wrist", "gripper", "revolute", "0.06 0 0", "1 0 0"),
    ("frame", "gripper", "tool frame", "fixed", "0.1 0 0", "0 0 1"),
    ("jaw", "gripper", "moving_jaw", "revolute", "0.02 0.02 0", "0 0 1"),
)


@pytest.fixture
def jaw_arm(tmp_path: Path) -> Path:
    """Five joints, a frame for the tool, and a jaw beside it."""
    links = dict.fromkeys(name for joint in JAW_ARM for name in joint[1:3])
    text = "".join(f'<link name="{name}"/>' for name in links)
    text += "".join(JOINT.format(*joint) for joint in JAW_ARM)
    path = tmp_path / "arm.urdf"
    path.write_text(f'<robot name="arm">{text}</robot>')
    return path


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


def test_import_lists_the_chains_of_a_tree(
    jaw_arm: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`import` of a robot with several ends prints a line for each, likely first."""
    status, out, _ = run("import", jaw_arm, capsys=capsys)
    title, *lines = out.splitlines()
    assert (status, title) == (0, "2 serial chains; choose one by its options:")
    assert lines[0].split("  ")[1] == "--tip 'tool frame'"
    assert "a jaw?" in lines[1]
    _, out, _ = run("import", jaw_arm, "--json", capsys=capsys)
    assert [chain["is_jaw"] for chain in json.loads(out)] == [False, True]


def test_all_audits_each_arm_and_names_the_rest(
    jaw_arm: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """`audit --all` has a line a chain, exit code 0, and JSON with the audits."""
    file = tmp_path / "all.json"
    status, out, err = run("audit", jaw_arm, "--all", "--json", file, capsys=capsys)
    arm, jaw = out.splitlines()
    assert (status, err) == (0, "")
    assert arm.split()[:2] == ["noncuspidal", "--tip"]
    assert jaw.startswith("no arm")
    records = json.loads(file.read_text())
    assert [record["verdict"] for record in records] == ["noncuspidal", None]
    assert records[0]["audit"]["robot"]["tip"] == "tool frame"


def test_all_beside_a_tip_is_refused(
    jaw_arm: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One chain and all of them contradict each other; either alone works."""
    status, _, err = run("audit", jaw_arm, "--all", "--tip", "gripper", capsys=capsys)
    assert (status, len(err.splitlines())) == (2, 1)
    assert "leave out --tip, or leave out --all" in err
    status, _, _ = run("audit", jaw_arm, "--tip", "tool frame", capsys=capsys)
    assert status == 0
