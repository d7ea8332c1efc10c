"""The theorem applied: the decision of Algorithm 1 on a variety and a map."""

from cuspaudit.cuspidality.decision import Couple, Decision, decide
from cuspaudit.cuspidality.surface_decision import (
    SurfaceCouple,
    SurfaceDecision,
    decide_surface,
)
from cuspaudit.cuspidality.verdict import Verdict

__all__ = [
    "Couple",
    "Decision",
    "SurfaceCouple",
    "SurfaceDecision",
    "Verdict",
    "decide",
    "decide_surface",
]
