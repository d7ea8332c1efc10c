"""Postures of the poses of given postures, as far as floating point meets them.

Six turning joints are solved (`kinematics.postures.numeric`). For arms with slides
Newton's method starts from random postures inside the limits, of the pose of each given
one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import shortest_turn
from cuspaudit.auditing.search.cusps import Interval, TaskMap
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.postures.moving import gap
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.robot.chain import Chain
from cuspaudit.runtime.clock import check_time

__all__ = ["postures_inside"]

Array = NDArray[np.float64]

_STARTS = 64
_NEWTON = 18
_STRIDE = 0.5
_REACHED = 1e-9
_EQUAL = 1e-5


def postures_inside(
    chain: Chain,
    limits: Sequence[Interval],
    given: Array,
    rng: np.random.Generator,
) -> Iterator[Array]:
    """For each given posture (6,) the postures (k, 6) of its pose, itself among them.

    Turning joints are in (-pi, pi], limits only tell where to start.
    """
    if "prismatic" not in chain.kinds:
        try:
            solver = PostureSolver.of(chain)
            yield from solver.solve(solver.poses(given))
        except UnableError:
            pass
        else:
            return
    map_ = TaskMap(chain)
    ends = [_span(map_, k, pair) for k, pair in enumerate(limits)]
    low, high = np.array(ends).T
    for posture in given:
        check_time("limits: search")
        starts = rng.uniform(low, high, (_STARTS, len(low)))
        settled = _settled(map_, np.vstack([posture, starts]), posture)
        yield _distinct(map_, settled)


def _span(map_: TaskMap, k: int, pair: Interval) -> tuple[float, float]:
    if pair is not None:
        return pair
    return (-np.pi, np.pi) if map_.turns[k] else (-2 * map_.size, 2 * map_.size)


def _settled(map_: TaskMap, q: Array, given: Array) -> Array:
    """The postures that Newton's method reaches from ``q``, of the pose of another."""
    target, unit = map_.poses(given[None]), np.where(map_.turns, 1.0, map_.size)
    for _ in range(_NEWTON):
        matrix = map_.matrices(q)
        missing = gap(map_.poses(q), target)[..., 0]
        missing[:, :3] /= map_.size
        step = (np.linalg.pinv(matrix) @ missing[..., None])[..., 0]
        size = np.abs(step).max(1, keepdims=True)
        q = q + unit * step * np.minimum(1.0, _STRIDE / (size + 1e-300))
    missing = gap(map_.poses(q), target)[..., 0]
    error = np.abs(missing).max(1) / max(1.0, map_.size)
    turned = np.where(map_.turns, shortest_turn(q), q)
    return np.asarray(turned[error < _REACHED])


def _distinct(map_: TaskMap, postures: Array) -> Array:
    kept: list[Array] = []
    for posture in postures:
        if not any(_apart(map_, posture, other) < _EQUAL for other in kept):
            kept.append(posture)
    return np.array(kept).reshape(-1, postures.shape[1])


def _apart(map_: TaskMap, a: Array, b: Array) -> float:
    away = np.where(map_.turns, shortest_turn(a - b), (a - b) / map_.size)
    return float(np.abs(away).max())
