"""Two hundred special arms, their relations hidden, against an independent oracle."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from numeric_oracle import decide
from special_arms import NONCUSPIDAL, SIX, WRITINGS, SpecialArm, special_arms

from cuspaudit.auditing.as_written import AsWritten
from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.auditing.proofs.certificates import certificate_of_audit
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.robot.library import open_robot

COUNTS = {3: 136, 6: 64}
SEED = 2026
ARMS = {joints: special_arms(COUNTS[joints], joints, SEED) for joints in COUNTS}


def known(arm: SpecialArm) -> str:
    """The verdict by theorem, or else by the oracle: it may be "unknown"."""
    regional = arm.kind.removeprefix("wrist: ")
    if arm.kind in SIX or regional in NONCUSPIDAL:
        return "noncuspidal"
    return decide(arm.regional)


def audited(arm: SpecialArm, folder: Path) -> FinishedAudit:
    """The audit of the arm as its file has it; the literal numbers are not asked."""
    text, ending = arm.file()
    file = folder / f"special{ending}"
    file.write_text(text)
    task = "position" if len(arm.links) == 3 else "pose"
    return audit(open_robot(file, task=task), Options(timeout=120))


def unfounded(found: FinishedAudit) -> Iterator[str]:
    """What the record calls proved without an exact model or a certificate."""
    record, exact = found.record(), found.answer.model.is_exact
    certificate = certificate_of_audit(found)
    proved = certificate is not None and verify(certificate).accepted
    if record["verdict"] != "undecided" and not exact and not proved:
        yield f"the verdict {record['verdict']}"
    if record["verdict"] == "cuspidal" and not proved and found.answer.crowd is None:
        yield "a witness"
    singular = record["singular"]
    for what, is_proved in (
        ("aspects", record["aspects"]["proved"]),
        ("postures", record["postures"]["proved"]),
        ("cusps", singular["cusps_proved"]),
        ("nodes", singular["nodes_proved"]),
    ):
        if is_proved and not exact:
            yield what


@pytest.fixture
def _no_literal(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the literal numbers out: they are another question, and take minutes."""
    nothing = AsWritten(Verdict.UNDECIDED)
    monkeypatch.setattr("cuspaudit.auditing.audit.as_written", lambda *_: nothing)
    monkeypatch.setattr("cuspaudit.auditing.audit.why_undecided", lambda *_: None)


@pytest.mark.slow
@pytest.mark.usefixtures("_no_literal")
@pytest.mark.parametrize("writing", WRITINGS)
@pytest.mark.parametrize("joints", COUNTS)
def test_no_special_arm_is_answered_wrongly(
    joints: int, writing: str, tmp_path: Path
) -> None:
    """Each has its verdict or none, and what is called proved is."""
    wrong, open_arms, asked = [], 0, 0
    for arm in ARMS[joints]:
        if arm.writing != writing:
            continue
        right = known(arm)
        found = audited(arm, tmp_path)
        verdict = found.verdict.value
        asked += right != "unknown"
        open_arms += verdict == "undecided"
        if "unknown" != right != verdict != "undecided":
            wrong.append((arm.kind, arm.links, f"{verdict}, not {right}"))
        wrong += [
            (arm.kind, arm.links, f"{what}: not proved") for what in unfounded(found)
        ]
    assert wrong == []
    assert asked > 0.7 * COUNTS[joints] / len(WRITINGS)
    assert open_arms <= (0.1 * asked if writing in ("frames 6", "frames 5") else 0)


@pytest.mark.slow
def test_the_oracle_agrees_with_the_theorems() -> None:
    """It never calls cuspidal what a theorem says is not."""
    arms = [arm for arm in ARMS[3] if arm.kind in NONCUSPIDAL]
    assert {decide(arm.links) for arm in arms[::17]} <= {"noncuspidal", "unknown"}
