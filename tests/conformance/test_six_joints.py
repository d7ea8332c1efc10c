"""Six-joint arms that an exact reduction decides, and near misses that none does."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from short_tables import Number, arm, ask, numbers, shift, with_wrist

from cuspaudit.algebra.numeric import NumericPolynomial
from cuspaudit.algebra.trigonometric import factor_on_circles
from cuspaudit.auditing.answer import Reason
from cuspaudit.auditing.crosscheck.singular_postures import model_points
from cuspaudit.auditing.deciders.by_search import search_witness
from cuspaudit.auditing.deciders.certify import find_witness
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.kinematics.theorems.triple_and_pair import triple_and_pair
from cuspaudit.robot.chain import Chain, Rotation, Translation, reverse
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap

Row = tuple[Number, ...]

CUSPIDAL_3R = (
    ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    ((1, "1.5", ".7"), (0, ".5", 0), (-90, 90, 0)),
    ((1, 3, 4), (0, 3, 0), (-90, 90, 0)),
)
UR5: tuple[Row, Row, Row] = (
    (0, "-0.425", "-0.39225", 0, 0, 0),
    ("0.089159", 0, 0, "0.10915", "0.09465", "0.0823"),
    (90, 0, 0, 90, -90, 0),
)
PUMA: tuple[Row, Row, Row] = (
    (0, ".4318", ".0203", 0, 0, 0),
    (0, 0, ".15005", ".4318", 0, 0),
    (90, 0, -90, 90, -90, 0),
)
HAIR = Fraction(1, 10**9)


def nudged(table: tuple[Row, Row, Row], column: int, row: int) -> Chain:
    """The arm of ``table`` with one number off by 1e-9 (m, or degrees)."""
    columns = [[Fraction(x) for x in entries] for entries in table]
    columns[column][row] += HAIR
    a, d, alpha = columns
    return arm(a, d, alpha)


@pytest.mark.parametrize(
    "name", ["puma-560", "abb-irb-120", "kuka-kr-6-r900", "puma-560-arm"]
)
def test_industrial_arms_are_noncuspidal(name: str) -> None:
    """PUMA 560, IRB 120 and KR 6 have a wrist and axes 2, 3 parallel: noncuspidal."""
    found = ask(snap(open_robot(name).chain)[0])
    assert found.verdict is Verdict.NONCUSPIDAL
    if found.model.chain.task == "pose":
        assert found.reduction is not None
        assert found.reduction.kind == "spherical wrist"


@pytest.mark.parametrize("table", CUSPIDAL_3R, ids=["ISSAC", "WT2", "WT5"])
@pytest.mark.parametrize("turned", [False, True], ids=["wrist", "shoulder"])
def test_a_wrist_on_a_cuspidal_arm_is_cuspidal(
    table: tuple[Row, Row, Row], turned: bool
) -> None:
    """A spherical wrist (or, reversed, shoulder) on a cuspidal 3R arm: certified."""
    chain = with_wrist(arm(*table))
    chain = reverse(chain) if turned else chain
    found = ask(chain)
    three = ask(arm(*table))
    assert found.verdict is Verdict.CUSPIDAL
    assert found.reduction is not None
    assert found.reduction.is_reversed == turned
    assert found.aspects is not None
    assert three.aspects is not None
    assert found.aspects.count == 2 * three.aspects.count
    witness = find_witness(found, chain)
    assert verify(witness.certificate).accepted
    assert witness.path.shape[1] == 6


@pytest.mark.parametrize("twists", [(-90, 90), (90, 90), (90, -90)])
def test_the_sense_of_the_wrist_does_not_matter(twists: Row) -> None:
    """Any right-angle wrist gives the verdict of its 3R arm."""
    regional = arm((1, ".7", ".3"), (0, ".2", 0), (-90, 90, 0))
    found = ask(with_wrist(regional, twists))
    assert numbers(found) == ("noncuspidal", 4, 4, 0, 0)


@pytest.mark.parametrize("twists", [(-60, 90), (-90, 60), (60, 60)])
def test_a_skew_wrist_on_a_cuspidal_arm_is_cuspidal(twists: Row) -> None:
    """An axis 6 that can stand square to axis 4 hides no couple: certified."""
    chain = with_wrist(arm(*CUSPIDAL_3R[0]), twists)
    found = ask(chain)
    assert found.verdict is Verdict.CUSPIDAL
    assert found.postures is None
    assert verify(find_witness(found, chain).certificate).accepted


@pytest.mark.parametrize("twists", [(-60, 90), (30, 45), (45, 45), (15, 20)])
def test_a_skew_wrist_on_a_noncuspidal_arm_is_noncuspidal(twists: Row) -> None:
    """Whatever the wrist, a couple of the arm is one of its first three joints."""
    found = ask(with_wrist(arm((1, ".7", ".3"), (0, ".2", 0), (-90, 90, 0)), twists))
    assert found.verdict is Verdict.NONCUSPIDAL
    assert found.aspects is not None
    assert (found.aspects.count, found.aspects.proved) == (4, True)


@pytest.mark.parametrize("twists", [(45, 45), (30, 45), (15, 20)])
def test_a_stiff_wrist_on_a_cuspidal_arm_is_undecided(twists: Row) -> None:
    """It may reach too few orientations for a couple: nothing is claimed."""
    found = ask(with_wrist(arm(*CUSPIDAL_3R[0]), twists))
    assert found.verdict is Verdict.UNDECIDED
    assert found.is_open_for(Reason.NO_THEOREM)


def test_reversing_an_arm_keeps_everything() -> None:
    """An arm and its reverse have one verdict, and equal aspects and postures."""
    chain = with_wrist(arm((1, ".5", ".8"), (0, ".2", 0), (-90, 90, 0)))
    assert numbers(ask(chain)) == numbers(ask(reverse(chain)))
    assert numbers(ask(reverse(reverse(chain)))) == numbers(ask(chain))


@pytest.mark.parametrize(
    ("column", "row"),
    [(0, 3), (0, 4), (1, 4)],
    ids=["a4", "a5", "d5"],
)
def test_a_wrist_off_by_a_hair_is_not_spherical(column: int, row: int) -> None:
    """One wrist number off by 1e-9 and the verdict is gone."""
    assert ask(arm(*PUMA)).verdict is Verdict.NONCUSPIDAL
    assert ask(nudged(PUMA, column, row)).verdict is Verdict.UNDECIDED


def test_the_ur5() -> None:
    """The UR5 is noncuspidal by its pattern, and by nothing else."""
    for chain in (arm(*UR5), snap(open_robot("ur5").chain)[0]):
        found = ask(chain)
        assert found.verdict is Verdict.NONCUSPIDAL
        assert found.reduction is not None
        assert found.reduction.kind == "UR pattern"
        assert found.rests_on == ("exact tests of the hypotheses",)


@pytest.mark.parametrize("seed", range(6))
def test_random_members_of_the_ur_pattern(seed: int) -> None:
    """Any lengths and offsets along the parallel axes keep the pattern."""
    rng = random.Random(seed)

    def length() -> Fraction:
        return Fraction(rng.randrange(1, 200) * rng.choice((-1, 1)), 100)

    right = rng.choice((90, -90)), rng.choice((90, -90)), rng.choice((90, -90))
    a = (0, length(), length(), 0, 0, length())
    d = [length() for _ in range(6)]
    alpha = (
        right[0],
        rng.choice((0, 180)),
        rng.choice((0, 180)),
        right[1],
        right[2],
        30,
    )
    theta = [rng.choice((0, 90, 45)) for _ in range(6)]
    found = ask(arm(a, d, alpha, theta=theta))
    assert found.verdict is Verdict.NONCUSPIDAL
    assert found.reduction is not None
    assert found.reduction.kind == "UR pattern"


@pytest.mark.parametrize(
    ("column", "row"), [(0, 4), (2, 1), (2, 2)], ids=["a5", "alpha2", "alpha3"]
)
def test_a_ur_off_by_a_hair_is_undecided(column: int, row: int) -> None:
    """A number of the UR pattern off by 1e-9 that matters, and the verdict is gone."""
    assert ask(nudged(UR5, column, row)).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("column", "row"),
    [(0, 0), (0, 3), (2, 0), (2, 3), (2, 4)],
    ids=["a1", "a4", "alpha1", "alpha4", "alpha5"],
)
def test_a_triple_and_a_pair(column: int, row: int) -> None:
    """a1, a4 and the twists 1, 4, 5 are free: axes 2, 3, 4 parallel, 5 and 6 meet."""
    chain = nudged(UR5, column, row)
    for turned in (chain, reverse(chain)):
        found = ask(turned)
        assert found.verdict is Verdict.NONCUSPIDAL
        assert found.reduction is not None
        assert found.reduction.kind == "triple and pair"


@pytest.mark.parametrize("name", ["puma-560", "kuka-kr-6-r900"])
def test_a_triple_and_a_pair_beside_a_wrist(name: str) -> None:
    """PUMA 560 and KR 6 are noncuspidal by a second theorem: axes 2, 3 are parallel."""
    model = exact_model(snap(open_robot(name).chain)[0])
    assert triple_and_pair(model) is not None


@pytest.mark.parametrize("seed", range(4))
def test_the_three_signs_tell_the_postures_apart(seed: int) -> None:
    """Random arms with parallel and meeting axes: never two postures of equal signs.

    The signs are those of the factors of det J that the theorem names, and no witness
    is found either.
    """
    rng = random.Random(seed)
    a, d = ([Fraction(rng.randrange(20, 90), 100) for _ in range(6)] for _ in "ad")
    a[4] = Fraction(0)
    twists = [rng.randrange(20, 160) for _ in range(6)]
    chain = arm(a, d, (twists[0], 0, 180, *twists[3:]))
    assert ask(chain).verdict is Verdict.NONCUSPIDAL
    model = exact_model(chain)
    factors = factor_on_circles(model.ring, model.circles, jacobian_determinant(model))
    assert [count for _, count in factors] == [1, 1, 1]
    signs = [NumericPolynomial(model.ring, factor) for factor, _ in factors]
    solver = PostureSolver.of(chain)
    given = np.random.default_rng(seed).uniform(-np.pi, np.pi, (40, 6))
    for postures in solver.solve(solver.poses(given)):
        points = model_points(model, postures)
        seen = {tuple(row) for row in np.sign([s(points) for s in signs]).T}
        assert len(seen) == len(postures)


@pytest.mark.parametrize(("column", "row"), [(0, 1), (0, 2), (1, 1), (1, 4)])
def test_the_ur_pattern_has_free_numbers(column: int, row: int) -> None:
    """a2, a3, d2 and d5 may be what they like."""
    assert ask(nudged(UR5, column, row)).verdict is Verdict.NONCUSPIDAL


@pytest.mark.slow
def test_three_parallel_axes_alone_prove_nothing() -> None:
    """Axes 2, 3, 4 parallel, a5 = 0.1: no theorem speaks, and the arm is cuspidal."""
    a, d, alpha = UR5
    chain = arm((*a[:4], "0.1", 0), d, alpha)
    assert ask(chain).verdict is Verdict.UNDECIDED
    witness = search_witness(chain, most=64).witness
    assert witness is not None
    assert verify(witness.certificate).accepted


def test_axes_that_coincide_leave_no_rank() -> None:
    """With a2 = 0 axes 2 and 3 are one line, and det J vanishes identically."""
    a, d, alpha = UR5
    with pytest.raises(DegenerateMapError):
        ask(arm((0, 0, *a[2:]), d, alpha))


@pytest.mark.parametrize(
    "name",
    [
        "abb-gofa-5",
        "fanuc-crx-10ia-l",
        "kinova-jaco-gen2",
        "raghavan-roth",
        "ufactory-xarm6",
        "hyperplane-6r",
    ],
)
def test_no_theorem_speaks_of_general_arms(name: str) -> None:
    """A 6R without a known structure is never called noncuspidal by one."""
    assert ask(snap(open_robot(name).chain)[0]).verdict is Verdict.UNDECIDED


def test_a_prismatic_joint_is_no_wrist() -> None:
    """A wrist turns; where joint 6 slides no theorem speaks."""
    chain = with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))
    joints = list(chain.joints)
    joints[5] = replace(joints[5], kind="prismatic")
    assert ask(chain.with_joints(joints)).verdict is Verdict.UNDECIDED


def test_the_stanford_arm_is_noncuspidal() -> None:
    """RRP with a spherical wrist: as its first three joints, four postures a point."""
    regional = arm((0, 0, 0), (".412", ".154", 0), (-90, 90, 0), "RRP")
    found, three = ask(with_wrist(regional)), ask(regional)
    assert found.reduction is not None
    assert found.reduction.kind == "spherical wrist"
    assert found.verdict is three.verdict is Verdict.NONCUSPIDAL
    assert three.postures is not None
    assert three.postures.count == 4
    joints = list(with_wrist(regional).joints)
    joints[5] = replace(joints[5], before=(shift("1e-9", 0, 0), *joints[5].before))
    beside = with_wrist(regional).with_joints(joints)
    assert ask(beside).verdict is Verdict.UNDECIDED


def test_a_wrist_on_a_cuspidal_sliding_arm_is_cuspidal() -> None:
    """A cuspidal RRP arm carrying a spherical wrist: certified."""
    regional = arm((-1, 2, -1), (0, -2, 1), (90, -60, 0), "RRP")
    chain = with_wrist(regional)
    found = ask(chain)
    assert ask(regional).verdict is found.verdict is Verdict.CUSPIDAL
    assert verify(find_witness(found, chain).certificate).accepted


def test_the_tool_of_a_wrist_does_not_matter() -> None:
    """Any tool may be mounted on the last link."""
    chain = with_wrist(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))
    x, y, z = (Fraction(k, 7) for k in (1, -2, 3))
    motions = (
        Translation((x, y, z)),
        *(motion for motion in chain.joints[-1].before if isinstance(motion, Rotation)),
    )
    other = replace(chain, tool=motions)
    assert numbers(ask(other)) == numbers(ask(chain))
