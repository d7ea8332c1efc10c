from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import cuspaudit
from cuspaudit.certificate import certificate_from_text, verify

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


def test_a_cuspidal_range_with_certificates() -> None:
    """Exit 1 with a little time: what is proved has certificates that verify."""
    done = free("franka-panda", "joint_3", "--timeout", "6", "--json", "-")
    found = json.loads(done.stdout)
    held(found, "free.schema.json")
    proved = [each for each in found["stretches"] if each["witness"]]
    assert done.returncode == (1 if proved else 3)
    for each in proved[:1]:
        text = json.dumps(each["witness"]["certificate"])
        assert verify(certificate_from_text(text)).accepted
    assert found["stopped"] or found["degrees"]["open"] == 0


@pytest.mark.parametrize(
    ("joint", "options", "said"),
    [
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
