r"""The column names of a D-H table as people write them, and what they state besides.

``alpha_{i-1}``, ``$\alpha_i$``, ``aⱼ₋₁``, ``Link Length (mm)``, ``d / mm`` and
``θ [deg]`` are names of our columns. A name may state the unit of its column, and an
index one below that of the joint: a row that holds the twist and length *before* its
joint, alpha_{i-1} and a_{i-1} beside theta_i and d_i, is Craig's, the modified
convention. Nothing else is concluded from a name.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from cuspaudit.robot.place import Place, quoted

__all__ = ["COLUMNS", "Header", "header_from_text", "stated_by"]

COLUMNS = (
    *("joint", "name", "type", "theta", "offset", "d", "a", "alpha", "sign"),
    *("limits", "qmin", "qmax", "convention"),
)

_MEANT = {
    **{name: name for name in COLUMNS},
    **dict.fromkeys(("", "#", "i", "j", "k", "n", "no", "nr", "num"), "joint"),
    **dict.fromkeys(("number", "link", "frame", "index", "row", "id"), "joint"),
    **dict.fromkeys(("joint#", "link#", "jointno", "jointnumber"), "joint"),
    **dict.fromkeys(("linkno", "linknumber", "jointi", "linki"), "joint"),
    **dict.fromkeys(("jointname", "linkname"), "name"),
    **dict.fromkeys(("jointtype", "kind", "sigma"), "type"),
    **dict.fromkeys(("th", "jointangle"), "theta"),
    **dict.fromkeys(("thetaoffset", "offsettheta", "theta0"), "offset"),
    **dict.fromkeys(("linkoffset",), "d"),
    **dict.fromkeys(("linklength",), "a"),
    **dict.fromkeys(("al", "twist", "linktwist", "twistangle"), "alpha"),
    **dict.fromkeys(("qlim", "qlimits", "limit", "jointlimits"), "limits"),
    **dict.fromkeys(("min", "lower", "q-", "lowerlimit"), "qmin"),
    **dict.fromkeys(("max", "upper", "q+", "upperlimit"), "qmax"),
}
_WORDS = {"α": "alpha", "⍺": "alpha", "θ": "theta", "ϑ": "theta", "σ": "sigma"}
_UNITS = {
    **{"mm": "mm", "millimeters": "mm", "millimetres": "mm", "m": "m"},
    **{"meters": "m", "metres": "m", "deg": "deg", "degree": "deg"},
    **{"degrees": "deg", "°": "deg", "º": "deg"},
    **{"rad": "rad", "radian": "rad", "radians": "rad"},
}
_UNIT = "|".join(sorted(_UNITS, key=len, reverse=True))
_WITH_UNIT = re.compile(
    rf"(?P<name>.+?)\s*(?:[(\[]\s*(?:in\s+)?(?P<a>{_UNIT})\s*[)\]]"
    rf"|/\s*(?P<b>{_UNIT})|_(?P<c>mm|m|deg|rad)|\s+in\s+(?P<d>{_UNIT}))"
)
_INDEXED = re.compile(
    r"(?P<name>alpha|theta|sigma|th|al|offset|a|d|q)"
    r"[_(]*(?:[ijkn])(?P<shift>[-+]1)?\)*"
)
_ANGLES = ("theta", "alpha", "offset")
_LONGEST = 80


@dataclass(frozen=True, slots=True)
class Header:
    """What one column name says.

    Attributes:
        column: our name of the column, "" when it has none.
        unit: "m", "mm", "deg" or "rad" when the name states it.
        is_before: whether its index is one below that of the joint.
        text: the name as it stands.
    """

    column: str
    unit: str | None
    is_before: bool
    text: str


def header_from_text(text: str) -> Header:
    r"""The column that a name of a table means.

    >>> header_from_text(r"$\alpha_{i-1}$").column, header_from_text("d / mm").unit
    ('alpha', 'mm')
    >>> header_from_text("aⱼ₋₁").is_before, header_from_text("beta").column
    (True, '')
    """
    unit, name = None, text.strip().lower()[:_LONGEST].strip("*`$ ")
    found = _WITH_UNIT.fullmatch(name)
    if found:
        unit = _UNITS[found["a"] or found["b"] or found["c"] or found["d"]]
        name = found["name"]
    name = unicodedata.normalize("NFKC", name).replace("\N{MINUS SIGN}", "-")
    for letter, word in _WORDS.items():
        name = name.replace(letter, word)
    name = re.sub(r"[\\${}\s*`.,]|mathrm|text", "", name)
    indexed = _INDEXED.fullmatch(name)
    if indexed and name not in _MEANT:
        column = _MEANT.get(indexed["name"], "")
        return Header(column, unit, indexed["shift"] == "-1", text)
    return Header(_MEANT.get(name.replace("_", ""), ""), unit, False, text)


def stated_by(headers: Sequence[Header], place: Place) -> Mapping[str, str]:
    """What the names of a table state together: convention, length and angle.

    Returns:
        any of "convention" ("modified"), "length" ("m", "mm") and "angle" ("deg",
        "rad").

    Raises:
        InvalidRobotError: the indices or the units of the names contradict each other.
    """
    stated = {}
    before = {h.column for h in headers if h.is_before}
    if before:
        if before != {"a", "alpha"}:
            names = ", ".join(quoted(h.text) for h in headers if h.is_before)
            found = f"of the columns {names} are those before the joint"
            expected = "write a_{i-1} and alpha_{i-1} beside theta_i and d_i, or all _i"
            raise place.error(found, expected)
        stated["convention"] = "modified"
    for kind, columns in (("angle", _ANGLES), ("length", ("a", "d"))):
        units = {h.unit for h in headers if h.unit and h.column in columns}
        if not units <= ({"deg", "rad"} if kind == "angle" else {"m", "mm"}):
            found = f"a unit of {kind} that is none: {', '.join(sorted(units))}"
            raise place.error(found, "write m or mm for lengths, deg or rad for angles")
        if len(units) > 1:
            found = f"two units of {kind}: {', '.join(sorted(units))}"
            raise place.error(found, "write one for all columns")
        if units:
            stated[kind] = units.pop()
    return stated
