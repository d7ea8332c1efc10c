"""The verdicts at every value of a locked joint, schema ``cuspaudit/free/1``."""

from __future__ import annotations

import json
from typing import Any

from cuspaudit.auditing.free_joint.stretch import FreeJoint, LockWitness, Stretch
from cuspaudit.auditing.free_joint.survey import LockChoice
from cuspaudit.auditing.record import PACKAGES
from cuspaudit.certificate import text_from_certificate
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.virtual_joint import without_virtual_joint
from cuspaudit.runtime.versions import versions

__all__ = ["SCHEMA", "SURVEY_SCHEMA", "free_record", "survey_record"]

SCHEMA = "cuspaudit/free/1"
SURVEY_SCHEMA = "cuspaudit/locks/1"


def free_record(robot: Robot, found: FreeJoint) -> dict[str, Any]:
    """The record: angles in rad, degrees where a key says so, joints in chain order.

    A witness holds its certificate, which `cuspaudit verify` reads from a file of its
    own.
    """
    return {
        "schema": SCHEMA,
        "robot": _robot(robot),
        "joint": found.joint,
        "number": found.number,
        "numbers": "snapped" if found.is_snapped else "literal",
        "within_limits": found.within_limits,
        "domain": _span(found.domain.lower, found.domain.upper),
        "verdict": found.verdict.value,
        "why": found.why,
        "degrees": _degrees(found),
        "stretches": [_stretch(each) for each in found.stretches],
        "stopped": found.stopped,
        "seconds": {key: round(value, 4) for key, value in found.seconds.items()},
        "versions": versions(PACKAGES),
        "seed": found.seed,
    }


def survey_record(robot: Robot, choices: list[LockChoice], seed: int) -> dict[str, Any]:
    """The record of what each joint gives when it is the one that is locked."""
    words = {choice.verdict for choice in choices}
    verdict = words.pop() if len(words) == 1 else Verdict.UNDECIDED
    return {
        "schema": SURVEY_SCHEMA,
        "robot": _robot(robot),
        "verdict": verdict.value,
        "locks": [
            {
                "joint": choice.joint,
                "verdict": choice.verdict.value,
                "value": choice.value,
                "noncuspidal_degrees": round(choice.degrees, 6),
                "why": choice.why,
            }
            for choice in choices
        ],
        "versions": versions(PACKAGES),
        "seed": seed,
    }


def _robot(robot: Robot) -> dict[str, Any]:
    chain = without_virtual_joint(robot.chain)
    return {
        "name": robot.name,
        "file": robot.file,
        "joints": [joint.name for joint in chain.joints],
        "base": chain.base,
        "tip": chain.tip,
        "task": chain.task,
        "unit": chain.unit,
    }


def _degrees(found: FreeJoint) -> dict[str, float]:
    names = {word: word.value for word in Verdict} | {Verdict.UNDECIDED: "open"}
    return {names[word]: round(found.degrees[word], 6) for word in Verdict}


def _stretch(stretch: Stretch) -> dict[str, Any]:
    return {
        **_span(stretch.span.lower, stretch.span.upper),
        "verdict": stretch.verdict.value,
        "proof": stretch.kind,
        "why": stretch.why,
        "witness": None if stretch.witness is None else _witness(stretch.witness),
    }


def _witness(witness: LockWitness) -> dict[str, Any]:
    return {
        "value": witness.value,
        "path": [[float(v) for v in row] for row in witness.path],
        "smallest": witness.smallest,
        "certificate": json.loads(text_from_certificate(witness.certificate)),
    }


def _span(lower: Any, upper: Any) -> dict[str, float]:
    return {"lower": angle_value(lower), "upper": angle_value(upper)}
