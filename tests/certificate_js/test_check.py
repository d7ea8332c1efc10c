"""Two checkers that share no line give one answer, on true and on forged files."""

from __future__ import annotations

import json
import random
import re
import subprocess
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from certified_arms import (
    ARMS,
    crx,
    det,
    divided,
    excursion,
    issac,
    kinematics,
    moved,
    sliding,
    with_offset,
)
from second_checker import FOLDER, NODE, needs_node, second_answers
from structured_arms import some_pairs, some_structures

from cuspaudit.certificate import (
    Certificate,
    PathCertificate,
    StructureCertificate,
    read_certificate,
    text_from_certificate,
    verify,
    write_certificate,
)
from cuspaudit.errors import InvalidCertificateError

pytestmark = needs_node

CONFORMANCE = Path(__file__).parents[2] / "certificates"
ACCEPTED = sorted((CONFORMANCE / "accepted").glob("*.json"))
FORGED = sorted((CONFORMANCE / "forged").glob("*.json"))
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
    """Under 1,500 lines that are not blank, and nothing is imported from outside."""
    files = sorted(FOLDER.glob("*.js"))
    lines = [line for file in files for line in file.read_text().splitlines()]
    assert sum(bool(line.strip()) for line in lines) < 1500
    assert max(map(len, lines)) < 140
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


def is_false(claim: Certificate) -> bool:
    """Whether floating point shows that the claim does not hold, beyond doubt.

    A path: the values of the two postures differ by more than 1e-7, the ends do not
    fit, or det J has the wrong sign at one of 300 points. A structure: an angle or a
    distance that ought to be 0 is more than 1e-9.
    """
    if isinstance(claim, PathCertificate):
        return _is_false_path(claim)
    assert isinstance(claim, StructureCertificate)
    return _is_false_structure(claim)


def _is_false_path(claim: PathCertificate) -> bool:
    first, second = claim.postures
    if claim.path[0] != first or claim.path[-1] != second:
        return True
    (T, _), (U, _) = kinematics(claim, first), kinematics(claim, second)  # type: ignore[arg-type]
    rows = T[:3] - U[:3] if len(claim.joints) == 6 else T[:3, 3] - U[:3, 3]
    if np.abs(rows).max() > 1e-7:
        return True
    for a, b in pairwise(claim.path):
        for s in np.linspace(0, 1, 300 // (len(claim.path) - 1)):
            q = [float(x) + s * float(y - x) for x, y in zip(a, b, strict=True)]
            if claim.sign * det(claim, q) < -1e-12:
                return True
    return False


def _is_false_structure(claim: StructureCertificate) -> bool:
    q = [0.3 * k for k, _ in enumerate(claim.joints)]
    lines = _lines(claim, q)
    for relation in claim.relations:
        chosen = [lines[k - 1] for k in relation.axes]
        for (u, p), (v, r) in pairwise(chosen):
            normal = np.cross(u, v)
            if relation.word == "parallel" and np.linalg.norm(normal) > 1e-9:
                return True
            if relation.word == "square" and abs(u @ v) > 1e-9:
                return True
            if relation.word == "meeting" and abs((r - p) @ normal) > 1e-9:
                return True
    return False


def _lines(claim: Any, q: Sequence[float]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Direction and a point of each axis at joint values q, in floats."""
    _, J = kinematics(claim, q)
    tip = kinematics(claim, q)[0][:3, 3]
    found = []
    for k, joint in enumerate(claim.joints):
        w, v = (J[3:, k], J[:3, k]) if joint.kind == "revolute" else (J[:3, k], None)
        # v = w x (tip - p), with w of length 1: p = tip - v x w is on the axis
        found.append((w, tip if v is None else tip - np.cross(v, w)))
    return found


def mutants(count: int, seed: int) -> list[str]:
    """Texts with one digit changed, of certificates of every kind in turn."""
    rng = random.Random(seed)
    texts = [
        text_from_certificate(replace(claim, made_by=""))
        for claim in (
            *(ARMS[name]() for name in ("issac", "sliding", "crx", "jaco_gen2")),
            *some_structures().values(),
        )
    ]
    return [one_digit_changed(texts[k % len(texts)], rng) for k in range(count)]


def check_mutants(folder: Path, count: int, seed: int) -> tuple[int, int]:
    """Neither checker accepts what has become false; how many are false, accepted."""
    files, false, accepted = [], 0, 0
    for index, text in enumerate(mutants(count, seed)):
        files.append(folder / f"{index}.json")
        files[-1].write_text(text)
    second = second_answers(files)
    for file in files:
        answers = first_answer(file), second[file].accepted
        assert answers[0] == answers[1], (file.read_text(), second[file].reason)
        try:
            false_now = is_false(read_certificate(file))
        except InvalidCertificateError:
            false_now = True
        false, accepted = false + false_now, accepted + answers[0]
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
