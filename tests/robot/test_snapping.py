from __future__ import annotations

import json
import math
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest
from axis_structure import are_parallel, lines, meet_in_one_point, structure

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
)
from cuspaudit.robot.formats.read_robot import read_robot
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.relations import relations
from cuspaudit.robot.snap_policy import (
    NO_SNAPPING,
    SnapPolicy,
    policy_from_name,
)
from cuspaudit.robot.snapping import snap


def turned(text: str) -> Chain:
    """A chain of one joint behind a twist of ``text`` rad."""
    angle = Angle(radians=Fraction(text))
    return Chain(
        "arm", (Joint("j", "revolute", (Rotation(X_AXIS, angle, "j rpy[0]"),)),)
    )


@pytest.mark.parametrize(
    ("text", "used"),
    [
        ("1.57", "pi/2"),
        ("-1.571", "-pi/2"),
        ("1.5708", "pi/2"),
        ("1.5707", "pi/2"),
        ("3.14", "pi"),
        ("3.1416", "pi"),
        ("-3.141592653589793", "-pi"),
        ("4.71", "3*pi/2"),
        ("1.570796326589793", "pi/2"),
        ("1.57080287682252", "pi/2"),
        ("1.0471975511965976", "pi/3"),
        ("0.7854", "pi/4"),
        ("0.0000036732051036", "0"),
    ],
)
def test_printed_multiples_of_pi(text: str, used: str) -> None:
    """A multiple of pi rounded or cut anywhere is taken for it, and listed."""
    chain, (record,) = snap(turned(text))
    assert (record.where, record.used) == ("j rpy[0]", used)
    assert record.given == float(text)
    exact = chain.joints[0].before[0].angle if chain.joints[0].before else Angle()
    assert exact.radians == 0
    expected = float(exact.half_turns) * math.pi - record.given
    assert record.difference == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize(
    "text",
    ["0.0486795", "1.5", "1.6", "1.58", "1.5690123", "0.0001", "3.1", "1.535866"],
)
def test_genuine_angles_survive(text: str) -> None:
    """An angle that no truncation of a multiple of pi prints is left as it is."""
    chain = turned(text)
    assert snap(chain) == (chain, ())


def test_exact_angles_survive() -> None:
    """What is written with pi or in degrees is exact and is left as it is."""
    angle = Angle(Fraction(1, 2), Fraction(1, 10**6))
    chain = Chain("arm", (Joint("j", "revolute", (Rotation(X_AXIS, angle),)),))
    assert snap(chain) == (chain, ())


@pytest.mark.parametrize(
    ("unit", "text", "kept"),
    [
        ("m", "0.000002", False),
        ("m", "0.00035", True),
        ("m", "0.0000051", True),
        ("mm", "0.002", False),
        ("mm", "0.35", True),
    ],
)
def test_only_noise_in_a_length_goes(unit: str, text: str, kept: bool) -> None:
    """At most 5e-6 m counts as 0; a genuine 0.35 mm offset survives, in any unit."""
    shift = Translation((Fraction(text), Fraction(0), Fraction(1)), "j xyz")
    joints = (Joint("i", "revolute"), Joint("j", "revolute", (shift,), Y_AXIS))
    chain = Chain("arm", joints, unit=unit)
    snapped, record = snap(chain)
    assert (snapped == chain) == kept
    assert [(r.where, r.used) for r in record] == ([] if kept else [("j xyz[0]", "0")])


def test_noise_in_an_axis_goes() -> None:
    """An axis that is a coordinate axis but for noise becomes it, exactly."""
    axis = (Fraction(-3, 10**6), Fraction(0), Fraction(1))
    chain, (record,) = snap(Chain("arm", (Joint("j", "revolute", (), axis),)))
    assert chain.joints[0].axis == Z_AXIS
    assert (record.where, record.given) == ("j axis[0]", -3e-6)


def test_a_policy_can_be_stricter() -> None:
    """With tolerances of 0 only printed multiples of a right angle are snapped."""
    strict = SnapPolicy(Fraction(0), Fraction(0), Fraction(0))
    assert snap(turned("1.57080287682252"), strict)[1] == ()
    assert len(snap(turned("1.5708"), strict)[1]) == 1


def test_nothing_can_be_snapped() -> None:
    """With the policy `none` even a printed pi/2 stays what it is."""
    chain = turned("1.5708")
    assert policy_from_name("none") == NO_SNAPPING
    assert snap(chain, NO_SNAPPING) == (chain, ())


def test_a_policy_is_read_from_a_file(tmp_path: Path) -> None:
    """A file changes the tolerances it names, as exact decimals, and is recorded."""
    path = tmp_path / "tight.yaml"
    path.write_text("length: 1e-9\nprinted: false\n")
    policy = policy_from_name(str(path))
    assert policy == SnapPolicy(
        length=Fraction(1, 10**9), printed=False, name=str(path)
    )
    assert policy.record() == {
        **{"name": str(path), "angle": "0.00001", "length": "0.000000001"},
        **{"axis": "0.00001", "printed": False},
    }


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("length: -1", "write a number from 0 to 1"),
        ("length: 2", "write a number from 0 to 1"),
        ("length: one", "is not a number"),
        ("printed: maybe", "no entry of a policy"),
        ("width: 1", "width: no entry of a policy"),
        ("1", "not a mapping"),
    ],
)
def test_a_bad_policy_is_refused(tmp_path: Path, text: str, said: str) -> None:
    """What is no policy is refused in one line that names the entry."""
    path = tmp_path / "bad.yaml"
    path.write_text(text)
    with pytest.raises(InvalidRobotError, match=said):
        policy_from_name(str(path))
    with pytest.raises(InvalidRobotError, match="give --snap none"):
        policy_from_name(str(tmp_path / "none.yaml"))


def noisy(*vector: Fraction | int, turn: Fraction | int = 0) -> tuple[Motion, ...]:
    """A translation, and a turn about x in rad."""
    x, y, z = (Fraction(entry) for entry in vector)
    return Translation((x, y, z)), Rotation(X_AXIS, Angle(radians=Fraction(turn)))


def test_each_snapped_number_says_what_it_changes() -> None:
    """A number names the axes that stand square, meet or are parallel because of it."""
    half, noise = Fraction("1.5708"), Fraction(1, 10**6)
    joints = (
        Joint("j1", "revolute"),
        Joint("j2", "revolute", noisy(0, noise, 1, turn=half)),
        Joint("j3", "revolute", noisy(1, 0, 0, turn=noise)),
        Joint("j4", "revolute", noisy(0, noise, 1, turn=half)),
    )
    _, record = snap(Chain("arm", joints, task="pose"))
    assert [(entry.given, entry.effect) for entry in record] == [
        (1.5708, "axes 1 and 2 are square"),
        (1e-6, "axes 2 and 3 are parallel"),
        (1.5708, "axes 3 and 4 are square"),
    ]


def test_noise_that_changes_no_relation_stays() -> None:
    """Noise before the first axis or along another length is no relation: it stays."""
    half, noise = Fraction("1.5708"), Fraction(1, 10**6)
    joints = (
        Joint("j1", "revolute", noisy(noise, 0, 1)),
        Joint("j2", "revolute", noisy(1, noise, 1, turn=half)),
        Joint("j3", "revolute", noisy(0, 1, 3, turn=half)),
    )
    snapped, record = snap(Chain("arm", joints, task="pose"))
    assert [entry.given for entry in record] == [1.5708, 1.5708]
    vectors = [joint.before[0].vector for joint in snapped.joints]
    assert vectors == [joint.before[0].vector for joint in joints]


def test_two_numbers_that_undo_each_other_stay_or_go_together() -> None:
    """A relation of the file is never lost to snapping one number out of two."""
    noise = Fraction(1, 10**6)
    there, back = noisy(noise, 0, 1)[0], noisy(-noise, 0, 1)[0]
    joints = (
        Joint("j1", "revolute"),
        Joint("j2", "revolute", (there, back), Y_AXIS),
    )
    chain = Chain("arm", joints, task="pose")
    assert relations(chain) <= relations(snap(chain)[0])


def cleared(chain: Chain) -> Chain:
    """The chain without any component of a translation of at most 5e-6 m."""

    def clear(motion: Motion) -> Motion:
        if isinstance(motion, Rotation):
            return motion
        x, y, z = (v if abs(v) > Fraction(5, 10**6) else 0 * v for v in motion.vector)
        return replace(motion, vector=(x, y, z))

    joints = [replace(j, before=tuple(map(clear, j.before))) for j in chain.joints]
    return replace(chain, joints=tuple(joints), tool=tuple(map(clear, chain.tool)))


def test_small_components_go_for_a_relation_and_all_relations_come(
    corpus: Path,
) -> None:
    """In public arms a length goes for a relation; to clear the rest adds none."""
    index = json.loads((corpus / "urdf" / "FK_ORACLE.json").read_text())["robots"]
    number = kept = 0
    for name, entry in index.items():
        path = corpus / "urdf" / f"{name}.urdf"
        chain = read_urdf(path, base=entry["root"], tip=entry["tip"]).chain
        snapped, record = snap(chain)
        assert relations(cleared(snapped)) <= relations(snapped), name
        small = [r for r in record if "xyz" in r.where]
        assert all(r.effect for r in small), name
        number += len(small)
        kept += cleared(snapped) != snapped
    assert number > 0
    assert kept > 0


def test_snapping_recovers_what_designers_meant(corpus: Path) -> None:
    """All public 6R arms have to 1e-12, snapped, the structure of the data sheet.

    As their files print them, they have that of the index, to its 1e-6.
    """
    index = json.loads((corpus / "urdf" / "INDEX.json").read_text())
    six = {name: entry for name, entry in index.items() if len(entry["dof"]) == 6}
    assert len(six) > 50
    found = {}
    for name, entry in six.items():
        path = corpus / "urdf" / f"{name}.urdf"
        chain = read_urdf(path, base=entry["root"], tip=entry["tip"]).chain
        assert structure(chain, 1e-6) == entry["klass"].removesuffix("~"), name
        found[name] = structure(snap(chain)[0])
        expected = entry["klass_snapped"].removesuffix("~")
        assert found[name] == expected, name
    gained = {name for name in six if six[name]["klass"] == "c~"} - {
        name for name in six if found[name] == "c"
    }
    assert {"doosan_m1013", "doosan_a0509", "aubo_i5", "fairino_fr3"} <= gained
    assert found["kinova_gen3_6dof"] == "c"


def triples(chain: Chain, tolerance: float) -> set[str]:
    """The three axes in a row that meet in one point, or are parallel.

    The tolerance is that of the gap between axes, twice the distance to its middle.
    """
    axes, found = lines(chain), set()
    for k in range(len(axes) - 2):
        group = axes[k : k + 3]
        parallel = [are_parallel(*pair, tolerance) for pair in pairwise(group)]
        numbers = f"({k + 1},{k + 2},{k + 3})"
        if all(parallel):
            found.add(f"parallel{numbers}")
        elif not any(parallel) and meet_in_one_point(group, tolerance / 2):
            found.add(f"concurrent{numbers}")
    return found


def test_the_literal_axes_of_all_arms_are_those_of_the_index(corpus: Path) -> None:
    """The 79 arms, of 3 to 7 joints, have to 1e-6 the triples that the index names."""
    index = json.loads((corpus / "urdf" / "INDEX.json").read_text())
    words = {"3 parallel": "parallel", "concurrent triple": "concurrent"}
    words |= dict.fromkeys(("spherical wrist", "spherical shoulder"), "concurrent")
    for name, entry in index.items():
        path = corpus / "urdf" / f"{name}.urdf"
        chain = read_urdf(path, base=entry["root"], tip=entry["tip"]).chain
        expected = {
            words[word] + "(" + numbers
            for word, _, numbers in (label.partition("(") for label in entry["labels"])
            if not word.startswith("NEAR")
        }
        assert triples(chain, 1e-6) == expected, name
    assert len(index) == 79


def test_snapping_recovers_the_shoulders_of_seven_joints(corpus: Path) -> None:
    """All public 7R arms have, snapped, the shoulder and wrist of the index."""
    ends = {"SRS": {1, 5}, "shoulder": {1}, "wrist": {5}, "general": set()}
    index = json.loads((corpus / "urdf" / "INDEX.json").read_text())
    gained = set()
    for name, entry in index.items():
        if len(entry["dof"]) != 7:
            continue
        path = corpus / "urdf" / f"{name}.urdf"
        chain = read_urdf(path, base=entry["root"], tip=entry["tip"]).chain
        found = triples(snap(chain)[0], 1e-12)
        expected = ends[entry["klass_snapped"].removeprefix("7R-")]
        balls = {f"concurrent({k},{k + 1},{k + 2})" for k in (1, 5)} & found
        assert balls == {f"concurrent({k},{k + 1},{k + 2})" for k in expected}, name
        gained |= {name} if entry["klass"] == "7R~" else set()
    assert gained == {"ufactory_xarm7", "realman_gen72"}


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        *(("puma560", "a"), ("irb140", "a"), ("stanford", "a"), ("ur5", "b")),
        *(("jaco", "c"), ("planar3", "b"), ("sawyer", "c"), ("panda", "c")),
    ],
)
def test_tables_have_their_structure(corpus: Path, name: str, expected: str) -> None:
    """Published tables have their structure, as printed and snapped."""
    chain = read_robot(corpus / "dh" / f"rtb_{name}.csv").chain
    assert structure(chain, 1e-6) == structure(snap(chain)[0]) == expected
