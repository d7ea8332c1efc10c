"""The theorem applied: the decision of Algorithm 1 on a variety and a map."""

from cuspaudit.cuspidality.decision import Couple, Decision, decide
from cuspaudit.cuspidality.pair_decision import (
    PairCouple,
    PairDecision,
    decide_pairs,
)
from cuspaudit.cuspidality.surface_decision import (
    SurfaceCouple,
    SurfaceDecision,
    decide_surface,
)
from cuspaudit.cuspidality.verdict import Verdict

__all__ = [
    "Couple",
    "Decision",
    "PairCouple",
    "PairDecision",
    "SurfaceCouple",
    "SurfaceDecision",
    "Verdict",
    "decide",
    "decide_pairs",
    "decide_surface",
]
