"""The record of an exact run: what a verdict without a certificate is re-checked with.

For a noncuspidal one the steps of Algorithm 1 are written down with their numbers: the
polynomials, the rational sample values, the postures of each in isolating balls, the
aspect each lies in and the graph that says so. The claim to re-check is that no two
postures of one value share an aspect. For a cuspidal one by the pigeon-hole, the pose
and all its postures, of which two share one.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import cuspaudit
from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.evidence import Crowd
from cuspaudit.robot.virtual_joint import without_virtual_joint
from cuspaudit.surface.sample_points import Fiber

if TYPE_CHECKING:
    from cuspaudit.cuspidality.pair_decision import PairDecision
    from cuspaudit.cuspidality.surface_decision import SurfaceDecision

__all__ = ["SCHEMA", "proof_record"]

SCHEMA = "cuspaudit/record/1"
_BITS = 64
_DIGITS = 15


def proof_record(answer: Answer) -> str:
    """The record of ``answer`` as JSON text, schema ``cuspaudit/record/1``."""
    reduction = answer.reduction
    record = {
        "schema": SCHEMA,
        "robot": answer.model.chain.name,
        "task": without_virtual_joint(answer.model.chain).task,
        "verdict": answer.verdict.value,
        "why": answer.why,
        "rests_on": list(answer.rests_on),
        "reduction": reduction.kind if reduction else None,
        "approximated": [
            {"where": a.where, "difference": a.difference}
            for a in answer.model.approximations
        ],
        "run": _run(answer.decision) if answer.decision else None,
        "pairs": _pairs(answer.by_pairs) if answer.by_pairs else None,
        "crowd": _crowd(answer.crowd) if answer.crowd else None,
        "made_by": f"cuspaudit {cuspaudit.__version__}",
    }
    return json.dumps(record, indent=1) + "\n"


def _run(decision: SurfaceDecision) -> dict[str, Any]:
    return {
        **_roadmap(decision),
        "fiber_polynomial": str(decision.fibers.polynomial),
        "atypical_values": [str(p) for p in decision.atypical],
        "samples": [_sample(decision, fiber) for fiber in decision.samples],
    }


def _pairs(decision: PairDecision) -> dict[str, Any]:
    sheets = decision.sheets
    return {
        **_roadmap(decision),
        "walls": None if sheets is None else [str(p) for p in sheets.walls],
        "pairs": [
            {
                "sheet": pair[0].sheet,
                "ends": [
                    {
                        "base": str(end.base[0]),
                        "fiber": [_text(ball) for ball in end.fiber_point(_BITS)],
                        "aspect": decision.graph.aspect(end),
                    }
                    for end in pair
                ],
            }
            for pair in decision.pairs
        ],
    }


def _roadmap(decision: SurfaceDecision | PairDecision) -> dict[str, Any]:
    road, surface = decision.roadmap, decision.surface
    return {
        "ring": repr(surface.ring),
        "delta": str(decision.delta),
        "fiber": {"kind": surface.fiber.kind, "variables": surface.fiber.names},
        "base": {
            "kind": surface.base.kind,
            "variables": surface.base.names,
            "chart_from": [str(entry) for entry in surface.base.rotation],
        },
        "roadmap": {
            "critical": [
                {
                    "polynomial": str(root.polynomial),
                    "near": _text(root.enclosure(_BITS)),
                }
                for root in road.critical
            ],
            "passing": list(road.passing),
            "strips": [
                {"sample": str(strip.sample), "signs": strip.signs}
                for strip in road.strips
            ],
        },
        "aspects": decision.aspects,
    }


def _crowd(crowd: Crowd) -> dict[str, Any]:
    return {
        "pose_of": [f"tan(theta/2) = {tangent}" for tangent in crowd.tangents],
        "postures": [
            {
                **{n: _text(b) for n, b in posture.ball(_BITS).items()},
                "aspect": aspect,
            }
            for aspect, postures in enumerate(crowd.aspects.values())
            for posture in postures
        ],
    }


def _sample(decision: SurfaceDecision, fiber: Fiber) -> dict[str, Any]:
    return {
        "value": [str(entry) for entry in fiber.value],
        "postures": [
            {
                **{n: _text(b) for n, b in posture.coordinates(_BITS).items()},
                "aspect": decision.graph.aspect(posture),
            }
            for posture in fiber.postures
        ],
    }


def _text(ball: Any) -> str:
    """The ball as FLINT writes it, midpoint and radius."""
    return str(ball.str(_DIGITS))
