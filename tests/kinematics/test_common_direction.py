from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from short_tables import Number, arm, ask, degrees, shift

from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, NoAngleError
from cuspaudit.kinematics.common_direction import common_direction
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import X_AXIS, Chain, Rotation, reverse
from cuspaudit.robot.frames import frames, jacobian

Array = NDArray[np.float64]
Row = tuple[Number, ...]
SCARA: tuple[Row, Row, Row] = (
    ("0.325", "0.275", 0, 0),
    ("0.3", 0, 0, 0),
    (0, 180, 0, 0),
)
PALLET: tuple[Row, Row, Row] = (
    ("0.2", 1, "0.8", "0.3"),
    (0, 0, "0.1", 0),
    (90, 0, 0, 0),
)


def four(rows: tuple[Row, Row, Row], kinds: str = "") -> Chain:
    """A chain with the task of an angle."""
    return replace(arm(*rows, kinds), task="position-and-angle")


def slanted(kinds: str) -> Chain:
    """Joints that turn about z, and slides in all directions."""
    chain = four(
        (("0.7", "0.9", "0.4", "0.5"), ("0.3", "0.2", 0, "0.1"), (0,) * 4), kinds
    )
    axes = [(3, 1, 2), (-1, 2, 4), (1, 5, -2), (2, -3, 1)]
    return chain.with_joints(
        [
            replace(joint, axis=shift(*axis).vector)
            if joint.kind == "prismatic"
            else joint
            for joint, axis in zip(chain.joints, axes, strict=True)
        ]
    )


def postures(chain: Chain, first: Array, starts: int = 30) -> Array:
    """The postures of the place of ``first`` that Newton's method meets, and it."""
    signs = np.array(common_direction(exact_model(chain)).signs)
    turns = np.array([kind == "revolute" for kind in chain.kinds])
    target = frames(chain, first)[-1, :3, 3]
    met = [first]
    for q in np.random.default_rng(0).uniform(-4, 4, (starts, 4)):
        for _ in range(40):
            angle = np.remainder(signs @ (first - q) + np.pi, 2 * np.pi) - np.pi
            error = np.r_[target - frames(chain, q)[-1, :3, 3], angle]
            if np.abs(error).max() < 1e-12:
                break
            q = q + np.linalg.lstsq(jacobian(chain, q), error, rcond=1e-9)[0]
        if np.abs(error).max() < 1e-9:
            away = [np.where(turns, np.sin((q - p) / 2), q - p) for p in met]
            if min(np.abs(row).max() for row in away) > 1e-5:
                met.append(q)
    return np.array(met)


@pytest.mark.slow
@pytest.mark.parametrize("kinds", ["RRPR", "RRRP", "PRRP", "RPPR", "PRPR", "PPRP"])
def test_parallel_axes_have_two_postures_of_opposite_signs(kinds: str) -> None:
    """Wherever the slides stand and point: at most two, and det J tells them apart."""
    chain, met = slanted(kinds), []
    for q in np.random.default_rng(7).uniform(-1.5, 1.5, (3, 4)):
        found = postures(chain, q)
        signs = [np.sign(np.linalg.det(jacobian(chain, p))) for p in found]
        assert len(set(signs)) == len(found)
        met.append(len(found))
    answer = ask(chain)
    assert answer.verdict is Verdict.NONCUSPIDAL
    assert max(met) <= 2
    if answer.postures is not None:
        assert max(met) == answer.postures.count


def test_a_scara_agrees_with_algorithm_1() -> None:
    """Its last joint enters nothing: the rest is an arm of three joints."""
    chain = four(SCARA, "RRPR")
    rest = replace(
        chain.with_joints(chain.joints[:3]),
        task="position",
        tool=chain.joints[3].before,
    )
    whole, regional = ask(chain), ask(rest)
    assert whole.verdict is regional.verdict is Verdict.NONCUSPIDAL
    assert whole.aspects == regional.aspects
    assert whole.postures == regional.postures
    assert ask(reverse(chain)).aspects == whole.aspects


@pytest.mark.slow
def test_yaw_and_pitch_are_told_apart_by_two_signs() -> None:
    """At most one posture of a place for each sign of the reach and of the elbow."""
    chain, most = four(PALLET), 0
    for q in np.random.default_rng(5).uniform(-2, 2, (4, 4)):
        found = postures(chain, q)
        reach = 0.2 + np.cos(np.cumsum(found[:, 1:], axis=1)) @ [1, 0.8, 0.3]
        sine = np.sin(found[:, 2])
        values = [np.linalg.det(jacobian(chain, p)) for p in found]
        assert np.abs(values) == pytest.approx(np.abs(reach * 0.8 * sine))
        pairs = {(x > 0, y > 0) for x, y in zip(reach, sine, strict=True)}
        assert len(pairs) == len(found)
        most = max(most, len(found))
    assert most == 4
    answer = ask(chain)
    assert answer.verdict is Verdict.NONCUSPIDAL
    assert answer.reduction is not None
    assert answer.reduction.kind == "yaw and pitch"


@pytest.mark.parametrize(
    ("rows", "kinds"), [(SCARA, "RRPR"), (PALLET, ""), (SCARA, "RRRP")]
)
@pytest.mark.parametrize("number", [1, 2, 3])
def test_axes_that_are_nearly_parallel_have_no_angle(
    rows: tuple[Row, Row, Row], kinds: str, number: int
) -> None:
    """A hair off the structure is another arm: the task means nothing for it."""
    chain = four(rows, kinds)
    common_direction(exact_model(chain))
    hair = replace(degrees(0), radians=shift("1e-9", 0, 0).vector[0])
    joints = list(chain.joints)
    if joints[number].kind == "prismatic":
        number += 1 if kinds == "RRPR" else -1
    tilt = Rotation(X_AXIS, hair)
    joints[number] = replace(joints[number], before=(*joints[number].before, tilt))
    with pytest.raises(NoAngleError, match="the tip has no angle"):
        ask(chain.with_joints(joints))


def test_an_arm_that_cannot_rise_or_reach_is_told() -> None:
    """Four parallel turns, and an upper arm of no length, have det J = 0."""
    for rows in (
        ((1, 1, 1, 1), (0,) * 4, (0,) * 4),
        ((0, 0, 1, 1), (0,) * 4, (90, 0, 0, 0)),
    ):
        with pytest.raises(DegenerateMapError):
            ask(four(rows))
