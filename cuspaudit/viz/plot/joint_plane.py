"""The plane of joints 2 and 3 of an arm, drawn as the paper's Figure 3.

Red is critical; green and blue are the signs of Delta, one tint an aspect; black dots
are the postures of one value.
"""

from __future__ import annotations

from typing import Any

from cuspaudit.viz.plot.data import JointPlane
from cuspaudit.viz.plot.sheet import Note
from cuspaudit.viz.plot.style import (
    BLACK,
    DARK,
    RED,
    draw_limits,
    frame,
    halo,
    legend,
    mark_at,
    pair,
    silent,
    swatch,
)

__all__ = ["plot_joint_plane"]

GREENS = ("#c9ecdd", "#9fdcc2", "#dff3c4", "#7fcbaa")
BLUES = ("#cfe0f7", "#a9c8ef", "#dcd8f5", "#86aee2")


def plot_joint_plane(axes: Any, data: JointPlane, note: Note | None = None) -> None:
    """Draw the plane of joints 2 and 3 on matplotlib ``axes``.

    Args:
        axes: where to draw.
        data: what to draw.
        note: called with a mark, its layer, and what it says when pointed at.
    """
    note = note or silent
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
        shown.append(swatch(axes, tint, name))
    for line in data.curve:
        (mark,) = axes.plot(*line.T, color=RED, lw=1.5, zorder=3)
        note(mark, "curve", "")
    shown.append(axes.plot([], [], color=RED, lw=1.5, label="singular postures")[0])
    shown.append(axes.plot([], [], color=BLACK, lw=0.9, label="roadmap")[0])
    shown[-1].set_color(DARK[1])
    shown += draw_limits(axes, data.limits, "joint limits", note)
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
    legend(axes, shown)


def _postures(axes: Any, data: JointPlane, note: Note, shown: list[Any]) -> None:
    for i, (point, aspect) in enumerate(
        zip(data.postures, data.posture_aspects, strict=True)
    ):
        name = chr(ord("A") + i)
        mark = mark_at(axes, point, "o", BLACK, "white", 8, 1.0)
        says = f"posture {name} {pair(point)}, in aspect {aspect}"
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


def _signed(sign: int) -> str:
    return "Delta > 0" if sign > 0 else "Delta < 0"
