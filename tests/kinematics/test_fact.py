"""Facts of a model are computed once."""

from __future__ import annotations

import pytest
from short_tables import arm

from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.fact import fact


class Owner:
    """Something that has facts."""


def test_a_fact_is_computed_once_for_each_owner() -> None:
    """The function runs once an owner, and two facts of one owner stay apart."""
    asked: list[Owner] = []

    @fact
    def number(owner: Owner) -> int:
        asked.append(owner)
        return len(asked)

    @fact
    def word(owner: Owner) -> str:
        return "word"

    first, second = Owner(), Owner()
    assert [number(first), number(first), number(second)] == [1, 1, 2]
    assert word(first) == "word"
    assert asked == [first, second]


def test_what_is_raised_is_not_kept() -> None:
    """A fact that failed once may be asked again."""
    tries: list[int] = []

    @fact
    def late(owner: Owner) -> int:
        tries.append(1)
        if len(tries) == 1:
            raise ValueError
        return 7

    owner = Owner()
    with pytest.raises(ValueError):
        late(owner)
    assert late(owner) == 7


def test_det_j_is_asked_once_of_a_model() -> None:
    """The determinant of one model is one object, of an equal model another."""
    chain = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
    model, other = exact_model(chain), exact_model(chain)
    assert jacobian_determinant(model) is jacobian_determinant(model)
    assert jacobian_determinant(model) is not jacobian_determinant(other)
    assert jacobian_determinant(model) == jacobian_determinant(other)
