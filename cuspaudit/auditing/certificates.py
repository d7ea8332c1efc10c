"""The certificate of an audit: what a stranger can check without this program."""

from __future__ import annotations

from dataclasses import replace

from cuspaudit.auditing.pairs_certificate import pairs_certificate
from cuspaudit.auditing.record import Audit
from cuspaudit.auditing.structure_certificate import structure_certificate
from cuspaudit.certificate import Certificate, text_from_certificate
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = ["certificate_of_audit", "certificate_text"]


def certificate_of_audit(audit: Audit) -> Certificate | None:
    """The certificate of the verdict of ``audit``, or None where it has none.

    Of a cuspidal verdict that of its witness. Of a noncuspidal one that of a theorem,
    or of three joints that of all pairs of postures, for the numbers that the verdict
    is about, or else for those of the file.
    """
    literal = with_virtual_joint(audit.robot.chain)
    if audit.witness is not None:
        is_literal = audit.witness.chain == literal
        return replace(
            audit.witness.certificate, numbers="literal" if is_literal else "snapped"
        )
    if audit.verdict is not Verdict.NONCUSPIDAL:
        return None
    kind = audit.answer.reduction.kind if audit.answer.reduction else ""
    for chain in dict.fromkeys((audit.answer.model.chain, literal)):
        found = structure_certificate(chain, kind) or _of_pairs(chain)
        if found is not None:
            return replace(found, numbers="literal" if chain == literal else "snapped")
    return None


def certificate_text(audit: Audit) -> str | None:
    """The text of `certificate_of_audit`, as a file holds it."""
    certificate = certificate_of_audit(audit)
    return None if certificate is None else text_from_certificate(certificate)


def _of_pairs(chain: Chain) -> Certificate | None:
    return pairs_certificate(chain) if chain.task == "position" else None
