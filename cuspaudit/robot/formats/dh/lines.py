"""D-H tables as lines of cells: CSV, Markdown, LaTeX, boxes, columns of blanks.

A line of column names, then one line a joint. What stands above is comment, where
``convention=standard`` and the like are settings. Of several tables in one text the
one with D-H columns is meant.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from cuspaudit.robot.formats.dh.endings import LINE_ENDINGS
from cuspaudit.robot.formats.dh.headers import COLUMNS, header_from_text
from cuspaudit.robot.place import Place, quoted
from cuspaudit.robot.tables import Table, read_mapping, read_text, table_from_mapping

__all__ = ["read_table"]

_MOST_ROWS = 5000
_SETTING = re.compile(r"\b(convention|angles|lengths|task)\s*=\s*([\w-]+)")
_RULE = re.compile(r"[\s|:+=\u2500-\u257f-]*")
_LATEX_RULE = re.compile(r"\\(?:begin|end|[a-z]*rule|hline|cline)\b.*")
_LATEX_END = re.compile(r"\\\\(?:\[[^\]]*\])?\s*(?:\\hline)?\s*$")
_BOX = "\N{BOX DRAWINGS LIGHT VERTICAL}"
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]*,[0-9]+")
_THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2}(?:,[0-9]{3})+")
_DIMENSIONS = {"theta", "d", "a", "alpha"}

Cells = list[list[str]]


def read_table(path: Path, place: Place) -> Table:
    """The table in ``path``, by the ending of its name.

    Args:
        path: a file of `LINE_ENDINGS` or a .json file; any other is read as YAML.
        place: the file, for messages.

    Raises:
        InvalidRobotError: it cannot be read, decoded or parsed.
    """
    if path.suffix.lower() not in LINE_ENDINGS:
        return table_from_mapping(read_mapping(path, place), place)
    text = read_text(path, place)
    lines = text.splitlines()
    split = _frame(text, lines)
    if split is not None:
        comments, cells = _framed(lines, split, place)
    else:
        comments, cells = _plain_lines(lines, place)
    if not cells:
        raise place.error("the file is empty", "write a line of column names")
    return Table(_settings(comments), _rows(_points(cells), place))


def _frame(text: str, lines: Sequence[str]) -> Callable[[str], list[str] | None] | None:
    """How a line of a framed table is split, None for a plain one."""
    if _BOX in text:
        return lambda line: _between(line, _BOX)
    if any("|" in line and "-" in line and _RULE.fullmatch(line) for line in lines):
        return lambda line: _between(line, "|")
    if any(line.count("&") > 1 for line in lines):
        return _latex
    return None


def _between(line: str, bar: str) -> list[str] | None:
    if bar not in line or _RULE.fullmatch(line):
        return None
    inner = line.strip().removeprefix(bar).removesuffix(bar)
    return [cell.strip() for cell in inner.split(bar)]


def _latex(line: str) -> list[str] | None:
    line = _LATEX_END.sub("", line.strip())
    line = line.removeprefix("\\hline").strip()
    if "&" not in line or _LATEX_RULE.fullmatch(line):
        return None
    return [cell.strip() for cell in line.split("&")]


def _framed(
    lines: Sequence[str], split: Callable[[str], list[str] | None], place: Place
) -> tuple[list[str], Cells]:
    """The comments and the cells of the one table with D-H columns."""
    tables: list[Cells] = []
    comments: list[str] = []
    open_table = False
    for line in lines:
        cells = split(line)
        rule = _RULE.fullmatch(line) and line.strip()
        if cells is not None:
            if not open_table:
                tables.append([])
            tables[-1].append(cells)
            open_table = True
        elif not rule and not _LATEX_RULE.fullmatch(line.strip()):
            comments.append(line)
            open_table = False
    meant = [table for table in tables if _is_dh(table[0])]
    if len(meant) > 1:
        raise place.error(f"{len(meant)} D-H tables", "leave one in the file")
    return comments, (meant or tables or [[]])[0]


def _is_dh(names: Sequence[str]) -> bool:
    return len(_DIMENSIONS & {header_from_text(name).column for name in names}) > 2


def _plain_lines(lines: Sequence[str], place: Place) -> tuple[list[str], Cells]:
    """The comments above the line of names, and the cells from there on."""
    start = next(
        (k for k, line in enumerate(lines) if line.strip() and line.lstrip()[0] != "#"),
        len(lines),
    )
    header = lines[start] if start < len(lines) else ""
    delimiter = next((d for d in ("\t", ";", ",") if d in header), "")
    if not delimiter:
        between = r"\s{2,}" if "  " in header.strip() else r"\s+"
        rows = [re.split(between, line.strip()) for line in lines[start:]]
        return [*lines[:start]], [row for row in rows if any(row)]
    body = io.StringIO("\n".join(lines[start:]))
    try:
        cells = [
            [cell.strip() for cell in row]
            for row in csv.reader(body, delimiter=delimiter, strict=True)
            if any(cell.strip() for cell in row)
        ]
    except csv.Error as error:
        raise place.error(str(error), "write one joint a line") from None
    return [*lines[:start]], cells


def _points(cells: Cells) -> Cells:
    """The cells with decimal points for decimal commas, where no point stands.

    Numbers with groups of three digits after commas alone are left: they may be
    thousands.
    """
    body = [cell for row in cells[1:] for cell in row]
    commas = [cell for cell in body if _DECIMAL_COMMA.fullmatch(cell)]
    dotted = any(re.search(r"[0-9]\.[0-9]", cell) for cell in body)
    if dotted or all(_THOUSANDS.fullmatch(cell) for cell in commas):
        return cells
    return [
        cells[0],
        *(
            [c.replace(",", ".") if _DECIMAL_COMMA.fullmatch(c) else c for c in row]
            for row in cells[1:]
        ),
    ]


def _rows(cells: Cells, place: Place) -> list[Mapping[str, object]]:
    if len(cells) > _MOST_ROWS:
        raise place.error(f"{len(cells) - 1} rows", "give a shorter table")
    names = list(_names(cells, place))
    for number, row in enumerate(cells[1:], 1):
        if len(row) != len(cells[0]):
            found = f"{len(row)} cells under {len(cells[0])} column names"
            raise place.at(f"row {number}").error(found, "write one cell a column")
    return [
        {
            name: cell
            for name, cell in zip(names, row, strict=True)
            if cell and name is not None
        }
        for row in cells[1:]
    ]


def _names(cells: Cells, place: Place) -> Iterator[str | None]:
    """The names of the columns, None for one without a name or a cell."""
    here = place.at("header")
    for index, name in enumerate(cells[0]):
        empty = not any(row[index] for row in cells[1:] if index < len(row))
        if not name and empty:
            yield None
            continue
        if not header_from_text(name).column:
            found = f"the column name {quoted(name)} is unknown"
            expected = f"begin with a line of names out of {', '.join(sorted(COLUMNS))}"
            raise here.error(found, expected)
        if name in cells[0][:index]:
            found = f"a column name stands twice: {quoted(', '.join(cells[0]))}"
            raise here.error(found, "write it once")
        yield name


def _settings(comments: Sequence[str]) -> dict[str, object]:
    """The settings in the comments above the header, as the YAML form names them."""
    found = dict(_SETTING.findall("\n".join(comments)))
    head: dict[str, object] = {
        name: found[name] for name in ("convention", "task") if name in found
    }
    units = {
        name: found[word]
        for word, name in (("lengths", "length"), ("angles", "angle"))
        if word in found
    }
    if units:
        head["units"] = units
    return head
