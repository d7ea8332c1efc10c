"""Certificates of verdicts and their checker, in ball arithmetic."""

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
    CuspCertificate,
    Limits,
    Motion,
    Numbers,
    PairsCertificate,
    PathCertificate,
    Relation,
    Rotate,
    StructureCertificate,
    Task,
    Tolerance,
    Translate,
    Word,
    check_certificate,
    printable,
)

__all__ = [
    "Certificate",
    "CertifiedJoint",
    "CuspCertificate",
    "Limits",
    "Motion",
    "Numbers",
    "PairsCertificate",
    "PathCertificate",
    "Relation",
    "Rotate",
    "StructureCertificate",
    "Task",
    "Tolerance",
    "Translate",
    "Verification",
    "Word",
    "certificate_from_text",
    "check_certificate",
    "printable",
    "read_certificate",
    "text_from_certificate",
    "verify",
    "write_certificate",
]
