"""The ways to a verdict, in the order in which they are tried.

Each is a function of the case and the clock. It returns None where it has nothing to
say, and else the answer so far: built from `Case.so_far`, with what it found. To add
one: a file beside this one, and a line here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.by_pairs import by_pair_maxima
from cuspaudit.auditing.deciders.by_pigeonhole import by_pigeonhole
from cuspaudit.auditing.deciders.by_search import by_search
from cuspaudit.auditing.deciders.by_theorem import by_theorem
from cuspaudit.auditing.deciders.certify import by_couple
from cuspaudit.auditing.deciders.three_joints import by_all_pairs, by_sample_values
from cuspaudit.runtime.clock import Clock

__all__ = ["EXACT", "HAIR", "WAYS", "Way"]


@dataclass(frozen=True)
class Way:
    """A way to a verdict.

    Attributes:
        stage: the stage that its time is counted for.
        decide: the answer so far, with what this way adds; None for nothing.
    """

    stage: str
    decide: Callable[[Case, Clock], Answer | None]


EXACT = (
    Way("decide", by_sample_values),
    Way("decide", by_all_pairs),
    Way("decide", by_theorem),
)
"""Exact engines and theorems alone."""

WAYS = (
    *EXACT,
    Way("certify", by_couple),
    Way("search", by_pigeonhole),
    Way("search", by_search),
    Way("pairs", by_pair_maxima),
)
"""All of them."""

HAIR = (*EXACT, Way("certify", by_couple), Way("search", by_search))
"""Those for the numbers as written, where the snapped ones were asked before."""
