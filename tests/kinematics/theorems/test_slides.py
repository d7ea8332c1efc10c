from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest
from flint import arb

from cuspaudit.algebra.trigonometric import factor_on_circles
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.theorems.plane_and_pair import PLANE_AND_PAIR
from cuspaudit.kinematics.theorems.registry import reduction_of
from cuspaudit.kinematics.theorems.three_slides import THREE_SLIDES
from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    JointKind,
    Motion,
    Rotation,
    Translation,
)
from cuspaudit.robot.frames import frames, jacobian

NAMES: dict[str, JointKind] = {"R": "revolute", "P": "prismatic"}
Link = tuple[str, ...]
GENERAL: Sequence[Link] = (
    *(("1/2", "1/3", "1/5"), ("1/3", "1/4", "2/5"), ("2/3", "-1/6", "1/4")),
    *(("1/4", "1/3", "1/7"), ("1/5", "1/6", "1/2"), ("0", "0", "1/3")),
)
FLAT: Link = ("1/2", "0", "0")
ACROSS: Link = ("1/3", "1/2", "0")
TURNED: Link = ("1/3", "1/2", "0", "1/2")
MEET: Link = ("0", "1/3", "0")


def arm(kinds: str, links: Sequence[Link]) -> Chain:
    """A standard table with rows a, alpha in half turns, d, and maybe theta."""
    joints = []
    before: tuple[Motion, ...] = ()
    for k, (kind, link) in enumerate(zip(kinds, links, strict=True), 1):
        joints.append(Joint(f"j{k}", NAMES[kind], before))
        a, half_turns, d, theta = map(Fraction, (*link, "0")[:4])
        before = (
            Rotation(Z_AXIS, Angle(theta)),
            Translation((a, Fraction(0), d)),
            Rotation(X_AXIS, Angle(half_turns)),
        )
    return Chain("arm", tuple(joints), before, "pose")


def postures(chain: Chain, goal: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """The postures of a pose that Newton's method meets from random starts."""
    slides = np.array([kind == "prismatic" for kind in chain.kinds])
    found: list[np.ndarray] = []
    for _ in range(40):
        q = rng.uniform(-3, 3, 6)
        for _ in range(30):
            tip = frames(chain, q)[-1]
            turn = goal[:3, :3] @ tip[:3, :3].T
            skew = turn - turn.T
            twist = np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
            error = np.r_[goal[:3, 3] - tip[:3, 3], twist / 2]
            J = jacobian(chain, q)
            step = J.T @ np.linalg.solve(J @ J.T + 1e-9 * np.eye(6), error)
            q = q + step * min(1.0, 1.0 / np.abs(step).max())
            if np.abs(error).max() < 1e-13:
                break
        q = np.where(slides, q, np.angle(np.exp(1j * q)))
        if np.abs(frames(chain, q)[-1] - goal).max() < 1e-9 and not any(
            np.abs(np.where(slides, q - p, np.angle(np.exp(1j * (q - p))))).max() < 1e-5
            for p in found
        ):
            found.append(q)
    return np.array(found)


def signs(model: ExactModel, rows: np.ndarray) -> list[tuple[int, ...]]:
    """The signs of the factors of det J at postures."""
    factors = factor_on_circles(model.ring, model.circles, jacobian_determinant(model))
    result = []
    for q in rows:
        values: dict[str, arb] = {}
        for joint, value, zero in zip(model.joints, q, model.zeros, strict=True):
            if joint.kind == "prismatic":
                values[joint.variables[0]] = arb(value)
            else:
                c, s = joint.variables
                values |= {c: arb(value + zero).cos(), s: arb(value + zero).sin()}
        balls = [model.ring.evaluate(factor, values) for factor, _ in factors]
        result.append(tuple(1 if ball > 0 else -1 for ball in balls))
    return result


SPECIAL = [
    ("PPPRRR", [ACROSS, TURNED, *GENERAL[2:]]),
    ("PRPRPR", GENERAL),
    ("RRRPPP", [*GENERAL[:3], ACROSS, TURNED, GENERAL[5]]),
    ("PPRRRR", [ACROSS, TURNED, GENERAL[2], GENERAL[3], MEET, GENERAL[5]]),
    ("PRRRRR", [FLAT, FLAT, FLAT, GENERAL[3], MEET, GENERAL[5]]),
    ("RPRRRR", [ACROSS, ACROSS, GENERAL[2], MEET, GENERAL[4], GENERAL[5]]),
    ("RRRPRR", [FLAT, FLAT, GENERAL[2], ACROSS, GENERAL[4], GENERAL[5]]),
    ("RRRRPR", [FLAT, FLAT, GENERAL[2], GENERAL[3], ACROSS, GENERAL[5]]),
    ("RRRRRP", [FLAT, FLAT, GENERAL[2], GENERAL[3], ACROSS, GENERAL[5]]),
]


@pytest.mark.slow
@pytest.mark.parametrize(("kinds", "links"), SPECIAL)
def test_signs_tell_the_postures_of_a_pose_apart(
    kinds: str, links: Sequence[Link]
) -> None:
    """Where a theorem holds, no two postures that Newton meets share all signs."""
    chain = arm(kinds, links)
    model = exact_model(chain)
    found = reduction_of(model)
    assert found is not None
    assert found.regional is None
    rng = np.random.default_rng(len(kinds))
    most = 0
    for _ in range(3):
        goal = frames(chain, rng.uniform(-3, 3, 6))[-1]
        met = postures(chain, goal, rng)
        most = max(most, len(met))
        told = signs(model, met)
        assert len(set(told)) == len(told)
        if found.postures:
            assert len(met) <= found.postures
    assert most > 1


@pytest.mark.parametrize(
    ("kinds", "links"),
    [
        ("PPRRRR", GENERAL),
        ("PRRRRR", GENERAL),
        ("PPRRRR", [ACROSS, ACROSS, *GENERAL[2:]]),
        ("RRPRRR", [FLAT, FLAT, GENERAL[2], MEET, GENERAL[4], GENERAL[5]]),
        ("RRRRRR", [FLAT, FLAT, GENERAL[2], MEET, GENERAL[4], GENERAL[5]]),
    ],
)
def test_a_structure_that_is_not_there_is_not_seen(
    kinds: str, links: Sequence[Link]
) -> None:
    """General slides, a slide along the axes, an arm without slides: no theorem."""
    model = exact_model(arm(kinds, links))
    assert THREE_SLIDES.apply(model) is None
    assert PLANE_AND_PAIR.apply(model) is None


def test_dependent_slides_are_no_three_directions() -> None:
    """Two parallel slides make det J vanish: no theorem speaks of such an arm."""
    model = exact_model(arm("PPPRRR", [FLAT, ACROSS, *GENERAL[2:]]))
    assert THREE_SLIDES.apply(model) is None
