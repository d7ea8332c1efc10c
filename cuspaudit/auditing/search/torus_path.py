"""Paths on the torus of joints 2 to 5 that keep h = det J away from zero.

A search in floating point: what it finds is proposed, and proved or refused by its
certificate. Points are (..., 4) angles, paths (m, 4) way points, not reduced modulo
2 pi. Everything is asked for the sign s of h; its height at x is s h(x).
"""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import FULL_TURN, shortest_turn
from cuspaudit.auditing.search.torus_determinant import TorusDeterminant

__all__ = ["height_of", "straight", "tidy"]

Array = NDArray[np.float64]

_SAMPLES = 48
_FINE = 200
_SPACING = 0.01
_LOW = 0.02
_KEEP = 0.9
_CUTS = 2
_TURNS = np.array(list(product((0, 1), repeat=4)), dtype=np.float64)


def _lowest(
    h: TorusDeterminant, sign: Array, start: Array, end: Array, samples: int = _SAMPLES
) -> Array:
    """The smallest sampled s h on segments (..., 4) to (..., 4): (...)."""
    t = np.linspace(0.0, 1.0, samples)[:, None]
    points = start[..., None, :] + t * (end - start)[..., None, :]
    return np.asarray((sign[..., None] * h(points)).min(-1))


def straight(
    h: TorusDeterminant, sign: Array, start: Array, end: Array
) -> tuple[Array, Array]:
    """The best straight path of each pair: its end (..., 4) and lowest s h on it.

    Each joint may turn the short way or the long way round: sixteen paths a pair.
    """
    short = shortest_turn(end - start)
    long = short - FULL_TURN * np.where(short > 0, 1.0, -1.0)
    moves = short[..., None, :] * (1 - _TURNS) + long[..., None, :] * _TURNS
    begin = np.broadcast_to(start[..., None, :], moves.shape)
    low = _lowest(h, sign[..., None], begin, begin + moves)
    best = low.argmax(-1)[..., None]
    chosen = np.take_along_axis(moves, best[..., None], -2)[..., 0, :]
    return start + chosen, np.take_along_axis(low, best, -1)[..., 0]


def height_of(h: TorusDeterminant, sign: float, path: Array) -> float:
    """The smallest s h on a path, to about 1e-10 of the largest |h| on it.

    It is sampled every 0.01 rad; where a sample is low, the cubic through the values
    and slopes at its ends is followed in between, so that a narrow dip is seen.
    """
    step = np.diff(path, axis=0)
    counts = np.ceil(np.linalg.norm(step, axis=1) / _SPACING).astype(int) + 1
    which = np.repeat(np.arange(len(step)), counts)
    share = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    move = step[which] / counts[which][:, None]
    begin = path[which] + share[:, None] * move
    value, ahead = sign * h(begin), sign * h(begin + move)
    lowest = float(min(value.min(), ahead.min()))
    low = np.minimum(value, ahead) < _LOW * np.abs(value).max()
    if lowest <= 0 or not low.any():
        return lowest
    slope, then = (
        sign * (h.gradient(x[low]) * move[low]).sum(-1) for x in (begin, begin + move)
    )
    return min(lowest, _lowest_of_cubics(value[low], ahead[low], slope, then))


def _lowest_of_cubics(f0: Array, f1: Array, m0: Array, m1: Array) -> float:
    """The least value in [0, 1] of cubics with these values and slopes at 0 and 1."""
    b, a = 3 * (f1 - f0) - 2 * m0 - m1, 2 * (f0 - f1) + m0 + m1
    with np.errstate(divide="ignore", invalid="ignore"):
        t = m0 / (-b - np.sqrt(b * b - 3 * a * m0))
    t = np.where((t > 0) & (t < 1), t, 0.0)
    return float(np.minimum(f0, f0 + t * (m0 + t * (b + t * a))).min())


def tidy(h: TorusDeterminant, sign: float, path: Array) -> Array:
    """A shorter and smoother path with the same ends, hardly lower than ``path``.

    Way points are left out where the straight way is high enough, then corners are
    cut off (Chaikin), which moves no end.
    """
    floor = _KEEP * height_of(h, sign, path)
    shorter = _shortened(h, sign, path, floor)
    if height_of(h, sign, shorter) < floor:
        return path
    for _ in range(_CUTS if len(shorter) > 2 else 0):
        cut = _corners_cut(shorter)
        if height_of(h, sign, cut) < floor:
            break
        shorter = cut
    return shorter


def _shortened(h: TorusDeterminant, sign: float, path: Array, floor: float) -> Array:
    kept, at = [path[0]], 0
    while at < len(path) - 1:
        ahead = path[at + 1 :]
        start, signs = np.broadcast_to(path[at], ahead.shape), np.full(len(ahead), sign)
        high = _lowest(h, signs, start, ahead, _FINE) >= floor
        at += 1 + int(np.nonzero(high)[0].max(initial=0))
        kept.append(path[at])
    return np.array(kept)


def _corners_cut(path: Array) -> Array:
    before, after = path[:-1], path[1:]
    near, far = 0.75 * before + 0.25 * after, 0.25 * before + 0.75 * after
    inner = np.stack([near, far], axis=1).reshape(-1, 4)[1:-1]
    return np.vstack([path[0], inner, path[-1]])
