"""Entries of a mapping in a robot file: which keys are known, and one value as text."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from cuspaudit.robot.place import Place, quoted

__all__ = ["check_known", "word"]


def check_known(
    entries: Mapping[str, object], known: Collection[str], place: Place
) -> None:
    """Check that every key is one we read.

    Raises:
        InvalidRobotError: one is not; the message lists those that are.
    """
    for key in entries:
        if key not in known:
            found = f"unknown name {quoted(key)}"
            raise place.error(found, f"the names here are {', '.join(sorted(known))}")


def word(entries: Mapping[str, object], key: str, place: Place) -> str | None:
    """The text under ``key``, None when it is absent or null.

    Raises:
        InvalidRobotError: a list or a mapping stands there.
    """
    value = entries.get(key)
    if value is None or value in ("", "null", "~"):
        return None
    if not isinstance(value, str):
        raise place.at(key).error("a list or mapping", "write one value")
    return value
