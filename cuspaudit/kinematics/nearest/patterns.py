"""The structures that theorems ask for, as relations between axes in a row.

A pattern has one or more ways, each a list of relations that can be met one by one: an
axis belongs to two links, and its place in each is free. Whether an arm has the
structure is asked of the theorem itself, on its exact model.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Literal

from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.neighbors import concurrent, coplanar, orthogonal, parallel
from cuspaudit.kinematics.theorems.registry import reduction_of
from cuspaudit.kinematics.theorems.triple_and_pair import PLACES, triple_and_pair
from cuspaudit.robot.chain import Chain, reverse

__all__ = ["Pattern", "Relation", "Way", "patterns_for"]


@dataclass(frozen=True)
class Relation:
    """How axes from number ``first`` on stand to each other; two, or three that meet.

    Attributes:
        kind: which relation.
        first: the number of the first axis, from 1.
    """

    kind: Literal["parallel", "meet", "meet at right angles", "meet in one point"]
    first: int

    def holds(self, model: ExactModel) -> bool:
        """Whether it does, tested exactly."""
        return _TESTS[self.kind](model, self.first)

    def __str__(self) -> str:
        count = 3 if self.kind == "meet in one point" else 2
        numbers = ", ".join(str(self.first + i) for i in range(count))
        verb = "are " if self.kind == "parallel" else ""
        return f"axes {numbers} {verb}{self.kind}"


Way = tuple[Relation, ...]


@dataclass(frozen=True)
class Pattern:
    """A structure that a theorem asks for.

    Attributes:
        name: of the structure.
        turning: the numbers of the joints that have to turn.
        ways: how axes may stand to have it.
        holds: the theorem's own test of an exact model.
    """

    name: str
    turning: tuple[int, ...]
    ways: tuple[Way, ...]
    holds: Callable[[ExactModel], bool]


def patterns_for(chain: Chain) -> tuple[Pattern, ...]:
    """The patterns of theorems on arms with the joints and the task of ``chain``."""
    patterns = {("position", 3): _THREE, ("pose", 6): _SIX}.get(
        (chain.task, len(chain.joints)), ()
    )
    return tuple(
        pattern
        for pattern in patterns
        if all(chain.kinds[k - 1] == "revolute" for k in pattern.turning)
    )


def _has(kind: str) -> Callable[[ExactModel], bool]:
    def test(model: ExactModel) -> bool:
        found = reduction_of(model)
        return found is not None and found.kind == kind

    return test


def _meet_at_right_angles(model: ExactModel, first: int) -> bool:
    return orthogonal(model, first) and coplanar(model, first)


_TESTS: dict[str, Callable[[ExactModel, int], bool]] = {
    "parallel": parallel,
    "meet": coplanar,
    "meet at right angles": _meet_at_right_angles,
    "meet in one point": concurrent,
}


def _has_shoulder(model: ExactModel) -> bool:
    return _has("spherical wrist")(exact_model(reverse(model.chain)))


def _has_triple_and_pair(model: ExactModel) -> bool:
    return triple_and_pair(model) is not None


def _triple(first: int) -> tuple[Way, ...]:
    """Three axes in a row that are parallel, or meet in one point."""
    level = (Relation("parallel", first), Relation("parallel", first + 1))
    return (level, (Relation("meet in one point", first),))


def _pair(first: int) -> tuple[Way, ...]:
    """Two axes in a row that are parallel, or meet."""
    return ((Relation("parallel", first),), (Relation("meet", first),))


_SIX = (
    Pattern(
        "spherical wrist",
        (4, 5, 6),
        ((Relation("meet in one point", 4),),),
        _has("spherical wrist"),
    ),
    Pattern(
        "spherical shoulder",
        (1, 2, 3),
        ((Relation("meet in one point", 1),),),
        _has_shoulder,
    ),
    Pattern(
        "UR pattern",
        (1, 2, 3, 4, 5, 6),
        (
            (
                *(Relation("parallel", k) for k in (2, 3)),
                *(Relation("meet at right angles", k) for k in (1, 4, 5)),
            ),
        ),
        _has("UR pattern"),
    ),
    Pattern(
        "triple and pair",
        (1, 2, 3, 4, 5, 6),
        tuple(
            triple + pair
            for first, other in PLACES
            for triple, pair in product(_triple(first), _pair(other))
        ),
        _has_triple_and_pair,
    ),
)
_THREE = tuple(
    Pattern(f"axes {k} and {k + 1} {word}", (1, 2, 3), ((relation,),), relation.holds)
    for k in (1, 2)
    for word, relation in (
        ("parallel", Relation("parallel", k)),
        ("meeting", Relation("meet", k)),
    )
)
"""For these the theorem is `neighbouring_axes`."""
