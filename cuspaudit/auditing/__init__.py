"""The audit of one robot: decision, cross-check, report."""

from cuspaudit.auditing.answer import Answer, answer
from cuspaudit.auditing.audit import Audit, Options, audit

__all__ = ["Answer", "Audit", "Options", "answer", "audit"]
