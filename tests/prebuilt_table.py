"""The arms whose kinematics the package ssik carries, audited: verdicts by class.

    python tests/prebuilt_table.py [FOLDER] [--timeout S]

FOLDER is that of the unpacked package, by default where it is installed. Of seven
joints one is locked at 0.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.errors import CuspauditError
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.proposals import fitting_locks
from cuspaudit.robot.ssik_arms import ssik_arms


@dataclass(frozen=True)
class Row:
    """One arm.

    Attributes:
        name: vendor and model.
        joints: how many it has.
        verdict: of the audit, or "refused".
        ground: the theorem, or the kind of proof.
        why: the reason that is given.
    """

    name: str
    joints: int
    verdict: str
    ground: str
    why: str


def table(folder: Path | None, timeout: float) -> Iterator[Row]:
    """A row for each arm."""
    for name, path in ssik_arms(folder).items():
        count = 0
        try:
            robot = open_robot(path, square=False)
            count = len(robot.chain.joints)
            if count == 7:
                [names] = fitting_locks(robot.chain, 1, 1)
                robot = open_robot(path, lock=dict.fromkeys(names, "0"))
            found = audit(robot, Options(timeout=timeout)).answer
        except CuspauditError as refusal:
            yield Row(name, count, "refused", "", str(refusal))
            continue
        ground = found.reduction.kind if found.reduction else "general"
        yield Row(name, count, found.verdict.value, ground, found.why)


def show(rows: list[Row]) -> str:
    """How many arms of each class have which verdict."""
    classes = Counter((row.joints, row.ground, row.verdict) for row in rows)
    return "\n".join(
        f"{joints} joints, {ground or 'none'}: {count} {verdict}"
        for (joints, ground, verdict), count in sorted(classes.items())
    )


def main() -> None:
    """Print a line for each arm, then the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", nargs="?", type=Path)
    parser.add_argument("--timeout", type=float, default=10.0)
    chosen = parser.parse_args()
    if not ssik_arms(chosen.folder):
        sys.exit("no arms of ssik: pip install --no-deps ssik, or give its folder")
    rows = []
    for row in table(chosen.folder, chosen.timeout):
        rows.append(row)
        ground = f"{row.joints} {row.verdict:12} {row.ground:18}"
        print(f"{row.name:34} {ground} {row.why[:60]}")
        sys.stdout.flush()
    print(show(rows))


if __name__ == "__main__":
    main()
