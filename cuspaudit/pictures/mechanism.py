"""A parallel mechanism for its page, and its critical values for a sheet.

The critical values of a map to the plane are the zeros of the polynomials of a run of
Algorithm 1, sampled on a grid: a picture, which decides nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.evaluation import Evaluator
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap
from cuspaudit.auditing.systems.file import SystemFile
from cuspaudit.errors import UnableError
from cuspaudit.geometry.angles import unrolled
from cuspaudit.geometry.atypical_values import atypical_values
from cuspaudit.geometry.heights.guessed_ways import random_points
from cuspaudit.parallel.drawing import drawn
from cuspaudit.robot.numbers import format_rational
from cuspaudit.viz.mechanism_page import DrawnWayPoint, MechanismPage
from cuspaudit.viz.plot.sheet import Note, Sheet

__all__ = ["page_of", "values_sheet"]

Array = NDArray[np.float64]

_COLOURS = {"critical": "#a63a0c", "even": "#c9ccd1"}
_LAYERS = {
    "critical": "Values at which modes are born or die",
    "even": "Factors of even multiplicity: perhaps no critical values",
}
_GRID = 400
_POINTS = 300
#: of the axes of space in the plane of the drawing
_AXES = np.array([[1.0, 0.0], [-0.4, -0.35], [0.0, 1.0]])


def page_of(system: SystemFile, record: dict[str, Any]) -> MechanismPage:
    """The page of a mechanism whose decision is ``record``."""
    proof, postures = record["proof"], record["postures"]
    facts = {
        "why": str(proof["why"]),
        "proof": ", ".join([str(proof["engine"]), *proof["rests_on"]]),
        "problem": f"{system.loops.mechanism.problem} kinematics"
        if system.loops
        else "",
        "aspects": str(record["aspects"]["count"] or "not counted"),
        "modes": f"{postures['max']}{'' if postures['proved'] else ' seen'}",
        "Delta": str(record["singular"]["determinant"]),
    }
    return MechanismPage(
        system.name, record["verdict"], facts, list(_frames(system, record["witness"]))
    )


def _frames(
    system: SystemFile, witness: dict[str, Any] | None
) -> Sequence[DrawnWayPoint]:
    if witness is None or system.loops is None:
        return []
    shown = drawn(system.loops, np.array(witness["path"]))
    bases, ends, anchors = (_flat(p) for p in (shown.bases, shown.ends, shown.anchors))
    return [
        DrawnWayPoint(
            [
                (_pair(a), _pair(b), _pair(c))
                for a, b, c in zip(bases, end, anchor, strict=True)
            ],
            [_pair(c) for c in anchor],
        )
        for end, anchor in zip(ends, anchors, strict=True)
    ]


def _flat(points: Array) -> Array:
    return points if points.shape[-1] == 2 else points @ _AXES


def _pair(point: Array) -> tuple[float, float]:
    return round(float(point[0]), 6), round(float(point[1]), 6)


def values_sheet(system: SystemFile, timeout: float = 120.0, seed: int = 1) -> Sheet:
    """The plane of values of a map with d = 2, and the zeros of its atypical values.

    An angle is shown in degrees; the zeros are those of polynomials in the tangent of
    its half.

    Raises:
        UnableError: d is not 2, or an elimination is too large.
    """
    mapping = system.mapping
    if mapping.dimension != 2:
        found = f"d = {mapping.dimension}; critical values are drawn for d = 2"
        raise UnableError("plot", found)
    values = atypical_values(*unrolled(system.variety, mapping), timeout, seed)
    flat = len(mapping.components)
    axes = [np.linspace(*window, _GRID) for window in _windows(system, mapping, seed)]
    places = [
        axis if i < flat else np.tan(np.radians(axis) / 2)
        for i, axis in enumerate(axes)
    ]
    curves = [
        (_sampled(factor, places), multiplicity % 2 == 1)
        for polynomial in values.polynomials
        for factor, multiplicity in polynomial.factor()[1]
    ]
    labels = system.loops.labels if system.loops else ("r1", "r2")

    def draw(figure: Any, note: Note) -> None:
        figure.get_layout_engine().set(rect=(0, 0.03, 1, 0.97))
        plane = figure.add_subplot()
        shown = {}
        for grid, odd in curves:
            if (grid > 0).any() and (grid < 0).any():
                layer = "critical" if odd else "even"
                colour = _COLOURS[layer]
                mark = plane.contour(*axes, grid.T, levels=[0.0], colors=colour)
                note(mark, layer, "a piece of the curve of critical values")
                shown[layer] = plane.plot([], [], color=colour, label=_LAYERS[layer])
        plane.set_xlabel(labels[0])
        plane.set_ylabel(labels[1])
        handles = [shown[layer][0] for layer in _LAYERS if layer in shown]
        if handles:
            below: dict[str, Any] = {"bbox_to_anchor": (0.5, -0.1), "frameon": False}
            plane.legend(handles=handles, loc="upper center", fontsize=9, **below)

    return Sheet(
        title=f"{system.name}: critical values",
        notes=[*_held(system), f"Sampled on a grid of {_GRID} by {_GRID}."],
        about="the curve of critical values in the plane of values",
        layers=_LAYERS,
        draw=draw,
        size=(6.4, 6.6),
    )


def _held(system: SystemFile) -> list[str]:
    """The legs whose length is fixed, a sentence each."""
    legs = system.loops.mechanism.legs if system.loops else ()
    return [
        f"Leg {number} has the fixed length {format_rational(leg.rod)}."
        for number, leg in enumerate(legs, 1)
        if leg.kind == "length" and leg.rod is not None
    ]


def _windows(
    system: SystemFile, mapping: PolynomialMap, seed: int
) -> list[tuple[float, float]]:
    """Where the values of random points of V mostly lie; a whole turn for an angle."""
    evaluate = Evaluator(system.variety.ring, mapping.components)
    points = random_points(system.variety, seed)
    values = np.array([evaluate.floats(p) for p in islice(points, _POINTS)])
    windows = []
    for column in values.T:
        low, high = np.quantile(column, [0.02, 0.95])
        pad = 0.1 * (high - low) or 1.0
        windows.append((float(low - pad), float(high + pad)))
    return windows + [(-179.5, 179.5)] * len(mapping.angles)


def _sampled(factor: Polynomial, places: Sequence[Array]) -> Array:
    """A polynomial of Q[t, y_1, y_2] in y alone on a grid, over its terms' sum."""
    x, y = np.meshgrid(*places, indexing="ij")
    total, size = np.zeros_like(x), np.zeros_like(x)
    for (_, i, j), c in factor.to_dict().items():
        term = int(c.p) / int(c.q) * x ** int(i) * y ** int(j)
        total, size = total + term, size + np.abs(term)
    return total / np.maximum(size, 1e-300)
