"""The audit of one robot: decision, cross-check, report."""

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.audit import Audit, Options, audit
from cuspaudit.auditing.deciders.decide import answer

__all__ = ["Answer", "Audit", "Options", "answer", "audit"]
