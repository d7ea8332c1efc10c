from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import cuspaudit as cu
from cuspaudit.auditing.calibrated import CalibratedAudit, audit_calibrated
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.robot.calibration import read_calibration
from cuspaudit.robot.library import open_robot

DELTAS = (
    "convention: standard\nunits: m\n"
    "delta_a: [0, 0.0002, 0, 0.0001, 0, 0]\ndelta_alpha: [0, 0.001, 0.002, 0, 0, 0]\n"
)


@pytest.fixture(scope="module")
def deltas(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Deltas of a UR5, about 1 mrad and a tenth of a millimetre."""
    path = tmp_path_factory.mktemp("calibration") / "ur5.yaml"
    path.write_text(DELTAS)
    return path


@pytest.fixture(scope="module")
def both(deltas: Path) -> CalibratedAudit:
    """A UR5 as designed and as built."""
    return audit_calibrated(open_robot("ur5"), read_calibration(deltas))


def test_a_calibrated_ur5_is_cuspidal_by_a_hair(both: CalibratedAudit) -> None:
    """A UR5 is noncuspidal; one whose parallel axes lean by 2 mrad is not."""
    assert both.nominal.answer.verdict is Verdict.NONCUSPIDAL
    assert both.built.answer.verdict is Verdict.CUSPIDAL
    assert both.built.answer.witness is not None


def test_the_distance_to_the_pattern_is_what_was_measured(
    both: CalibratedAudit,
) -> None:
    """The UR pattern is as far away as the deltas say, and would be noncuspidal."""
    before, now = both.nearest[0]
    assert now.name == "UR pattern"
    assert before.holds
    assert not now.holds
    assert 0.0005 < now.angle <= 0.0021
    assert now.length <= 0.0003
    assert "nominally noncuspidal, as built cuspidal; the UR pattern" in both.why


def test_the_record_holds_both(both: CalibratedAudit) -> None:
    """The verdict of the record is that of the arm as built; both audits are in it."""
    record = both.record()
    assert record["schema"] == "cuspaudit/calibrated/1"
    assert record["verdict"] == record["calibrated"]["verdict"] == "cuspidal"
    assert record["nominal"]["verdict"] == "noncuspidal"
    assert record["structures"][0]["nominal"] == {
        "holds": True,
        "length": 0.0,
        "angle": 0.0,
        "verdict": "noncuspidal",
    }


def test_python_loads_the_arm_as_built(deltas: Path) -> None:
    """`load(calibration=...)` is the robot with the measured axes."""
    robot = cu.load("ur5", calibration=deltas)
    assert robot.chain != cu.load("ur5").chain
    assert "calibrated by" in robot.notes[-1]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "code", "said"),
    [
        ((), 1, "both: nominally noncuspidal, as built cuspidal"),
        (("--calibration", "no.yaml"), 2, "no.yaml"),
        (("--free", "joint_1"), 2, "--calibration beside --free"),
        (("--all",), 2, "--calibration beside --all"),
    ],
)
def test_the_command(
    deltas: Path, options: tuple[str, ...], code: int, said: str
) -> None:
    """Exit code of the arm as built; what does not go together is one line."""
    command = [sys.executable, "-m", "cuspaudit", "audit", "ur5"]
    command += ["--calibration", str(deltas), *options]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == code, done.stderr
    assert said in " ".join((done.stdout + done.stderr).split())
