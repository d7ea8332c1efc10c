"""Cusps of the map of a task, met by Newton's method in floating point.

At a cusp det J = 0 and k . grad det J = 0, k spanning the kernel of J. With the
singular value decomposition J = U S V^T, k the last column of V and u of U, let

    f = +-s_n, the sign that of det J,    g = u . (D_k J) k.

Where s_n is simple both are smooth, up to a sign, f vanishes where det J does, and
there g is a multiple of k . grad det J. Two equations for the joints that move det J:
from random postures a Newton step is the shortest that solves the linear equations.
Where the rank drops by two the search may end as well; a proof refuses it.

The derivative of a column of J is a bracket of columns: with w_i the angular velocity
and v_j the velocity of the tip for unit speed of joint j, d_i v_j = d_j v_i = w_i x v_j
and d_i w_j = w_i x w_j for i <= j, and d_j w_i = 0 for j > i.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import transform
from cuspaudit.runtime.clock import check_time

__all__ = [
    "FoundCusp",
    "Interval",
    "TaskMap",
    "moving_joints",
    "refined_cusp",
    "search_cusps",
]

Array = NDArray[np.float64]
Interval = tuple[float, float] | None

_STARTS = 48
_FEW = 24
_STEPS = 24
_POLISH = 4
_STRIDE = 0.4
_DIFFERENCE = 1e-5
_REACHED = 1e-9
_CLEAR = 1e-13
_MARGIN = 1e-3
_DIGITS = 15
_DISTINCT = 1e-4


@dataclass(frozen=True)
class FoundCusp:
    """A posture that looks like a cusp.

    Attributes:
        posture: joint values.
        slack: the distance to the nearest limit; inf without limits.
        clear: how far it is from a cusp that is degenerate, in units of no meaning.
    """

    posture: tuple[float, ...]
    slack: float
    clear: float


def search_cusps(
    chain: Chain,
    limits: Sequence[Interval],
    seed: int = 0,
    starts: int | None = None,
) -> list[FoundCusp]:
    """Postures inside the limits that look like cusps, the clearest first.

    Args:
        chain: three joints and task "position", or six and "pose", a virtual joint
            included.
        limits: for each joint an interval, or None.
        seed: of the random starts.
        starts: how many there are; None for a number that suits the arm.
    """
    starts = starts or (_STARTS if len(chain.joints) > 3 else _FEW)
    rng = np.random.default_rng(seed)
    ends = np.array([_span(chain, k, limits[k]) for k in range(len(chain.joints))])
    low, high = ends.T
    q = rng.uniform(low, high, (starts, len(low)))
    fixed = [k for k in range(len(low)) if k not in moving_joints(chain)]
    q[:, fixed] = (low + high)[fixed] / 2
    found = _settled(chain, limits, q, _STEPS)
    found.sort(key=lambda cusp: -cusp.clear * min(cusp.slack, 1.0))
    return _distinct(found)


def refined_cusp(
    chain: Chain, limits: Sequence[Interval], posture: Sequence[float]
) -> FoundCusp | None:
    """The cusp of a chain next to that of a slightly different one."""
    found = _settled(chain, limits, np.array([posture]), _POLISH)
    return found[0] if found else None


def moving_joints(chain: Chain) -> range:
    """The joints that move det J, counted from 0."""
    count = len(chain.joints)
    return range(1, count if count == 3 else count - 1)


def _settled(
    chain: Chain, limits: Sequence[Interval], q: Array, steps: int
) -> list[FoundCusp]:
    """The cusps that Newton's method reaches from the postures ``q``."""
    map_ = TaskMap(chain)
    ends = np.array([pair or (-np.inf, np.inf) for pair in limits])
    low, high = ends.T
    margin = np.where(np.isfinite(high - low), _MARGIN * (high - low), 0.0)
    with np.errstate(all="ignore"):
        for _ in range(steps):
            check_time("cusp")
            q = np.clip(q + map_.step(q), low + margin, high - margin)
        q = np.round(q + map_.step(q), _DIGITS)
        left = np.abs(map_.conditions(q)[0]).max(1)
        clear = map_.clearness(q)
    slack = np.minimum(q - low, high - q).min(1)
    good = (left < _REACHED) & (slack > 0) & (clear > _CLEAR)
    return [
        FoundCusp(tuple(map(float, q[k])), float(slack[k]), float(clear[k]))
        for k in np.flatnonzero(good)
    ]


def _distinct(found: list[FoundCusp]) -> list[FoundCusp]:
    kept: list[FoundCusp] = []
    for cusp in found:
        here = np.array(cusp.posture)
        if all(np.abs(here - other.posture).max() > _DISTINCT for other in kept):
            kept.append(cusp)
    return kept


def _span(chain: Chain, k: int, pair: Interval) -> tuple[float, float]:
    """Where the starts of one joint lie."""
    if pair is not None:
        width = pair[1] - pair[0]
        return pair[0] + _MARGIN * width, pair[1] - _MARGIN * width
    return (-1.0, 1.0) if chain.joints[k].kind == "prismatic" else (-np.pi, np.pi)


class TaskMap:
    """The map of a task at many postures; lengths in units of the arm's size.

    Args:
        chain: three joints, or six of a pose.
    """

    def __init__(self, chain: Chain) -> None:
        self.before = [transform(joint.before) for joint in chain.joints]
        self.tool = transform(chain.tool)
        size = sum(np.linalg.norm(m[:3, 3]) for m in (*self.before, self.tool)) or 1.0
        self.size = float(size)
        axes = [np.array([float(x) for x in joint.axis]) for joint in chain.joints]
        self.axes = [axis / np.linalg.norm(axis) for axis in axes]
        self.turns = np.array([kind == "revolute" for kind in chain.kinds])
        self.moving = list(moving_joints(chain))

    def columns(self, q: Array) -> tuple[Array, Array]:
        """Angular velocities and tip velocities of the joints, (m, n, 3) each."""
        axes, origins, placed = self._placed(q)
        tip = placed[:, :3, 3]
        n = np.stack(axes, 1)
        arm = tip[:, None] - np.stack(origins, 1)
        turns = self.turns[None, :, None]
        v = np.where(turns, _cross(n, arm) / self.size, n)
        return np.where(turns, n, 0.0), v

    def poses(self, q: Array) -> Array:
        """The poses of the tip, (m, 4, 4), in the unit of the chain."""
        return self._placed(q)[2]

    def matrices(self, q: Array) -> Array:
        """J at many postures, (m, 3, 3) or (m, 6, 6)."""
        w, v = self.columns(q)
        matrix = np.concatenate([v, w], 2) if w.shape[1] == 6 else v
        return np.swapaxes(matrix, 1, 2)

    def determinants(self, q: Array) -> Array:
        """Det J at many postures, (m,)."""
        return np.asarray(np.linalg.det(self.matrices(q)))

    def _placed(self, q: Array) -> tuple[list[Array], list[Array], Array]:
        """The axes and origins of the joints and the pose of the tip."""
        placed = np.broadcast_to(np.eye(4), (len(q), 4, 4))
        axes, origins = [], []
        for k, axis in enumerate(self.axes):
            placed = placed @ self.before[k]
            axes.append(placed[:, :3, :3] @ axis)
            origins.append(placed[:, :3, 3])
            placed = placed @ self._motion(k, q[:, k])
        return axes, origins, placed @ self.tool

    def placed(self, q: Array) -> Array:
        """The frames of the tip, (m, 4, 4), lengths in the chain's unit."""
        placed = np.broadcast_to(np.eye(4), (len(q), 4, 4))
        for k, before in enumerate(self.before):
            placed = placed @ before @ self._motion(k, q[:, k])
        return np.asarray(placed @ self.tool)

    def _motion(self, k: int, value: Array) -> Array:
        motion = np.zeros((len(value), 4, 4))
        motion[:, 3, 3] = 1
        axis = self.axes[k]
        if not self.turns[k]:
            motion[:, :3, :3] = np.eye(3)
            motion[:, :3, 3] = value[:, None] * axis
            return motion
        c, s = np.cos(value)[:, None, None], np.sin(value)[:, None, None]
        beside = np.cross(np.eye(3), axis)
        motion[:, :3, :3] = c * np.eye(3) + (1 - c) * np.outer(axis, axis) + s * beside
        return motion

    def decomposed(self, q: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Per posture f, g, u, k and the second smallest singular value."""
        w, v = self.columns(q)
        is_pose = w.shape[1] == 6
        matrix = np.concatenate([v, w], 2) if is_pose else v
        matrix = np.swapaxes(matrix, 1, 2)
        left, values, right = np.linalg.svd(matrix)
        u, k = left[..., -1], right[:, -1]
        f = values[:, -1] * np.sign(np.linalg.det(matrix))
        return f, self._bracket(w, v, u, k, is_pose), u, k, values[:, -2]

    def _bracket(self, w: Array, v: Array, u: Array, k: Array, is_pose: bool) -> Array:
        """U . (D_k J) k, from the sums of the screws k_i (w_i, v_i) up to a joint."""
        turning, going = k[..., None] * w, k[..., None] * v
        before = np.cumsum(turning, 1) - turning
        bent = _cross(2 * before + turning, going).sum(1)
        total = np.asarray((u[:, :3] * bent).sum(1))
        if is_pose:
            total += (u[:, 3:] * _cross(before, turning).sum(1)).sum(1)
        return total

    def conditions(self, q: Array) -> tuple[Array, Array]:
        """(f, g) at many postures (..., n): (..., 2), with u."""
        f, g, u, _, _ = self.decomposed(q.reshape(-1, q.shape[-1]))
        shape = q.shape[:-1]
        return np.stack([f, g], 1).reshape(*shape, 2), u.reshape(*shape, -1)

    def slopes(self, q: Array) -> tuple[Array, Array]:
        """(f, g) and their derivatives by the moving joints, (m, 2, p)."""
        moved = _DIFFERENCE * np.eye(q.shape[1])[self.moving]
        sides = np.stack([q + e for e in (*moved, *-moved)])
        values, others = self.conditions(np.concatenate([q[None], sides]))
        here, u, around = values[0], others[0], values[1:]
        # g changes sign with u; k enters twice
        around[..., 1] *= np.sign((u * others[1:]).sum(-1))
        count = len(moved)
        slope = (around[:count] - around[count:]) / (2 * _DIFFERENCE)
        return here, np.moveaxis(slope, 0, 2)

    def step(self, q: Array) -> Array:
        """A Newton step, the shortest, no longer than a stride."""
        here, slope = self.slopes(q)
        bad = ~np.isfinite(slope).all((1, 2))
        slope[bad] = 0.0
        full = np.zeros_like(q)
        full[:, self.moving] = -(np.linalg.pinv(slope) @ here[..., None])[..., 0]
        length = np.abs(full).max(1)[:, None]
        return np.asarray(full * np.minimum(1.0, _STRIDE / (length + 1e-300)))

    def clearness(self, q: Array) -> Array:
        """|k . grad g| times the second smallest singular value and |grad f|."""
        _, slope = self.slopes(q)
        *_, k, second = self.decomposed(q)
        along = np.einsum("mp,mp->m", slope[:, 1], k[:, self.moving])
        return np.asarray(np.abs(along) * second * np.linalg.norm(slope[:, 0], axis=1))


def _cross(a: Array, b: Array) -> Array:
    """The vector products of (..., 3) vectors, faster than ``numpy.cross``."""
    (a0, a1, a2), (b0, b1, b2) = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    return np.stack([a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0], -1)
