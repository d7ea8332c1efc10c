"""The certificate as a file: JSON of schema ``cuspaudit/certificate/2``.

::

    {"schema": "cuspaudit/certificate/2",
     "kind": "path" | "lock" | "cusp" | "pairs" | "structure",
     "robot": {"name": "...", "unit": "m",
       "task": "position" | "position-and-angle" | "position-and-axis" | "pose",
       "joints": [{"name": "...", "type": "revolute" | "prismatic",
                   "axis": ["0", "0", "1"], "before": [MOTION, ...]}, ...],
       "tool": [MOTION, ...]},
     "numbers": "literal" | "snapped",                              (may be left out)
     "limits": [["-1", "1"] | null, ...],                           (may be left out)
     "tolerance": {"lengths": "0.0001", "angles": "0.0001"},        (may be left out)
     "made_by": "...",
     and the keys of its kind}

    path: "sign": 1 | -1,
          "postures": [["0.1", ...], ["...", ...]],
          "path": [["0.1", ...], ...]
    lock: "sign": 1 | -1,
          "path": [["0.1", ...], ...],
          "lock": {"joint": 3, "motion": 2, "half": "0.1"},
          "slopes": [["0.1", ...], ...],
          "bends": [["0.1", ...], ...]
    cusp: "posture": ["0.1", ...]
    pairs: "parting": ["0.1", ...],
          "regular": ["0.1", ...]
    structure: "theorem": "spherical wrist",
          "relations": [{"axes": [2, 3], "are": "parallel"}, ...],
          "regular": ["0.1", ...]

    MOTION: {"translate": ["x", "y", "z"]}
            {"rotate": ["ax", "ay", "az"], "angle": {"pi": "1/2", "rad": "0"}}
            {"turn": ["ax", "ay", "az"], "within": "0.001"}
            {"slide": ["ax", "ay", "az"], "within": "0.001"}

Version 1 had the kind "path" only, neither its name nor the three keys that may be
left out. Both versions are read, version 2 is written; docs/certificate.md says what a
checker has to prove.

Every number is a string (see `exact`). No other key is allowed, and none may come
twice: a file that is cut, or that says more than the checker reads, is not a
certificate.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from fractions import Fraction
from pathlib import Path
from typing import Any, NoReturn

from cuspaudit.certificate.model import (
    Certificate,
    CuspCertificate,
    LockCertificate,
    Loose,
    Motion,
    PairsCertificate,
    PathCertificate,
    StructureCertificate,
    Translate,
)
from cuspaudit.certificate.reading import SCHEMA, Place, certificate_from_json
from cuspaudit.certificate.structure.exact import text_from_fraction
from cuspaudit.certificate.well_formed import check_certificate

__all__ = [
    "certificate_from_text",
    "read_certificate",
    "text_from_certificate",
    "write_certificate",
]

LARGEST = 64 * 1024 * 1024
"""The largest file that is read, in bytes."""


def read_certificate(path: str | os.PathLike[str]) -> Certificate:
    """Read a certificate file.

    Args:
        path: the file.

    Returns:
        The certificate, every number exactly as the file has it. It is well formed;
        whether it is true, `verify` says.

    Raises:
        InvalidCertificateError: no such file, or not a certificate; the error names
            the key.
    """
    root = Place(os.fspath(path))
    try:
        with open(path, "rb") as stream:
            content = stream.read(LARGEST + 1)
    except OSError as error:
        root.fail(f"cannot be read ({error.strerror})", "name a certificate file")
    if len(content) > LARGEST:
        root.fail("too long", f"a certificate has at most {LARGEST} bytes")
    try:
        text = content.decode()
    except UnicodeDecodeError:
        root.fail("not text in UTF-8", "name a certificate file")
    return certificate_from_text(text, root.file)


def write_certificate(path: str | os.PathLike[str], certificate: Certificate) -> None:
    """Write ``certificate`` to ``path``, whole or not at all.

    The text goes to a temporary file in the same folder, which then takes the name.

    Raises:
        InvalidCertificateError: the certificate is not well formed, one of its
            numbers is too long, or the file cannot be written.
    """
    target = Path(path)
    text = text_from_certificate(certificate, str(target))
    temporary = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    try:
        temporary.write_text(text, encoding="utf-8")
        os.replace(temporary, target)
    except OSError as error:
        Place(str(target)).fail(
            f"cannot be written ({error.strerror})", "name a file in an existing folder"
        )
    finally:
        temporary.unlink(missing_ok=True)


def certificate_from_text(text: str, file: str = "certificate") -> Certificate:
    """Return the certificate that ``text`` holds; ``file`` is for the messages.

    Raises:
        InvalidCertificateError: the text is not a certificate.
    """
    root = Place(file)
    try:
        value = json.loads(text, object_pairs_hook=_unique, parse_constant=_no_constant)
    except (ValueError, RecursionError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else error
        root.fail(f"not JSON ({reason})", "the file is cut or damaged; make it again")
    certificate = certificate_from_json(value, root)
    check_certificate(certificate, file)
    return certificate


def text_from_certificate(certificate: Certificate, file: str = "certificate") -> str:
    """Return the JSON text of ``certificate``, numbers exact; one line a way point.

    Raises:
        InvalidCertificateError: the certificate is not well formed, or one of its
            numbers is too long to be written.
    """
    check_certificate(certificate, file)
    try:
        rows = _json_from_certificate(certificate)
    except ValueError as error:
        Place(file).fail("a number is too long", str(error))
    lines = [f"{json.dumps(key)}: {_text(key, rows[key])}" for key in rows]
    return "{" + ",\n ".join(lines) + "}\n"


def _text(key: str, value: Any) -> str:
    """The JSON text of one top-level value, its list rows on lines of their own."""
    if key == "path":
        return "[\n  " + ",\n  ".join(json.dumps(row) for row in value) + "]"
    return json.dumps(value)


def _json_from_certificate(certificate: Certificate) -> dict[str, Any]:
    def texts(row: Iterable[Fraction]) -> list[str]:
        return [text_from_fraction(Fraction(number)) for number in row]

    def motion(motion: Motion) -> dict[str, Any]:
        if isinstance(motion, Translate):
            return {"translate": texts(motion.vector)}
        if isinstance(motion, Loose):
            (within,) = texts((motion.within,))
            return {motion.kind: texts(motion.axis), "within": within}
        pi, rad = texts((motion.half_turns, motion.radians))
        return {"rotate": texts(motion.axis), "angle": {"pi": pi, "rad": rad}}

    joints = [
        {
            "name": joint.name,
            "type": joint.kind,
            "axis": texts(joint.axis),
            "before": [motion(each) for each in joint.before],
        }
        for joint in certificate.joints
    ]
    found: dict[str, Any] = {
        "schema": SCHEMA,
        "kind": "",
        "robot": {
            "name": certificate.robot_name,
            "task": certificate.task,
            "unit": certificate.unit,
            "joints": joints,
            "tool": [motion(each) for each in certificate.tool],
        },
    }
    if certificate.numbers is not None:
        found["numbers"] = certificate.numbers
    if certificate.limits is not None:
        found["limits"] = [pair and texts(pair) for pair in certificate.limits]
    if certificate.tolerance is not None:
        lengths, angles = texts(
            (certificate.tolerance.lengths, certificate.tolerance.angles)
        )
        found["tolerance"] = {"lengths": lengths, "angles": angles}
    if isinstance(certificate, PathCertificate):
        found["kind"] = "path"
        found["sign"] = certificate.sign
        found["postures"] = [texts(row) for row in certificate.postures]
        found["path"] = [texts(row) for row in certificate.path]
    if isinstance(certificate, LockCertificate):
        found["kind"] = "lock"
        found["sign"] = certificate.sign
        found["path"] = [texts(row) for row in certificate.path]
        lock = certificate.lock
        [half] = texts((lock.half,))
        found["lock"] = {"joint": lock.joint, "motion": lock.motion, "half": half}
        found["slopes"] = [texts(row) for row in certificate.slopes]
        found["bends"] = [texts(row) for row in certificate.bends]
    if isinstance(certificate, CuspCertificate):
        found["kind"] = "cusp"
        found["posture"] = texts(certificate.posture)
    if isinstance(certificate, PairsCertificate):
        found["kind"] = "pairs"
        found["parting"] = texts(certificate.parting)
        found["regular"] = texts(certificate.regular)
    if isinstance(certificate, StructureCertificate):
        found["kind"] = "structure"
        found["theorem"] = certificate.theorem
        found["relations"] = [
            {"axes": list(relation.axes), "are": relation.word}
            for relation in certificate.relations
        ]
        found["regular"] = texts(certificate.regular)
    return found | {"made_by": certificate.made_by}


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) != len(pairs):
        raise ValueError("a key comes twice")
    return table


def _no_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number")
