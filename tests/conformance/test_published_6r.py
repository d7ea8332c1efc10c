"""Six-joint arms without a theorem: what is published of them, and what is proved."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import cuspaudit
from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.witness import certificate_of, certified
from cuspaudit.certificate import verify
from cuspaudit.robot.chain import Chain, Joint, Translation
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.frames import jacobian
from cuspaudit.robot.library import open_robot

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"
Rows = tuple[tuple[object, object, object], ...]

Z, Y, X = ("0", "0", "1"), ("0", "1", "0"), ("1", "0", "0")
MINUS_Z, MINUS_Y, MINUS_X = ("0", "0", "-1"), ("0", "-1", "0"), ("-1", "0", "0")
NONE = ("0", "0", "0")

PRODUCTS_OF_EXPONENTIALS = {
    "crx": (
        (Z, Y, MINUS_Y, MINUS_X, MINUS_Y, MINUS_X),
        (
            ("0", "0", "0.245"),
            NONE,
            ("0", "0", "0.71"),
            NONE,
            ("0.54", "-0.15", "0"),
            ("0.16", "0", "0"),
        ),
    ),
    "gofa": (
        (Z, Y, Y, X, Y, X),
        (
            NONE,
            ("0", "0", "0.265"),
            ("0", "0", "0.444"),
            ("0", "0", "0.11"),
            ("0.47", "0", "0"),
            ("0", "0", "0.08"),
        ),
    ),
    "jaco2": (
        (MINUS_Z, MINUS_Y, Y, MINUS_Z, ("0", "-0.866025403784439", "-0.5"), MINUS_Z),
        (
            ("0", "0", "0.15675"),
            ("0", "0.0016", "0.11875"),
            ("0", "0", "-0.41"),
            ("0", "-0.0114", "0.2073"),
            ("0", "0.03703", "0.06414"),
            ("0", "0.03703", "0.06414"),
        ),
    ),
    "xarm6": (
        (Z, Y, Y, MINUS_Z, Y, MINUS_Z),
        (
            ("0", "0", "0.267"),
            NONE,
            ("0.0535", "0", "0.2845"),
            ("0.0775", "0", "-0.3425"),
            NONE,
            ("0.076", "0", "-0.097"),
        ),
    ),
}
COUPLES = {
    "jaco": (
        "-3.120092470828 0.708443663229 1.490229800567"
        " 2.61999307176 -1.963267524543 -1.881961383418",
        "2.472352422606 0.093721874112 2.028182382333"
        " -1.491333538969 -2.42332307626 2.434887957753",
    ),
    "crx": (
        "-3.10159265359 -1.98 -1.36159265359 0.47159265359 0.32 -1.94",
        "-2.351541039862 -2.089140450037 -0.943744242273"
        " 4.202133156789 0.36555118529 -5.061892439164",
    ),
    "gofa": (
        "-0.8 0.59 2.34 2.72 1.06 -1.84",
        "2.259908262326 2.19985826615 2.667688761117"
        " 2.529777454606 -2.528612242718 0.48314656653",
    ),
    "jaco2": (
        "-1.648410281258 2.283285436426 0.492104361132"
        " 0.020057768214 -1.878516820424 1.110688778004",
        "0.990639546092 2.605670258822 0.303040618222"
        " 2.060658963384 -2.908297691948 -0.296983527512",
    ),
    "xarm6": (
        "-0.496835034695 -1.779707150236 -0.029628901299"
        " -0.428190437316 0.84766969277 -1.051444278015",
        "2.41913727588 -1.84254702967 -0.487893816283"
        " -0.510545944956 -2.886037030662 1.179814300887",
    ),
}
CUSPIDAL = (
    "abb-gofa-5",
    "fanuc-crx-10ia-l",
    "hyperplane-6r",
    "kinova-jaco-gen2",
    "raghavan-roth",
    "ufactory-xarm6",
)


def chain_of(name: str) -> Chain:
    """The JACO Gen2 of its robot file, the others by products of exponentials."""
    if name == "jaco":
        return read_robot(ROBOTS / "kinova-jaco-gen2.yaml").chain
    axes, steps = PRODUCTS_OF_EXPONENTIALS[name]
    joints = [
        Joint(f"joint_{k}", "revolute", (Translation(_vector(step)),), _vector(axis))
        for k, (axis, step) in enumerate(zip(axes, steps, strict=True), 1)
    ]
    return Chain(name, tuple(joints), (), "pose")


def couple_of(name: str) -> np.ndarray:
    """The two published joint vectors, (2, 6)."""
    return np.array([[float(x) for x in row.split()] for row in COUPLES[name]])


def _vector(entries: tuple[str, ...]) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = map(Fraction, entries)
    return (x, y, z)


@pytest.mark.parametrize("name", COUPLES)
def test_published_straight_paths_are_proved(name: str) -> None:
    """The straight segment between the published postures, as listed, is accepted."""
    witness = certified(chain_of(name), couple_of(name))
    assert witness.verification.accepted, witness.verification.reason
    assert witness.verification.seconds < 2


@pytest.mark.parametrize("name", COUPLES)
def test_what_was_altered_is_rejected(name: str) -> None:
    """The other sign, a moved end, equal postures, another length: each is refused."""
    chain, couple = chain_of(name), couple_of(name)
    sign = int(np.sign(np.linalg.det(jacobian(chain, couple[0]))))
    moved = couple + np.array([[0.0] * 6, [0, 1e-6, 0, 0, 0, 0]])
    turned = couple[[0, 0]] + np.array([[0.0] * 6, [2 * np.pi, 0, 0, 0, 0, 0]])
    longer = replace(chain.joints[2].before[0], vector=_vector(("0.1", "0.2", "0.3")))
    joints = list(chain.joints)
    joints[2] = replace(joints[2], before=(longer,))
    for altered in (
        certificate_of(chain, -sign, couple),
        certificate_of(chain, sign, moved),
        certificate_of(chain, sign, turned),
        certificate_of(chain.with_joints(joints), sign, couple),
    ):
        assert not verify(altered).accepted


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("name", CUSPIDAL)
def test_offset_wrists_are_cuspidal(name: str, seed: int) -> None:
    """Every cobot with an offset wrist, and the general arms: proved by a witness."""
    found = audit(open_robot(name), Options(seed=seed))
    record = found.record()
    assert record["verdict"] == "cuspidal"
    assert record["proof"]["engine"] == "search"
    assert record["models"] == {"literal": "cuspidal", "snapped": "cuspidal"}
    assert record["witness"]["clearance"] > 0.001
    assert found.witness is not None
    assert verify(found.witness.certificate).accepted
    assert record["postures"]["max"] >= 4
