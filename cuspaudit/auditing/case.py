"""What is to be decided: one arm, and how it is asked."""

from __future__ import annotations

from dataclasses import dataclass

from cuspaudit.auditing.answer import Answer
from cuspaudit.kinematics.exact_model import ExactModel

__all__ = ["HAIR_POSES", "MOST_POSES", "Case"]

MOST_POSES = 192
HAIR_POSES = 64
"""Random poses for an arm that rounding alone may have made cuspidal."""


@dataclass(frozen=True, eq=False)
class Case:
    """An arm to be decided.

    Attributes:
        model: the numbers that the verdict is about, a virtual joint included. Every
            proof is about the chain of this model: a witness of other numbers, near
            as they may be, proves nothing here.
        seed: of every random choice.
        engine: the route to connectivity, "auto", "roadmap" or "routing"; or "pairs".
        poses: the most random poses that a search tries.
        certify: whether a CUSPIDAL of an exact run needs a proved path as well.
        counts: the numbers that are asked for beside the verdict, of "aspects",
            "max_postures", "cusps" and "nodes"; None where a couple and sample values
            are as well.
        so_far: what the ways tried before came to; None when none had an answer.
    """

    model: ExactModel
    seed: int = 0
    engine: str = "auto"
    poses: int = MOST_POSES
    certify: bool = True
    counts: frozenset[str] | None = None
    so_far: Answer | None = None
