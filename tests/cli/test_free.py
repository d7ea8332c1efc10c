from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import cuspaudit

FOLDER = Path(cuspaudit.__file__).parents[1] / "robots" / "seven-joints"
SCHEMAS = Path(cuspaudit.__file__).parent / "auditing" / "free_joint"


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """The command line."""
    command = [sys.executable, "-m", "cuspaudit", *arguments]
    return subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=120
    )


def free(name: str, joint: str, *options: str) -> subprocess.CompletedProcess[str]:
    """`audit --free` of one of our robots."""
    return run("audit", str(FOLDER / f"{name}.yaml"), "--free", joint, *options)


def held(found: dict[str, Any], schema: str) -> None:
    """Hold a record to its schema."""
    jsonschema.validate(found, json.loads((SCHEMAS / schema).read_text()))


def test_a_noncuspidal_circle(tmp_path: Path) -> None:
    """Exit 0, the shares in degrees, a page and a record that keeps to its schema."""
    page, record = tmp_path / "a.html", tmp_path / "a.json"
    done = free("barrett-wam", "joint_3", "--html", str(page), "--json", str(record))
    assert done.returncode == 0, done.stderr
    assert "noncuspidal 360 deg" in done.stdout
    found = json.loads(record.read_text())
    held(found, "free.schema.json")
    assert found["degrees"] == {"cuspidal": 0, "noncuspidal": 360, "open": 0}
    assert "spherical wrist" in page.read_text()


@pytest.mark.slow
def test_a_cuspidal_range_with_certificates(tmp_path: Path) -> None:
    """Exit 1 with a little time: `verify` proves each interval, and sees one moved."""
    file = tmp_path / "panda.json"
    done = free("franka-panda", "joint_3", "--timeout", "12", "--json", str(file))
    found = json.loads(file.read_text())
    held(found, "free.schema.json")
    proved = [each for each in found["stretches"] if each["witness"]]
    assert done.returncode == (1 if proved else 3)
    assert found["stopped"] or found["degrees"]["open"] == 0
    if not proved:
        pytest.skip("no interval was reached in the time")
    done = run("verify", str(file))
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("accepted: ") == len(proved)
    proved[0]["upper"] += 0.1
    file.write_text(json.dumps(found))
    done = run("verify", str(file))
    assert done.returncode == 1
    assert "REJECTED" in done.stdout


def test_a_record_without_certificates_is_no_proof(tmp_path: Path) -> None:
    """The record of a noncuspidal circle has nothing to verify: one line."""
    file = tmp_path / "wam.json"
    free("barrett-wam", "joint_3", "--json", str(file))
    done = run("verify", str(file))
    assert done.returncode == 2
    assert "no interval has a certificate" in done.stderr
    file.write_text('{"schema": "cuspaudit/free/1", "stretches": 3}')
    done = run("verify", str(file))
    assert done.returncode == 2
    assert "cut or altered" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("joint", "options", "said"),
    [
        ("", (), 'no joint is named ""'),
        ("joint_9", (), 'no joint is named "joint_9"'),
        ("joint_4", (), "whatever the value of joint_4"),
        ("joint_3", ("--certificate", "c.json"), "--json FILE"),
        ("joint_3", ("--all",), "--free beside --all"),
        ("joint_3", ("--lock", "joint_1=0"), "6 joints for the task pose"),
    ],
)
def test_bad_questions_are_one_line(
    joint: str, options: tuple[str, ...], said: str
) -> None:
    """No such joint, a locked elbow, options that do not go together: exit 2."""
    done = free("kuka-lbr-iiwa-14", joint, *options)
    assert done.returncode == 2
    assert said in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.slow
def test_without_free_every_joint_is_tried() -> None:
    """A row a joint says which lock gives what; an elbow locked is singular."""
    done = run("audit", str(FOLDER / "barrett-wam.yaml"), "--json", "-")
    found = json.loads(done.stdout)
    held(found, "locks.schema.json")
    rows = {row["joint"]: row for row in found["locks"]}
    assert len(rows) == 7
    assert rows["joint_3"]["verdict"] == "noncuspidal"
    assert rows["joint_3"]["value"] is None
    assert "det J vanishes" in rows["joint_4"]["why"]
    assert done.returncode == 3


@pytest.mark.slow
def test_a_rail_may_be_locked_too(tmp_path: Path) -> None:
    """A UR on a rail: the rail locked leaves the UR; a slide has no circle."""
    table = FOLDER.parent / "ur5.yaml"
    rail = "joints:\n  - {type: prismatic, a: 0, alpha: pi/2, theta: 0}\n"
    text = table.read_text().replace("joints:\n", rail).partition("expect:")[0]
    robot = tmp_path / "rail.yaml"
    robot.write_text(text)
    done = run("audit", str(robot), "--json", "-", "--timeout", "8")
    found = json.loads(done.stdout)
    held(found, "locks.schema.json")
    assert found["locks"][0]["verdict"] == "noncuspidal"
    assert "a slide, locked at 0" in found["locks"][0]["why"]
    done = run("audit", str(robot), "--free", "joint_1")
    assert done.returncode == 2
    assert '"joint_1" slides' in done.stderr
