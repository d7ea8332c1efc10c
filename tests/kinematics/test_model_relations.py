from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from short_tables import arm, degrees, shift

from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.model_relations import changed_relations
from cuspaudit.robot.chain import X_AXIS, Chain, Joint, Rotation
from cuspaudit.robot.snapping import faithful


def cancelling(*turns: str) -> Chain:
    """Axes 2 and 3 with moves between turns about x that sum to 0."""
    steps = [part for turn in turns for part in (turned(turn), shift("1/5", 0, 0))]
    joints = (
        Joint("a", "revolute"),
        Joint("b", "revolute", (shift("1/20", 0, 0), turned("-90"))),
        Joint("c", "revolute", (shift(1, 0, "3/10"), *steps)),
    )
    return Chain("cancelling", joints, (shift("9/10", 0, 0),))


def turned(text: str) -> Rotation:
    """A turn about x, in degrees."""
    return Rotation(X_AXIS, degrees(text))


def test_turns_that_cancel_lose_the_relation_in_a_product() -> None:
    """110 - 55 - 55 degrees, moves between, is 0 in the chain and not the model."""
    chain = cancelling("110", "-55", "-55")
    assert "axes 2 and 3 are parallel" in changed_relations(exact_model(chain))


def test_written_by_its_invariants_the_arm_keeps_it() -> None:
    """The same arm in other numbers has an exact model with every relation."""
    model = exact_model(faithful(cancelling("110", "-55", "-55")))
    assert changed_relations(model) == frozenset()
    assert model.is_exact


@pytest.mark.parametrize("turns", [("110", "-55", "-55"), ("20", "-10", "-10")])
def test_turns_in_a_row_add_exactly(turns: tuple[str, ...]) -> None:
    """About one direction, with nothing between them, they are no turn at all."""
    chain = arm((1, 1, 1), (0, 1, 0), (90, 0, 0), "RRR")
    joints = list(chain.joints)
    rows = tuple(turned(turn) for turn in turns)
    joints[2] = replace(joints[2], before=(*joints[2].before, *rows))
    model = exact_model(chain.with_joints(joints))
    assert model.is_exact and changed_relations(model) == frozenset()


def test_an_angle_of_no_structure_may_be_moved() -> None:
    """35 degrees between two axes becomes a rational point, and nothing is lost."""
    chain = arm((1, 1, 1), (0, 1, 0), (90, 35, 0), "RRR")
    model = exact_model(chain)
    assert not model.is_exact
    assert changed_relations(model) == frozenset()


def test_what_turns_the_base_or_a_tip_is_no_approximation() -> None:
    """A base turned by 35 degrees, a tip by 10: the arm is exact all the same."""
    chain = arm((1, 1, 1), (0, 1, 0), (90, 60, 0), "RRR")
    first = replace(chain.joints[0], before=(turned("35"),))
    turned_chain = replace(
        chain.with_joints((first, *chain.joints[1:])),
        tool=(*chain.tool, Rotation((Fraction(1),) * 3, degrees(10))),
    )
    model = exact_model(turned_chain)
    assert model.is_exact
    assert {entry.is_idle for entry in model.approximations} == {True}
