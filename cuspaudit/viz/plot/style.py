"""The look of the paper's Figures 2 and 3: colours, marks, frames and legends."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from cuspaudit.viz.plot.data import Array, Window

__all__ = [
    "BLACK",
    "BLUE",
    "DARK",
    "RED",
    "draw_limits",
    "frame",
    "halo",
    "legend",
    "mark_at",
    "pair",
    "silent",
    "swatch",
]

RED, BLACK, BLUE, PURPLE = "#c4161c", "#111111", "#1f4fd8", "#7b2fa0"
DARK = {1: "#00684a", -1: "#1c4f93"}


def mark_at(
    axes: Any,
    point: Array,
    shape: str,
    face: str,
    edge: str,
    size: float,
    width: float = 1.3,
) -> Any:
    """A mark of one point, above everything else."""
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


def draw_limits(
    axes: Any, lines: Sequence[Array], name: str, note: Callable[[Any, str, str], None]
) -> list[Any]:
    """The sides of a box of joint limits, or their images; what the legend shows."""
    for line in lines:
        (mark,) = axes.plot(*line.T, color=PURPLE, lw=1.5, ls="--", zorder=5)
        note(mark, "limits", name)
    if not lines:
        return []
    return [axes.plot([], [], color=PURPLE, lw=1.5, ls="--", label=name)[0]]


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


def legend(axes: Any, shown: list[Any]) -> None:
    """What the marks in ``shown`` mean, below the plane."""
    box = axes.legend(
        handles=shown,
        loc="upper center",
        bbox_to_anchor=(0.5, -0.1),
        ncols=2,
        frameon=False,
        fontsize=9,
    )
    box.set_in_layout(False)


def swatch(axes: Any, colour: str, name: str) -> Any:
    """A coloured square for the legend."""
    from matplotlib.patches import Patch

    return Patch(facecolor=colour, edgecolor="#777777", linewidth=0.6, label=name)


def halo(width: float) -> list[Any]:
    """A white rim of ``width`` points for text and lines."""
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=width, foreground="white")]


def pair(point: Array) -> str:
    """A point as a reader sees it."""
    return f"({point[0]:.4f}, {point[1]:.4f})"


def silent(mark: Any, layer: str, text: str) -> None:
    """Nobody points at a bitmap."""
