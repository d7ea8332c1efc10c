"""Both planes of an arm that three joints decide, on one sheet."""

from __future__ import annotations

import string
from collections.abc import Sequence
from typing import Any, Protocol

from cuspaudit.viz.plot.sheet import Note, Sheet
from cuspaudit.viz.plot.three_joints import (
    LAYERS,
    JointPlaneData,
    ValuePlaneData,
    plot_joint_plane,
    plot_value_plane,
)

__all__ = ["FiguresData", "planes_sheet"]

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


def planes_sheet(data: FiguresData) -> Sheet:
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


def _cells(value: ValuePlaneData) -> dict[str, Any]:
    """The numbers of postures: a digit a cell, rows from the top."""
    rows = [row.tolist() for row in value.grid[::-1]]
    return {
        "window": [float(x) for x in value.window],
        "cells": ["".join(_DIGITS[count] for count in row) for row in rows],
    }
