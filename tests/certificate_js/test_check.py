"""Two checkers that share no line give one answer, on true and on forged files."""

from __future__ import annotations

import json
import random
import re
import subprocess
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from certified_arms import (
    ARMS,
    crx,
    divided,
    excursion,
    issac,
    moved,
    sliding,
    with_offset,
)
from false_claims import is_false
from second_checker import FOLDER, NODE, needs_node, second_answers
from structured_arms import some_pairs, some_structures

from cuspaudit.certificate import (
    Certificate,
    CuspCertificate,
    PathCertificate,
    read_certificate,
    verify,
    write_certificate,
)
from cuspaudit.errors import InvalidCertificateError

pytestmark = needs_node

CONFORMANCE = Path(__file__).parents[2] / "certificates"
ACCEPTED = sorted((CONFORMANCE / "accepted").glob("*.json"))
FORGED = sorted((CONFORMANCE / "forged").glob("*.json"))
SLOW = ("crx-", "gofa-", "hc10-", "lwa4p-", "piper-", "xarm6-every", "limits-within")
"""Certificates that take a checker longer than others; the digits of others change."""
REASONS = json.loads((CONFORMANCE / "reasons.json").read_text())


def first_answer(file: Path) -> bool:
    """Whether the first checker accepts the file."""
    try:
        return verify(read_certificate(file)).accepted
    except InvalidCertificateError:
        return False


def both(folder: Path, claims: Sequence[Certificate]) -> list[tuple[bool, bool]]:
    """What each of the two says of certificates, written to files first."""
    files = [folder / f"{index}.json" for index in range(len(claims))]
    for file, claim in zip(files, claims, strict=True):
        write_certificate(file, claim)
    second = second_answers(files)
    return [(first_answer(file), second[file].accepted) for file in files]


def test_the_second_checker_is_small_and_alone() -> None:
    """Under 1,200 lines that are not blank, none long, and no import from outside."""
    files = sorted(FOLDER.glob("*.js"))
    lines = [line for file in files for line in file.read_text().splitlines()]
    assert sum(bool(line.strip()) for line in lines) < 1200
    assert max(map(len, lines)) < 120
    imports = {
        name
        for file in files
        for name in re.findall(r'from "([^"]+)"', file.read_text())
    }
    assert all(name.startswith("./") for name in imports)
    text = "".join(file.read_text() for file in files if file.suffix == ".js")
    for door in (
        "eval(",
        "import(",
        "Function(",
        "fetch(",
        "node:",
        "require(",
        "document",
    ):
        assert door not in text


def test_true_certificates_are_accepted_by_both() -> None:
    """Every file of the folder of true certificates, in less than a second each."""
    second = second_answers(ACCEPTED)
    assert len(ACCEPTED) >= 19
    for file in ACCEPTED:
        assert first_answer(file), file.name
        assert second[file].accepted, (file.name, second[file].reason)
        assert second[file].milliseconds < 2000


def test_forged_files_are_accepted_by_none() -> None:
    """Each kind of forgery has its reason, and neither checker takes it."""
    assert len(FORGED) >= 60
    assert [file.name for file in FORGED] == sorted(REASONS)
    second = second_answers(FORGED)
    for file in FORGED:
        assert not first_answer(file), file.name
        assert not second[file].accepted, file.name


def test_the_certificates_of_the_tests_are_accepted_by_both(tmp_path: Path) -> None:
    """The known arms as one segment and as twenty, and a structure of every theorem."""
    claims: list[Certificate] = [make() for make in ARMS.values()]
    claims += [divided(make(), 20) for make in ARMS.values()]
    claims += [*some_structures().values(), *some_pairs().values()]
    assert both(tmp_path, claims) == [(True, True)] * len(claims)


def test_a_hair_makes_the_same_difference_to_both(tmp_path: Path) -> None:
    """1e-9 before a singularity is accepted, 1e-9 beyond it refused, by both."""
    claims, hair = [], Fraction(1, 10**9)
    for make, seed in [(issac, 0), (issac, 2), (sliding, 1), (crx, 0)]:
        arm = make()
        direction = np.random.default_rng(seed).normal(size=len(arm.joints))
        claims += [excursion(arm, direction, past) for past in (-hair, hair)]
    assert both(tmp_path, claims) == [(True, True), (False, False)] * 4


def test_falsified_claims_are_refused_by_both(tmp_path: Path) -> None:
    """The other sign, a posture moved, an arm whose zero is elsewhere."""
    claims: list[PathCertificate] = []
    for make in (issac, sliding, crx):
        arm = make()
        claims.append(replace(arm, sign=-arm.sign))
        claims += [
            moved(arm, index, joint, Fraction(1, 1000))
            for index in (0, 1)
            for joint in range(3)
        ]
    claims.append(with_offset())
    assert both(tmp_path, claims) == [(False, False)] * len(claims)


def test_limits_are_held_by_both(tmp_path: Path) -> None:
    """A path just inside its limits is accepted, one that touches a limit refused."""
    arm = issac()
    low = min(row[1] for row in arm.path)
    claims = []
    for beyond in (Fraction(1, 10**6), Fraction(0), Fraction(-1, 10**6)):
        claims.append(replace(arm, limits=(None, (low - beyond, Fraction(9)), None)))
    assert both(tmp_path, claims) == [(True, True), (False, False), (False, False)]


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    """No crash, and no answer but no."""
    missing = tmp_path / "nowhere.json"
    assert not second_answers([missing])[missing].accepted


def test_no_file_is_no_proof() -> None:
    """A run that no certificate is given to does not end like one that accepts all."""
    assert NODE is not None
    command = [NODE, str(FOLDER / "run.mjs")]
    run = subprocess.run(
        command, capture_output=True, text=True, timeout=60, check=False
    )
    assert run.returncode == 2
    assert not run.stdout
    assert "no certificate is named" in run.stderr


# --- one digit changed


def one_digit_changed(text: str, rng: random.Random) -> str:
    """The text with one digit of one number of the proof replaced by another."""
    start = text.index('"joints"')
    places = [
        m.start()
        for m in re.finditer(r'(?<=[0-9"./-])[0-9](?=[0-9"./])', text)
        if m.start() > start and not _in_a_name(text, m.start())
    ]
    place = rng.choice(places)
    digit = rng.choice([d for d in "0123456789" if d != text[place]])
    return text[:place] + digit + text[place + 1 :]


def _in_a_name(text: str, place: int) -> bool:
    before = text.rfind('"', 0, place)
    return text[max(0, before - 8) : before + 1] == '"name": "'


def mutants(count: int, seed: int, kind: str = "") -> list[str]:
    """Texts with one digit changed, of certificates in turn.

    Without a kind: of every one but pairs, which are long in being refused.
    """
    rng = random.Random(seed)
    quick = [file for file in ACCEPTED if not file.stem.startswith(SLOW)]
    files = [f for f in quick if f.stem.endswith("pairs") == (kind == "pairs")]
    texts = [file.read_text() for file in files]
    return [one_digit_changed(texts[k % len(texts)], rng) for k in range(count)]


def check_mutants(
    folder: Path, count: int, seed: int, kind: str = ""
) -> tuple[int, int]:
    """Neither checker accepts what has become false; how many are false, accepted.

    Both give one answer, but for a cusp whose posture has moved a little: it is still
    next to the cusp, and doubles may be too coarse to reach it.
    """
    files, false, accepted = [], 0, 0
    for index, text in enumerate(mutants(count, seed, kind)):
        files.append(folder / f"{index}.json")
        files[-1].write_text(text)
    second = second_answers(files)
    for file in files:
        answers = first_answer(file), second[file].accepted
        try:
            claim = read_certificate(file)
            false_now, is_cusp = is_false(claim), isinstance(claim, CuspCertificate)
        except InvalidCertificateError:
            false_now, is_cusp = True, False
        if not (is_cusp and answers[0]):
            assert answers[0] == answers[1], (file.read_text(), second[file].reason)
        false, accepted = false + false_now, accepted + all(answers)
        assert not (false_now and any(answers)), file.read_text()
    return false, accepted


def test_one_digit_makes_a_claim_false_to_both(tmp_path: Path) -> None:
    """Forty mutants: some are false, some still true, and both see which."""
    false, accepted = check_mutants(tmp_path, 40, 1)
    assert false >= 12
    assert accepted >= 4


@pytest.mark.slow
def test_a_thousand_digits(tmp_path: Path) -> None:
    """A thousand mutants, none of the false ones accepted by either."""
    false, accepted = check_mutants(tmp_path, 1000, 2)
    assert false >= 300
    assert accepted >= 100


@pytest.mark.slow
def test_digits_of_pairs(tmp_path: Path) -> None:
    """Of pairs too no false one is accepted: arms that have got a cusp."""
    _, accepted = check_mutants(tmp_path, 6, 3, "pairs")
    assert accepted >= 1
