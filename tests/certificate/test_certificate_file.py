from __future__ import annotations

import copy
import json
import os
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from certified_arms import issac
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.certificate import (
    PathCertificate,
    Rotate,
    Tolerance,
    certificate_from_text,
    check_certificate,
    file,
    read_certificate,
    text_from_certificate,
    verify,
    write_certificate,
)
from cuspaudit.errors import InvalidCertificateError

TEXT = text_from_certificate(issac())
TREE = json.loads(TEXT)


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Every key of every object, and the first items of every list."""
    if isinstance(value, dict):
        for key in value:
            yield (*path, key)
            yield from places(value[key], (*path, key))
    elif isinstance(value, list):
        for index, item in enumerate(value[:2]):
            yield from places(item, (*path, index))


def leaves(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Every value that is no object and no list."""
    if isinstance(value, dict):
        for key in value:
            yield from leaves(value[key], (*path, key))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from leaves(item, (*path, index))
    else:
        yield path


def parent(tree: Any, path: tuple[Any, ...]) -> Any:
    """The container of the value at ``path``."""
    for key in path[:-1]:
        tree = tree[key]
    return tree


def changed(path: tuple[Any, ...], value: Any) -> str:
    """The certificate's text with another value at ``path``."""
    tree = copy.deepcopy(TREE)
    parent(tree, path)[path[-1]] = value
    return json.dumps(tree)


KEYS = list(places(TREE))
NUMBERS = [path for path in leaves(TREE) if path[0] in ("postures", "path")]
NUMBERS += [path for path in leaves(TREE) if "before" in path or "tool" in path]
NUMBERS += [path for path in leaves(TREE) if "axis" in path]


def test_a_certificate_survives_its_file(tmp_path: Path, arm6: PathCertificate) -> None:
    """What is written is read back, equal in every exact number."""
    for certificate in (issac(), arm6):
        path = tmp_path / "arm.json"
        write_certificate(path, certificate)
        assert read_certificate(path) == certificate
        assert certificate_from_text(path.read_text()) == certificate


def test_radians_and_half_turns_survive(arm3: PathCertificate) -> None:
    """An angle keeps its two parts."""
    tool = (
        Rotate((Fraction(0), Fraction(3), Fraction(4)), Fraction(1, 3), Fraction(1)),
    )
    certificate = replace(arm3, tool=tool)
    assert certificate_from_text(text_from_certificate(certificate)) == certificate


def test_numbers_limits_and_tolerance_survive(arm3: PathCertificate) -> None:
    """What may be left out of a file is read back where it is there."""
    certificate = replace(
        arm3,
        numbers="snapped",
        limits=(None, (Fraction(-1), Fraction(1, 3)), None),
        tolerance=Tolerance(Fraction(1, 1000), Fraction(0)),
    )
    assert certificate_from_text(text_from_certificate(certificate)) == certificate


def test_the_first_version_is_read() -> None:
    """A file of version 1 is a path, and none of the later keys stands in it."""
    tree = copy.deepcopy(TREE)
    del tree["kind"]
    tree["schema"] = "cuspaudit/certificate/1"
    assert certificate_from_text(json.dumps(tree)) == issac()
    for key, value in (("kind", "path"), ("limits", [None] * 3)):
        with pytest.raises(InvalidCertificateError, match="unknown key"):
            certificate_from_text(json.dumps(tree | {key: value}))


def test_a_claim_beyond_the_proof_is_refused(arm3: PathCertificate) -> None:
    """A tolerance of a whole metre and radian, in which no couple lasts."""
    result = verify(replace(arm3, tolerance=Tolerance(Fraction(1), Fraction(1))))
    assert not result.accepted
    assert "every robot" in result.reason


def test_the_file_stands_alone() -> None:
    """The robot, the sign, the postures and the path are all in the text."""
    assert TREE["schema"] == "cuspaudit/certificate/2"
    assert TREE["kind"] == "path"
    assert TREE["robot"]["task"] == "position"
    assert TREE["robot"]["joints"][1]["before"][2] == {
        "rotate": ["1", "0", "0"],
        "angle": {"pi": "-0.5", "rad": "0"},
    }
    assert TREE["postures"][0] == ["0", "-0.742", "2.628"]
    assert TREE["path"] == TREE["postures"]


@pytest.mark.parametrize("path", KEYS, ids=lambda p: ".".join(map(str, p)))
def test_a_file_without_one_of_its_keys_is_no_certificate(path: Any) -> None:
    """Any key removed, the error names it."""
    tree = copy.deepcopy(TREE)
    del parent(tree, path)[path[-1]]
    with pytest.raises(InvalidCertificateError) as caught:
        certificate_from_text(json.dumps(tree), "arm.json")
    motion = {"translate", "rotate"} & set(path[-1:])
    assert motion or str(path[-1]) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("path", KEYS, ids=lambda p: ".".join(map(str, p)))
def test_a_file_with_a_key_more_is_no_certificate(path: Any) -> None:
    """Nothing is skipped: a key that the checker would not read is refused."""
    tree = copy.deepcopy(TREE)
    parent(tree, path)["extra"] = "0"
    with pytest.raises(InvalidCertificateError, match="unknown key"):
        certificate_from_text(json.dumps(tree))


@given(st.integers(min_value=0, max_value=len(TEXT) - 3))
def test_a_file_cut_anywhere_is_no_certificate(length: int) -> None:
    """A truncated file is refused wherever it was cut."""
    with pytest.raises(InvalidCertificateError):
        certificate_from_text(TEXT[:length])


@pytest.mark.parametrize(
    "bad", ["nan", "inf", "1e999999999", "", "1e2", "9" * 401, 1, 0.5, None, [], True]
)
@pytest.mark.parametrize("path", NUMBERS[::5], ids=lambda p: ".".join(map(str, p)))
def test_what_is_no_number_is_named(path: Any, bad: Any) -> None:
    """NaN, infinities, exponents and numbers that are no strings are refused."""
    with pytest.raises(InvalidCertificateError):
        certificate_from_text(changed(path, bad))


@pytest.mark.parametrize("constant", ["NaN", "Infinity", "-Infinity"])
def test_json_constants_are_refused(constant: str) -> None:
    """Python's extensions of JSON are no numbers."""
    with pytest.raises(InvalidCertificateError, match="no number"):
        certificate_from_text(TEXT.replace('"-0.742"', constant, 1))


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("schema",), "cuspaudit/certificate/3"),
        (("schema",), 1),
        (("kind",), "proof"),
        (("kind",), ["path"]),
        (("numbers",), "exact"),
        (("numbers",), None),
        (("limits",), None),
        (("limits",), [None, None]),
        (("limits",), [None, None, ["1", "1"]]),
        (("limits",), [None, None, ["1", "0"]]),
        (("limits",), [None, None, ["1"]]),
        (("tolerance",), None),
        (("tolerance",), {"lengths": "1"}),
        (("tolerance",), {"lengths": "-1", "angles": "0"}),
        (("sign",), 0),
        (("sign",), True),
        (("sign",), "1"),
        (("sign",), 1.0),
        (("robot",), []),
        (("robot", "name"), 3),
        (("robot", "task"), "orientation"),
        (("robot", "task"), "pose"),
        (("robot", "joints"), {}),
        (("robot", "joints"), []),
        (("robot", "joints", 0), "joint"),
        (("robot", "joints", 0, "type"), "fixed"),
        (("robot", "joints", 0, "axis"), ["0", "0", "0"]),
        (("robot", "joints", 0, "axis"), ["0", "1"]),
        (("robot", "joints", 1, "before", 0), {"translate": ["1"]}),
        (("robot", "joints", 1, "before", 0), {"scale": ["1", "1", "1"]}),
        (("robot", "joints", 1, "before", 2, "rotate"), ["0", "0", "0"]),
        (("robot", "joints", 1, "before", 2, "angle"), "1/2"),
        (("robot", "tool"), None),
        (("postures",), [["0", "0", "0"]]),
        (("postures", 1), ["0", "0"]),
        (("path",), [["0", "0", "0"]]),
        (("path",), []),
        (("path", 0), ["0", "0", "0", "0"]),
        (("path", 0), "000"),
        (("made_by",), None),
    ],
)
def test_a_value_of_the_wrong_kind_is_named(path: Any, value: Any) -> None:
    """Each part is held to its kind, and the error says where it stands."""
    with pytest.raises(InvalidCertificateError) as caught:
        certificate_from_text(changed(path, value))
    assert str(path[0]) in caught.value.where


@pytest.mark.parametrize(
    "text",
    ["", "null", "[]", "3", '"x"', "{}", "[" * 100_000, TEXT + "x", "1" * 5000],
)
def test_other_json_is_no_certificate(text: str) -> None:
    """Text that is no object with the keys is refused, without a crash."""
    with pytest.raises(InvalidCertificateError):
        certificate_from_text(text)


def test_a_key_that_comes_twice_is_refused() -> None:
    """Two values for one key would let two readers read two robots."""
    with pytest.raises(InvalidCertificateError, match="twice"):
        certificate_from_text(TEXT.replace('"sign"', '"sign": -1, "sign"', 1))


def test_unreadable_files_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A missing, a binary and an overlong file are bad input, not a traceback."""
    with pytest.raises(InvalidCertificateError, match=r"nowhere\.json"):
        read_certificate(tmp_path / "nowhere.json")
    path = tmp_path / "arm.json"
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(InvalidCertificateError, match="UTF-8"):
        read_certificate(path)
    path.write_text(TEXT)
    monkeypatch.setattr(file, "LARGEST", 100)
    with pytest.raises(InvalidCertificateError, match="too long"):
        read_certificate(path)


def test_a_failed_write_leaves_the_old_file(
    tmp_path: Path, arm3: PathCertificate, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file is replaced whole or not at all, and no temporary file is left."""
    path = tmp_path / "arm.json"
    write_certificate(path, arm3)

    def no_space(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", no_space)
    with pytest.raises(InvalidCertificateError, match="No space"):
        write_certificate(path, replace(arm3, made_by="another"))
    assert read_certificate(path) == arm3
    assert [each.name for each in tmp_path.iterdir()] == ["arm.json"]
    with pytest.raises(InvalidCertificateError, match="cannot be written"):
        write_certificate(tmp_path / "no folder" / "arm.json", arm3)


def test_what_could_not_be_read_is_not_written(arm3: PathCertificate) -> None:
    """A number too long to be read again stops the writer."""
    first, second = arm3.postures
    third = (Fraction(1, 3**1000), *second[1:])
    with pytest.raises(InvalidCertificateError, match="too long"):
        text_from_certificate(replace(arm3, postures=(first, third)))


def test_floats_are_no_part_of_a_certificate(arm3: PathCertificate) -> None:
    """A certificate built with a float, or with a wrong sign, is not well formed."""
    first: Any = (0.0, -0.742, 2.628)
    with pytest.raises(InvalidCertificateError, match="rational"):
        verify(replace(arm3, postures=(first, first)))
    sign: Any = 2
    with pytest.raises(InvalidCertificateError, match="sign"):
        check_certificate(replace(arm3, sign=sign))
