from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import pytest

from cuspaudit.kinematics.degeneracy import cause_of_degeneracy
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.regular import is_regular_somewhere
from cuspaudit.robot.chain import (
    X_AXIS,
    Angle,
    Chain,
    Joint,
    JointKind,
    Motion,
    Rotation,
    Task,
    Translation,
)

Link = tuple[float, float, float]
GENERAL: Sequence[Link] = (
    *((1, 1, 1), (2, 0.5, 1), (1, 3, 1)),
    *((2, 1, 2), (1, 0.5, 1), (1, 1, 3)),
)


def arm(
    kinds: str, links: Sequence[Link], task: Task, tool: Sequence[float] = (1, 2, 3)
) -> Chain:
    """A standard table with rows a, alpha in quarter turns, d."""
    joints = []
    before: tuple[Motion, ...] = ()
    names: dict[str, JointKind] = {"R": "revolute", "P": "prismatic"}
    for k, (kind, (a, quarters, d)) in enumerate(zip(kinds, links, strict=False), 1):
        joints.append(Joint(f"j{k}", names[kind], before))
        before = (
            Translation((Fraction(a), Fraction(0), Fraction(d))),
            Rotation(X_AXIS, Angle(Fraction(quarters) / 2)),
        )
    x, y, z = (Fraction(entry) for entry in tool)
    return Chain("arm", tuple(joints), (Translation((x, y, z)),), task)


@pytest.mark.parametrize(
    ("kinds", "links", "task", "cause"),
    [
        ("RRRRRR", [(1, 0, 1)] * 6, "pose", "all six axes are parallel"),
        ("RRR", [(1, 0, 1), (1, 2, 0), (1, 0, 0)], "position", "all three axes are"),
        ("RRRRRR", [*GENERAL[:4], (0, 0, 2), (0, 0, 0)], "pose", "axes 5 and 6 coin"),
        ("RPRRRR", [(0, 0, 1), (0, 0, 1), *GENERAL[2:]], "pose", "axes 1 and 3 coinc"),
        ("PPRRRR", [(1, 0, 1), *GENERAL[1:]], "pose", "slides 1 and 2 are parallel"),
        ("PRPRRR", [(1, 0, 1), (1, 0, 1), *GENERAL[2:]], "pose", "slides 1 and 3 are"),
        ("PPPPRR", [(0, 1, 0), (0, 0.5, 0), (0, 0.3, 0), *GENERAL[3:]], "pose", "four"),
        ("PPPRRR", [(0, 1, 0), (0, 0.5, 0), *GENERAL[2:]], "pose", "slides 1, 2, 3 st"),
        ("RRRRRR", [(1, 0, 0)] * 3 + list(GENERAL[3:]), "pose", "joints 1, 2, 3, 4 al"),
        ("RPRRRR", [(1, 1, 0)] * 2 + [(1, 0, 0)] * 4, "pose", "joints 1, 2, 3, 4, 5"),
        (
            "PRPRPR",
            [(1, 0.5, 1), (1, 0.5, 1), (1, 1.5, 1), *GENERAL[3:]],
            "pose",
            "axes 2",
        ),
        ("RRRRRR", [*GENERAL[:2], *[(0, 1, 0)] * 4], "pose", "axes 3, 4, 5, 6 meet"),
        ("RRR", [(0, 1, 0), (0, 1, 0), (1, 1, 1)], "position", "axes 1, 2, 3 meet in"),
    ],
)
def test_the_cause_is_named(
    kinds: str, links: Sequence[Link], task: Task, cause: str
) -> None:
    """Each cause is found on an arm made of it, whose det J does vanish identically."""
    model = exact_model(arm(kinds, links, task))
    assert not is_regular_somewhere(model)
    found = cause_of_degeneracy(model)
    assert found is not None
    assert found.startswith(cause)


def test_a_tip_on_the_last_axis() -> None:
    """A tip on axis 3 is not moved by joint 3; off it, it is."""
    chain = arm("RRR", GENERAL, "position", (0, 0, 2))
    assert cause_of_degeneracy(exact_model(chain)) == "the tip lies on axis 3"
    assert is_regular_somewhere(exact_model(arm("RRR", GENERAL, "position", (0, 1, 2))))


def test_a_joint_about_the_tool_axis() -> None:
    """The virtual joint of a tool axis may be one line with joint 5."""
    chain = arm("RRRRR", GENERAL, "position-and-z-axis", (0, 0, 2))
    found = cause_of_degeneracy(exact_model(chain))
    assert found == "j5 turns about the tool axis itself"
    other = replace(chain, task="position-and-x-axis")
    assert is_regular_somewhere(exact_model(other))
    assert cause_of_degeneracy(exact_model(other)) is None


@pytest.mark.parametrize("kinds", ["RRRRRR", "PRRRRR", "RPRRPR", "PPRRRR", "PRPRPR"])
def test_a_general_arm_has_no_cause(kinds: str) -> None:
    """No cause is named of an arm whose det J does not vanish."""
    model = exact_model(arm(kinds, GENERAL, "pose"))
    assert is_regular_somewhere(model)
    assert cause_of_degeneracy(model) is None
