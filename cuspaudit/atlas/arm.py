"""One arm audited for the atlas: in a process of its own, or on another machine."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

import cuspaudit
from cuspaudit.atlas.entry import Entry, entry_from_record, failed_entry
from cuspaudit.atlas.picture import picture
from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.proofs.certificates import certificate_text
from cuspaudit.auditing.proofs.certified_robot import regular_posture
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.errors import CuspauditError, unforeseen
from cuspaudit.pictures.page import page_text
from cuspaudit.robot.library import open_robot, serial_chains
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = ["AtlasArm", "Made", "arm_key", "make_arm"]

_FORMAT = "2"
_MOST = 12
"""Chains of one robot that are audited at most."""


@dataclass(frozen=True)
class AtlasArm:
    """An arm to be audited.

    Attributes:
        source: a file, or a name of the library.
        slug: name of its files in the site.
        timeout: seconds after which no further step of the audit begins, or None.
        seed: of every random choice.
    """

    source: str
    slug: str
    timeout: float | None
    seed: int = 0


@dataclass(frozen=True)
class Made:
    """What an audit gives the site.

    Attributes:
        entry: the line of the table.
        page: the offline page; "" where there is no audit.
        certificate: its text; "" where there is none.
        record: the audit as JSON.
    """

    entry: Entry
    page: str = ""
    certificate: str = ""
    record: str = ""


def arm_key(arm: AtlasArm, content: bytes) -> str:
    """What an entry depends on: the file, the way it is audited, and the program."""
    parts = (_FORMAT, cuspaudit.__version__, arm.source, arm.timeout, arm.seed)
    return hashlib.sha256(repr(parts).encode() + content).hexdigest()[:16]


def make_arm(arm: AtlasArm, key: str) -> list[Made]:
    """Audit ``arm``; an error is the arm's and ends nothing else.

    Of a robot with several chains each arm among them is audited, redundant joints
    locked at 0. Times are left out: the same arm gives the same files.
    """
    made = _tried(lambda: [_made(arm.slug, open_robot(arm.source), arm)], arm)
    if made[0].entry.error:
        chains = _tried(lambda: list(_of_each_chain(arm)), arm)
        made = chains or made
    return [replace(m, entry=replace(m.entry, group=arm.slug, key=key)) for m in made]


def _tried(work: Callable[[], list[Made]], arm: AtlasArm) -> list[Made]:
    try:
        return work()
    except CuspauditError as error:
        text = str(error)
    except Exception as error:  # the other arms are audited all the same
        text = unforeseen(error)
    return [Made(failed_entry(arm.slug, Path(arm.source).name, text))]


def _of_each_chain(arm: AtlasArm) -> Iterator[Made]:
    """The arms among the serial chains of a robot."""
    for chain in islice((c for c in serial_chains(arm.source) if c.is_arm), _MOST):
        slug = f"{arm.slug}--{re.sub('[^a-z0-9]+', '-', chain.tip.lower()).strip('-')}"
        robot = open_robot(
            arm.source,
            base=chain.base,
            tip=chain.tip,
            task=chain.task,
            lock=dict.fromkeys(chain.locked, "0"),
        )
        try:
            yield _made(slug, robot, arm)
        except CuspauditError as error:
            yield Made(failed_entry(slug, Path(arm.source).name, str(error)))


def _made(slug: str, robot: Robot, arm: AtlasArm) -> Made:
    result = audit(robot, Options(arm.seed, arm.timeout))
    proof = certificate_text(result)
    record = _without_times(result.record(f"{slug}.json" if proof else None))
    kind = str(json.loads(proof)["kind"]) if proof else ""
    drawn = picture(with_virtual_joint(result.shown_chain), _postures(result))
    entry = entry_from_record(slug, Path(arm.source).name, record, kind, drawn)
    return Made(
        entry,
        page_text(record, result),
        proof or "",
        json.dumps(record, indent=1, allow_nan=False) + "\n",
    )


def _postures(result: FinishedAudit) -> list[list[float]]:
    """The two ends of the witness path, or one regular posture."""
    chain = with_virtual_joint(result.shown_chain)
    if result.witness is not None:
        path = result.witness.path
        return [[float(x) for x in row] for row in (path[0], path[-1])]
    return [[float(x) / 3 for x in regular_posture(chain)]]


def _without_times(record: dict[str, Any]) -> dict[str, Any]:
    return record | {"seconds": {}, "robot": _named(record["robot"])}


def _named(robot: dict[str, Any]) -> dict[str, Any]:
    """The robot with the name of its file alone: where it stood is nobody's matter."""
    return robot | {"file": Path(str(robot["file"])).name}
