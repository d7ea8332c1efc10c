"""Both planes of an arm that three joints decide, on one sheet."""

from __future__ import annotations

import string
from typing import Any

from cuspaudit.viz.plot.data import Figures, ValuePlane
from cuspaudit.viz.plot.joint_plane import plot_joint_plane
from cuspaudit.viz.plot.sheet import Note, Sheet
from cuspaudit.viz.plot.value_plane import plot_value_plane

__all__ = ["LAYERS", "planes_sheet"]

_DIGITS = string.digits + string.ascii_lowercase
_LEGEND = 0.17  # the part of the height below both planes
LAYERS = {
    "cells": "cells by number of postures",
    "curve": "critical curves",
    "special": "cusps and nodes",
    "samples": "sample points",
    "aspects": "aspects",
    "roadmap": "roadmap",
    "path": "nonsingular path",
    "limits": "joint limits",
    "postures": "postures of one value",
}


def planes_sheet(data: Figures) -> Sheet:
    """Both planes side by side, the legends below."""

    def draw(figure: Any, note: Note) -> None:
        figure.get_layout_engine().set(rect=(0, _LEGEND, 1, 1 - _LEGEND))
        left, right = figure.subplots(1, 2)
        plot_value_plane(left, data.value, note)
        plot_joint_plane(right, data.joint, note)

    about = (
        "the curve of critical values with its sample points, and the aspects with the "
        "postures of one value"
    )
    cells = _cells(data.value)
    return Sheet(data.title, data.notes, about, LAYERS, draw, (13.0, 8.2), cells)


def _cells(value: ValuePlane) -> dict[str, Any]:
    """The numbers of postures: a digit a cell, rows from the top."""
    rows = [row.tolist() for row in value.grid[::-1]]
    return {
        "window": [float(x) for x in value.window],
        "cells": ["".join(_DIGITS[count] for count in row) for row in rows],
    }
