"""Small boxes of six joints in which no pose has two postures in one aspect."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from flint import arb
from short_tables import arm

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.cusp_witness import find_cusps
from cuspaudit.auditing.limits.joint_limits import outer_limits
from cuspaudit.auditing.limits.pairs_apart import pairs_apart
from cuspaudit.auditing.limits.within_limits import within_limits
from cuspaudit.auditing.proofs.certified_robot import certified_robot
from cuspaudit.certificate import CuspCertificate
from cuspaudit.certificate.arm import arm_from_certificate
from cuspaudit.certificate.balls import working_precision
from cuspaudit.certificate.pairs.boxes_apart import (
    Ends,
    Search,
    functions_of_pose,
    halved,
)
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.robot.chain import Angle, Chain
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.library import open_robot
from cuspaudit.runtime.clock import Clock

CRX = open_robot("fanuc-crx-10ia-l").chain
REGULAR = (0.8, -0.1, 0.2, -0.5, 1.4, -0.3)
SLIDES = arm((1, 2, 1, 1, 0, 1), (0, 1, 0, 2, 1, 0), (90, 60, 90, -90, 90, 0), "RPRRRR")


def about(chain: Chain, posture: Sequence[float], width: float) -> Chain:
    """The chain with every joint limited to a range about a posture."""
    half, joints = Fraction(str(width)) / 2, []
    for joint, value in zip(chain.joints, posture, strict=True):
        middle = Fraction(str(round(value, 6)))
        ends: tuple[Fraction, Fraction] = (middle - half, middle + half)
        limits = tuple(map(Angle, (0, 0), ends)) if joint.kind == "revolute" else ends
        joints.append(replace(joint, limits=limits))
    return chain.with_joints(joints)


def model_about(width: float) -> ExactModel:
    """A box of the CRX about a regular posture."""
    return exact_model(about(CRX, REGULAR, width))


def test_a_small_box_is_told_apart() -> None:
    """One look is enough: the pose tells the joint values apart."""
    found = pairs_apart(model_about(0.05))
    assert found is not None
    assert (found.pairs, found.injective) == (1, 1)


def test_halves_of_pairs_hold_every_pair_of_points() -> None:
    """In one order or the other, whether the two boxes are one or not."""
    rng = np.random.default_rng(5)
    box = ((Fraction(0), Fraction(2)), (Fraction(0), Fraction(1)))
    other = ((Fraction(2), Fraction(3)), (Fraction(0), Fraction(3)))

    def holds(part: Ends, point: np.ndarray) -> bool:
        return all(a <= x <= b for (a, b), x in zip(part, point, strict=True))

    for pair in ((box, box), (box, other)):
        for _ in range(50):
            p, q = (
                np.array([rng.uniform(float(a), float(b)) for a, b in part])
                for part in pair
            )
            assert any(
                (holds(a, p) and holds(b, q)) or (holds(a, q) and holds(b, p))
                for a, b in halved(*pair)
            )


def test_opposite_signs_part_a_box_from_another() -> None:
    """Where det J has one sign on A and the other on A', no aspect meets both."""
    flat = list(REGULAR)
    certificate = CuspCertificate(
        **certified_robot(CRX), limits=None, posture=(Fraction(0),) * 6
    )
    search = Search(certificate, lambda box: (), 50)
    down = [-q for q in flat]
    ends = [
        tuple(pair for pair in outer_limits(about(CRX, q, 0.02))[1:5] if pair)
        for q in (flat, down)
    ]
    with working_precision(64, 2):
        signs = [search.look(box).signs[0] for box in ends]
        ground = search.ground(*ends)
    assert 0 not in signs
    assert ground == ("signs" if signs[0] != signs[1] else "apart")


def test_a_box_with_a_cusp_is_never_told_apart() -> None:
    """Next to a cusp there are postures of one pose in one aspect."""
    cusp = next(find_cusps(CRX, 0, inside=False))
    for width in (0.1, 0.001):
        assert pairs_apart(exact_model(about(CRX, cusp.posture, width))) is None


def test_a_box_across_a_fold_is_not_told_apart() -> None:
    """On both sides of {det J = 0} there are two postures of one pose: of two signs.

    So signs settle pairs far from it, but none of those near it.
    """
    first, last = np.array(REGULAR), np.array(REGULAR)
    last[4] = -1.4
    up = np.linalg.det(jacobian(CRX, first)) > 0
    for _ in range(40):
        middle = (first + last) / 2
        if (np.linalg.det(jacobian(CRX, middle)) > 0) == up:
            first = middle
        else:
            last = middle
    assert abs(first[4] - last[4]) < 1e-9
    assert pairs_apart(exact_model(about(CRX, first.tolist(), 0.02)), looks=100) is None


def test_joints_without_limits_are_not_told_apart() -> None:
    """A joint between that has no limits goes round."""
    joints = list(model_about(0.05).chain.joints)
    joints[2] = replace(joints[2], limits=None)
    assert pairs_apart(exact_model(CRX.with_joints(joints))) is None


def test_a_slide_between_is_a_joint_like_others() -> None:
    """Its derivative is a velocity alone."""
    posture = (-0.1, 1.3, -1.5, 1.2, -0.2, -1.4)
    found = pairs_apart(exact_model(about(SLIDES, posture, 0.02)))
    assert found is not None


def test_the_verdict_within_limits_says_so() -> None:
    """Noncuspidal within limits, of a cuspidal arm, whatever joint 1 may do."""
    joints = list(about(CRX, REGULAR, 0.05).joints)
    joints[0] = replace(joints[0], limits=None)
    chain = CRX.with_joints(joints)
    cuspidal = Answer(exact_model(chain), Verdict.CUSPIDAL, "")
    found = within_limits(cuspidal, chain, 0, Clock())
    assert found is not None
    assert found.verdict is Verdict.NONCUSPIDAL
    assert found.kind == "apart"
    assert "joint values apart" in found.why


@pytest.mark.parametrize("chain", [CRX, SLIDES], ids=["turns", "slide"])
def test_the_functions_and_their_derivative(chain: Chain) -> None:
    """The pose fixes f up to joints 1 and 6; D is its derivative, by differences."""
    certificate = CuspCertificate(
        **certified_robot(chain), limits=None, posture=(Fraction(0),) * 6
    )
    arms = arm_from_certificate(certificate, lambda ball: ball)

    def values(q: np.ndarray) -> np.ndarray:
        return np.array(
            [float(v.mid()) for v in functions_of_pose(arms, [*map(arb, q)])[0] if v]
        )

    q = np.array([0.3, 0.7, -0.4, 0.5])
    rows = functions_of_pose(arms, [*map(arb, q)])[1]
    slope = np.array([[0.0 if e is None else float(e.mid()) for e in r] for r in rows])
    step = 1e-6
    for k in range(4):
        e = step * np.eye(4)[k]
        difference = (values(q + e) - values(q - e)) / (2 * step)
        assert slope[:, k] == pytest.approx(difference, abs=1e-7)
    # the distance of the two fixed points does not depend on joints 1 and 6
    first, last = (frames(chain, np.r_[a, q, b]) for a, b in ((0.0, 0.0), (1.0, 2.0)))
    for placed in (first, last):
        away = placed[5, :3, 3] - placed[0, :3, 3]
        assert values(q)[4] == pytest.approx(away @ away)
