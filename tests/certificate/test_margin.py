"""The proved distance from a witness path to the nearest singular posture."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.certificate.margin import margin_of
from cuspaudit.robot.frames import jacobian
from cuspaudit.robot.library import open_robot

NAMES = ("chablat-2022-3r", "fanuc-crx-10ia-l", "chablat-2022-5r")


@pytest.fixture(scope="module")
def audits() -> dict[str, FinishedAudit]:
    """Cuspidal arms of three, six and five joints."""
    return {name: audit(open_robot(name)) for name in NAMES}


def points(path: np.ndarray, count: int) -> np.ndarray:
    """Places of every segment."""
    steps = np.linspace(0, 1, count)[:, None]
    return np.vstack([a + steps * (b - a) for a, b in pairwise(path)])


@pytest.mark.parametrize("name", NAMES)
def test_no_posture_within_the_margin_is_singular(
    audits: dict[str, FinishedAudit], name: str
) -> None:
    """The sign of det J stays at postures on the rim, those downhill among them."""
    found = audits[name]
    witness, margin = found.witness, found.margin
    assert witness is not None
    assert margin is not None
    assert margin > 0.03
    random = np.random.default_rng(1)
    for q in points(witness.path, 40):
        away = random.normal(size=(30, len(q)))
        away *= margin / np.linalg.norm(away, axis=1, keepdims=True)
        away[0] = -witness.sign * downhill(found, q) * margin
        for step in away:
            value = np.linalg.det(jacobian(witness.chain, q + step))
            assert np.sign(value) == witness.sign


def downhill(found: FinishedAudit, q: np.ndarray) -> np.ndarray:
    """The unit gradient of det J."""
    assert found.witness is not None
    chain, step = found.witness.chain, 1e-6 * np.eye(len(q))
    value = [
        np.linalg.det(jacobian(chain, q + e)) - np.linalg.det(jacobian(chain, q - e))
        for e in step
    ]
    return np.array(value) / np.linalg.norm(value)


def test_the_margin_is_no_larger_than_the_true_distance(
    audits: dict[str, FinishedAudit],
) -> None:
    """Ways downhill from the path meet a singular posture, all beyond the margin."""
    found = audits["chablat-2022-3r"]
    assert found.witness is not None
    assert found.margin is not None
    met = []
    for q in points(found.witness.path, 60):
        way = -found.witness.sign * downhill(found, q)
        for t in np.linspace(0, 1.2, 121):
            value = np.linalg.det(jacobian(found.witness.chain, q + t * way))
            if np.sign(value) != found.witness.sign:
                met.append(t)
                break
    assert met
    assert found.margin < min(met) < 12 * found.margin


def test_a_path_that_touches_a_singularity_has_none(
    audits: dict[str, FinishedAudit],
) -> None:
    """A way point moved beyond det J = 0 leaves nothing to prove."""
    witness = audits["chablat-2022-3r"].witness
    assert witness is not None
    certificate = witness.certificate
    start = certificate.path[0]
    beyond = (start[0], start[1], start[2] + Fraction(22, 7))
    assert margin_of(replace(certificate, path=(start, beyond))) is None


def test_it_is_written_and_only_where_there_is_a_path(
    audits: dict[str, FinishedAudit],
) -> None:
    """JSON has it in rad, proved; a noncuspidal arm has none."""
    found = audits["fanuc-crx-10ia-l"]
    assert found.record()["margin"] == {"joint_angle": found.margin, "proved": True}
    assert audit(open_robot("ur5")).record()["margin"] is None
