"""The offline page of an audit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cuspaudit.auditing.proofs.certificates import certificate_text
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.pictures.postures import shown_postures
from cuspaudit.robot.formats.urdf.visuals import visuals
from cuspaudit.robot.library import example_robot_data
from cuspaudit.viz import build_scene, render_page, sample_path, sample_postures

__all__ = ["page_text"]


def page_text(record: Mapping[str, Any], result: FinishedAudit) -> str:
    """The offline page: the witness path, or the postures of one pose.

    It gives away the certificate of what it shows: of the path within the limits where
    it shows that.

    Args:
        record: the JSON of ``result``.
        result: the audit.
    """
    chain = result.shown_chain
    own = len(chain.joints)
    if result.shown_witness is not None:
        frames = sample_path(chain, result.shown_witness.path[:, :own].tolist())
    else:
        shown = shown_postures(result.answer, result.seed)
        rows = [posture[:own] for posture in shown.postures]
        frames = sample_postures(chain, rows, shown.aspects)
    share = example_robot_data()
    shapes = (
        visuals(result.robot, [share] if share else []) if result.robot.urdf else ()
    )
    scene = build_scene(chain, frames, shapes)
    inside = result.within is not None and result.within.witness is not None
    proof = certificate_text(result, within=inside)
    return render_page(record, scene, certificate=proof)
