from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq

from cuspaudit.audit.aspects import count_aspects
from cuspaudit.audit.library import open_robot
from cuspaudit.audit.pigeonhole import crowded_aspects, postures_by_aspect
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import ExactModel, exact_model


def model_of(name: str) -> ExactModel:
    """The exact model of a robot of the library."""
    return exact_model(open_robot(name).chain)


def poses(count: int, seed: int) -> list[tuple[fmpq, ...]]:
    """Rational postures, one a pose."""
    numbers = np.random.default_rng(seed).integers(-30, 31, (count, 6))
    return [tuple(fmpq(int(x), 13) for x in row) for row in numbers]


@pytest.mark.parametrize("name", ["fanuc-crx-10ia-l", "abb-gofa-5", "ufactory-xarm6"])
def test_cobots_crowd_an_aspect(name: str) -> None:
    """More than two postures of one pose in two aspects: cuspidal, without a path."""
    model = model_of(name)
    count = count_aspects(model)
    assert count is not None
    for tangents in poses(6, 1):
        found = postures_by_aspect(model, tangents)
        sizes = sorted(len(here) for here in found.values())
        # over a regular value as many postures have det J > 0 as < 0
        assert len(set(sizes)) == 1
        if sum(sizes) > count.count:
            assert crowded_aspects(found)
            return
    pytest.fail("no pose with more than two postures")


def test_no_aspect_of_a_ur5_holds_two_postures_of_a_pose() -> None:
    """The eight signs tell the postures apart: the theorem of the UR pattern."""
    model, most = model_of("ur5"), 0
    for tangents in poses(4, 2):
        found = postures_by_aspect(model, tangents)
        assert crowded_aspects(found) == {}
        most = max(most, len(found))
    assert most >= 4


def test_unproved_aspects_are_no_ground() -> None:
    """Without a count of aspects nothing is said."""
    with pytest.raises(UnableError):
        postures_by_aspect(model_of("hyperplane-6r"), poses(1, 0)[0])
