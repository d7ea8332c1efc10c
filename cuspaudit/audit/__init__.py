"""The audit of one robot: decision, cross-check, report."""

from cuspaudit.audit.answer import Answer, answer
from cuspaudit.audit.library import library, open_robot
from cuspaudit.audit.report import Audit, Options, audit

__all__ = ["Answer", "Audit", "Options", "answer", "audit", "library", "open_robot"]
