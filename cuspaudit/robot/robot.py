"""A robot as its file gives it: the literal chain, and what the file says about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from cuspaudit.robot.chain import Chain
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.tolerance import AxisTolerance, LooseNumber

__all__ = ["COUNTS", "VERDICTS", "WITHIN", "Robot", "TableReading", "parse_expectation"]

VERDICTS = ("cuspidal", "noncuspidal", "undecided")
WITHIN = "within_limits"
COUNTS = ("aspects", "max_postures", "cusps", "nodes")


@dataclass(frozen=True, slots=True)
class TableReading:
    """What the rows of a D-H table give in one convention.

    Attributes:
        convention: "standard" or "modified".
        chain: the chain.
    """

    convention: str
    chain: Chain


@dataclass(frozen=True, slots=True)
class Robot:
    """A robot read from a file.

    Attributes:
        name: the robot's name.
        file: the file as the user gave it.
        chain: the literal chain: every number exactly as the file has it.
        title: one line about the robot.
        source: where its numbers and its recorded verdict come from.
        expect: what is known of it, see `parse_expectation`; None when nothing is.
        urdf: the URDF file, when it came from one (its meshes can be drawn).
        notes: what the reader assumed, one sentence each.
        locked: joints that are held fixed in the chain, with their values as text.
        other_convention: what the same D-H table gives in the other convention; None
            where there is none.
        beside: the same chain to other links of the body its tip is on.
        tolerance: how far its axes may be off as built; None where the file is silent.
        loose: numbers of its table that are known within some bound only.
    """

    name: str
    file: str
    chain: Chain
    title: str = ""
    source: str = ""
    expect: Mapping[str, str | int | None] | None = None
    urdf: Path | None = None
    notes: tuple[str, ...] = ()
    locked: Mapping[str, str] = field(default_factory=dict)
    other_convention: TableReading | None = None
    beside: tuple[Chain, ...] = ()
    tolerance: AxisTolerance | None = None
    loose: tuple[LooseNumber, ...] = ()

    def __repr__(self) -> str:
        """The robot in one short line."""
        held = "".join(f", {name} = {value}" for name, value in self.locked.items())
        joints = len(self.chain.joints)
        return f"<Robot {self.name}: {joints} joints, {self.chain.task}{held}>"


def parse_expectation(
    entries: Mapping[str, object], place: Place
) -> dict[str, str | int | None]:
    """The recorded verdict and counts of a robot file.

    Args:
        entries: any of "verdict", "aspects", "max_postures", "cusps", "nodes", each
            as text ("null" and "" stand for None) or None; and "within_limits", a
            mapping with a verdict and aspects of its own, which come back under the
            keys "within_limits.verdict" and "within_limits.aspects".
        place: where they stand.

    Raises:
        InvalidRobotError: another key, another verdict, or a count that is none.
    """
    result: dict[str, str | int | None] = {}
    for key, value in entries.items():
        here = place.at(key if key.isidentifier() else quoted(key))
        if key == WITHIN:
            result |= _within(value, here)
            continue
        if key not in ("verdict", *COUNTS):
            expected = f"write one of verdict, {', '.join(COUNTS)}, {WITHIN}"
            raise here.error("an unknown key", expected)
        if value is None or value in ("null", "~", ""):
            result[key] = None
        elif key == "verdict":
            if value not in VERDICTS:
                expected = f"write one of {', '.join(VERDICTS)}"
                raise here.error(quoted(str(value)), expected)
            result[key] = str(value)
        else:
            result[key] = _count(value, here)
    return result


def _within(value: object, place: Place) -> dict[str, str | int | None]:
    """The recorded verdict and number of aspects within the joint limits."""
    if value is None or value in ("null", "~", ""):
        return {}
    expected = "write within_limits: {verdict: ..., aspects: ...}"
    if not isinstance(value, Mapping):
        raise place.error("not a mapping", expected)
    if set(value) - {"verdict", "aspects"}:
        raise place.error("an unknown key", expected)
    inside = parse_expectation(value, place)
    return {f"{WITHIN}.{key}": found for key, found in inside.items()}


def _count(value: object, place: Place) -> int:
    text = str(value)
    if not (text.isascii() and text.isdigit() and len(text) < 7):
        raise place.error(f"{quoted(text)} is not a count", "write 0, 1, 2, ...")
    return int(text)
