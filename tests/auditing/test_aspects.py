from __future__ import annotations

from collections.abc import Sequence

import pytest
from flint import arb
from short_tables import Number, arm

from cuspaudit.auditing.aspects import aspect_components, count_aspects
from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.robot.frames import angle_value
from cuspaudit.robot.library import open_robot

#: joints 2 to 5 of the twelve postures of the published pose [ICRA 2023, Table II]
JACO = (
    (1.05450, 1.30900, 2.42830, -1.23050),
    (0.09297, 1.57408, 1.43182, 2.34534),
    (3.04143, 1.57216, -1.59045, 2.16270),
    (0.28231, 1.92961, -2.16549, -2.96869),
    (2.03455, 1.86318, -0.58325, -1.09163),
    (2.81569, 1.30914, 0.48764, -2.83014),
    (0.70844, 1.49023, 2.61999, -1.96327),
    (0.09372, 2.02818, -1.49133, -2.42332),
    (2.70257, 1.46997, -0.06557, -2.54026),
    (1.93979, 2.02688, -1.42654, 0.62083),
    (3.04714, 1.11338, 1.51051, -2.26879),
    (1.20237, 1.11478, 1.58443, 0.60253),
)


def model_of(name: str) -> ExactModel:
    """The exact model of a robot of the library."""
    return exact_model(open_robot(name).chain)


def label(model: ExactModel, posture: Sequence[float]) -> tuple[int, ...] | None:
    """The aspect of a posture in floating point."""
    values: dict[str, arb] = {}
    for joint, angle in zip(model.joints, posture, strict=True):
        c, s = joint.variables
        turned = arb(angle + angle_value(joint.zero))
        values |= {c: turned.cos(), s: turned.sin()}
    return aspect_components(model).component(values)


def test_the_audit_reports_the_aspects_of_a_crx_as_proved() -> None:
    """The answer carries the count, whatever its verdict."""
    model = model_of("fanuc-crx-10ia-l")
    count = answer(model).aspects
    assert count is not None
    assert (count.count, count.proved) == (2, True)


def test_the_count_of_a_wrist_arm_is_that_of_its_reduction() -> None:
    """Two exact routes: twice the regional aspects, and the theorem on the torus."""
    for name in ("puma-560", "abb-irb-120"):
        model = model_of(name)
        assert count_aspects(model) == answer(model).aspects


@pytest.mark.parametrize("a1", [0, "0.2", 2])
def test_three_joints_with_parallel_axes(a1: Number) -> None:
    """A 3R arm with axes 2 and 3 parallel: the 3R engine agrees where a1 = 0."""
    model = exact_model(arm((a1, 1, "0.9"), (0, "0.3", 0), (-90, 0, 0)))
    count = count_aspects(model)
    assert (count == answer(model).aspects) if a1 == 0 else (count is None)


def test_the_published_postures_of_one_pose_share_two_aspects() -> None:
    """JACO: twelve postures of one pose, six in each of its two aspects."""
    model = model_of("kinova-jaco-gen2")
    labels = [label(model, [0, *posture, 0]) for posture in JACO]
    assert labels == labels[:1] * 6 + labels[-1:] * 6
    assert labels[0] != labels[-1]


def test_a_general_arm_is_refused() -> None:
    """Without parallel axes det J is linear along no circle; no count is claimed."""
    model = model_of("raghavan-roth")
    assert count_aspects(model) is None
    with pytest.raises(UnableError, match="linear along no circle"):
        aspect_components(model)


def test_a_cover_out_of_time_is_no_count() -> None:
    """No number is claimed when the time is up."""
    assert count_aspects(model_of("raghavan-roth"), 0.0) is None


@pytest.mark.slow
def test_a_time_limit_is_used_to_count_the_aspects_of_a_general_arm() -> None:
    """The audit of an arm that no theorem covers counts by covers, if given time."""
    robot = open_robot("hyperplane-6r")
    record = audit(robot, Options(timeout=300)).record()
    assert record["aspects"] == {"count": 2, "proved": True}
    assert record["seconds"]["aspects"] > 0
