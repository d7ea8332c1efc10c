"""The options that say how a robot file is read, by every command that reads one."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from cuspaudit.cli.main import main

ARM = """\
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find lengths)/lengths.xacro"/>
  <link name="base"/><link name="a"/><link name="b"/><link name="c"/><link name="tip"/>
  <joint name="j1" type="continuous"><parent link="base"/><child link="a"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="j2" type="continuous"><parent link="a"/><child link="b"/>
    <origin xyz="${a} 0 0"/><axis xyz="0 1 0"/></joint>
  <joint name="j3" type="continuous"><parent link="b"/><child link="c"/>
    <origin xyz="0 0 $(arg upper)"/><axis xyz="0 1 0"/></joint>
  <joint name="t" type="fixed"><parent link="c"/><child link="tip"/>
    <origin xyz="0 0 0.5"/></joint>
</robot>
"""
COMMANDS = {
    "audit": (),
    "import": (),
    "check": (),
    "plot": ("-o", "arm.svg"),
    "show": ("--html", "arm.html"),
    "postures": ("--joints", "0.1,0.2,0.3"),
    "same": ("--from", "0.1,0.2,0.3", "--to", "0.2,0.3,0.4"),
    "trace": ("path.csv", "--angle-unit", "deg"),
}


def run(*words: str, monkeypatch: pytest.MonkeyPatch) -> int:
    """The exit code of a command."""
    monkeypatch.setattr(sys, "argv", ["cuspaudit", *words])
    with pytest.raises(SystemExit) as ended:
        main()
    return int(ended.value.code or 0)


@pytest.mark.parametrize("command", COMMANDS)
def test_packages_and_arguments_are_taken_by_every_command(
    command: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Without them the message asks for one after the other; with both it runs."""
    pytest.importorskip("xacrodoc")
    monkeypatch.chdir(tmp_path)
    Path("arm.xacro").write_text(ARM)
    Path("path.csv").write_text("j1,j2,j3\n10,20,30\n10,20,40\n")
    Path("sizes").mkdir()
    Path("sizes/lengths.xacro").write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:property name="a" value="0.1"/></robot>'
    )
    words, bad = [command, "arm.xacro", *COMMANDS[command]], 1 + (command != "check")
    assert run(*words, monkeypatch=monkeypatch) == bad
    said = capsys.readouterr()
    assert "--package NAME=DIR" in said.out + said.err
    words += ["--package", "lengths=sizes"]
    assert run(*words, monkeypatch=monkeypatch) == bad
    said = capsys.readouterr()
    assert "--xacro-arg NAME=VALUE" in said.out + said.err
    words += ["--xacro-arg", "upper=0.7"]
    assert run(*words, monkeypatch=monkeypatch) in (0, 1)
    assert "xacro-arg" not in "".join(capsys.readouterr())


@pytest.mark.parametrize("command", [name for name in COMMANDS if name != "check"])
def test_an_option_of_another_format_is_refused(
    command: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nothing that was given is passed over in silence; without it the command runs."""
    words = [command, "chablat-2022-3r", *COMMANDS[command], "--xacro-arg", "a=1"]
    assert run(*words, monkeypatch=monkeypatch) == 2
    assert "which has no use for it; leave out --xacro-arg" in capsys.readouterr().err
    words = [command, "ur5_robot", *COMMANDS[command], "--length-unit", "mm"]
    assert run(*words, monkeypatch=monkeypatch) == 2
    assert "leave out --length-unit" in capsys.readouterr().err
