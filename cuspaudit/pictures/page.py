"""The offline page of an audit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.pictures.postures import shown_postures
from cuspaudit.robot.formats.urdf.visuals import visuals
from cuspaudit.robot.library import example_robot_data
from cuspaudit.viz import build_scene, render_page, sample_path, sample_postures

__all__ = ["page_text"]


def page_text(
    record: Mapping[str, Any], result: FinishedAudit, proof: str | None
) -> str:
    """The offline page: the witness path, or the postures of one pose.

    Args:
        record: the JSON of ``result``.
        result: the audit.
        proof: its certificate, which the page gives away, or None.
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
    return render_page(record, scene, certificate=proof)
