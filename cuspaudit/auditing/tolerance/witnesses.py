"""Paths that may stand play: those of a search, by how much they stand to first order.

The widest path of an audit has the largest |det J|. Of play another is the best: its
ends lie far from singular postures too, as the second posture moves the less there.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.cusp_witness import CuspWitness, find_cusps
from cuspaudit.auditing.search.around_cusp import paths_around
from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.search.six_joints import search
from cuspaudit.auditing.tolerance.box import ToleranceBox, over
from cuspaudit.auditing.witness import CertifiedPath, certificate_of
from cuspaudit.certificate import PathCertificate
from cuspaudit.certificate.loose.play_estimate import estimated_room
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import jacobian
from cuspaudit.runtime.clock import Progress, check_time

__all__ = ["paths_with_room"]

Array = NDArray[np.float64]
_KEPT = 40
_LOW = 0.05
_TINY = 1e-4
_POSES = 64
_CUSPS = 2
_AROUND = 4


def paths_with_room(
    chain: Chain,
    witness: CertifiedPath | None,
    box: ToleranceBox,
    seed: int,
    progress: Progress = lambda step: None,
) -> list[tuple[float, PathCertificate]]:
    """Proved paths, and about how many times the box each stands; the best first.

    Args:
        chain: whose numbers the certificates hold.
        witness: of the audit, whose path is among those that are looked at.
        box: the play.
        seed: of the search.
        progress: called with each step of the search.
    """
    found = []
    tiny = box.times(_TINY)
    for path in _paths(chain, witness, seed, progress):
        check_time("tolerance")
        for way in (path, path[::-1]):
            try:
                closed = close(chain, way)
            except RetryableError:
                continue
            sign = int(np.sign(np.linalg.det(jacobian(chain, closed[0]))))
            certificate = certificate_of(chain, sign, closed)
            claim = over(certificate, tiny)
            assert isinstance(claim, PathCertificate)
            room = estimated_room(claim) * _TINY
            if room > 0:
                found.append((room, certificate))
    found.sort(key=lambda pair: -pair[0])
    return found


def _paths(
    chain: Chain, witness: CertifiedPath | None, seed: int, progress: Progress
) -> Iterator[Array]:
    """The path of the audit, those of a search, and some round cusps."""
    if witness is not None:
        yield witness.path
    if chain.task == "pose" and "prismatic" not in chain.kinds:
        try:
            found = search(chain, seed, progress, _POSES, _KEPT)
        except UnableError:
            return
        yield from (
            proposal.path
            for proposal in found.proposals
            if proposal.clearance > _LOW * found.proposals[0].clearance
        )
    elif chain.task in ("position", "pose"):
        cusps: Iterator[CuspWitness] = find_cusps(chain, seed, inside=False)
        for cusp in islice(cusps, _CUSPS):
            free = [None] * len(cusp.posture)
            yield from islice(paths_around(chain, cusp.posture, free), _AROUND)
