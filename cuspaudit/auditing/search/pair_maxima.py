"""Pairs of postures of one pose as evidence, and a way to witnesses [mathematics 6.4].

An arm of a compact task is noncuspidal if and only if no local maximum of |h h'| over
its pairs has both ends in one aspect. The maxima are looked for by ascents from seeded
random pairs (`pair_space`). That the list is complete is not proved: what it says of
noncuspidal arms is evidence, with an estimate of what it misses. A maximum with both
ends in one aspect proposes a witness, and its certificate proves it. For three joints
`cuspidality.pair_decision` is complete.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.angles import separation, shortest_turn
from cuspaudit.auditing.aspects import aspect_components
from cuspaudit.auditing.evidence import PairMaximum, PairRecord
from cuspaudit.auditing.search.aspect_routing import AspectRouting, route_aspects
from cuspaudit.auditing.search.pair_space import Maxima, PairSpace
from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus.function import TorusFunction
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel, revolute_circles

__all__ = ["pair_maxima"]

Array = NDArray[np.float64]
Judge = Callable[[Array, Array], bool]

STARTS = 512
_ROUNDS = 3
_EQUAL = 1e-3
PROVED, ROUTED = "exact labels", "ascents of |det J|"


def pair_maxima(
    model: ExactModel,
    seed: int = 0,
    progress: Callable[[str], None] = lambda step: None,
    starts: int = STARTS,
) -> PairRecord:
    """Look for the local maxima of |h h'| over the pairs of an arm.

    Args:
        model: revolute joints, a task of as many dimensions; det J not identically 0.
        seed: of the random pairs.
        progress: called before each round; an UnableError it raises ends the
            search with what has been met.
        starts: random starts a round; a part of them become pairs.

    Raises:
        UnableError: a joint is prismatic, or the time was up before the first round,
            or floating point failed.
        DegenerateMapError: det J vanishes identically.
    """
    h = TorusFunction.from_polynomial(
        model.ring, revolute_circles(model), jacobian_determinant(model)
    )
    zeros = model.zeros
    space = PairSpace.of(model.chain, h, zeros)
    rng, rounds = np.random.default_rng(seed), list[Maxima]()
    progress("pairs: aspects")
    together, told_by = _judge(model, seed)
    for number in range(_ROUNDS):
        try:
            progress(f"pairs: round {number + 1} of {_ROUNDS}")
        except UnableError:
            break
        rounds.append(_round(space, starts, rng))
    return _record(space, rounds, together, told_by, seed)


def _round(space: PairSpace, starts: int, rng: np.random.Generator) -> Maxima:
    try:
        with np.errstate(all="ignore"):
            return space.maxima(space.random_pairs(starts, rng))
    except np.linalg.LinAlgError as error:
        raise UnableError("pairs", str(error)) from None


def _judge(model: ExactModel, seed: int) -> tuple[Judge, str]:
    """Whether two postures lie in one aspect, and how that is told."""
    circles = revolute_circles(model)
    zeros = model.zeros
    try:
        components = aspect_components(model)
    except UnableError:
        routing: AspectRouting = route_aspects(model, seed)
        return (
            lambda p, q: routing.routing.connected(*routing.on_torus(np.array([p, q]))),
            ROUTED,
        )

    def together(p: Array, q: Array) -> bool:
        first, second = (
            components.component_at(dict(zip(circles, x + zeros, strict=True)))
            for x in (p, q)
        )
        return first is not None and first == second

    return together, PROVED


def _record(
    space: PairSpace, rounds: list[Maxima], together: Judge, told_by: str, seed: int
) -> PairRecord:
    empty = np.empty((0, 2, len(space.zeros)))
    pairs = np.concatenate([empty, *(found.pairs for found in rounds)])
    heights = space.heights(pairs)
    largest = float(np.abs(space.h(pairs + space.zeros)).max(initial=0.0))
    maxima = []
    for group in _groups(pairs[..., space.inner]):
        first, second = shortest_turn(pairs[group[0]])
        level = float(np.exp(heights[group[0]])) / largest**2
        sign = 1 if space.h(first + space.zeros) > 0 else -1
        ends = (tuple(map(float, first)), tuple(map(float, second)))
        one = together(first, second)
        maxima.append(PairMaximum(ends, sign, level, len(group), one))
    lost = sum(found.lost for found in rounds)
    once = sum(found.found == 1 for found in maxima)
    return PairRecord(
        pairs=len(pairs) + lost,
        lost=lost,
        maxima=tuple(sorted(maxima, key=lambda found: -found.level)),
        missed=once / len(pairs) if len(pairs) else None,
        together=sum(found.together for found in maxima),
        aspects=told_by,
        seed=seed,
    )


def _groups(pairs: Array) -> list[list[int]]:
    """The indices of equal pairs; the order of the ends does not count."""
    groups: list[list[int]] = []
    left = list(range(len(pairs)))
    while left:
        here = pairs[left[0]]
        rest = pairs[left]
        apart = [separation(rest, x).max((1, 2)) for x in (here, here[::-1])]
        same = np.minimum(*apart) < _EQUAL
        groups.append([k for k, equal in zip(left, same, strict=True) if equal])
        left = [k for k, equal in zip(left, same, strict=True) if not equal]
    return groups
