from __future__ import annotations

import math

import numpy as np
import pytest
from short_tables import Number, arm, ask, with_wrist

from cuspaudit.auditing.search import lift
from cuspaudit.auditing.search.lift import (
    close,
    lift_position,
    lift_wrist,
    wrist_middle,
    wrist_spread,
)
from cuspaudit.cuspidality.surface_path import propose_paths
from cuspaudit.errors import RetryableError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames, jacobian

Row = tuple[Number, ...]
ARMS: dict[str, tuple[Row, Row, Row, str, Row]] = {
    "ISSAC": ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0), "RRR", ()),
    "zeros": ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0), "RRR", (20, 90, -45)),
    "PRR": ((1, "1.2", 1), (0, "0.5", "0.3"), (60, 90, 0), "PRR", ()),
    "RRP": ((-1, 2, -1), (0, -2, 1), (90, -60, 0), "RRP", ()),
}


def lifted(name: str) -> tuple[Chain, np.ndarray]:
    """An arm and its best proposed path of all joints."""
    a, d, alpha, kinds, theta = ARMS[name]
    found = ask(arm(a, d, alpha, kinds, theta))
    assert found.decision is not None
    path = next(propose_paths(found.decision))
    return found.model.chain, lift_position(found.model, path)


@pytest.mark.parametrize("name", ARMS)
def test_joint_1_closes_the_path(name: str) -> None:
    """The first joint starts at 0 and brings the tip back to where it began."""
    chain, path = lifted(name)
    assert path[0, 0] == 0
    first, last = (frames(chain, q)[-1, :3, 3] for q in path[[0, -1]])
    assert np.allclose(first, last, atol=1e-7)


@pytest.mark.parametrize("name", ARMS)
def test_closing_rounds_the_start_and_corrects_the_end(name: str) -> None:
    """The first way point has 12 digits; the last reaches its tip to rounding."""
    chain, path = lifted(name)
    closed = close(chain, path)
    assert (closed[0] == np.round(path[0], 12)).all()
    first, last = (frames(chain, q)[-1, :3, 3] for q in closed[[0, -1]])
    assert np.abs(first - last).max() < 1e-13 * (1 + np.abs(first).max())


def test_a_path_that_does_not_close_is_unlucky(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """When Newton's method has too few steps to settle the path is refused."""
    chain, path = lifted("ISSAC")
    path[-1] += 0.01
    assert close(chain, path).shape == path.shape
    monkeypatch.setattr(lift, "_NEWTON", 1)
    with pytest.raises(RetryableError, match="does not reach"):
        close(chain, path)


@pytest.mark.parametrize("twists", [(-90, 90), (90, -90), (90, 90)])
def test_a_wrist_brings_the_hand_back(twists: Row) -> None:
    """The six-joint path ends in the first pose, on one side of the wrist's zero."""
    regional_chain, regional = lifted("ISSAC")
    chain = with_wrist(regional_chain, twists)
    path = lift_wrist(chain, regional)
    assert path.shape == (len(regional) + 1, 6)
    first, last = (frames(chain, q)[-1] for q in path[[0, -1]])
    assert np.allclose(first, last, atol=1e-6)
    middle = wrist_middle(chain, regional[0])
    assert all(wrist_spread(q, middle) > 0 for q in path)
    assert (path[:-1, :3] == regional).all()
    signs = {np.sign(np.linalg.det(jacobian(chain, q))) for q in path}
    assert len(signs) == 1


def test_the_middle_of_a_wrist_is_where_its_axes_are_square() -> None:
    """At the middle axes 4 and 6 are at right angles, and the spread is 1."""
    chain = with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))
    middle = wrist_middle(chain, np.zeros(3))
    posture = np.array([0.3, -0.2, 1.0, 0.5, middle, 2.0])
    placed = frames(chain, posture)
    assert abs(placed[3, :3, 2] @ placed[5, :3, 2]) < 1e-12
    assert wrist_spread(posture, middle) == pytest.approx(1)
    posture[4] += math.pi / 2
    assert wrist_spread(posture, middle) == pytest.approx(0, abs=1e-12)


def test_a_wrist_out_of_luck(monkeypatch: pytest.MonkeyPatch) -> None:
    """When no start reaches the orientation the path is refused."""
    monkeypatch.setattr(lift, "_STARTS", 0)
    regional_chain, regional = lifted("ISSAC")
    with pytest.raises(RetryableError, match="wrist"):
        lift_wrist(with_wrist(regional_chain), regional)
