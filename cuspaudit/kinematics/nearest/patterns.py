"""The structures that theorems ask for, as relations between axes in a row.

A pattern has one or more ways, each a list of relations that can be met one by one: an
axis belongs to two links, and its place in each is free. Whether an arm has the
structure is asked of the theorem itself, on its exact model.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import groupby, product

from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.neighbors import concurrent, coplanar, orthogonal, parallel
from cuspaudit.kinematics.theorems.neighbouring_axes import NEIGHBOURING_AXES
from cuspaudit.kinematics.theorems.spherical_shoulder import SPHERICAL_SHOULDER
from cuspaudit.kinematics.theorems.spherical_wrist import SPHERICAL_WRIST
from cuspaudit.kinematics.theorems.theorem import Theorem
from cuspaudit.kinematics.theorems.triple_and_pair import PLACES, TRIPLE_AND_PAIR
from cuspaudit.kinematics.theorems.ur_pattern import UR_PATTERN
from cuspaudit.robot.chain import Chain

__all__ = ["AxisRelation", "Pattern", "Way", "patterns_for", "way_words"]


@dataclass(frozen=True)
class AxisRelation:
    """How axes from number ``first`` on stand to each other; two, or three that meet.

    Attributes:
        kind: which relation.
        first: the number of the first axis, from 1.
    """

    kind: str
    first: int

    def holds(self, model: ExactModel) -> bool:
        """Whether it does, tested exactly."""
        return _TESTS[self.kind](model, self.first)

    @property
    def axes(self) -> tuple[int, ...]:
        """The numbers of the axes."""
        count = 3 if self.kind == "meet in one point" else 2
        return tuple(range(self.first, self.first + count))


Way = tuple[AxisRelation, ...]


@dataclass(frozen=True)
class Pattern:
    """A structure that a theorem asks for.

    Attributes:
        theorem: which one.
        ways: how axes may stand to have the structure.
    """

    theorem: Theorem
    ways: tuple[Way, ...]


def patterns_for(chain: Chain) -> tuple[Pattern, ...]:
    """The patterns of theorems on arms with the joints and the task of ``chain``."""
    return tuple(each for each in _PATTERNS if each.theorem.speaks_of(chain))


def way_words(way: Way) -> str:
    """How the axes stand, those of one kind together.

    >>> way_words((AxisRelation("parallel", 2), AxisRelation("parallel", 3)))
    'axes 2, 3, 4 are parallel'
    >>> way_words((AxisRelation("meet", 1), AxisRelation("meet", 5)))
    'axes 1-2, 5-6 meet'
    """
    parts = []
    for kind, same in groupby(way, key=lambda relation: relation.kind):
        runs: list[tuple[int, ...]] = []
        for relation in same:
            if kind == "parallel" and runs and runs[-1][-1] == relation.first:
                runs[-1] += relation.axes[1:]
            else:
                runs.append(relation.axes)
        between = ", " if len(runs) == 1 else "-"
        axes = ", ".join(between.join(map(str, run)) for run in runs)
        parts.append(f"axes {axes} {'are ' * (kind == 'parallel')}{kind}")
    return "; ".join(parts)


def _meet_at_right_angles(model: ExactModel, first: int) -> bool:
    return orthogonal(model, first) and coplanar(model, first)


_TESTS: dict[str, Callable[[ExactModel, int], bool]] = {
    "parallel": parallel,
    "meet": coplanar,
    "meet at right angles": _meet_at_right_angles,
    "meet in one point": concurrent,
}


def _triple(first: int) -> tuple[Way, ...]:
    """Three axes in a row that are parallel, or meet in one point."""
    level = (AxisRelation("parallel", first), AxisRelation("parallel", first + 1))
    return (level, (AxisRelation("meet in one point", first),))


def _pair(first: int) -> tuple[Way, ...]:
    """Two axes in a row that are parallel, or meet."""
    return ((AxisRelation("parallel", first),), (AxisRelation("meet", first),))


_PATTERNS = (
    Pattern(SPHERICAL_WRIST, ((AxisRelation("meet in one point", 4),),)),
    Pattern(SPHERICAL_SHOULDER, ((AxisRelation("meet in one point", 1),),)),
    Pattern(
        UR_PATTERN,
        (
            (
                *(AxisRelation("parallel", k) for k in (2, 3)),
                *(AxisRelation("meet at right angles", k) for k in (1, 4, 5)),
            ),
        ),
    ),
    Pattern(
        TRIPLE_AND_PAIR,
        tuple(
            triple + pair
            for first, other in PLACES
            for triple, pair in product(_triple(first), _pair(other))
        ),
    ),
    *(
        Pattern(theorem, ((AxisRelation(kind, first),),))
        for (first, kind), theorem in NEIGHBOURING_AXES.items()
    ),
)
