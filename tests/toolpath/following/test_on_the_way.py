from __future__ import annotations

from fractions import Fraction

import pytest

from cuspaudit.robot.library import open_robot
from cuspaudit.toolpath.trace import trace_path
from cuspaudit.toolpath.traced_arm import traced_arm
from cuspaudit.toolpath.waypoints import Pose, ToolPath
from tests.toolpath.traced_arms import mirror, places

#: paths of the arm of the paper on which two runs are born and die together
PATHS = (
    ((-1.978, -1.571, -2.543), (-2.26, -1.176, 1.938)),
    ((2.767, -3.009, -1.671), (1.796, -1.59, -1.757)),
    ((-0.349, -3.218, 0.086), (0.37, 0.212, 1.168)),
)
_TOOL = Fraction(1, 5)


@pytest.mark.parametrize("number", [0, pytest.param(1, marks=pytest.mark.slow), 2])
def test_births_of_an_arm_with_a_wrist_are_those_of_the_arm(number: int) -> None:
    """The arm's runs that meet neither end, proved, are met twice with a wrist."""
    ends = PATHS[number]
    exact = trace_path(mirror(), places(*ends))
    assert exact.births_complete
    wanted = [b.at for b in exact.born if b.end == "singular"]
    assert wanted
    # the wrist holds the tool upright: its centre is 0.2 below the tip
    poses = []
    for end in ends:
        x, y, z = (Fraction(str(value)) for value in end)
        turn = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))
        poses.append(Pose((x, y, z + _TOOL), turn))
    arm = traced_arm(open_robot("chablat-2022-6r").chain)
    found = trace_path(arm, ToolPath(tuple(poses)))
    assert not found.births_complete
    [remark] = found.remarks
    assert "were looked for, in floating point, at" in remark
    born = [b.at for b in found.born]
    for at in wanted:
        assert sum(abs(b - at) < 1e-6 for b in born) >= 2 * wanted.count(at)


def test_an_arm_with_slides_is_not_looked_at() -> None:
    """No solver in floating point is at hand for it, which the remark says."""
    arm = traced_arm(open_robot("adept-cobra-600").chain)
    assert arm.joints == 4
    turn = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))
    ends = [(Fraction(2, 5), Fraction(y, 10), Fraction(1, 10)) for y in (1, 2)]
    poses = tuple(Pose(end, turn) for end in ends)
    try:
        found = trace_path(arm, ToolPath(poses))
    except Exception:
        flipped = (Fraction(0), Fraction(1), Fraction(0), Fraction(0))
        poses = tuple(Pose(end, flipped) for end in ends)
        found = trace_path(arm, ToolPath(poses))
    assert "runs that are born and die on the way are not looked for" in found.remarks
