"""The expectation of a robot file: written where there is none, pointed at where wrong.

A file is a text that a person wrote: comments, order and line ends stay as they are,
one ``expect:`` line is added, and an expectation that stands there is never replaced.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Mapping
from pathlib import Path

from cuspaudit.errors import InvalidInputError, InvalidRobotError
from cuspaudit.robot.formats.dh.read import read_dh
from cuspaudit.robot.robot import WITHIN
from cuspaudit.runtime.writing import write_text

__all__ = ["annotation", "write_expectation"]

_EMPTY = re.compile(r"^expect:[ \t]*(?:null|~)?[ \t]*(?=#|\r?$)", re.MULTILINE)
_ANY = re.compile(r"^expect[ \t]*:", re.MULTILINE)
_LEVELS = {
    **dict.fromkeys(("mismatch", "error", "fault"), "error"),
    "undecided": "warning",
}


def write_expectation(file: Path, found: Mapping[str, str | int]) -> bool:
    """Add ``found`` to a robot file that records nothing; say whether it was done.

    Args:
        file: a D-H table in YAML; its text is kept and the line is appended.
        found: the verdict, and the counts that are known.

    Returns:
        False when the file has an expectation already: it is left as it is.

    Raises:
        InvalidInputError: the file has no place for an expectation, or cannot be
            written.
    """
    if file.suffix.lower() not in (".yaml", ".yml"):
        raise _by_hand(file, "only a YAML file can hold an expectation", found)
    if read_dh(file).expect:
        return False
    text = file.read_bytes().decode("utf-8")
    ending = "\r\n" if "\r\n" in text else "\n"
    line = _line(found)
    if _EMPTY.search(text):
        text = _EMPTY.sub(line, text, count=1)
    else:
        text += ("" if text.endswith("\n") else ending) + line + ending
    _check_reads_back(file, text, found)
    write_text(file, text)
    return True


def annotation(file: str, status: str, detail: str) -> str | None:
    """A line that GitHub shows beside the expectation in a change; None if all is well.

    >>> annotation("robots/no_such.yaml", "mismatch", "aspects 2 where 3 is recorded")
    '::error file=robots/no_such.yaml,line=1,title=mismatch::aspects 2 where 3 is recorded'
    """  # noqa: E501 - one line is what the format asks for
    if status == "ok":
        return None
    level = _LEVELS.get(status, "notice")
    message = detail.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")
    name = file.replace("%", "%25").replace(":", "%3A").replace(",", "%2C")
    return f"::{level} file={name},line={_line_number(file)},title={status}::{message}"


def _line(found: Mapping[str, str | int]) -> str:
    plain = {key: value for key, value in found.items() if "." not in key}
    inside = {
        key.removeprefix(f"{WITHIN}."): value
        for key, value in found.items()
        if key.startswith(f"{WITHIN}.")
    }
    said = dict[str, object](plain)
    if inside:
        said[WITHIN] = _mapping(inside)
    return f"expect: {_mapping(said)}"


def _mapping(found: Mapping[str, object]) -> str:
    return f"{{{', '.join(f'{key}: {value}' for key, value in found.items())}}}"


def _line_number(file: str) -> int:
    """The line of the expectation, 1 where there is none."""
    try:
        text = Path(file).read_text("utf-8", errors="replace")
    except OSError:
        return 1
    match = _ANY.search(text)
    return text.count("\n", 0, match.start()) + 1 if match else 1


def _check_reads_back(file: Path, text: str, found: Mapping[str, str | int]) -> None:
    """Refuse a text from which the expectation would not be read again."""
    with tempfile.TemporaryDirectory() as folder:
        trial = Path(folder) / file.name
        trial.write_text(text, "utf-8", newline="")
        try:
            expect = read_dh(trial).expect
        except InvalidRobotError:
            expect = None
    if expect != found:
        raise _by_hand(file, "an expectation cannot be appended to it", found)


def _by_hand(file: Path, why: str, found: Mapping[str, str | int]) -> InvalidInputError:
    return InvalidInputError(
        file=str(file), found=why, expected=f"add by hand {_line(found)}"
    )
