"""Both planes of an arm on one sheet, as PNG, SVG or one HTML page that opens offline.

SVG and HTML name every mark when it is pointed at: the marks carry ``title`` elements,
and their ids begin with the name of their layer.
"""

from __future__ import annotations

import io
import string
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any, Protocol

from markupsafe import Markup

from cuspaudit.errors import InvalidInputError
from cuspaudit.viz.offline import asset, environment, policy
from cuspaudit.viz.plots import (
    LAYERS,
    JointPlaneData,
    Layer,
    ValuePlaneData,
    plot_joint_plane,
    plot_value_plane,
)

__all__ = ["ENDINGS", "FiguresData", "figure", "page_text", "save_plot", "svg_text"]

ENDINGS = (".png", ".svg", ".html")
_DPI = 150
_SIZE = (13.0, 8.2)
_DIGITS = string.digits + string.ascii_lowercase
_LEGEND = 0.17  # the part of the height below both planes


class FiguresData(Protocol):
    """Both planes of one arm."""

    @property
    def title(self) -> str:
        """The arm and its verdict."""

    @property
    def notes(self) -> Sequence[str]:
        """What the reader must know, one sentence each."""

    @property
    def value(self) -> ValuePlaneData:
        """The plane of values."""

    @property
    def joint(self) -> JointPlaneData:
        """The plane of joints 2 and 3."""


def figure(data: FiguresData) -> Any:
    """Both planes side by side, as a matplotlib Figure without any window."""
    return _figure(data)[0]


def save_plot(data: FiguresData, path: Path) -> None:
    """Write both planes to ``path``, in the format its ending names.

    Raises:
        InvalidInputError: the ending is none of `ENDINGS`, or the file cannot be
            written.
    """
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise InvalidInputError(
            file=str(path),
            found="no format that can be drawn",
            expected=f"end the name in one of {', '.join(ENDINGS)}",
        )
    if ending == ".png":
        content = _rendered(figure(data), "png")
    else:
        text = svg_text(data) if ending == ".svg" else page_text(data)
        content = text.encode()
    try:
        path.write_bytes(content)
    except OSError as error:
        raise InvalidInputError(
            file=str(path),
            found=f"cannot be written ({error.strerror})",
            expected="name a file in a folder that exists and is writable",
        ) from error


def svg_text(data: FiguresData, *, titled: bool = True) -> str:
    """Both planes as an SVG whose marks say what they are; the same every time.

    Args:
        data: what to draw.
        titled: write the title and the notes into the drawing.
    """
    drawing, notes = _figure(data, titled)
    text = _rendered(drawing, "svg").decode()
    for name, note in notes.items():
        opened, title = f'<g id="{name}">', f"<title>{escape(note)}</title>"
        text = text.replace(opened, opened + title if note else opened, 1)
    return text


def page_text(data: FiguresData) -> str:
    """Both planes as one HTML page that asks for no other file.

    Pointing at a mark, a region or a cell says what it is; every layer can be hidden.
    """
    svg = svg_text(data, titled=False)
    svg = svg[svg.index("<svg") :]
    script = asset("plot.js")
    return (
        environment()
        .get_template("plot.html")
        .render(
            data=data,
            svg=Markup(svg),
            layers={
                name: text for name, text in LAYERS.items() if f'id="{name}-' in svg
            },
            sheet=_sheet(data.value),
            style=Markup(asset("plot.css")),
            script=Markup(script),
            policy=policy([script]),
        )
    )


def _sheet(value: ValuePlaneData) -> dict[str, Any]:
    """The cells for the page's script: a digit a cell, rows from the top."""
    rows = [row.tolist() for row in value.grid[::-1]]
    return {
        "window": [float(x) for x in value.window],
        "cells": ["".join(_DIGITS[count] for count in row) for row in rows],
    }


def _figure(data: FiguresData, titled: bool = True) -> tuple[Any, dict[str, str]]:
    """The figure, and for the id of each mark what it says."""
    from matplotlib.figure import Figure

    notes: dict[str, str] = {}

    def note(mark: Any, layer: Layer, text: str) -> None:
        name = f"{layer}-{len(notes)}"
        mark.set_gid(name)
        notes[name] = text

    drawing: Any = Figure(figsize=_SIZE, layout="constrained")
    drawing.get_layout_engine().set(rect=(0, _LEGEND, 1, 1 - _LEGEND))
    left, right = drawing.subplots(1, 2)
    plot_value_plane(left, data.value, note)
    plot_joint_plane(right, data.joint, note)
    if titled:
        drawing.suptitle(_plain(data.title), fontsize=15)
    if titled and data.notes:
        drawing.text(0.5, 0.012, _plain(" ".join(data.notes)), fontsize=9, ha="center")
    return drawing, notes


def _plain(text: str) -> str:
    """Text in which a dollar is a dollar, not the beginning of a formula."""
    return text.replace("$", r"\$")


def _rendered(drawing: Any, form: str) -> bytes:
    import matplotlib

    stream = io.BytesIO()
    fixed = {"svg.hashsalt": "cuspaudit", "svg.fonttype": "path"}
    with matplotlib.rc_context(fixed):
        metadata = {"Date": None} if form == "svg" else None
        drawing.savefig(stream, format=form, dpi=_DPI, metadata=metadata)
    return stream.getvalue()
