"""From JSON values to a certificate: each key where the schema has it, and no other.

Two versions of the schema are read. In version 1 every certificate is of kind "path".

Whatever does not fit is an `InvalidCertificateError` that names the place in the file,
as ``robot.joints[1].axis[2]``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal, NoReturn, TypeVar, cast

from cuspaudit.certificate.model import (
    Certificate,
    CertifiedJoint,
    CuspCertificate,
    JointKind,
    Limits,
    Lock,
    LockCertificate,
    Loose,
    Motion,
    Numbers,
    PairsCertificate,
    PathCertificate,
    Posture,
    Relation,
    Rotate,
    StructureCertificate,
    Task,
    Tolerance,
    Translate,
    Vector,
    Word,
    is_loose,
)
from cuspaudit.certificate.structure.exact import fraction_from_text
from cuspaudit.errors import InvalidCertificateError

__all__ = ["SCHEMA", "Place", "certificate_from_json"]

SCHEMA = "cuspaudit/certificate/2"
_FIRST = "cuspaudit/certificate/1"
_FRAME = ("schema", "kind", "robot", "made_by")
_OPTIONAL = ("numbers", "limits", "tolerance")

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Place:
    """A place in a file, which knows how to complain."""

    file: str
    where: str = ""

    def fail(self, found: str, expected: str) -> NoReturn:
        """Raise the error about what stands here."""
        raise InvalidCertificateError(
            file=self.file, where=self.where, found=found, expected=expected
        ) from None

    def key(self, key: str) -> Place:
        """The value of ``key`` in the object at this place."""
        return Place(self.file, f"{self.where}.{key}" if self.where else key)

    def item(self, index: int) -> Place:
        """An item of the list at this place."""
        return Place(self.file, f"{self.where}[{index}]")

    def table(
        self, value: Any, *keys: str, optional: tuple[str, ...] = ()
    ) -> dict[str, Any]:
        """``value`` if it is an object with exactly these keys, the optional or not."""
        if not isinstance(value, dict):
            self.fail(f"{_short(value)} is no object", f"give the keys {keys}")
        for key in keys:
            if key not in value:
                self.key(key).fail("key is missing", "the file is cut or altered")
        for key in value:
            if key not in keys and key not in optional:
                self.fail(f"unknown key {_short(key)}", f"the keys are {keys}")
        return value

    def items(self, value: Any, read: Callable[[Any, Place], T]) -> tuple[T, ...]:
        """``value`` if it is a list, each item read by ``read``."""
        if not isinstance(value, list):
            self.fail(f"{_short(value)} is no list", "give a list")
        return tuple(read(each, self.item(i)) for i, each in enumerate(value))

    def text(self, value: Any) -> str:
        """``value`` if it is a string."""
        if not isinstance(value, str):
            self.fail(f"{_short(value)} is no string", "give a string")
        return value


def certificate_from_json(value: Any, place: Place) -> Certificate:
    """Return the certificate that a decoded JSON value holds.

    Args:
        value: what `json.loads` returned.
        place: the file, for the messages.

    Raises:
        InvalidCertificateError: a key is missing or unknown, or a value is of the
            wrong kind.
    """
    if not isinstance(value, dict):
        place.fail(f"{_short(value)} is no object", "give a certificate")
    schema = value.get("schema", SCHEMA)
    if schema == _FIRST:
        first = ("schema", "robot", "sign", "postures", "path", "made_by")
        path = _path(place.table(value, *first), place)
        if is_loose(path):
            place.key("robot").fail("a loose number", f"only {SCHEMA} has those")
        return path
    if schema != SCHEMA:
        found = f"unknown schema {_short(schema)}"
        place.key("schema").fail(found, f"this checker reads {_FIRST} and {SCHEMA}")
    kind = value.get("kind")
    if not isinstance(kind, str) or kind not in _KINDS:
        found = "key is missing" if "kind" not in value else _short(kind)
        place.key("kind").fail(found, f"the kinds are {tuple(_KINDS)}")
    keys, read = _KINDS[kind]
    return read(place.table(value, *_FRAME, *keys, optional=_OPTIONAL), place)


def _path(top: dict[str, Any], place: Place) -> PathCertificate:
    postures = place.key("postures").items(top["postures"], _row)
    return PathCertificate(
        **_frame(top, place),
        sign=_sign(top["sign"], place.key("sign")),
        postures=cast(tuple[Posture, Posture], postures),
        path=place.key("path").items(top["path"], _row),
    )


def _sign(value: Any, place: Place) -> Literal[1, -1]:
    if type(value) is not int or value not in (1, -1):
        place.fail(_short(value), "use 1 or -1")
    return cast(Literal[1, -1], value)


def _moving(top: dict[str, Any], place: Place) -> LockCertificate:
    at = place.key("lock")
    lock = at.table(top["lock"], "joint", "motion", "half")
    joint, motion = (_whole(lock[key], at.key(key)) for key in ("joint", "motion"))
    path, slopes, bends = (
        place.key(key).items(top[key], _row) for key in ("path", "slopes", "bends")
    )
    return LockCertificate(
        **_frame(top, place),
        sign=_sign(top["sign"], place.key("sign")),
        path=path,
        lock=Lock(joint, motion, _number(lock["half"], at.key("half"))),
        slopes=slopes,
        bends=bends,
    )


def _whole(value: Any, place: Place) -> int:
    if type(value) is not int:
        place.fail(_short(value), "give a whole number")
    return value


def _cusp(top: dict[str, Any], place: Place) -> CuspCertificate:
    posture = _row(top["posture"], place.key("posture"))
    return CuspCertificate(**_frame(top, place), posture=posture)


def _structure(top: dict[str, Any], place: Place) -> StructureCertificate:
    return StructureCertificate(
        **_frame(top, place),
        theorem=place.key("theorem").text(top["theorem"]),
        relations=place.key("relations").items(top["relations"], _relation),
        regular=_row(top["regular"], place.key("regular")),
    )


def _pairs(top: dict[str, Any], place: Place) -> PairsCertificate:
    return PairsCertificate(
        **_frame(top, place),
        parting=_row(top["parting"], place.key("parting")),
        regular=_row(top["regular"], place.key("regular")),
    )


def _relation(value: Any, place: Place) -> Relation:
    table = place.table(value, "axes", "are")
    axes = place.key("axes").items(table["axes"], _axis_number)
    return Relation(axes, cast(Word, place.key("are").text(table["are"])))


def _axis_number(value: Any, place: Place) -> int:
    if type(value) is not int:
        place.fail(_short(value), "give the number of an axis")
    return value


_KINDS: dict[str, tuple[tuple[str, ...], Callable[[Any, Place], Certificate]]] = {
    "path": (("sign", "postures", "path"), _path),
    "lock": (("sign", "path", "lock", "slopes", "bends"), _moving),
    "cusp": (("posture",), _cusp),
    "pairs": (("parting", "regular"), _pairs),
    "structure": (("theorem", "relations", "regular"), _structure),
}
"""The keys of each kind beside those that all have, and what reads it."""


def _frame(top: dict[str, Any], place: Place) -> dict[str, Any]:
    """What every kind has, as arguments of its class."""
    at = place.key("robot")
    robot = at.table(top["robot"], "name", "task", "unit", "joints", "tool")
    found: dict[str, Any] = {
        "robot_name": at.key("name").text(robot["name"]),
        "task": cast(Task, at.key("task").text(robot["task"])),
        "unit": at.key("unit").text(robot["unit"]),
        "joints": at.key("joints").items(robot["joints"], _joint),
        "tool": at.key("tool").items(robot["tool"], _motion),
        "made_by": place.key("made_by").text(top["made_by"]),
    }
    for key, read in (
        ("numbers", _numbers),
        ("limits", _limits),
        ("tolerance", _tolerance),
    ):
        if key in top:
            found[key] = read(top[key], place.key(key))
    return found


def _numbers(value: Any, place: Place) -> Numbers:
    if value not in ("literal", "snapped"):
        place.fail(_short(value), 'use "literal" or "snapped"')
    return cast(Numbers, value)


def _limits(value: Any, place: Place) -> Limits:
    return place.items(value, _interval)


def _interval(value: Any, place: Place) -> tuple[Fraction, Fraction] | None:
    if value is None:
        return None
    row = _row(value, place)
    if len(row) != 2:
        place.fail(f"{len(row)} values", "give the lower and the upper limit, or null")
    return row[0], row[1]


def _tolerance(value: Any, place: Place) -> Tolerance:
    table = place.table(value, "lengths", "angles")
    return Tolerance(
        _number(table["lengths"], place.key("lengths")),
        _number(table["angles"], place.key("angles")),
    )


def _joint(value: Any, place: Place) -> CertifiedJoint:
    table = place.table(value, "name", "type", "axis", "before")
    return CertifiedJoint(
        name=place.key("name").text(table["name"]),
        kind=cast(JointKind, place.key("type").text(table["type"])),
        axis=_vector(table["axis"], place.key("axis")),
        before=place.key("before").items(table["before"], _motion),
    )


def _motion(value: Any, place: Place) -> Motion:
    if isinstance(value, dict) and "translate" in value:
        table = place.table(value, "translate")
        return Translate(_vector(table["translate"], place.key("translate")))
    if isinstance(value, dict) and "within" in value:
        kind: Literal["turn", "slide"] = "turn" if "turn" in value else "slide"
        table = place.table(value, kind, "within")
        axis = _vector(table[kind], place.key(kind))
        return Loose(kind, axis, _number(table["within"], place.key("within")))
    table = place.table(value, "rotate", "angle")
    at = place.key("angle")
    angle = at.table(table["angle"], "pi", "rad")
    return Rotate(
        axis=_vector(table["rotate"], place.key("rotate")),
        half_turns=_number(angle["pi"], at.key("pi")),
        radians=_number(angle["rad"], at.key("rad")),
    )


def _row(value: Any, place: Place) -> Posture:
    return place.items(value, _number)


def _vector(value: Any, place: Place) -> Vector:
    row = _row(value, place)
    if len(row) != 3:
        place.fail(f"{len(row)} values", "give 3")
    x, y, z = row
    return x, y, z


def _number(value: Any, place: Place) -> Fraction:
    try:
        return fraction_from_text(place.text(value))
    except ValueError as error:
        place.fail(_short(value), str(error))


def _short(value: Any) -> str:
    """What stands in the file, cut to fit in a message of one line."""
    text = repr(value)
    return text if len(text) <= 40 else f"{text[:36]} ..."
