"""The data of the paper's Figures 2 and 3, for any arm that three joints decide."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np

from cuspaudit.algebra.ring import Rational, rational
from cuspaudit.auditing.answer import Answer
from cuspaudit.cuspidality.surface_decision import SurfaceCouple, SurfaceDecision
from cuspaudit.cuspidality.surface_path import posture_angles, propose_path
from cuspaudit.errors import InvalidInputError, UnableError
from cuspaudit.pictures.critical_curve import pieces, trace, wall_pieces
from cuspaudit.pictures.cusps_and_nodes import critical_points
from cuspaudit.pictures.joint_plane import joint_plane
from cuspaudit.pictures.joint_surface import JointSurface
from cuspaudit.pictures.value_plane import value_plane
from cuspaudit.surface.graph_isotop import RoadmapGraph, graph_isotop
from cuspaudit.surface.sample_points import Fiber, sample_points
from cuspaudit.viz.plot.data import Figures, ValuePlane

__all__ = ["figures"]

Point = tuple[Fraction, Fraction]


def figures(found: Answer, at: Point | None = None) -> Figures:
    """The figures that belong to an answer of the exact engine.

    Args:
        found: for an arm of three joints, or one reduced to its three joints.
        at: the point whose postures are drawn, in the coordinates of the plane of
            values; by default a sample value.

    Raises:
        UnableError: Algorithm 1 was not run for this arm, so there is nothing to draw.
        InvalidInputError: ``at`` is critical, or out of reach.
    """
    decision, reduction = found.decision, found.reduction
    model = found.model if reduction is None else reduction.regional
    if decision is None or model is None:
        raise UnableError(
            "plot", f"there is no arm of three joints to draw here: {found.why}"
        )
    surface = JointSurface(decision, model)
    traced = [(p, *trace(p)) for p in [*pieces(surface), *wall_pieces(surface)]]
    special = critical_points(surface, traced, found.cusps, found.nodes)
    fiber, graph, couple = _focus(surface, at)
    path = None
    if couple is not None:
        shown = decision if at is None else _refocused(decision, fiber, graph, couple)
        path = surface.points_at(propose_path(shown, couple).points)
    value = value_plane(surface, traced, special, fiber)
    return Figures(
        title=f"{found.model.chain.name}: {found.verdict.value}",
        notes=tuple(_notes(found, value)),
        value=value,
        joint=joint_plane(surface, traced, fiber, graph, path),
    )


def _focus(
    surface: JointSurface, at: Point | None
) -> tuple[Fiber, RoadmapGraph, SurfaceCouple | None]:
    """The fiber to draw, the graph that places its postures, and its best couple.

    Of the sample values one with as many couples and postures as there are, and with
    postures as far from singular as can be.
    """
    decision = surface.decision
    if at is not None:
        fiber = _fiber_at(surface, at)
        graph = graph_isotop(decision.roadmap, decision.delta, fiber.postures)
        return fiber, graph, _couple(surface, fiber, graph)[2]
    graph = decision.graph
    ranked = [(_couple(surface, f, graph), f) for f in decision.samples if f.postures]
    (*_, couple), fiber = max(ranked, key=lambda pair: pair[0][:2])
    return fiber, graph, couple


def _couple(
    surface: JointSurface, fiber: Fiber, graph: RoadmapGraph
) -> tuple[tuple[int, int], float, SurfaceCouple | None]:
    """Rank of a fiber, its distance from singular, its couple farthest from that."""
    decision, postures = surface.decision, fiber.postures
    angles = np.array([posture_angles(decision, p) for p in postures]).reshape(-1, 2)
    heights = surface.delta(surface.points_at(angles))
    pairs = [
        (min(abs(heights[i]), abs(heights[j])), i, j)
        for i in range(len(postures))
        for j in range(i)
        if graph.aspect(postures[i]) == graph.aspect(postures[j])
    ]
    rank = (len(pairs), len(postures))
    if not pairs:
        return rank, float(np.abs(heights).min(initial=np.inf)), None
    best, i, j = max(pairs)
    sign = int(np.sign(heights[i]))
    return (
        rank,
        float(best),
        SurfaceCouple(fiber.value, (postures[j], postures[i]), sign),
    )


def _fiber_at(surface: JointSurface, at: Point) -> Fiber:
    """The fiber of a point of the plane of values.

    Raises:
        InvalidInputError: the point is critical, or a chart misses a posture.
    """
    x, y = at
    fibers = surface.decision.fibers
    if surface.model.joints[0].kind == "revolute":
        z = y - Fraction(surface.rise).limit_denominator(10**9)
        x, y = x * x + z * z, z
    value = (rational(x), rational(y))
    places: dict[str, Rational | int] = dict(zip(("u", "v"), value, strict=True))
    for condition in (fibers.discriminant, fibers.chart_gap()):
        if fibers.ring.substitute(condition, places) == 0:
            raise InvalidInputError(
                file=f"({at[0]}, {at[1]})",
                found="a critical value, or one where a posture is outside the charts",
                expected="choose a value near it",
            )
    fiber = sample_points(fibers, value)
    if not fiber.postures:
        raise InvalidInputError(
            file=f"({at[0]}, {at[1]})",
            found="out of reach: no posture has this value",
            expected="choose a value inside the curve",
        )
    return fiber


def _refocused(
    decision: SurfaceDecision, fiber: Fiber, graph: RoadmapGraph, couple: SurfaceCouple
) -> SurfaceDecision:
    """The decision as if ``fiber`` had been its only sample."""
    return replace(decision, samples=[fiber], graph=graph, couples=[couple])


def _notes(found: Answer, value: ValuePlane) -> list[str]:
    notes = []
    if found.reduction is not None:
        which = (
            "last three joints, from tip to base,"
            if (found.reduction.is_reversed)
            else "first three joints"
        )
        notes.append(f"The {which} of an arm with a {found.reduction.kind}.")
    if value.beyond:
        notes.append(f"Sample points outside the window: {value.beyond}.")
    if found.nodes is not None and not found.nodes.proved:
        notes.append("Nodes are not marked: their number is not proved.")
    return notes
