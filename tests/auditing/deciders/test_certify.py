from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from short_tables import Number, arm, ask, degrees, with_wrist

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.deciders import certify as module
from cuspaudit.auditing.deciders.certify import find_witness
from cuspaudit.auditing.witness import CertifiedPath, certificate_of
from cuspaudit.certificate import (
    certificate_from_text,
    text_from_certificate,
    verify,
)
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.robot.chain import X_AXIS, Chain, Rotation, reverse
from cuspaudit.robot.frames import frames, jacobian

Row = tuple[Number, ...]
CUSPIDAL: dict[str, Chain] = {
    "ISSAC": arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    "mirror": arm((1, 2, "3/2"), (0, 1, 0), (90, -90, 0)),
    "WT2": arm((1, "1.5", ".7"), (0, ".5", 0), (-90, 90, 0)),
    "WT5": arm((1, 3, 4), (0, 3, 0), (-90, 90, 0)),
    "sqrt 3": arm((1, 2, 1), (0, 1, 0), (-30, 90, 0)),
    "sqrt 2": arm((1, "3/2", 1), (0, 1, "1/2"), (45, -45, 0)),
    "general": arm((1, "1.3", ".9"), (0, ".4", "-.7"), (70, 110, 0)),
    "8 cusps": arm((1, ".7", ".7"), (0, ".3", ".9"), (-90, 90, 0)),
    "RRP": arm((-1, 2, -1), (0, -2, 1), (90, -60, 0), "RRP"),
    "PRR": arm((1, "1.2", 1), (0, "0.5", "0.3"), (60, 90, 0), "PRR"),
    "wrist": with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))),
    "shoulder": reverse(with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))),
}


@cache
def asked(name: str) -> Answer:
    """The answer for an arm of the list."""
    return ask(CUSPIDAL[name])


@cache
def witness_of(name: str) -> CertifiedPath:
    """Its witness."""
    return find_witness(asked(name), CUSPIDAL[name])


@pytest.mark.parametrize("name", CUSPIDAL)
def test_every_cuspidal_answer_has_its_certificate(name: str) -> None:
    """The certificate verifies, also after being written and read."""
    chain = CUSPIDAL[name]
    found = witness_of(name)
    assert found.verification.accepted
    again = certificate_from_text(text_from_certificate(found.certificate), "test")
    assert verify(again).accepted
    assert found.chain == chain
    assert found.clearance is None or 0 < found.clearance <= 1
    # |det J| is bounded unless joint 2 or 3 slides
    assert (found.clearance is None) == ("prismatic" in chain.kinds[1:3])


@pytest.mark.parametrize("name", CUSPIDAL)
def test_a_witness_is_what_it_says(name: str) -> None:
    """One pose at both ends, different postures, one sign along a dense sample."""
    chain = CUSPIDAL[name]
    found = witness_of(name)
    first, last = (frames(chain, q)[-1] for q in found.path[[0, -1]])
    moved = (
        np.abs(first - last) if chain.task == "pose" else np.abs((first - last)[:, 3])
    )
    assert moved.max() < 1e-9
    turn = found.path[0] - found.path[-1]
    turned = [k == "revolute" for k in chain.kinds]
    turn = np.where(turned, np.remainder(turn + np.pi, 2 * np.pi) - np.pi, turn)
    assert np.abs(turn).max() > 1e-3
    steps = np.linspace(0, 1, 20)[:, None]
    for a, b in zip(found.path[:-1], found.path[1:], strict=True):
        for q in a + steps * (b - a):
            assert found.sign * np.linalg.det(jacobian(chain, q)) > 0


def test_the_literal_numbers_are_certified() -> None:
    """A witness for other numbers than the model's: those are what it proves."""
    nominal = CUSPIDAL["ISSAC"]
    rounded = arm((1, 2, "1.5"), (0, 1, 0), ("-89.99", "90.01", 0))
    found = find_witness(ask(nominal), rounded)
    assert found.verification.accepted
    assert found.chain == rounded
    assert found.certificate.robot_name == rounded.name


def test_the_certificate_holds_the_chain() -> None:
    """Names, kinds, axes, fixed motions, tool, task and unit are the chain's."""
    chain = replace(CUSPIDAL["RRP"], unit="mm", name="my arm")
    path = np.array([[0.0, 0.1, 0.2], [1.0, 1.1, 1.2]])
    certificate = certificate_of(chain, -3, path)
    assert certificate.sign == -1
    assert certificate.unit == "mm"
    assert certificate.robot_name == "my arm"
    assert [joint.kind for joint in certificate.joints] == list(chain.kinds)
    assert [len(j.before) for j in certificate.joints] == [
        len(j.before) for j in chain.joints
    ]
    assert len(certificate.tool) == len(chain.tool)
    assert [[float(x) for x in row] for row in certificate.path] == path.tolist()
    assert certificate.postures == (certificate.path[0], certificate.path[-1])


def test_a_witness_for_another_arm_is_refused() -> None:
    """For an arm on which the couples are none, nothing is proved."""
    other = arm((1, ".5", ".8"), (0, ".2", 0), (-90, 90, 0))
    with pytest.raises(UnableError, match="no path could be proved"):
        find_witness(asked("ISSAC"), other)


def test_unlucky_paths_are_passed_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """A path that does not close is followed by the next; none left is UnableError."""
    found, real = asked("ISSAC"), module.close
    calls: list[int] = []

    def once(chain: Chain, path: np.ndarray) -> np.ndarray:
        calls.append(1)
        if len(calls) == 1:
            raise RetryableError("unlucky")
        return real(chain, path)

    monkeypatch.setattr(module, "close", once)
    assert find_witness(found, CUSPIDAL["ISSAC"]).verification.accepted
    assert len(calls) == 2

    def never(chain: Chain, path: np.ndarray) -> np.ndarray:
        raise RetryableError("always unlucky")

    monkeypatch.setattr(module, "close", never)
    with pytest.raises(UnableError, match="always unlucky"):
        find_witness(found, CUSPIDAL["ISSAC"])


def test_a_wrist_without_luck(monkeypatch: pytest.MonkeyPatch) -> None:
    """When the wrist cannot follow on any path, no path was proposed."""

    def never(chain: Chain, path: np.ndarray) -> np.ndarray:
        raise RetryableError("no wrist")

    monkeypatch.setattr(module, "lift_wrist", never)
    for name in ("wrist", "shoulder"):
        with pytest.raises(UnableError, match="no path was proposed"):
            find_witness(asked(name), CUSPIDAL[name])


def test_the_tool_s_orientation_leaves_the_clearance() -> None:
    """Clearance is a property of the arm: a turned tool does not change it."""
    chain = CUSPIDAL["ISSAC"]
    turned = replace(chain, tool=(*chain.tool, Rotation(X_AXIS, degrees(90))))
    one, other = (find_witness(ask(c), c).clearance for c in (chain, turned))
    assert one == pytest.approx(other, rel=1e-6)
