"""The box of joint limits on the planes of a figure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from short_tables import arm, ask, degrees

from cuspaudit.pictures.figures import figures
from cuspaudit.pictures.joint_surface import JointSurface
from cuspaudit.pictures.limit_lines import limit_sides
from cuspaudit.robot.chain import Chain

ISSAC = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))


def limited() -> Chain:
    """Joint 2 within limits, joint 3 without."""
    joints = list(ISSAC.joints)
    joints[1] = replace(joints[1], limits=(degrees(-100), degrees(200)))
    return ISSAC.with_joints(joints)


def test_each_limit_has_a_side_and_an_image() -> None:
    """Two sides for one limited joint, at its limits modulo a turn; none without."""
    found = ask(limited())
    assert found.decision is not None
    surface = JointSurface(found.decision, found.model)
    sides = [surface.joint_values(points) for points in limit_sides(surface)]
    assert [np.unique(side[:, 0]).tolist() for side in sides] == [
        [np.radians(-100)],
        [np.radians(200)],
    ]
    drawn = figures(found)
    places = sorted({round(float(np.degrees(c[0, 0]))) for c in drawn.joint.limits})
    assert places == [-160, -100]
    assert len(drawn.value.limits) == 2
    assert np.isfinite(drawn.value.limits[0]).all()
    free = figures(ask(ISSAC))
    assert free.joint.limits == free.value.limits == ()
