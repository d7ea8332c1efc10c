"""The two planes of a three-joint arm, drawn in the look of the paper's Figures 2, 3.

Red is critical in both; blue diamonds are sample values; green and blue are the signs
of Delta, one tint an aspect; black dots are the postures of one value. The data comes
in as plain arrays, described here by protocols, so that any room may make it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from cuspaudit.viz.plot.sheet import Note

__all__ = [
    "BLACK",
    "DARK",
    "LAYERS",
    "RED",
    "AspectData",
    "JointPlaneData",
    "ValuePlaneData",
    "frame",
    "halo",
    "plot_joint_plane",
    "plot_value_plane",
]

Array = NDArray[np.float64]
Window = tuple[float, float, float, float]

RED, BLACK, BLUE = "#c4161c", "#111111", "#1f4fd8"
CELLS = ("#ffffff", "#fbe8bd", "#f4cf80", "#e8b04a", "#cf8a1f")  # 0, 2, 4, 6, 8
GREENS = ("#c9ecdd", "#9fdcc2", "#dff3c4", "#7fcbaa")
BLUES = ("#cfe0f7", "#a9c8ef", "#dcd8f5", "#86aee2")
DARK = {1: "#00684a", -1: "#1c4f93"}


class ValuePlaneData(Protocol):
    """What `plot_value_plane` draws; lengths in one unit, named in the labels."""

    @property
    def labels(self) -> tuple[str, str]:
        """Of the two axes."""

    @property
    def window(self) -> Window:
        """(left, right, bottom, top)."""

    @property
    def curve(self) -> Sequence[Array]:
        """(m, 2) polylines of critical values."""

    @property
    def points(self) -> Array:
        """(k, 2) isolated critical values."""

    @property
    def cusps(self) -> Array:
        """(k, 2)."""

    @property
    def nodes(self) -> Array:
        """(k, 2)."""

    @property
    def samples(self) -> Array:
        """(k, 2) sample values."""

    @property
    def sample_postures(self) -> NDArray[np.int64]:
        """(k,) how many postures each has."""

    @property
    def focus(self) -> Array:
        """(2,) the value whose postures are drawn beside."""

    @property
    def grid(self) -> NDArray[np.int64]:
        """(rows from the bottom, columns) numbers of postures."""


class AspectData(Protocol):
    """One aspect for `plot_joint_plane`."""

    @property
    def number(self) -> int:
        """1, 2, ..."""

    @property
    def sign(self) -> int:
        """Of Delta in it."""

    @property
    def regions(self) -> Sequence[Array]:
        """(m, 2) polygons."""

    @property
    def roadmap(self) -> Sequence[Array]:
        """(m, 2) polylines."""

    @property
    def label(self) -> Array:
        """(2,) a place for its name."""


class JointPlaneData(Protocol):
    """What `plot_joint_plane` draws; rad, or a length where an axis is no turn."""

    @property
    def labels(self) -> tuple[str, str]:
        """Of the two axes."""

    @property
    def window(self) -> Window:
        """(left, right, bottom, top)."""

    @property
    def is_turn(self) -> tuple[bool, bool]:
        """Whether each axis is an angle."""

    @property
    def aspects(self) -> Sequence[AspectData]:
        """All of them."""

    @property
    def curve(self) -> Sequence[Array]:
        """(m, 2) polylines of critical postures."""

    @property
    def postures(self) -> Array:
        """(k, 2) the postures of one value."""

    @property
    def posture_aspects(self) -> Sequence[int]:
        """The number of the aspect of each."""

    @property
    def paths(self) -> Sequence[Array]:
        """(m, 2) copies of one path between two postures."""


LAYERS = {
    "cells": "cells by number of postures",
    "curve": "critical curves",
    "special": "cusps and nodes",
    "samples": "sample points",
    "aspects": "aspects",
    "roadmap": "roadmap",
    "path": "nonsingular path",
    "postures": "postures of one value",
}


def plot_value_plane(axes: Any, data: ValuePlaneData, note: Note | None = None) -> None:
    """Draw the plane of values on matplotlib ``axes``.

    Args:
        axes: where to draw.
        data: what to draw.
        note: called with a mark, its layer, and what it says when pointed at.
    """
    note = note or _silent
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
    marks = (
        (data.points, "o", RED, RED, 4, "a whole critical fiber"),
        (data.nodes, "s", "none", BLACK, 8, "node"),
        (data.cusps, "o", "none", RED, 7.5, "cusp"),
    )
    for points, shape, face, edge, size, name in marks:
        for i, point in enumerate(points):
            label = f"{name}s: {len(points)}" if name in ("cusp", "node") else name
            mark = _mark(axes, point, shape, face, edge, size)
            note(mark, "special", f"{name} at {_pair(point)}")
            if i == 0:
                mark.set_label(label)
                shown.append(mark)
    for i, (point, count) in enumerate(
        zip(data.samples, data.sample_postures, strict=True)
    ):
        mark = _mark(axes, point, "D", BLUE, "white", 5, 0.5)
        note(mark, "samples", f"sample point {_pair(point)}: {count} postures, proved")
        if i == 0:
            mark.set_label("rational sample points")
            shown.append(mark)
    mark = _mark(axes, data.focus, "D", "none", BLACK, 11, 1.4)
    mark.set_label("value of the postures A, B, ...")
    note(mark, "postures", f"{_pair(data.focus)}: its postures are A, B, ...")
    shown.append(mark)
    for count, colour in zip(counts, colours, strict=True):
        name = "out of reach" if count == 0 else f"{count} postures"
        shown.append(_patch(axes, colour, name))
    frame(axes, data.window, data.labels, (False, False))
    axes.set_title("Values: the curve of critical values")
    _legend(axes, shown)


def plot_joint_plane(axes: Any, data: JointPlaneData, note: Note | None = None) -> None:
    """Draw the plane of joints 2 and 3 on matplotlib ``axes``; see above."""
    note = note or _silent
    shown = []
    ranks = {1: 0, -1: 0}
    for aspect in data.aspects:
        tints = GREENS if aspect.sign > 0 else BLUES
        tint = tints[ranks[aspect.sign] % len(tints)]
        ranks[aspect.sign] += 1
        name = f"aspect {aspect.number}, {_signed(aspect.sign)}"
        for polygon in aspect.regions:
            (patch,) = axes.fill(*polygon.T, color=tint, lw=0.4, zorder=1)
            note(patch, "aspects", name)
        for line in aspect.roadmap:
            (mark,) = axes.plot(*line.T, color=DARK[aspect.sign], lw=0.9, zorder=2)
            note(mark, "roadmap", "")
        number = axes.text(
            *aspect.label,
            f"{aspect.number}",
            color=DARK[aspect.sign],
            fontsize=15,
            fontweight="bold",
            ha="center",
            va="center",
            zorder=6,
            path_effects=halo(3),
        )
        note(number, "aspects", name)
        shown.append(_patch(axes, tint, name))
    for line in data.curve:
        (mark,) = axes.plot(*line.T, color=RED, lw=1.5, zorder=3)
        note(mark, "curve", "")
    shown.append(axes.plot([], [], color=RED, lw=1.5, label="singular postures")[0])
    shown.append(axes.plot([], [], color=BLACK, lw=0.9, label="roadmap")[0])
    shown[-1].set_color(DARK[1])
    for path in data.paths:
        (edge,) = axes.plot(*path.T, color="white", lw=4.2, zorder=4)
        (mark,) = axes.plot(*path.T, color=BLACK, lw=2.0, zorder=4, dashes=(3, 1.5))
        note(edge, "path", "")
        note(mark, "path", "nonsingular path between two postures of one value")
    if data.paths:
        label = "nonsingular path of a couple"
        (line,) = axes.plot([], [], color=BLACK, lw=2, dashes=(3, 1.5), label=label)
        shown.append(line)
    _postures(axes, data, note, shown)
    frame(axes, data.window, data.labels, data.is_turn)
    axes.set_title("Joints: aspects, roadmap, postures of one value")
    _legend(axes, shown)


def _postures(axes: Any, data: JointPlaneData, note: Note, shown: list[Any]) -> None:
    for i, (point, aspect) in enumerate(
        zip(data.postures, data.posture_aspects, strict=True)
    ):
        name = chr(ord("A") + i)
        mark = _mark(axes, point, "o", BLACK, "white", 8, 1.0)
        says = f"posture {name} {_pair(point)}, in aspect {aspect}"
        note(mark, "postures", says)
        right, up = point[0] < data.window[1] * 0.85, point[1] < data.window[3] * 0.9
        letter = axes.annotate(
            name,
            point,
            (7 if right else -7, 6 if up else -6),
            textcoords="offset points",
            ha="left" if right else "right",
            va="bottom" if up else "top",
            fontsize=12,
            fontweight="bold",
            zorder=8,
            path_effects=halo(2.5),
        )
        note(letter, "postures", says)
        if i == 0:
            mark.set_label("postures of one value")
            shown.append(mark)


def _mark(
    axes: Any,
    point: Array,
    shape: str,
    face: str,
    edge: str,
    size: float,
    width: float = 1.3,
) -> Any:
    (mark,) = axes.plot(
        [point[0]],
        [point[1]],
        linestyle="",
        marker=shape,
        markerfacecolor=face,
        markeredgecolor=edge,
        markersize=size,
        markeredgewidth=width,
        zorder=7,
    )
    return mark


def frame(
    axes: Any, window: Window, labels: tuple[str, str], is_turn: tuple[bool, bool]
) -> None:
    """Window, labels, scales and ticks of one plane; a turn has ticks at pi."""
    axes.set_xlim(window[0], window[1])
    axes.set_ylim(window[2], window[3])
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1])
    if is_turn[0] == is_turn[1]:
        axes.set_aspect("equal")
    else:
        axes.set_box_aspect(1)
    quarters = [k * math.pi / 2 for k in range(-2, 3)]
    names = ["−π", "−π/2", "0", "π/2", "π"]
    if is_turn[0]:
        axes.set_xticks(quarters, names)
    if is_turn[1]:
        axes.set_yticks(quarters, names)


def _legend(axes: Any, shown: list[Any]) -> None:
    legend = axes.legend(
        handles=shown,
        loc="upper center",
        bbox_to_anchor=(0.5, -0.1),
        ncols=2,
        frameon=False,
        fontsize=9,
    )
    legend.set_in_layout(False)


def _patch(axes: Any, colour: str, name: str) -> Any:
    from matplotlib.patches import Patch

    return Patch(facecolor=colour, edgecolor="#777777", linewidth=0.6, label=name)


def halo(width: float) -> list[Any]:
    """A white rim of ``width`` points for text and lines."""
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=width, foreground="white")]


def _rgb(colour: str) -> tuple[float, ...]:
    return tuple(int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))


def _pair(point: Array) -> str:
    return f"({point[0]:.4f}, {point[1]:.4f})"


def _signed(sign: int) -> str:
    return "Delta > 0" if sign > 0 else "Delta < 0"


def _silent(mark: Any, layer: str, text: str) -> None:
    """Nobody points at a bitmap."""
