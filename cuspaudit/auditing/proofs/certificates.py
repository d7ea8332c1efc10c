"""The certificate of an audit: what a stranger can check without this program."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from cuspaudit.auditing.proofs.pairs_certificate import pairs_certificate
from cuspaudit.auditing.proofs.structure_certificate import structure_certificate
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.certificate import Certificate, text_from_certificate
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.virtual_joint import with_virtual_joint

if TYPE_CHECKING:
    from cuspaudit.auditing.limits.limits_result import LimitsAnswer

__all__ = ["certificate_of_audit", "certificate_text", "is_of_many_arms"]


def certificate_of_audit(
    audit: FinishedAudit, within: bool = False
) -> Certificate | None:
    """The certificate of the verdict of ``audit``, or None where it has none.

    With a tolerance the one for all its arms, or for those of the largest box that is
    proved. Of a cuspidal verdict that of its witness or its cusp. Of a noncuspidal one
    that of a theorem, or of three joints that of all pairs of postures, for the numbers
    that the verdict is about, or else for those of the file.

    Args:
        audit: what was found.
        within: whether the verdict within the joint limits is meant, if there are any.
    """
    literal = with_virtual_joint(audit.robot.chain)
    if is_of_many_arms(audit, within):
        assert audit.over is not None
        return audit.over.certificate
    if within and audit.within is not None:
        # what limits alone make noncuspidal has no certificate
        if audit.within.verdict is not Verdict.NONCUSPIDAL:
            return _within_limits(audit.within)
        if audit.verdict is not Verdict.NONCUSPIDAL:
            return None
    if audit.witness is not None:
        is_literal = audit.witness.chain == literal
        return replace(
            audit.witness.certificate, numbers="literal" if is_literal else "snapped"
        )
    if audit.answer.cusp is not None:
        cusp = audit.answer.cusp
        is_literal = cusp.chain == literal
        return replace(cusp.certificate, numbers="literal" if is_literal else "snapped")
    if audit.verdict is not Verdict.NONCUSPIDAL:
        return None
    kind = audit.answer.reduction.kind if audit.answer.reduction else ""
    for chain in dict.fromkeys((audit.answer.model.chain, literal)):
        found = structure_certificate(chain, kind) or _of_pairs(chain)
        if found is not None:
            return replace(found, numbers="literal" if chain == literal else "snapped")
    return None


def is_of_many_arms(audit: FinishedAudit, within: bool = False) -> bool:
    """Whether the certificate of ``audit`` is one for every arm of a box."""
    return not within and audit.over is not None and audit.over.certificate is not None


def _within_limits(within: LimitsAnswer) -> Certificate | None:
    if within.witness is not None:
        return within.witness.certificate
    return within.cusp.certificate if within.cusp is not None else None


def certificate_text(audit: FinishedAudit, within: bool = False) -> str | None:
    """The text of `certificate_of_audit`, as a file holds it."""
    certificate = certificate_of_audit(audit, within)
    return None if certificate is None else text_from_certificate(certificate)


def _of_pairs(chain: Chain) -> Certificate | None:
    return pairs_certificate(chain) if chain.task == "position" else None
