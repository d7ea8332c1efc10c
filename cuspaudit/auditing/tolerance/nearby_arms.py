"""Arms of a box, built one by one: what play makes of an arm that a structure decides.

Both axes of each link are off by as much as the box allows, in random directions. Each
arm is searched for a path between two postures of one pose, and a path that is met is
proved for its numbers. Arms are sampled: what no arm showed may still be there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.cusp_witness import find_cusps
from cuspaudit.auditing.deciders.by_search import search_witness
from cuspaudit.auditing.search.around_cusp import paths_around
from cuspaudit.auditing.tolerance.box import ToleranceBox
from cuspaudit.auditing.witness import CertifiedPath, certified
from cuspaudit.errors import UnableError
from cuspaudit.robot.chain import Angle, Chain, Motion, Rotation, Translation
from cuspaudit.robot.frames import jacobian
from cuspaudit.robot.tolerance import LooseNumber
from cuspaudit.runtime.clock import Clock, check_time

__all__ = ["NearbyArms", "built_arm", "nearby_arms"]

Array = NDArray[np.float64]
_ARMS = 24
_POSES = 32
_AROUND = 12
_HEIGHTS = 2000
_INSIDE = Fraction(999_999, 1_000_000)
"""A little less than the box, as directions are rounded."""


@dataclass(frozen=True, slots=True)
class NearbyArms:
    """What was seen of arms at the edge of a box.

    Attributes:
        arms: how many were looked at.
        cuspidal: of how many a path is proved.
        clearance: the largest of their paths, as a share of the largest |det J| met;
            None when none is cuspidal; with slides, as |det J| has no largest value.
        seed: of the random directions.
    """

    arms: int
    cuspidal: int
    clearance: float | None
    seed: int


def nearby_arms(
    chain: Chain, box: ToleranceBox, seed: int, clock: Clock, count: int = _ARMS
) -> NearbyArms:
    """Look at ``count`` arms at the edge of the box, or at fewer when time is up."""
    rng = np.random.default_rng(seed)
    seen, met = 0, list[CertifiedPath]()
    for number in range(count):
        try:
            clock.step(f"tolerance: arm {number + 1} of {count}")
            check_time("tolerance")
            witness = _widest(built_arm(chain, box, rng), seed, clock)
        except UnableError:
            break
        seen += 1
        if witness is not None:
            met.append(witness)
    known = [each.clearance for each in met if each.clearance is not None]
    return NearbyArms(seen, len(met), max(known, default=None), seed)


def built_arm(chain: Chain, box: ToleranceBox, rng: np.random.Generator) -> Chain:
    """An arm at the edge of the box, exactly: each loose number at one of its ends."""
    links = [list(joint.before) for joint in chain.joints] + [list(chain.tool)]
    for placed in sorted(box.numbers, key=lambda each: -each.after):
        links[placed.link].insert(placed.after + 1, _end(placed.number, rng))
    if box.axes is not None:
        links = [[*_off(box, rng), *link, *_off(box, rng)] for link in links]
    *before, tool = map(tuple, links)
    joints = tuple(
        replace(joint, before=motions)
        for joint, motions in zip(chain.joints, before, strict=True)
    )
    return replace(chain, joints=joints, tool=tool)


def _end(number: LooseNumber, rng: np.random.Generator) -> Motion:
    """The motion by one end of a loose number."""
    way = number.within * (1 if rng.random() < 0.5 else -1)
    if number.kind == "turn":
        return Rotation(number.axis, Angle(radians=way))
    x, y, z = number.axis
    return Translation((x * way, y * way, z * way))


def _off(box: ToleranceBox, rng: np.random.Generator) -> tuple[Motion, ...]:
    """A play of full length and full angle."""
    v, w = (
        tuple(Fraction(round(x, 9)) for x in (row / np.linalg.norm(row)).tolist())
        for row in rng.normal(size=(2, 3))
    )
    way = (v[0] * box.lengths, v[1] * box.lengths, v[2] * box.lengths)
    inside = (way[0] * _INSIDE, way[1] * _INSIDE, way[2] * _INSIDE)
    turn = Rotation((w[0], w[1], w[2]), Angle(radians=box.angles * _INSIDE))
    return Translation(_short(inside)), turn


def _short(vector: tuple[Fraction, ...]) -> tuple[Fraction, Fraction, Fraction]:
    """Each number as the decimal that prints as its float."""
    x, y, z = (Fraction(repr(float(number))) for number in vector)
    return x, y, z


def _widest(chain: Chain, seed: int, clock: Clock) -> CertifiedPath | None:
    """The widest path that is met and proved; None without one."""
    if chain.task == "pose":
        return search_witness(chain, seed, clock.step, _POSES).witness
    free = [None] * len(chain.joints)
    largest = _largest(chain, seed)
    found = []
    for cusp in islice(find_cusps(chain, seed, inside=False), 1):
        for path in islice(paths_around(chain, cusp.posture, free), _AROUND):
            witness = certified(chain, path, largest)
            if witness.verification.accepted:
                found.append(witness)
    return max(found, key=lambda witness: witness.clearance or 0.0, default=None)


def _largest(chain: Chain, seed: int) -> float:
    """The largest |det J| of random postures."""
    rng = np.random.default_rng(seed)
    postures = rng.uniform(-np.pi, np.pi, (_HEIGHTS, len(chain.joints)))
    return max(abs(float(np.linalg.det(jacobian(chain, q)))) for q in postures)
