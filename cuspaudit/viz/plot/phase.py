"""Phase diagrams: two parameters of a family, a verdict or a count as colour.

Every pixel takes the colour of the nearest member, so a grid, a random design and an
adaptive one are drawn alike; boundaries are lines between members of other colours and
are no sharper than the members are dense. The members themselves are dots with a title.
"""

from __future__ import annotations

import html
import io
import re
from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any

import numpy as np
from markupsafe import Markup
from matplotlib import colormaps
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from cuspaudit.viz.offline import asset, environment, policy

__all__ = ["draw_phases", "phase_page"]

_PIXELS = 400
_VERDICTS = {
    "noncuspidal": "#4477aa",
    "cuspidal": "#ee6677",
    "undecided": "#ccbb44",
    "error": "#bbbbbb",
}
Rows = Sequence[Mapping[str, Any]]


def draw_phases(
    rows: Rows,
    x: str,
    y: str,
    colour: str,
    file_format: str,
    title: str = "",
    labels: tuple[str, str] | None = None,
) -> bytes:
    """The phase diagram as a picture.

    Args:
        rows: the members; each has ``index``, ``x``, ``y``, ``colour`` and ``error``.
        x: the parameter to the right.
        y: the parameter upwards.
        colour: "verdict", or the name of a count.
        file_format: "png" or "svg"; an SVG shows a member's title under the pointer.
        title: over the picture; none on a page, which has its own.
        labels: of the two axes; the names of the parameters when left out.
    """
    names = [_name(row, colour) for row in rows]
    classes = sorted(set(names), key=lambda name: (len(name), name))
    colours = _colours(classes)
    points = np.array([[float(row[x]), float(row[y])] for row in rows])
    extent = _extent(points)
    nearest = _nearest(points, extent)
    codes = np.array([classes.index(name) for name in names])[nearest]
    figure = Figure(figsize=(7, 5.5), layout="constrained")
    axes = figure.subplots()
    norm = BoundaryNorm(np.arange(len(classes) + 1) - 0.5, max(len(classes), 1))
    axes.imshow(
        codes,
        ListedColormap(colours),
        norm=norm,
        extent=extent,
        origin="lower",
        aspect="auto",
        interpolation="nearest",
        alpha=0.75,
    )
    for code in range(len(classes) - 1):
        above = np.where(codes <= code, 0.0, 1.0)
        lines = {"colors": "black", "linewidths": 0.6, "origin": "lower"}
        axes.contour(above, levels=[0.5], extent=extent, **lines)
    size = float(np.clip(4000 / len(rows), 1, 12))
    for row, (px, py) in zip(rows, points, strict=True):
        (dot,) = axes.plot(px, py, "o", color="black", ms=size**0.5, mew=0)
        dot.set_gid(f"member-{row['index']}")
    right, up = labels or (x, y)
    axes.set(xlabel=right, ylabel=up)
    if title:
        figure.suptitle(fill(title.replace("$", r"\$"), 70), fontsize=12)
    handles = [Patch(color=c, label=n) for c, n in zip(colours, classes, strict=True)]
    figure.legend(handles=handles, title=colour, loc="outside right upper")
    stream = io.BytesIO()
    metadata = {"Date": None} if file_format == "svg" else {}
    figure.savefig(stream, format=file_format, dpi=150, metadata=metadata)
    picture = stream.getvalue()
    return _titled(picture, rows, colour, x, y) if file_format == "svg" else picture


def phase_page(
    svg: bytes,
    title: str,
    files: Mapping[int, str],
    audits: Mapping[int, str],
    command: str,
) -> str:
    """One offline page: the diagram, whose members lead to their audits.

    Args:
        svg: the diagram of `draw_phases`.
        title: of the page.
        files: member index to the text of its robot file.
        audits: member index to the address of its audit, of those that have one.
        command: what draws this page again; ``--audit INDEX`` is shown after it.
    """
    picture, script = svg.decode("utf-8"), asset("phases.js")
    members = {"command": command, "files": files, "audits": audits}
    return (
        environment()
        .get_template("phases.html")
        .render(
            title=title,
            svg=Markup(picture[picture.index("<svg") :]),
            members=members,
            style=Markup(asset("plot.css")),
            script=Markup(script),
            policy=policy([script]),
        )
    )


def _name(row: Mapping[str, Any], colour: str) -> str:
    if row.get("error"):
        return "error"
    value = row.get(colour)
    return "unknown" if value is None else str(value)


def _colours(classes: Sequence[str]) -> list[str | tuple[float, ...]]:
    others = colormaps["tab10"]
    return [_VERDICTS.get(name, others(k % 10)) for k, name in enumerate(classes)]


def _extent(points: NDArray[np.float64]) -> tuple[float, float, float, float]:
    low, high = points.min(axis=0), points.max(axis=0)
    margin = np.where(high > low, (high - low) / 40, 0.5)
    (left, bottom), (right, top) = low - margin, high + margin
    return float(left), float(right), float(bottom), float(top)


def _nearest(
    points: NDArray[np.float64], extent: tuple[float, float, float, float]
) -> NDArray[np.int64]:
    """Which point is nearest to each pixel, by jump flooding."""
    left, right, bottom, top = extent
    scale = np.array([right - left, top - bottom]) / (_PIXELS - 1)
    seeds = (points - np.array([left, bottom])) / scale
    at = np.rint(seeds).astype(int)
    best = np.full((_PIXELS, _PIXELS), -1)
    best[at[:, 1], at[:, 0]] = np.arange(len(points))
    rows, columns = np.mgrid[0:_PIXELS, 0:_PIXELS]
    distance = _distance(best, seeds, rows, columns)
    steps = [2**k for k in range(int(np.log2(_PIXELS)) + 1)][::-1]
    for step in [*steps, 1]:
        for dy in (-step, 0, step):
            for dx in (-step, 0, step):
                moved = best[
                    np.clip(rows + dy, 0, _PIXELS - 1),
                    np.clip(columns + dx, 0, _PIXELS - 1),
                ]
                other = _distance(moved, seeds, rows, columns)
                best = np.where(other < distance, moved, best)
                distance = np.minimum(other, distance)
    return best


def _distance(
    best: NDArray[np.int64],
    seeds: NDArray[np.float64],
    rows: NDArray[np.int64],
    columns: NDArray[np.int64],
) -> NDArray[np.float64]:
    found = seeds[best]
    away = (found[..., 0] - columns) ** 2 + (found[..., 1] - rows) ** 2
    return np.where(best < 0, np.inf, away)


def _titled(svg: bytes, rows: Rows, colour: str, x: str, y: str) -> bytes:
    """Give every dot of the SVG its title, which a browser shows under the pointer."""
    by_index = {str(row["index"]): row for row in rows}

    def title(match: re.Match[str]) -> str:
        row = by_index[match[1]]
        parts = [f"member {row['index']}", f"{x} = {row.get(f'{x}_exact', row[x])}"]
        parts += [f"{y} = {row.get(f'{y}_exact', row[y])}", f"{colour}: "]
        text = html.escape(", ".join(parts) + _name(row, colour))
        return f"{match[0]}<title>{text}</title>"

    text = re.sub(r'<g id="member-(\d+)">', title, svg.decode("utf-8"))
    return text.encode("utf-8")
