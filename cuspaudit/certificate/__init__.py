"""The certificate of a witness and its checker, in ball arithmetic."""

from cuspaudit.certificate.checker import Verification, verify
from cuspaudit.certificate.file import (
    certificate_from_text,
    read_certificate,
    text_from_certificate,
    write_certificate,
)
from cuspaudit.certificate.model import (
    Certificate,
    CertifiedJoint,
    Motion,
    Rotate,
    Task,
    Translate,
    check_certificate,
    printable,
)

__all__ = [
    "Certificate",
    "CertifiedJoint",
    "Motion",
    "Rotate",
    "Task",
    "Translate",
    "Verification",
    "certificate_from_text",
    "check_certificate",
    "printable",
    "read_certificate",
    "text_from_certificate",
    "verify",
    "write_certificate",
]
