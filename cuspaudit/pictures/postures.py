"""Postures to look at when there is no path: those of one pose, one aspect a colour.

The postures are found in floating point, for drawing only; the aspect of each is told
by the exact engine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import shortest_turn
from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.aspects import aspect_components
from cuspaudit.auditing.crosscheck.pinocchio_model import reach_scale
from cuspaudit.auditing.crosscheck.singular_postures import random_postures
from cuspaudit.auditing.search.lift import lift_position, lift_wrist, wrist_middle
from cuspaudit.cuspidality.surface_decision import SurfaceDecision
from cuspaudit.cuspidality.surface_path import SurfacePath, posture_angles
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.geometry.torus.components import TorusComponents
from cuspaudit.kinematics.common_direction import common_direction
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.postures.numeric import PostureSolver, is_even
from cuspaudit.pictures.joint_surface import JointSurface
from cuspaudit.robot.chain import Chain, reverse
from cuspaudit.robot.frames import angle_value, frames, jacobian
from cuspaudit.surface.sample_points import Fiber

__all__ = ["ShownPostures", "shown_postures"]

Array = NDArray[np.float64]
Label = tuple[int, ...]
_POSES = 64
_PLACES, _STARTS, _STEPS = 4, 12, 15
_NEAR, _APART = 1e-9, 1e-4


@dataclass(frozen=True)
class ShownPostures:
    """Postures, of one pose where there are several.

    Attributes:
        postures: joint values, rad or the chain's unit.
        aspects: the name of the aspect of each; None where they are not told apart.
    """

    postures: Sequence[Sequence[float]]
    aspects: Sequence[str] | None


def shown_postures(answer: Answer, seed: int = 0) -> ShownPostures:
    """The postures of a pose that has many, sorted by aspect.

    Those of a sample value for a three-joint arm or one reduced to it; those of one of
    a few random places for four joints, or another arm of six revolute ones. Otherwise
    one posture, with every joint at 0.2 rad or a fifth of a unit.

    Args:
        answer: of the exact engine, for a chain whose task is square.
        seed: of the random poses.
    """
    try:
        if answer.model.chain.task == "position-and-angle":
            return _of_an_angle(answer.model, seed)
        if answer.decision is None:
            return _of_a_pose(answer.model, seed)
        return _of_a_sample(answer, answer.decision)
    except UnableError:
        return ShownPostures([[0.2] * len(answer.model.chain.joints)], None)


def _of_an_angle(model: ExactModel, seed: int) -> ShownPostures:
    """The postures that Newton's method meets, of the random place with the most."""
    rng = np.random.default_rng(seed)
    size = reach_scale(model.chain) / 2
    places = random_postures(model, _PLACES, rng, size)
    starts = random_postures(model, _STARTS, rng, size)
    found = [_met(model, first, starts) for first in places]
    return _coloured(model, max(found, key=len))


def _met(model: ExactModel, first: Array, starts: Array) -> Array:
    """The posture ``first``, and others of its place."""
    chain, signs = model.chain, common_direction(model).signs
    turns = np.array([kind == "revolute" for kind in chain.kinds])
    point = frames(chain, first)[-1, :3, 3]
    met = [first]
    for posture in starts:
        for _ in range(_STEPS):
            angle = math.remainder(float(signs @ (first - posture)), 2 * np.pi)
            error = np.r_[point - frames(chain, posture)[-1, :3, 3], angle]
            step = np.linalg.lstsq(jacobian(chain, posture), error, rcond=None)[0]
            posture = posture + step
        gaps = [np.where(turns, np.sin((posture - q) / 2), posture - q) for q in met]
        if np.abs(error).max() < _NEAR and all(np.abs(g).max() > _APART for g in gaps):
            met.append(posture)
    wrapped = shortest_turn(np.array(met))
    return np.where(turns, wrapped, np.array(met))


def _of_a_pose(model: ExactModel, seed: int) -> ShownPostures:
    """The postures of the pose with the most of them, far from singular.

    Raises:
        UnableError: the arm has not six revolute joints, or resists elimination.
    """
    solver = PostureSolver.of(model.chain)
    random = np.random.default_rng(seed).uniform(-np.pi, np.pi, (_POSES, 6))
    found = solver.solve(solver.poses(random))
    heights = [solver.determinants(postures) for postures in found]
    whole = [k for k, height in enumerate(heights) if height.size and is_even(height)]
    if not whole:
        raise UnableError("postures", "no pose was found with all its postures")
    best = max(whole, key=lambda k: (len(found[k]), np.abs(heights[k]).min()))
    return _coloured(model, found[best])


def _coloured(model: ExactModel, postures: Array) -> ShownPostures:
    """The postures by aspect, or by the sign of det J where aspects are not known."""
    try:
        components = aspect_components(model)
    except UnableError:
        heights = [np.linalg.det(jacobian(model.chain, q)) for q in postures]
        order = np.argsort(np.array(heights) < 0, kind="stable")
        return ShownPostures(postures[order].tolist(), None)
    return _named(postures, [_label(model, components, q) for q in postures])


def _label(model: ExactModel, components: TorusComponents, posture: Array) -> Label:
    """The aspect of a posture.

    Raises:
        UnableError: the posture is too near a singular one to tell.
    """
    turned = [
        float(value) + angle_value(joint.zero)
        for joint, value in zip(model.joints, posture, strict=True)
        if joint.kind == "revolute"
    ]
    label = components.component_at(dict(zip(model.circles, turned, strict=True)))
    if label is None:
        raise UnableError("postures", "a posture is too near a singular one to tell")
    return label


def _named(postures: Array, labels: Sequence[Label]) -> ShownPostures:
    """The postures sorted by label, the labels numbered from 1."""
    order = sorted(range(len(labels)), key=lambda i: labels[i])
    numbers = {label: n for n, label in enumerate(sorted(set(labels)), 1)}
    names = [f"aspect {numbers[labels[i]]}" for i in order]
    return ShownPostures([postures[i].tolist() for i in order], names)


def _of_a_sample(answer: Answer, decision: SurfaceDecision) -> ShownPostures:
    """The postures of the sample value with the most of them, far from singular.

    With a wrist each aspect of the three joints is two of the arm's, one for either
    sign of det J: for either side of the wrist [kinematics.reductions].
    """
    reduction = answer.reduction
    model = reduction.regional if reduction else None
    surface = JointSurface(decision, model or answer.model)

    def angles(fiber: Fiber) -> Array:
        found = [posture_angles(decision, p) for p in fiber.postures]
        return np.array(found).reshape(-1, 2)

    def rank(fiber: Fiber) -> tuple[int, float]:
        heights = surface.delta(surface.points_at(angles(fiber)))
        return len(heights), float(np.abs(heights).min(initial=np.inf))

    fiber = max(decision.samples, key=rank)
    ends = angles(fiber)
    postures, aspects = [], []
    for end, posture in zip(ends, fiber.postures, strict=True):
        path = SurfacePath(np.array([ends[0], end]), 1, 1.0, 1.0, 1.0)
        try:
            postures.append(_last(answer, path))
        except RetryableError:
            continue
        aspects.append(decision.graph.aspect(posture) + 1)
    if reduction is not None:
        postures += list(_turned_over(answer, np.array(postures)))
        aspects += [aspect + decision.aspects for aspect in aspects]
    order = np.argsort(aspects, kind="stable")
    names = [f"aspect {aspects[i]}" for i in order]
    return ShownPostures([postures[i].tolist() for i in order], names)


def _last(answer: Answer, path: SurfacePath) -> Array:
    """The posture of all joints at the end of a two-point path of joints 2 and 3."""
    reduction = answer.reduction
    if reduction is None or reduction.regional is None:
        return np.asarray(lift_position(answer.model, path)[-1])
    regional = lift_position(reduction.regional, path)
    lifted = lift_wrist(_wrist_last(answer), regional, (0.0,))[-1]
    return np.asarray(lifted[::-1] if reduction.is_reversed else lifted)


def _wrist_last(answer: Answer) -> Chain:
    """The chain of a wrist arm, taken from tip to base if its wrist comes first."""
    chain, reduction = answer.model.chain, answer.reduction
    return reverse(chain) if reduction and reduction.is_reversed else chain


def _turned_over(answer: Answer, postures: Array) -> Array:
    """The postures with the wrist turned over: joints 4 and 6 by pi, 5 mirrored.

    The mirror is the wrist's singularity, a quarter turn from its middle.
    """
    step = -1 if answer.reduction and answer.reduction.is_reversed else 1
    other = postures[:, ::step].copy()
    middle = wrist_middle(_wrist_last(answer), other[0, :3])
    other[:, 4] = 2 * middle - np.pi - other[:, 4]
    other[:, 3:] += np.array([np.pi, 0.0, np.pi])
    return shortest_turn(other)[:, ::step]
