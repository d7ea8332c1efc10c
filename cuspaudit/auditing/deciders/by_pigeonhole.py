"""The postures of one pose by aspect: cuspidality without a path.

Two postures of one pose in one aspect make an arm cuspidal; so do more postures than
there are aspects. Both the postures and their aspects are exact here: no path is
searched, and none is given. Which pose to look at is proposed in floating point.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.points.parametrization import RealPoint
from cuspaudit.algebra.ring import Rational, rational
from cuspaudit.algebra.univariate import PRECISIONS
from cuspaudit.auditing.answer import Answer, Reason
from cuspaudit.auditing.aspects import aspect_components
from cuspaudit.auditing.case import Case
from cuspaudit.auditing.evidence import Crowd, Label
from cuspaudit.count import Count
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    AssumptionError,
    PrecisionError,
    RetryableError,
    UnableError,
)
from cuspaudit.geometry.torus.components import TorusComponents
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.postures.exact import exact_postures, real_postures
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.runtime.clock import Clock

__all__ = [
    "by_pigeonhole",
    "crowded_aspects",
    "crowded_pose",
    "postures_by_aspect",
]

Array = NDArray[np.float64]

_POSES = 64
_EXACT = 8
_PARTS = 32


def by_pigeonhole(case: Case, clock: Clock) -> Answer | None:
    """CUSPIDAL by a pose with two postures in one aspect, exactly; no path is given.

    A model that only comes near the arm is not asked: it would speak of another arm.
    """
    found, chain = case.so_far, case.model.chain
    if found is None or not found.is_open_for(Reason.NO_THEOREM):
        return None
    if chain.task != "pose" or chain.kinds != ("revolute",) * 6:
        return None
    if not case.model.is_exact:
        return None
    try:
        clock.step("pigeon-hole")
        crowd = crowded_pose(case.model, case.seed)
    except UnableError:
        return None
    if crowd is None:
        return None
    return replace(
        found,
        verdict=Verdict.CUSPIDAL,
        why=f"{crowd.sentence()}; no path between them was proved",
        rests_on=crowd.grounds,
        engine="pigeon-hole",
        postures=found.more_postures(Count(crowd.count, False)),
        crowd=crowd,
        undecided=None,
    )


def crowded_pose(
    model: ExactModel, seed: int = 0, timeout: float | None = None
) -> Crowd | None:
    """A pose with two postures in one aspect, proved; None when none was met.

    Args:
        model: six revolute joints.
        seed: of the rational postures whose poses are looked at.
        timeout: of covers, as in ``aspect_components``.

    Raises:
        UnableError: the aspects or the postures are out of reach.
    """
    components = aspect_components(model, timeout)
    for tangents in _proposed(model, components, seed):
        with suppress(AssumptionError, RetryableError):
            found, grounds = _placed(model, components, tangents)
            if crowded_aspects(found):
                return Crowd(model, tangents, found, (*grounds, *components.grounds))
    return None


def _proposed(
    model: ExactModel, components: TorusComponents, seed: int
) -> Iterator[tuple[Rational, ...]]:
    """Rational postures of whose poses an aspect seems to have two; most first."""
    solver = PostureSolver.of(model.chain)
    zeros = model.zeros
    steps = np.random.default_rng(seed).integers(-2 * _PARTS, 2 * _PARTS, (_POSES, 6))
    given = 2 * np.arctan(steps / _PARTS) - zeros
    most = []
    for k, postures in enumerate(solver.solve(solver.poses(given))):
        labels = (_seen(model, components, q + zeros) for q in postures)
        counts = Counter(label for label in labels if label is not None)
        most.append((max(counts.values(), default=0), k))
    for number, k in sorted(most, reverse=True)[:_EXACT]:
        if number > 1:
            yield tuple(rational(Fraction(int(x), _PARTS)) for x in steps[k])


def _seen(
    model: ExactModel, components: TorusComponents, angles: Array
) -> Label | None:
    circles = model.circles
    return components.component_at(dict(zip(circles, angles.tolist(), strict=True)))


def postures_by_aspect(
    model: ExactModel, tangents: Sequence[Rational], timeout: float | None = None
) -> dict[Label, list[RealPoint]]:
    """The postures of the pose of a rational posture, by the aspect they lie in.

    Args:
        model: six revolute joints.
        tangents: tan(theta_i / 2) of the posture, theta_i the variables of the model.
        timeout: of covers, as in ``aspect_components``.

    Returns:
        label of the aspect -> postures. Two postures under one label prove the arm of
        the model cuspidal. Complete: every posture of the pose is there.

    Raises:
        UnableError: the postures or the aspects are out of reach.
        PrecisionError: a posture is too near to a singular one to be placed.
    """
    return _placed(model, aspect_components(model, timeout), tangents)[0]


def _placed(
    model: ExactModel, components: TorusComponents, tangents: Sequence[Rational]
) -> tuple[dict[Label, list[RealPoint]], tuple[str, ...]]:
    """The postures by aspect, and the grounds on which they are all."""
    postures = exact_postures(model, tangents)
    found: dict[Label, list[RealPoint]] = {}
    for posture in real_postures(postures):
        found.setdefault(_label(components, posture), []).append(posture)
    return found, postures.grounds


def crowded_aspects(found: dict[Label, list[RealPoint]]) -> dict[Label, int]:
    """The aspects with more than one posture of the pose, and how many."""
    return {label: len(here) for label, here in found.items() if len(here) > 1}


def _label(components: TorusComponents, posture: RealPoint) -> Label:
    for bits in PRECISIONS:
        label = components.component(posture.ball(bits))
        if label is not None:
            return label
    raise PrecisionError("aspect of a posture", PRECISIONS[-1])
