"""`cuspaudit verify` of the record of `audit --free`: each interval's certificate."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from cuspaudit.errors import InvalidCertificateError

if TYPE_CHECKING:
    from cuspaudit.certificate import LockCertificate

__all__ = ["SCHEMA", "verify_free"]

SCHEMA = "cuspaudit/free/1"


def verify_free(record: Mapping[str, Any], file: Path, as_json: bool) -> None:
    """Prove the certificate of each interval again, and that it speaks of it; and exit.

    What rests on a structure has none, and is not looked at.

    Raises:
        InvalidCertificateError: the record has no certificate, or one cannot be read.
    """
    rows = list(_rows(record, file))
    if not rows:
        raise InvalidCertificateError(
            file=str(file),
            found="no interval has a certificate",
            expected="its intervals are open, or rest on structures of the axes",
        )
    if as_json:
        typer.echo(json.dumps({"file": str(file), "intervals": rows}, indent=1))
    else:
        for row in rows:
            word = "accepted" if row["accepted"] else "REJECTED"
            low, high = (math.degrees(row[end]) for end in ("lower", "upper"))
            typer.echo(f"{word}: {low:.6g} to {high:.6g} deg: {row['reason']}")
    raise typer.Exit(0 if all(row["accepted"] for row in rows) else 1)


def _rows(record: Mapping[str, Any], file: Path) -> Iterator[dict[str, Any]]:
    from cuspaudit.certificate import LockCertificate, certificate_from_text, verify

    try:
        within = bool(record["within_limits"])
        held = [
            (float(each["lower"]), float(each["upper"]), each["witness"]["certificate"])
            for each in record["stretches"]
            if each["proof"] == "path" or each["witness"] is not None
        ]
    except (KeyError, TypeError, ValueError):
        raise InvalidCertificateError(
            file=str(file),
            where="stretches",
            found="not as the schema has them",
            expected="the file is cut or altered",
        ) from None
    for lower, upper, certificate in held:
        claim = certificate_from_text(json.dumps(certificate), str(file))
        accepted, reason = False, "the certificate is about other values"
        if within and claim.limits is None:
            reason = "the certificate is not about the joint limits"
        elif isinstance(claim, LockCertificate) and _covers(claim, lower, upper):
            result = verify(claim)
            accepted, reason = result.accepted, result.reason
        yield {
            "lower": lower,
            "upper": upper,
            "accepted": accepted,
            "reason": reason,
        }


def _covers(claim: LockCertificate, lower: float, upper: float) -> bool:
    """Whether the certificate speaks of all values from ``lower`` to ``upper``.

    Certificates are written for a little more than their interval, so that the rounding
    of its ends needs no room here.
    """
    places = [*(joint.before for joint in claim.joints), claim.tool]
    turn: Any = places[claim.lock.joint - 1][claim.lock.motion]
    middle = float(turn.half_turns) * math.pi + float(turn.radians)
    half = float(claim.lock.half)
    return middle - half <= lower <= upper <= middle + half
