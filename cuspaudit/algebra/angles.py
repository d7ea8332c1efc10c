"""Angles in floating point, modulo whole turns."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["FULL_TURN", "beside", "separation", "shortest_turn"]

Array = NDArray[np.float64]

FULL_TURN = 2 * np.pi


def shortest_turn(angles: Array) -> Array:
    """``angles`` reduced to [-pi, pi).

    >>> shortest_turn(np.array([3 * np.pi, -0.5]))
    array([-3.14159265, -0.5       ])
    """
    return np.asarray(np.remainder(angles + np.pi, FULL_TURN) - np.pi)


def separation(a: Array, b: Array) -> Array:
    """How far angles are apart, in [0, pi].

    >>> separation(np.array([3.0]), np.array([-3.0])).round(4)
    array([0.2832])
    """
    return np.abs(shortest_turn(a - b))


def beside(way: Array, point: Array, at: int = 0) -> Array:
    """``way``, moved by whole turns so that its entry ``at`` lies next to ``point``.

    >>> beside(np.array([[0.0], [1.0]]), np.array([6.0])).round(4)
    array([[6.2832],
           [7.2832]])
    """
    return np.asarray(way + FULL_TURN * np.round((point - way[at]) / FULL_TURN))
