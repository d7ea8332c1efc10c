"""The ways to a verdict, in the order in which they are tried.

Each is a function of the case and the clock. It returns None where it has nothing to
say, and else the answer so far: built from `Case.so_far`, with what it found. To add
one: a file beside this one, and a line here. What is needed only where the ways before
left the case open is loaded then, so that no arm waits for what it does not need.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.deciders.by_theorem import by_theorem
from cuspaudit.auditing.deciders.by_tiles import by_tiles
from cuspaudit.auditing.deciders.certify import by_couple
from cuspaudit.auditing.deciders.three_joints import by_all_pairs, by_sample_values
from cuspaudit.runtime.clock import Clock

__all__ = ["DECIDERS", "EXACT", "HAIR", "Decider"]


@dataclass(frozen=True)
class Decider:
    """A way to a verdict.

    Attributes:
        stage: the stage that its time is counted for.
        decide: the answer so far, with what this way adds; None for nothing.
    """

    stage: str
    decide: Callable[[Case, Clock], Answer | None]


def _when_open(file: str, name: str) -> Callable[[Case, Clock], Answer | None]:
    """The way ``name`` in ``file`` beside this one, for a case that is still open."""

    def decide(case: Case, clock: Clock) -> Answer | None:
        if case.so_far is None or case.so_far.is_settled:
            return None
        module = import_module(f"cuspaudit.auditing.deciders.{file}")
        way: Callable[[Case, Clock], Answer | None] = getattr(module, name)
        return way(case, clock)

    return decide


_BY_SEARCH = Decider("search", _when_open("by_search", "by_search"))
_BY_CUSP = Decider("cusp", _when_open("by_cusp", "by_cusp"))

EXACT = (
    Decider("decide", by_tiles),  # where the verdict alone is asked for
    Decider("decide", by_sample_values),
    Decider("decide", by_all_pairs),
    Decider("decide", by_tiles),  # where those did not come to an end
    Decider("decide", by_theorem),
)
"""Exact engines and theorems alone."""

DECIDERS = (
    *EXACT,
    Decider("certify", by_couple),
    _BY_CUSP,
    Decider("search", _when_open("by_pigeonhole", "by_pigeonhole")),
    _BY_SEARCH,
    Decider("pairs", _when_open("by_pairs", "by_pair_maxima")),
)
"""All of them."""

HAIR = (*EXACT, Decider("certify", by_couple), _BY_SEARCH, _BY_CUSP)
"""Those for the numbers as written, where the snapped ones were asked before."""
