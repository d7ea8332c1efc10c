"""The landscape of |det J| of a six-joint arm: its merge tree, and planes through it.

Green and blue are the signs of det J, the darker the farther from singular; red is
singular. Branches of the tree join where two maxima of |det J| can reach each other.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from cuspaudit.viz.plot.data import Array, Landscape, Slice
from cuspaudit.viz.plot.sheet import Note, Sheet
from cuspaudit.viz.plot.style import BLACK, DARK, RED, frame, halo

__all__ = ["landscape_sheet"]

SHADES = ("#2f6fc0", "#cfe0f7", "#ffffff", "#c9ecdd", "#1f8a63")
LAYERS = {
    "tree": "merge tree",
    "maxima": "maxima",
    "heights": "det J in the planes",
    "singular": "singular postures",
    "path": "witness path",
    "postures": "ends and narrowest place",
}


def landscape_sheet(data: Landscape) -> Sheet:
    """The tree and the planes on one sheet."""

    def draw(figure: Any, note: Note) -> None:
        figure.get_layout_engine().set(rect=(0, 0.03, 1, 0.97))
        panels = figure.subplots(2, 2).ravel()
        _draw_tree(panels[0], data, note)
        for axes, plane in zip(panels[1:], data.slices, strict=False):
            _draw_slice(axes, plane, note)
        for axes in panels[1 + len(data.slices) :]:
            axes.axis("off")

    about = "the merge tree of the size of det J, and planes through the joints"
    return Sheet(data.title, data.notes, about, LAYERS, draw, (12.0, 11.5))


def _draw_tree(axes: Any, data: Landscape, note: Note) -> None:
    for line in data.branches:
        (mark,) = axes.plot(*line.T, color=BLACK, lw=1.3, zorder=2)
        note(mark, "tree", "")
    for x, level in data.joins:
        (mark,) = axes.plot([x], [level], "s", color=RED, ms=5, zorder=3)
        note(mark, "tree", f"saddle: two groups join at {level:.4f} of the largest")
    for x, leaf in enumerate(data.leaves):
        (mark,) = axes.plot(
            [x], [leaf.level], "o", color=DARK[leaf.sign], ms=7, zorder=4
        )
        sign = ">" if leaf.sign > 0 else "<"
        says = f"maximum of |det J|: {leaf.level:.4f}, det J {sign} 0"
        note(mark, "maxima", f"{says}, aspect {leaf.aspect}")
        axes.annotate(f"{leaf.aspect}", (x, leaf.level), (0, 7), **_CENTRED)
    if data.clearance is not None:
        mark = axes.axhline(data.clearance, color=BLACK, lw=1.6, dashes=(3, 1.5))
        note(mark, "path", f"clearance of the witness: {data.clearance:.4f}")
        text = f"witness {data.clearance:.3f}"
        label = axes.annotate(text, (1, data.clearance), (-3, 4), **_AT_RIGHT)
        label.set_path_effects(halo(2.5))
        axes.set_xlim(-0.5, 1.3 * len(data.leaves) - 0.5)  # room for the label
    axes.set_yscale("function", functions=(np.cbrt, lambda x: x**3))
    axes.set_yticks([0, 0.01, 0.05, 0.1, 0.25, 0.5, 1.0])
    axes.set_ylim(0, 1.25)
    for name, place in data.ends.items():
        _draw_mark(axes, name, place, f"{name}, at {place[1]:.4f} of the largest", note)
    axes.set_xticks([])
    axes.set_xlabel("maxima of |det J|, the number of the aspect over each")
    axes.set_ylabel("|det J| over the largest (cube-root scale)")
    axes.set_title("Merge tree: at which clearance aspects hold together")


def _draw_slice(axes: Any, plane: Slice, note: Note) -> None:
    from matplotlib.colors import LinearSegmentedColormap

    shades = LinearSegmentedColormap.from_list("signs", SHADES)
    heights = np.cbrt(plane.heights)
    extent: dict[str, Any] = {"extent": plane.window, "origin": "lower"}
    limits = {"vmin": -1, "vmax": 1, "interpolation": "nearest"}
    image = axes.imshow(heights, cmap=shades, **extent, **limits)
    note(image, "heights", "")
    if heights.min() < 0 < heights.max():
        curve = axes.contour(plane.heights, [0.0], colors=RED, linewidths=1.5, **extent)
        note(curve, "singular", "singular: det J = 0")
    for line in plane.lines:
        (edge,) = axes.plot(*line.T, color="white", lw=3.6, zorder=4)
        (mark,) = axes.plot(*line.T, color=BLACK, lw=1.7, zorder=4, dashes=(3, 1.5))
        note(edge, "path", "")
        note(mark, "path", "the witness path, seen along the other joints")
    frame(axes, plane.window, plane.labels, (not plane.lines, not plane.lines))
    for name, place in plane.marks.items():
        _draw_mark(axes, name, place, f"{name} ({place[0]:.3f}, {place[1]:.3f})", note)
    axes.set_title(f"det J in the plane {plane.title}")


def _draw_mark(axes: Any, name: str, place: Array, says: str, note: Note) -> None:
    """A named black dot."""
    (mark,) = axes.plot(*place[:, None], "o", color=BLACK, mec="white", ms=8, zorder=7)
    note(mark, "postures", says)
    share = axes.transAxes.inverted().transform(axes.transData.transform(place))
    offset = (-16 if share[0] > 0.94 else 7, -15 if share[1] > 0.94 else 6)
    text = axes.annotate(name, place, offset, path_effects=halo(2.5), **_NAMED)
    note(text, "postures", says)


_CENTRED = {"textcoords": "offset points", "ha": "center", "fontsize": 9}
_AT_RIGHT = {
    **{"textcoords": "offset points", "xycoords": ("axes fraction", "data")},
    **{"ha": "right", "fontsize": 9},
}
_NAMED = {
    **{"textcoords": "offset points", "fontsize": 12, "fontweight": "bold"},
    "zorder": 8,
}
