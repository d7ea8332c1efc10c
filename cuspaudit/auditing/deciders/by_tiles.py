"""Three joints that turn, with a position: verdict and numbers, without sample values.

**Postures.** Over a value of joint 3 a position is taken once, where det J != 0, and
it is taken where a trigonometric polynomial of degree 2 is 0 (``surface.value_waves``):
a position has four regular postures at most. A regular position has as many of either
sign of det J, as the map of the torus of joints 2 and 3 to the plane has degree 0. So
an arm with two postures of one position and one sign has four over a regular one: near
by, as the two stay.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from cuspaudit.algebra.system import PolynomialMap
from cuspaudit.auditing.answer import Answer, Reason
from cuspaudit.auditing.case import Case
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.runtime.clock import Clock, time_at_least

if TYPE_CHECKING:
    from cuspaudit.cuspidality.tile_decision import TileDecision

__all__ = ["by_tiles"]

_RESTS_ON = ("FLINT root isolation", "exact signs", "ball arithmetic")
_MOST_POSTURES = 4
_SECONDS = 0.5
"""That tiles have, though the time limit has passed."""


def by_tiles(case: Case, clock: Clock) -> Answer | None:
    """Verdict and aspects by tiles of pairs of postures [mathematics 6.5].

    Asked where no couple and no sample values are, and where these were out of reach or
    out of time: tiles take some hundredths of a second. None where some stay open,
    where they find a couple and a path between its ends is asked for, and where the
    postures of a noncuspidal arm are to be counted.

    Raises:
        DegenerateMapError: det J vanishes identically.
    """
    model = case.model
    if model.chain.task != "position" or model.chain.kinds != ("revolute",) * 3:
        return None
    if case.engine != "auto" or not _is_asked(case):
        return None
    from cuspaudit.cuspidality.tile_decision import decide_by_tiles

    variety, mapping = reduced_map(model)
    try:
        with time_at_least(_SECONDS):
            decision = decide_by_tiles(variety, mapping)
        if case.so_far is None and case.counts:
            return _counted(_tiled(model, decision), decision, mapping, case.counts)
        found = _tiled(model, decision)
    except (UnableError, RetryableError):
        return None
    needs_path = case.certify and found.verdict is Verdict.CUSPIDAL
    return None if needs_path else found


def _is_asked(case: Case) -> bool:
    if case.so_far is None:
        return case.counts is not None and not case.certify
    return case.so_far.is_open_for(Reason.OUT_OF_REACH, Reason.TIME_LIMIT)


def _counted(
    found: Answer,
    decision: TileDecision,
    mapping: PolynomialMap,
    wanted: frozenset[str],
) -> Answer | None:
    """The answer with the counts asked for; None where postures are not counted."""
    from cuspaudit.surface.cusps import cusps
    from cuspaudit.surface.fibers import fiber_polynomials
    from cuspaudit.surface.nodes import nodes

    road = decision.roadmap
    if decision.couple is not None:
        found = replace(found, postures=Count(_MOST_POSTURES, True))
    elif "max_postures" in wanted:
        return None
    if "cusps" in wanted:
        found = replace(found, cusps=cusps(road, mapping, decision.delta))
    if "nodes" in wanted:
        fibers = fiber_polynomials(road.surface, mapping)
        found = replace(found, nodes=nodes(fibers, road, mapping))
    return found


def _tiled(model: ExactModel, decision: TileDecision) -> Answer:
    if decision.couple is not None:
        why = "two postures of one pose, proved in ball arithmetic, lie in one aspect"
    elif decision.tiles:
        why = (
            f"in each of {decision.tiles} tiles of pairs of postures of one pose, the "
            f"two lie in different ones of the {decision.aspects} aspects"
        )
    else:
        why = (
            "up to turns of joint 1 one coordinate of the position depends on one "
            "joint alone, which tells the postures of a pose apart"
        )
    return Answer(
        model,
        decision.verdict,
        why,
        _RESTS_ON,
        "tiles",
        by_tiles=decision,
        aspects=Count(decision.aspects, True),
    )
