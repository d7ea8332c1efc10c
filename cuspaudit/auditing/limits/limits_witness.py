"""A path inside the joint limits between two postures of one pose, proved.

Paths are proposed round cusps, and through the cells of the box of three joints; those
of the three joints before a wrist are lifted to all six. Each is proved for the model,
which the verdict is about, and shown for the numbers of the file where it is one there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.cusp_witness import CuspWitness
from cuspaudit.auditing.limits.joint_limits import interval_of, rational_limits
from cuspaudit.auditing.limits.limits_result import LimitsAnswer
from cuspaudit.auditing.limits.three_in_box import ThreeInBox
from cuspaudit.auditing.search.around_cusp import paths_around, slack_of
from cuspaudit.auditing.search.lift import close, lift_position
from cuspaudit.auditing.search.lift_inside import centred, lift_wrist_inside
from cuspaudit.auditing.witness import CertifiedPath, certified
from cuspaudit.cuspidality.box_path import box_paths
from cuspaudit.errors import RetryableError
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.robot.chain import Chain, reverse
from cuspaudit.runtime.clock import check_time

__all__ = [
    "first_proved",
    "limited",
    "paths_of_cells",
    "paths_of_cusps",
    "shown",
    "slack",
]

Array = NDArray[np.float64]

_AROUND = 4
_THROUGH = 8


def limited(path: Array, chain: Chain) -> CertifiedPath | None:
    """The path as a witness within the limits of a chain, if it is proved."""
    try:
        closed = close(chain, path)
    except RetryableError:
        return None
    witness = certified(chain, closed, limits=rational_limits(chain))
    return witness if witness.verification.accepted else None


def first_proved(
    paths: Iterable[Array], chains: Sequence[Chain]
) -> CertifiedPath | None:
    """The first of the paths that is proved for the last chain.

    Args:
        paths: proposed.
        chains: the last is the one that the verdict is about; of the others the first
            for which the path is proved as well is shown in its place.
    """
    *others, own = chains
    for path in paths:
        check_time("limits")
        witness = limited(path, own)
        if witness is None:
            continue
        shown = (limited(path, chain) for chain in others if chain != own)
        return next((each for each in shown if each is not None), witness)
    return None


def slack(witness: CertifiedPath) -> float:
    """How near the path of a witness comes to a limit."""
    return slack_of(witness.path, _intervals(witness.chain))


def shown(result: LimitsAnswer, witness: CertifiedPath | None) -> LimitsAnswer:
    """The same with a path to look at, if there is one."""
    if witness is None:
        return result
    return replace(result, witness=witness, slack=slack(witness))


def paths_of_cusps(cusps: Iterable[CuspWitness]) -> Iterator[Array]:
    """Paths round cusps inside the limits."""
    for cusp in cusps:
        limits = _intervals(cusp.chain)
        yield from islice(paths_around(cusp.chain, cusp.posture, limits), _AROUND)


def paths_of_cells(found: Answer, box: ThreeInBox) -> Iterator[Array]:
    """Paths through the cells of the box of three joints, for all joints of the arm.

    Args:
        found: the answer without limits; with the wrist that led to three joints.
        box: of the three joints.
    """
    reduction = found.reduction
    if reduction is None or reduction.regional is None:
        yield from _of_three(found.model, box)
        return
    chain = found.model.chain
    own = reverse(chain) if reduction.is_reversed else chain
    limits = _intervals(chain)[:: -1 if reduction.is_reversed else 1]
    for regional in _of_three(reduction.regional, box):
        try:
            path = lift_wrist_inside(own, regional, limits)
        except RetryableError:
            continue
        yield path[:, ::-1] if reduction.is_reversed else path


def _of_three(model: ExactModel, box: ThreeInBox) -> Iterator[Array]:
    limits = _intervals(model.chain)
    for way in islice(box_paths(box.decision), _THROUGH):
        yield centred(lift_position(model, way), 0, limits)


def _intervals(chain: Chain) -> list[tuple[float, float] | None]:
    return [interval_of(joint) for joint in chain.joints]
