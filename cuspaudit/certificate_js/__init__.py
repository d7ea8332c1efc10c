"""The second checker of certificates: JavaScript, written from docs/certificate.md.

It shares nothing with ``cuspaudit.certificate``. What is Python here only hands its
files over.
"""

from cuspaudit.certificate_js.bundle import checker_script

__all__ = ["checker_script"]
