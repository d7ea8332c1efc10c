"""The certificate of a run of a tool path that ends in another posture."""

from __future__ import annotations

import numpy as np

from cuspaudit.auditing.search.lift import close
from cuspaudit.auditing.witness import certified
from cuspaudit.certificate import text_from_certificate
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.toolpath.traced_path import TracedPath

__all__ = ["run_certificate"]


def run_certificate(trace: TracedPath) -> str:
    """The certificate, as text, of the first run that changes posture and is proved.

    Its path goes straight from point to point of the run, its last point moved to the
    exact pose of the first: it is proved anew, by the checker.

    Raises:
        UnableError: no run changes posture, or none of them can be certified.
    """
    arm, reason = trace.arm, "no run of this path ends in another posture"
    for index in trace.changing:
        run = trace.runs[index]
        if run.free is None:
            continue
        rows = run.free.points[:, :-1] * arm.scales
        values = rows[: np.searchsorted(run.free.points[:, -1], run.at, "right")]
        try:
            witness = certified(arm.chain, close(arm.chain, values))
        except RetryableError as unlucky:
            reason = str(unlucky)
            continue
        if witness.verification.accepted:
            return text_from_certificate(witness.certificate)
        reason = witness.verification.reason
    raise UnableError("certificate", reason)
