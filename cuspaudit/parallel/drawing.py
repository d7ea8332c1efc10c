"""A mechanism at points of V, as line segments: what an animation shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.evaluation import Evaluator
from cuspaudit.parallel.equations import Loops

__all__ = ["Drawing", "drawn"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Drawing:
    """Way points of a mechanism; (m, k, d) points of the plane or of space.

    Attributes:
        bases: (k, d) where the legs begin.
        ends: (m, k, d) ends of cranks and slides; of a length leg its base.
        anchors: (m, k, d) where the legs hold the platform.
    """

    bases: Array
    ends: Array
    anchors: Array


def drawn(loops: Loops, path: Array) -> Drawing:
    """The mechanism at the rows of ``path``, points near V in the order of its ring."""
    functions = [p for leg in loops.ends for point in leg for p in point]
    evaluate = Evaluator(loops.variety.ring, functions)
    values = np.array([evaluate.floats(row) for row in path])
    space = loops.mechanism.space
    shaped = values.reshape(len(path), len(loops.ends), 3, space)
    return Drawing(shaped[0, :, 0], shaped[:, :, 1], shaped[:, :, 2])
