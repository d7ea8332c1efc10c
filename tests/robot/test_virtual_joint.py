from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from short_tables import Number, arm, shift

from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.kinematics.theorems.registry import reduction_of
from cuspaudit.robot.chain import Chain, Task
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.virtual_joint import (
    TOOL_AXES,
    with_virtual_joint,
    without_virtual_joint,
)

ROWS: tuple[tuple[Number, ...], ...] = (
    ("0.1", 1, "0.3", "0.2", "-0.4"),
    ("0.2", "0.5", 0, "0.7", "0.3"),
    (90, 40, -90, 70, 110),
)


def five(task: Task) -> Chain:
    """A general five-joint arm with a tool off its last axis."""
    return replace(arm(*ROWS), task=task, tool=(*arm(*ROWS).tool, shift("0.3", 0, 2)))


@pytest.mark.parametrize("task", TOOL_AXES)
def test_det_j_is_that_of_the_five_joints(task: Task) -> None:
    """Sign included, at each value of the virtual joint; rows are velocities."""
    chain, whole = five(task), with_virtual_joint(five(task))
    axis = [float(x) for x in TOOL_AXES[task]]
    for q in np.random.default_rng(1).uniform(-3, 3, (5, 6)):
        J = jacobian(chain, q[:5])
        assert np.linalg.det(jacobian(whole, q)) == pytest.approx(np.linalg.det(J))
        step = 1e-6 * np.eye(5)
        moved = [
            frames(chain, q[:5] + s)[-1] - frames(chain, q[:5] - s)[-1] for s in step
        ]
        sights = np.array([np.r_[m[:3, 3], m[:3, :3] @ axis] for m in moved]).T / 2e-6
        assert sights[:3] == pytest.approx(J[:3], abs=1e-8)
        # the tool axis moves as fast as the tip turns across it
        assert sights[3:].T @ sights[3:] == pytest.approx(J[3:].T @ J[3:], abs=1e-7)


def test_a_place_has_as_many_postures_as_each_of_its_poses() -> None:
    """Poses that a turn about the tool axis joins have the same five joint values."""
    solver = PostureSolver.of(with_virtual_joint(five("position-and-y-axis")))
    q = np.array([0.4, -1.1, 0.8, 0.5, 1.9])
    poses = solver.poses(np.array([np.r_[q, 0.0], np.r_[q, 2.0]]))
    first, second = (sorted(map(tuple, p[:, :5].round(6))) for p in solver.solve(poses))
    assert len(first) > 1
    assert first == second


def test_the_virtual_joint_comes_off_again() -> None:
    """The chain comes back whole; a chain with another task is left as it is."""
    for task in TOOL_AXES:
        chain = five(task)
        whole = with_virtual_joint(chain)
        assert len(whole.joints) == 6
        assert without_virtual_joint(whole) == chain
        assert exact_model(chain).chain == whole
    chain = replace(five("position-and-x-axis"), task="position")
    assert with_virtual_joint(chain) == without_virtual_joint(chain) == chain


def test_the_tool_axis_counts_as_an_axis_of_a_structure() -> None:
    """A wrist is spherical with the tool axis through it, and not beside it."""
    rows = (("0.1", 1, "0.3", 0, 0), ("0.2", "0.5", 0, 0, 0), (90, 40, 90, -90, 90))
    chain = replace(arm(*rows), task="position-and-z-axis")
    along = replace(chain, tool=(*chain.tool, shift(0, 0, "0.3")))
    beside = replace(chain, tool=(*chain.tool, shift("1e-9", 0, "0.3")))
    found = reduction_of(exact_model(along))
    assert found is not None
    assert found.kind == "spherical wrist"
    assert reduction_of(exact_model(beside)) is None
    rolled = replace(along, tool=(shift(0, 0, "0.3"),))  # joint 5 is the tool axis
    assert jacobian_determinant(exact_model(rolled)) == 0
