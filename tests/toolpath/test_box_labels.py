from __future__ import annotations

from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy import ndimage

from cuspaudit.auditing.search.cusps import TaskMap
from cuspaudit.robot.chain import Angle
from cuspaudit.toolpath.aspect_labels import aspect_labels
from cuspaudit.toolpath.box_labels import box_labels
from cuspaudit.toolpath.joint_pose import value_balls
from cuspaudit.toolpath.same_aspect import same_aspect
from cuspaudit.toolpath.traced_arm import TracedArm, traced_arm
from tests.toolpath.traced_arms import table_arm

_ARMS: Any = (
    ([1, 2, "1.5"], [0, 1, 0], ["-1/2", "1/2", "0"]),
    ([1, "1.3", "0.8"], [0, "0.4", 0], ["1/2", "-1/2", "0"]),
    (["0.3", 1, "0.9"], [0, "0.2", 0], ["1/3", "1/2", "0"]),
)
_BOXES = (
    (None, ("-2.5", "1.2"), ("-1.3", "2.9")),
    (("-1", "1"), ("-0.4", "4"), ("-2.8", "3.4")),
    (("-1", "1"), ("-4.5", "2.5"), ("0.3", "2")),
    (None, ("-0.7", "7.5"), ("-3.9", "-0.4")),
)


def limited_arm(arm: int, box: int) -> TracedArm:
    """An arm of three joints with limits in rad."""
    limits: Any = [
        None if pair is None else tuple(Angle(radians=Fraction(x)) for x in pair)
        for pair in _BOXES[box]
    ]
    return traced_arm(table_arm(*_ARMS[arm], limits))


class Grid:
    """The components of {det J != 0} in a box, by a flood over a fine grid."""

    def __init__(self, arm: TracedArm, box: int, size: int = 500) -> None:
        pairs: Any = _BOXES[box][1:]
        self.lines = [np.linspace(float(a), float(b), size) for a, b in pairs]
        second, third = np.meshgrid(*self.lines, indexing="ij")
        q = np.stack([0 * second, second, third], -1).reshape(-1, 3)
        _, v = TaskMap(arm.robot_chain).columns(q)
        self.values = np.linalg.det(v).reshape(size, size)
        slope = max(np.abs(np.diff(self.values, axis=k)).max() for k in (0, 1))
        # neighbours with more than a step of height have no zero between them
        self.sure = [ndimage.label(s * self.values > slope)[0] for s in (1, -1)]
        self.most = [ndimage.label(s * self.values > -slope)[0] for s in (1, -1)]
        self.slope = slope

    def joined(self, p: tuple[int, int], q: tuple[int, int]) -> bool | None:
        """Whether two grid points of one sign are joined; None where not certain."""
        k = 0 if self.values[p] > 0 else 1
        if self.sure[k][p] and self.sure[k][p] == self.sure[k][q]:
            return True
        return False if self.most[k][p] != self.most[k][q] else None

    def exact(self, p: tuple[int, int]) -> tuple[Angle, ...]:
        """The joint values of a grid point."""
        return tuple(
            Angle(radians=Fraction(str(float(x))))
            for x in (0.5, self.lines[0][p[0]], self.lines[1][p[1]])
        )


_FAST = {(0, 0), (1, 3), (2, 1), (0, 2)}


@pytest.mark.parametrize(
    ("arm", "box"),
    [
        pytest.param(a, b, marks=[] if (a, b) in _FAST else pytest.mark.slow)
        for a, b in product(range(len(_ARMS)), range(len(_BOXES)))
    ],
)
def test_labels_are_those_of_a_flood_over_a_grid(arm: int, box: int) -> None:
    """Of random pairs of one sign: one label where joined, two where not."""
    limited = limited_arm(arm, box)
    grid, labels = Grid(limited, box), box_labels(limited)
    assert labels is not None
    rng, told = np.random.default_rng(arm + 10 * box), {True: 0, False: 0}
    for _ in range(40):
        p, q = (tuple(int(x) for x in rng.integers(5, 495, 2)) for _ in range(2))
        if grid.values[p] * grid.values[q] <= 0:
            continue
        truth = grid.joined(p, q)
        if truth is None:
            continue
        for inside in (False, True):
            names = {labels.label(grid.exact(x), inside=inside) for x in (p, q)}
            assert None not in names
            assert (len(names) == 1) == truth
        told[truth] += 1
    assert sum(told.values()) > 5


def test_same_within_limits_says_no_where_the_box_cuts_an_aspect() -> None:
    """One aspect without limits, two within them; and yes where they leave a way."""
    limited = limited_arm(2, 1)
    grid = Grid(limited, 1)
    rng, met, free = np.random.default_rng(5), set(), aspect_labels(limited)
    assert free is not None
    for _ in range(200):
        p, q = (tuple(int(x) for x in rng.integers(5, 495, 2)) for _ in range(2))
        truth = grid.joined(p, q)
        if grid.values[p] * grid.values[q] <= 0 or truth is None or truth in met:
            continue
        first, second = grid.exact(p), grid.exact(q)
        names = {free.label(value_balls(values)) for values in (first, second)}
        if len(names) > 1 or None in names:
            continue
        met.add(truth)
        found = same_aspect(limited, first, second, within_limits=True)
        assert found.answer == ("same" if truth else "different")
        if not truth:
            assert "within the limits" in found.why
    assert met == {True, False}


def test_windings_are_told_apart() -> None:
    """A turn of joint 2 within a long range leads to another posture of the box."""
    limited = limited_arm(0, 3)
    labels = box_labels(limited)
    assert labels is not None
    here = [Angle(radians=Fraction(x)) for x in ("0", "0.3", "-2")]
    there = [here[0], here[1] + Angle(Fraction(2)), here[2]]
    outside = [here[0], here[1] + Angle(Fraction(4)), here[2]]
    assert labels.label(here, inside=False) is not None
    assert labels.label(there, inside=False) is not None
    assert labels.label(outside, inside=False) is None


def test_only_exact_arms_of_three_joints_have_labels() -> None:
    """Without limits, and for other tasks, there is no box."""
    assert box_labels(traced_arm(table_arm(*_ARMS[0]))) is None
