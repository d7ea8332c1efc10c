"""What the page of a locked joint draws, as data: the arm on each witness's path."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.free_joint.stretch import FreeJoint, LockWitness
from cuspaudit.pictures.tool_path import stick
from cuspaudit.viz.lock_page import render_lock_page

__all__ = ["lock_drawing", "lock_page"]

Array = NDArray[np.float64]

_SAMPLES = 41


def lock_page(record: Mapping[str, Any], found: FreeJoint) -> str:
    """The offline page of ``found``; ``record`` is its JSON."""
    return render_lock_page(record, lock_drawing(found))


def lock_drawing(found: FreeJoint) -> list[list[list[list[float]]] | None]:
    """For each stretch the arm along its witness's path, base to tip; None without.

    The locked joint stands at the value in the middle.
    """
    return [
        None if each.witness is None else _moved(found, each.witness)
        for each in found.stretches
    ]


def _moved(found: FreeJoint, witness: LockWitness) -> list[list[list[float]]]:
    rows = _sampled(witness.path)
    whole = np.insert(rows, found.number - 1, witness.value, axis=1)
    return [stick(found.chain, row) for row in whole]


def _sampled(path: Array) -> Array:
    """The path at equal steps of its length."""
    length = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
    at = np.linspace(0.0, length[-1], _SAMPLES)
    return np.column_stack([np.interp(at, length, column) for column in path.T])
