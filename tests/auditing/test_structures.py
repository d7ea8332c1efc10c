"""The structures near an audited arm, and what is said of them."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from short_tables import arm, ask, shift, with_wrist

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.auditing.structures import JudgedStructure, near_structures
from cuspaudit.cli.summary import print_summary
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.nearest.nearest_structures import nearest_structures
from cuspaudit.robot.chain import X_AXIS, Angle, Chain, Rotation
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.robot import Robot
from cuspaudit.viz import render_page

ELBOW = ((0, 2, "3/2"), (1, "1/4", 0), (90, 180, 0))
"""Axes 1, 2 meet and axes 2, 3 are parallel, as in most arms of the industry."""
CUSPIDAL = ((1, 2, "3/2"), (0, 1, 0), (90, -90, 0))


def broken(chain: Chain) -> Chain:
    """Axis 6 stands 1/1000 beside the point in which it met axes 4 and 5."""
    *joints, last = chain.joints
    aside = (shift("1/1000", 0, 0), *last.before)
    return chain.with_joints([*joints, replace(last, before=aside)])


def near(chain: Chain) -> dict[str, JudgedStructure]:
    """The structures near a chain, by name."""
    return {found.name: found for found in near_structures(ask(chain))}


def test_a_broken_wrist_has_the_verdict_of_the_whole_one() -> None:
    """A hair beside a noncuspidal arm: undecided itself, and the hair is named."""
    chain = with_wrist(arm(*ELBOW))
    whole, found = ask(chain), near(broken(chain))
    assert ask(broken(chain)).verdict is Verdict.UNDECIDED
    wrist = found["spherical wrist"]
    assert wrist.length == pytest.approx(0.001)
    assert wrist.verdict is whole.verdict is Verdict.NONCUSPIDAL
    assert whole.aspects is not None
    assert wrist.aspects == whole.aspects.count == 8


def test_a_wrist_on_other_joints_is_decided_by_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Where no theorem settles the three joints, Algorithm 1 does, or time is up."""
    chain = with_wrist(arm(*CUSPIDAL))
    whole = ask(chain)
    assert whole.verdict is Verdict.CUSPIDAL
    wrist = near(broken(chain))["spherical wrist"]
    assert wrist.verdict is Verdict.CUSPIDAL
    assert whole.aspects is not None
    assert wrist.aspects == whole.aspects.count
    monkeypatch.setattr("cuspaudit.auditing.structures._SECONDS", 0.0)
    assert near(broken(chain))["spherical wrist"].verdict is None


@pytest.mark.parametrize(
    "name", ["ur5", "puma-560", "chablat-2022-3r", "baili-2004-wt1", "ur3"]
)
def test_verdicts_are_those_of_the_engine(name: str) -> None:
    """The exact answer for each nearest arm agrees in verdict and aspects."""
    calibrated = arm(
        (0, "-0.24", "-0.18", 0, 0, 0),
        ("0.15", "0.01", 0, "0.11", "0.085", "0.08"),
        (90, "1/10", "1/10", 90, -90, 0),
    )
    chain = calibrated if name == "ur3" else open_robot(name).chain
    answered = ask(chain)
    judged = {found.name: found for found in near_structures(answered)}
    for found in nearest_structures(answered.model):
        own = ask(found.model.chain)
        if judged[found.name].verdict is not None:
            assert judged[found.name].verdict is own.verdict
        if judged[found.name].aspects is not None and own.aspects is not None:
            assert judged[found.name].aspects == own.aspects.count


def test_an_audit_names_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    """JSON, terminal and page say how far, and what would follow."""
    found = audit(open_robot("chablat-2022-3r"), Options())
    record = found.record()
    sizes = [entry["angle"] for entry in record["structures"]]
    assert sizes == sorted(sizes)
    assert {entry["verdict"] for entry in record["structures"]} == {"noncuspidal"}
    print_summary(record, {})
    said = " ".join(capsys.readouterr().out.split())
    assert "an arm with axes 1 and 2 meeting is 888 mm and 11 deg away" in said
    page = render_page(record)
    assert "Nearest structures" in page
    assert "axis 2 by 888 mm and 11 deg" in page


def test_tasks_without_patterns_have_no_structures() -> None:
    """Four joints with an angle: null in the JSON, no card, no line."""
    found = audit(open_robot("adept-cobra-600"), Options())
    assert exact_model(found.chain).chain.task == "position-and-angle"
    assert found.record()["structures"] is None
    assert "Nearest structures" not in render_page(found.record())


def printed(chain: Chain, quarter: str) -> Robot:
    """The robot of a chain whose quarter turns are printed in rad."""
    turns = {
        Angle(Fraction(sign, 2)): Angle(radians=sign * Fraction(quarter))
        for sign in (1, -1)
    }
    joints = [
        replace(
            joint,
            before=tuple(
                replace(motion, angle=turns.get(motion.angle, motion.angle))
                if isinstance(motion, Rotation)
                else motion
                for motion in joint.before
            ),
        )
        for joint in chain.joints
    ]
    return Robot("printed", "printed.urdf", chain.with_joints(joints))


def test_a_structure_that_needs_no_rounding_decides_the_literal_numbers() -> None:
    """1.5708 is no right angle, but the wrist and the parallel axes need none."""
    found = audit(printed(with_wrist(arm(*ELBOW)), "1.5708"), Options())
    assert found.verdict is found.literal is Verdict.NONCUSPIDAL
    assert not exact_model(found.robot.chain).is_exact
    assert found.record()["literal_why"] is None


def test_undecided_numbers_name_what_they_are_near_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Two turns of 1.5708 that bring axis 3 back to axis 2 miss by 7.3 microradians.

    So the arm has a cusp, which decides it; where none is met it stays undecided.
    """
    where = "cuspaudit.auditing.cusp_witness.find_cusps"
    monkeypatch.setattr(where, lambda *args, **options: iter(()))
    chain = with_wrist(arm((1, 2, "3/2"), (0, 1, "1/3"), (90, 60, 0)))
    nearly = chain.joints[2].before[:-1]
    quarter = Rotation(X_AXIS, Angle(radians=Fraction("1.5708")))
    third = replace(chain.joints[2], before=(*nearly, quarter, quarter))
    robot = Robot(
        "nearly",
        "nearly.urdf",
        chain.with_joints([*chain.joints[:2], third, *chain.joints[3:]]),
    )
    found = audit(robot, Options())
    assert found.literal is Verdict.UNDECIDED
    assert found.why_literal == "0.0073 mrad from a triple and pair, noncuspidal"


@pytest.mark.parametrize(("turn", "holds"), [("1.5708", True), ("1e-13", False)])
def test_only_what_the_numbers_have_holds(turn: str, holds: bool) -> None:
    """A model within 1e-12 may have parallel axes where the numbers have none."""
    bent = Rotation(X_AXIS, Angle(radians=Fraction(turn)))
    chain = with_wrist(arm((1, 2, "3/2"), (0, 1, "1/3"), (90, 180, 0)))
    joints = list(chain.joints)
    number = 1 if holds else 2
    before = (*joints[number].before, bent)
    joints[number] = replace(joints[number], before=before)
    model = exact_model(chain.with_joints(joints))
    assert not model.is_exact
    assert {s.name for s in nearest_structures(model) if s.holds} >= {"triple and pair"}
    found = near(model.chain)
    assert found["triple and pair"].length == found["triple and pair"].angle == 0
    assert found["spherical wrist"].holds is holds
    assert found["triple and pair"].holds is False or holds
    assert found["spherical wrist"].verdict is Verdict.NONCUSPIDAL
