from __future__ import annotations

import json
from typing import Any

import pytest

from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.auditing.proofs.proof_record import SCHEMA, proof_record
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.library import open_robot


def record_of(name: str) -> dict[str, Any]:
    """The record of a robot of ours."""
    record: dict[str, Any] = json.loads(
        proof_record(answer(exact_model(open_robot(name).chain)))
    )
    return record


@pytest.mark.parametrize("name", ["puma-560-arm", "baili-2004-wt8", "puma-560"])
def test_noncuspidal_record_separates_the_postures(
    name: str,
) -> None:
    """In the record of a noncuspidal run no two postures of a value share an aspect."""
    record = record_of(name)
    samples = record["run"]["samples"]
    assert (record["schema"], record["verdict"]) == (SCHEMA, "noncuspidal")
    assert max(len(sample["postures"]) for sample in samples) == 4
    for sample in samples:
        aspects = [posture["aspect"] for posture in sample["postures"]]
        assert len(set(aspects)) == len(aspects)


def test_cuspidal_record_shows_a_couple() -> None:
    """In the record of a cuspidal run some value has two postures in one aspect."""
    samples = record_of("chablat-2022-3r")["run"]["samples"]
    shared = [
        sample
        for sample in samples
        if len({p["aspect"] for p in sample["postures"]}) < len(sample["postures"])
    ]
    assert shared


def test_the_record_of_pairs_separates_their_ends() -> None:
    """In the record of a noncuspidal decision by pairs no pair is in one aspect."""
    model = exact_model(open_robot("baili-2004-wt8").chain)
    record = json.loads(proof_record(answer(model, engine="pairs")))
    assert record["run"] is None
    assert len(record["pairs"]["walls"]) == 4
    pairs = [pair["ends"] for pair in record["pairs"]["pairs"]]
    assert len(pairs) > 10
    assert all(one["aspect"] != other["aspect"] for one, other in pairs)


def test_a_theorem_leaves_no_run_to_record() -> None:
    """The UR pattern is settled without a run: its record names the theorem."""
    record = record_of("ur5")
    assert record["run"] is None
    assert record["reduction"] == "UR pattern"
