"""A sheet of drawings as PNG, SVG or one HTML page that opens offline.

SVG and HTML name every mark when it is pointed at: the marks carry ``title`` elements,
and their ids begin with the name of their layer.
"""

from __future__ import annotations

import io
from html import escape
from pathlib import Path
from typing import Any

from markupsafe import Markup

from cuspaudit.errors import InvalidInputError
from cuspaudit.viz.offline import asset, environment, policy
from cuspaudit.viz.plot.data import Figures
from cuspaudit.viz.plot.sheet import Sheet
from cuspaudit.viz.plot.three_joints import planes_sheet

__all__ = ["ENDINGS", "Drawn", "figure", "page_text", "save_plot", "svg_text"]

ENDINGS = (".png", ".svg", ".html")
_DPI = 150

Drawn = Sheet | Figures
"""A sheet, or the two planes that `planes_sheet` makes one of."""


def figure(data: Drawn) -> Any:
    """The sheet as a matplotlib Figure without any window."""
    return _figure(data)[0]


def save_plot(data: Drawn, path: Path) -> None:
    """Write a sheet to ``path``, in the format its ending names.

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


def svg_text(data: Drawn, *, titled: bool = True) -> str:
    """A sheet as an SVG whose marks say what they are; the same every time.

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


def page_text(data: Drawn) -> str:
    """A sheet as one HTML page that asks for no other file.

    Pointing at a mark, a region or a cell says what it is; every layer can be hidden.
    """
    sheet = _sheet(data)
    svg = svg_text(sheet, titled=False)
    svg = svg[svg.index("<svg") :]
    script = asset("plot.js")
    return (
        environment()
        .get_template("plot.html")
        .render(
            sheet=sheet,
            svg=Markup(svg),
            layers={
                name: text
                for name, text in sheet.layers.items()
                if f'id="{name}-' in svg
            },
            style=Markup(asset("plot.css")),
            script=Markup(script),
            policy=policy([script]),
        )
    )


def _sheet(data: Drawn) -> Sheet:
    return data if isinstance(data, Sheet) else planes_sheet(data)


def _figure(data: Drawn, titled: bool = True) -> tuple[Any, dict[str, str]]:
    """The figure, and for the id of each mark what it says."""
    from matplotlib.figure import Figure

    sheet, notes = _sheet(data), dict[str, str]()

    def note(mark: Any, layer: str, text: str) -> None:
        name = f"{layer}-{len(notes)}"
        mark.set_gid(name)
        notes[name] = text

    drawing: Any = Figure(figsize=sheet.size, layout="constrained")
    sheet.draw(drawing, note)
    if titled:
        drawing.suptitle(_plain(sheet.title), fontsize=15)
    if titled and sheet.notes:
        drawing.text(0.5, 0.012, _plain(" ".join(sheet.notes)), fontsize=9, ha="center")
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
