"""The command line as a user meets it: output, files, exit codes, one-line errors."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from importlib.resources import files
from pathlib import Path

import jsonschema
import pytest

from cuspaudit.cli import main

SCHEMA = json.loads((files("cuspaudit.auditing") / "schema.json").read_text("utf-8"))


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


@pytest.mark.parametrize(
    ("arguments", "verdict", "code"),
    [
        (["chablat-2022-3r"], "cuspidal", 1),
        (["ur5"], "noncuspidal", 0),
        (["chablat-2022-3r", "--timeout", "0"], "undecided", 3),
        (["chablat-2022-6r"], "cuspidal", 1),
    ],
)
def test_audit_prints_json_of_the_schema(
    arguments: list[str], verdict: str, code: int, capsys: pytest.CaptureFixture[str]
) -> None:
    """`audit --json -` prints an audit that the shipped schema accepts."""
    status, out, err = run("audit", *arguments, "--json", "-", capsys=capsys)
    record = json.loads(out)
    jsonschema.validate(record, SCHEMA)
    assert (status, record["verdict"], err) == (code, verdict, "")


def test_schema_refuses_a_cuspidal_audit_without_a_witness(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The schema holds the rule that a cuspidal verdict carries its witness."""
    _, out, _ = run("audit", "chablat-2022-3r", "--json", "-", capsys=capsys)
    record = json.loads(out) | {"witness": None}
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(record, SCHEMA)


def test_audit_writes_files_that_verify(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """An audit's certificate is accepted by `verify`, and the JSON names it."""
    proof, record = tmp_path / "c.json", tmp_path / "a.json"
    status, out, _ = run(
        *("audit", "chablat-2022-3r", "--certificate", proof, "--json", record),
        *("--html", tmp_path / "a.html", "--exit-zero"),
        capsys=capsys,
    )
    assert status == 0
    assert "cuspidal" in out
    assert json.loads(record.read_text())["witness"]["certificate"] == str(proof)
    assert "<canvas" in (tmp_path / "a.html").read_text() or (
        "viewer" in (tmp_path / "a.html").read_text()
    )
    assert run("verify", proof, capsys=capsys)[0] == 0


def test_verify_rejects_a_flipped_sign(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A certificate with the other sign exits 1, in one line whatever its name is."""
    proof = tmp_path / "c.json"
    run("audit", "chablat-2022-3r", "--certificate", proof, capsys=capsys)
    claim = json.loads(proof.read_text())
    claim["sign"] = -claim["sign"]
    claim["robot"]["name"] = "arm\raccepted\naccepted: arm"
    proof.write_text(json.dumps(claim))
    status, out, _ = run("verify", proof, capsys=capsys)
    assert status == 1
    assert out.startswith("REJECTED")
    assert out.strip().isprintable()


def test_show_writes_the_page_of_a_saved_audit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`show AUDIT.json --html` makes the page of the same robot and seed."""
    saved, page = tmp_path / "a.json", tmp_path / "a.html"
    run("audit", "ur5_robot", "--json", saved, capsys=capsys)
    status, _, _ = run("show", saved, "--html", page, capsys=capsys)
    assert status == 0
    assert page.stat().st_size > 100_000


def test_show_reads_the_schemas_of_both_versions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A saved audit of version 1 is shown too; what names no robot is refused."""
    saved, page = tmp_path / "a.json", tmp_path / "a.html"
    run("audit", "ur5", "--json", saved, capsys=capsys)
    record = json.loads(saved.read_text())
    assert record["schema"] == "cuspaudit/audit/2"
    for key in ("limits", "cusp", "structures", "margin", "tolerance"):
        del record[key]
    saved.write_text(json.dumps(record | {"schema": "cuspaudit/audit/1"}))
    assert run("show", saved, "--html", page, capsys=capsys)[0] == 0
    for change in ({"robot": None}, {"schema": "cuspaudit/trace/1"}):
        saved.write_text(json.dumps(record | change))
        status, _, err = run("show", saved, "--html", page, capsys=capsys)
        assert (status, err.count("\n")) == (2, 1)
        assert "names no robot" in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["audit", "no-such-robot"], "no-such-robot"),
        (["audit", "chablat-2022-3r", "--json", "no/such/folder/a.json"], "folder"),
        (["audit", "panda"], "tip"),
        (["audit", "ur5_robot", "--lock", "elbow_joint"], "JOINT=VALUE"),
        (["audit", "ur5_robot", "--lock", "elbow=0.1"], "elbow_joint"),
        (["audit", "ur5_robot", "--task", "position"], "lock"),
        (["verify", "no-such-file.json"], "no-such-file.json"),
        (["check", "no-such-folder"], "no-such-folder"),
        (["show", "no-such.json"], "no-such.json"),
        (["import"], "--list"),
        (["audit", "ur5_robot", "--snap", "loose"], "give --snap none, default or"),
        (["import", "arm.xacro"], "no such file"),
    ],
)
def test_bad_input_gives_one_line_and_exit_code_2(
    arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Bad input: nothing on stdout, one line on stderr that says what to do, code 2."""
    status, out, err = run(*arguments, capsys=capsys)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    assert words in err


def test_a_singular_arm_is_refused_with_its_reason(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A planar arm asked for a position in space exits 2: det J vanishes everywhere."""
    rows = "\n".join("  - {type: revolute, a: 1, alpha: 0, d: 0}" for _ in range(3))
    robot = tmp_path / "planar.yaml"
    robot.write_text(
        "name: planar\nconvention: standard\nunits: m\ntask: position\njoints:\n" + rows
    )
    status, _, err = run("audit", robot, capsys=capsys)
    assert status == 2
    assert "det J vanishes" in err


def test_usage_errors_exit_with_2(capsys: pytest.CaptureFixture[str]) -> None:
    """An unknown option is a usage error."""
    assert run("audit", "ur5", "--no-such-option", capsys=capsys)[0] == 2


@pytest.mark.parametrize("command", ["audit", "verify", "show", "import", "check"])
def test_help_shows_an_example(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """The help of every command teaches by an example."""
    status, out, _ = run(command, "--help", capsys=capsys)
    assert status == 0
    assert f"Example: cuspaudit {command}" in " ".join(out.split())


def test_import_says_what_was_snapped(capsys: pytest.CaptureFixture[str]) -> None:
    """`import` lists every snapped number with its before, after and difference."""
    status, out, _ = run("import", "ur5_robot", capsys=capsys)
    assert status == 0
    assert "rpy[1]: 1.57079632679 -> pi/2" in out


def test_import_prints_the_polynomial_map(capsys: pytest.CaptureFixture[str]) -> None:
    """`import --to poly` prints f, R and the factors of det J."""
    _, out, _ = run("import", "chablat-2022-3r", "--to", "poly", capsys=capsys)
    assert "c1^2 + s1^2 - 1 = 0" in out
    assert "3*c3 + 4" in out


@pytest.mark.parametrize("form", ["dh", "dh-modified"])
def test_import_writes_a_robot_file(
    form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`import --to dh` writes a file that is audited like the URDF it came from."""
    _, text, _ = run("import", "ur5_robot", "--to", form, capsys=capsys)
    robot = tmp_path / "arm.yaml"
    robot.write_text(text)
    status, out, _ = run("audit", robot, "--json", "-", capsys=capsys)
    record = json.loads(out)
    assert (status, record["verdict"], record["robot"]["snapped"]) == (
        *(0, "noncuspidal"),
        [],
    )
    assert record["robot"]["source"] == "ur5_robot.urdf, numbers snapped"


def test_snapping_is_chosen_by_one_option(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`--snap` takes none, default or a file; a saved audit is shown with its own."""
    saved, policy = tmp_path / "a.json", tmp_path / "exact.yaml"
    policy.write_text("printed: false\nangle: 0\nlength: 0\naxis: 0\n")
    for chosen in ("none", policy):
        run("audit", "ur5_robot", "--snap", chosen, "--json", saved, capsys=capsys)
        robot = json.loads(saved.read_text())["robot"]
        assert robot["snap_policy"]["name"] == str(chosen)
        assert robot["snapped"] == []
    status, _, _ = run("show", saved, "--html", tmp_path / "a.html", capsys=capsys)
    assert status == 0
    _, literal, _ = run(
        *("import", "ur5_robot", "--to", "dh", "--snap", "none"), capsys=capsys
    )
    assert "numbers as in the file" in literal
    assert "1.57079632679 rad" in literal


def test_check_compares_with_the_recorded_verdict(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`check` exits 1 on a file whose recorded verdict is wrong, 0 when it is right."""
    text = (files("cuspaudit") / ".." / "robots" / "chablat-2022-3r.yaml").read_text()
    robot = tmp_path / "robot.yaml"
    robot.write_text(text)
    report = tmp_path / "report.xml"
    assert run("check", robot, "--junit", report, capsys=capsys)[0] == 0
    assert 'failures="0"' in report.read_text()
    robot.write_text(text.replace("verdict: cuspidal", "verdict: noncuspidal"))
    status, out, _ = run("check", tmp_path, "--junit", report, capsys=capsys)
    assert status == 1
    assert "cuspidal where noncuspidal is recorded" in out
    assert 'failures="1"' in report.read_text()


def test_check_says_which_recorded_counts_are_not_proved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A count that no theorem gives is neither a mismatch nor silently confirmed."""
    robot = tmp_path / "pallet.yaml"
    pitch = "  - {type: revolute, a: 1, alpha: 0, d: 0}\n"
    robot.write_text(
        "name: pallet\nconvention: standard\nunits: m\njoints:\n"
        "  - {type: revolute, a: 1, alpha: pi/2, d: 0}\n"
        f"{3 * pitch}expect: {{verdict: noncuspidal, max_postures: 9}}\n"
    )
    status, out, _ = run("check", robot, capsys=capsys)
    assert status == 0
    assert "not proved: max_postures 9" in out


@pytest.mark.slow
def test_every_robot_of_ours_matches_its_record(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """`check robots/`: no verdict and no count contradicts the literature."""
    folder = files("cuspaudit") / ".." / "robots"
    status, out, _ = run("check", folder, "-j", 2, capsys=capsys)
    assert status == 0, out
    assert "mismatch" not in out


def test_interrupt_leaves_no_file(tmp_path: Path) -> None:
    """Ctrl-C during an audit ends it without a traceback and without a file."""
    page = tmp_path / "a.html"
    command = ["-m", "cuspaudit", "audit", "ark-2022-3r", "--html", str(page)]
    process = subprocess.Popen(
        [sys.executable, *command],
        stderr=subprocess.PIPE,
        text=True,
        # a background shell hands down an ignored SIGINT
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert "Traceback" not in err
    assert os.listdir(tmp_path) == [] or process.returncode == 1


def test_plot_writes_a_figure(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`plot` draws arms of three joints and of six; `--at` is for three only."""
    figure = tmp_path / "figure.svg"
    arguments = ("plot", "baili-2004-wt8", "-o", figure)
    assert run(*arguments, capsys=capsys)[0] == 0
    assert figure.read_text().count("<path") > 10
    assert run("plot", "ur5", "-o", figure, capsys=capsys)[0] == 0
    assert "Merge tree" in figure.read_text()
    refused = ("plot", "ur5", "-o", figure, "--at", "1,1")
    status, _, err = run(*refused, capsys=capsys)
    assert (status, err.count("\n")) == (2, 1)


def test_plot_takes_a_robot_as_an_audit_does(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`plot` snaps, and reads a table that states nothing, as `audit` does."""
    table, figure = tmp_path / "arm.csv", tmp_path / "figure.svg"
    rows = ("1,R,0,0,1,1.5708", "2,R,0,1,2,-1.5708", "3,R,0,0,1.5,0")
    table.write_text("\n".join(("joint,type,theta,d,a,alpha", *rows)))
    arguments = ("plot", table, "-o", figure, "--angle-unit", "rad")
    assert "convention" in run(*arguments, capsys=capsys)[2]
    arguments += ("--convention", "standard")
    assert run(*arguments, capsys=capsys)[0] == 0
    assert "cuspidal" in figure.read_text()
    status, _, err = run(*arguments, "--snap", "loose", capsys=capsys)
    assert status == 2
    assert "give --snap none" in err
