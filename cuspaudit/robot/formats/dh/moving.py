"""Which entry of a D-H row moves, where its zero is, and which way it counts.

A revolute joint turns theta, a prismatic one slides d. A row without ``type`` is read
as revolute, unless its d holds the joint's own symbol and its theta does not. The
constant beside the symbol, or ``offset``, is the joint's zero.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from cuspaudit.robot.chain import JointKind
from cuspaudit.robot.entries import word
from cuspaudit.robot.formats.dh.cells import Variable, plain_cell, variable_in
from cuspaudit.robot.place import Place, quoted

__all__ = ["SLIDING", "Moving", "check_indices", "moving_entry"]

SLIDING = ("prismatic", "p", "1")
_TURNING = ("revolute", "r", "0")
_ZEROS = (None, "0", "0.0")


@dataclass(frozen=True, slots=True)
class Moving:
    """The moving entry of a row.

    Attributes:
        kind: "revolute" or "prismatic".
        is_typed: whether the row states it.
        theta: plain text of the constant turn about z.
        d: plain text of the constant distance along z.
        sign: -1 when the joint's symbol is negated there.
        index: the number in the joint's symbol, None without one.
    """

    kind: JointKind
    is_typed: bool
    theta: str
    d: str
    sign: int
    index: int | None


def moving_entry(cells: Mapping[str, object], place: Place) -> Moving:
    """The moving entry of a row under our column names.

    Raises:
        InvalidRobotError: the type is unknown, the other entry holds a symbol, a
            revolute row states its zero twice, or it is not clear what an offset is.
    """
    theta, d = _plain(cells, "theta", place), _plain(cells, "d", place)
    turn = variable_in(theta, "theta") if theta else None
    slide = variable_in(d, "d") if d else None
    kind, is_typed = _kind(cells, turn, slide, place)
    column = "theta" if kind == "revolute" else "d"
    own, other = (turn, slide) if kind == "revolute" else (slide, turn)
    if other is not None:
        still = "d" if kind == "revolute" else "theta"
        found = f"{quoted(str(cells[still]))} in a row of a {kind} joint"
        expected = "write a number there, or another type (revolute or prismatic)"
        raise place.at(still).error(found, expected)
    constant = own.rest if own else (theta if kind == "revolute" else d)
    zero = _zero(cells, kind, column, constant, d is not None, place)
    return Moving(
        kind,
        is_typed,
        zero if kind == "revolute" else theta or "0",
        d or "0" if kind == "revolute" else zero,
        own.sign if own else 1,
        own.index if own else None,
    )


def check_indices(indices: Sequence[int | None], place: Place) -> None:
    """Check that the symbols are numbered as the rows are, from 1 or from 0.

    Raises:
        InvalidRobotError: one is not; a sum of two joints is no entry of a row.
    """
    stated = [(row, index) for row, index in enumerate(indices, 1) if index is not None]
    first = {index - row for row, index in stated}
    if first <= {0} or first <= {-1}:
        return
    row, index = next((r, i) for r, i in stated if i != r)
    found = f"the symbol of joint {index}"
    expected = "number the symbols as the rows, from 1 or from 0"
    raise place.at(f"row {row}").error(found, expected)


def _plain(cells: Mapping[str, object], column: str, place: Place) -> str | None:
    text = word(cells, column, place)
    return None if text is None else plain_cell(text)


def _kind(
    cells: Mapping[str, object],
    turn: Variable | None,
    slide: Variable | None,
    place: Place,
) -> tuple[JointKind, bool]:
    text = word(cells, "type", place) or ""
    if text.lower() in _TURNING:
        return "revolute", True
    if text.lower() in SLIDING:
        return "prismatic", True
    if text:
        expected = "write revolute or prismatic (or R, P)"
        raise place.at("type").error(f"the type {quoted(text)}", expected)
    return ("prismatic" if slide and not turn else "revolute"), False


def _zero(
    cells: Mapping[str, object],
    kind: JointKind,
    column: str,
    constant: str | None,
    has_d: bool,
    place: Place,
) -> str:
    """The joint's zero: the constant beside its symbol, or its ``offset``."""
    offset = _plain(cells, "offset", place)
    if offset is None:
        return constant or "0"
    here = place.at("offset")
    if kind == "revolute" and not has_d:
        found = "an offset in a row without d"
        raise here.error(found, "call it theta (the joint's zero) or d (along z)")
    if constant not in _ZEROS and offset not in _ZEROS:
        found = f"both {column} and offset state the joint's zero"
        raise here.error(found, "write one of them")
    return offset if constant in _ZEROS else constant or "0"
