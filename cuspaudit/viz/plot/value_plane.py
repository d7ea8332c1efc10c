"""The plane of values of a three-joint arm, drawn as the paper's Figure 2.

Red is critical; blue diamonds are sample values.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from cuspaudit.viz.plot.data import ValuePlane
from cuspaudit.viz.plot.sheet import Note
from cuspaudit.viz.plot.style import (
    BLACK,
    BLUE,
    RED,
    draw_limits,
    frame,
    legend,
    mark_at,
    pair,
    silent,
    swatch,
)

__all__ = ["plot_value_plane"]

CELLS = ("#ffffff", "#fbe8bd", "#f4cf80", "#e8b04a", "#cf8a1f")  # 0, 2, 4, 6, 8


def plot_value_plane(axes: Any, data: ValuePlane, note: Note | None = None) -> None:
    """Draw the plane of values on matplotlib ``axes``.

    Args:
        axes: where to draw.
        data: what to draw.
        note: called with a mark, its layer, and what it says when pointed at.
    """
    note = note or silent
    counts = sorted(set(data.grid.ravel().tolist()))
    colours = [CELLS[min(max(count, 0) // 2, len(CELLS) - 1)] for count in counts]
    cells = axes.imshow(
        np.array([_rgb(c) for c in colours])[np.searchsorted(counts, data.grid)],
        extent=data.window,
        origin="lower",
        interpolation="nearest",
        zorder=0,
    )
    note(cells, "cells", "")
    for line in data.curve:
        (mark,) = axes.plot(*line.T, color=RED, lw=1.5, zorder=3)
        mark.set_solid_capstyle("round")
        note(mark, "curve", "")
    shown = [axes.plot([], [], color=RED, lw=1.5, label="critical values")[0]]
    shown += draw_limits(axes, data.limits, "values at joint limits", note)
    marks = (
        (data.points, "o", RED, RED, 4, "a whole critical fiber"),
        (data.nodes, "s", "none", BLACK, 8, "node"),
        (data.cusps, "o", "none", RED, 7.5, "cusp"),
    )
    for points, shape, face, edge, size, name in marks:
        for i, point in enumerate(points):
            label = f"{name}s: {len(points)}" if name in ("cusp", "node") else name
            mark = mark_at(axes, point, shape, face, edge, size)
            note(mark, "special", f"{name} at {pair(point)}")
            if i == 0:
                mark.set_label(label)
                shown.append(mark)
    for i, (point, count) in enumerate(
        zip(data.samples, data.sample_postures, strict=True)
    ):
        mark = mark_at(axes, point, "D", BLUE, "white", 5, 0.5)
        note(mark, "samples", f"sample point {pair(point)}: {count} postures, proved")
        if i == 0:
            mark.set_label("rational sample points")
            shown.append(mark)
    mark = mark_at(axes, data.focus, "D", "none", BLACK, 11, 1.4)
    place = "({:.3f}, {:.3f})".format(*data.focus).replace("-", "−")
    mark.set_label(f"{place}: value of A, B, ...")
    note(mark, "postures", f"{pair(data.focus)}: its postures are A, B, ...")
    shown.append(mark)
    for count, colour in zip(counts, colours, strict=True):
        name = "out of reach" if count == 0 else f"{count} postures"
        shown.append(swatch(axes, colour, name))
    frame(axes, data.window, data.labels, (False, False))
    axes.set_title("Values: the curve of critical values")
    legend(axes, shown)


def _rgb(colour: str) -> tuple[float, ...]:
    return tuple(int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
