"""Every six-joint arm of the corpus with limits: the verdict within them.

    python tests/limits_table.py [CORPUS] [--timeout S] [--arms NAME ...]

One row an arm: its class in the index, the free verdict, the verdict within limits with
its ground, how near the shown path keeps to a limit, and the seconds of the whole audit
and of the limits alone. A CUSPIDAL is verified again from the text of its certificate.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.auditing.proofs.certificates import certificate_text
from cuspaudit.certificate import certificate_from_text, verify
from cuspaudit.errors import CuspauditError
from cuspaudit.robot.library import open_robot

CORPUS = Path(__file__).parents[2] / "shared" / "corpus"


@dataclass(frozen=True)
class Row:
    """One arm.

    Attributes:
        arm: its name in the index.
        klass: a (spherical wrist), b (three parallel axes) or c, after snapping.
        free: the verdict without limits.
        within: the verdict within them, "none" without limits.
        kind: of its proof.
        slack: of the path within limits; None without one.
        is_certified: whether a CUSPIDAL within limits has a certificate that carries
            the limits and is accepted.
        seconds: of the audit.
        limits_seconds: of the verdict within limits.
        why: the sentence of the verdict within limits.
    """

    arm: str
    klass: str
    free: str
    within: str
    kind: str
    slack: float | None
    is_certified: bool
    seconds: float
    limits_seconds: float
    why: str

    @property
    def is_wrong(self) -> bool:
        """Whether the two verdicts contradict, or a CUSPIDAL lacks its certificate."""
        turned = self.free == "noncuspidal" and self.within == "cuspidal"
        return turned or (self.within == "cuspidal" and not self.is_certified)


def six_joint_arms(corpus: Path) -> dict[str, dict[str, str]]:
    """The entries of the index with six joints, by name."""
    index = json.loads((corpus / "urdf" / "INDEX.json").read_text())
    return {n: e for n, e in index.items() if e["klass"] in ("a", "b", "c", "c~")}


def table(
    corpus: Path, timeout: float | None = None, names: Sequence[str] = ()
) -> Iterator[Row]:
    """The rows, in the order of the index."""
    for name, entry in six_joint_arms(corpus).items():
        if not names or name in names:
            yield _row(corpus, name, entry, timeout)


def _row(corpus: Path, name: str, entry: dict[str, str], timeout: float | None) -> Row:
    path = corpus / "urdf" / f"{name}.urdf"
    robot = open_robot(path, base=entry["root"], tip=entry["tip"])
    klass = entry["klass_snapped"]
    try:
        found = audit(robot, Options(timeout=timeout))
    except CuspauditError as error:
        return Row(name, klass, "none", "none", "none", None, False, 0, 0, str(error))
    within = found.within
    total, own = found.seconds["total"], found.seconds["limits"]
    free = found.verdict.value
    if within is None:
        return Row(name, klass, free, "none", "none", None, False, total, own, "")
    return Row(
        *(name, klass, free, within.verdict.value, within.kind, within.slack),
        within.verdict.value == "cuspidal"
        and _is_accepted(certificate_text(found, within=True)),
        *(total, own, within.why),
    )


def _is_accepted(text: str | None) -> bool:
    if text is None:
        return False
    certificate = certificate_from_text(text)
    is_limited = getattr(certificate, "limits", None) is not None
    return is_limited and verify(certificate).accepted


def show(rows: Sequence[Row]) -> str:
    """The rows as text, and how many there are of each kind."""
    lines = [line_of(row) for row in rows]
    kinds = sorted({(row.klass, row.within, row.kind) for row in rows})
    for key in kinds:
        count = sum((row.klass, row.within, row.kind) == key for row in rows)
        lines.append(f"class {key[0]}: {count} {key[1]} ({key[2]})")
    return "\n".join(lines)


def line_of(row: Row) -> str:
    """One line of the table."""
    slack = "-" if row.slack is None else f"{row.slack:.3f}"
    said = row.why if row.within == "undecided" else ""
    return (
        f"{row.arm:28} {row.klass:3} {row.free:12} {row.within:12} {row.kind:10} "
        f"{slack:>6} {row.seconds:6.1f} {row.limits_seconds:6.1f} {said}"
    )


def main() -> int:
    """Print the table; 1 if a row is wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    beside = os.environ.get("CUSPAUDIT_CORPUS", CORPUS)
    parser.add_argument("corpus", nargs="?", type=Path, default=beside)
    parser.add_argument("--timeout", type=float)
    parser.add_argument("--arms", nargs="*", default=[])
    chosen = parser.parse_args()
    rows = []
    for row in table(Path(chosen.corpus), chosen.timeout, chosen.arms):
        print(line_of(row), flush=True)
        rows.append(row)
    print(show(rows))
    return int(any(row.is_wrong for row in rows))


if __name__ == "__main__":
    sys.exit(main())
