"""Three axes in a row and two others: the theorem's arms and near misses."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from short_tables import Number, arm, shift

from cuspaudit.algebra.numeric import NumericPolynomial
from cuspaudit.algebra.trigonometric import factor_on_circles
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.kinematics.theorems.registry import reduction_of
from cuspaudit.kinematics.theorems.triple_and_pair import triple_and_pair
from cuspaudit.robot.chain import X_AXIS, Angle, Chain, Rotation, reverse
from cuspaudit.robot.frames import angle_value

PLANAR, POINT = "parallel", "meet in one point"
KINDS = [
    (triple, first, pair, other)
    for triple in (PLANAR, POINT)
    for first, other in ((1, 4), (1, 5), (2, 5))
    for pair in ("parallel", "meet")
]


def structured(triple: str, first: int, pair: str, other: int, seed: int = 0) -> Chain:
    """A random arm with the structure; its model is over Q, where forms factor."""
    rng = random.Random(seed)
    a = [Fraction(rng.randrange(30, 95), 100) for _ in range(6)]
    d: list[Number] = [Fraction(rng.randrange(-90, 90), 100) for _ in range(6)]
    twists: list[Number] = [rng.choice((37, 61, 90, 112, 143)) for _ in range(6)]
    for k in (first, first + 1):
        if triple == PLANAR:
            twists[k - 1] = rng.choice((0, 180))
        else:
            a[k - 1] = Fraction(0)
    if triple == POINT:
        d[first] = 0
    if pair == "parallel":
        twists[other - 1] = 0
    else:
        a[other - 1] = Fraction(0)
    return arm(a, d, twists)


def factors_of(chain: Chain) -> list[NumericPolynomial]:
    """The distinct factors of det J, in floating point."""
    model = exact_model(chain)
    names, determinant = model.circles, jacobian_determinant(model)
    found = factor_on_circles(model.ring, names, determinant)
    return [NumericPolynomial(model.ring, factor) for factor, _ in found]


def points_of(chain: Chain, postures: np.ndarray) -> np.ndarray:
    """The variables (c_i, s_i) of the exact model at joint values."""
    turned = postures + [angle_value(j.zero) for j in exact_model(chain).joints]
    return np.stack([np.cos(turned), np.sin(turned)], -1).reshape(len(postures), -1)


@pytest.mark.parametrize("kind", KINDS, ids=str)
def test_the_structure_is_seen_from_both_ends(kind: tuple[str, int, str, int]) -> None:
    """The axes are named, also for the arm taken from tip to base."""
    triple, first, pair, other = kind
    chain = structured(*kind)
    found = triple_and_pair(exact_model(chain))
    assert found is not None
    assert found.startswith(f"axes {first}, {first + 1}, {first + 2} ")
    assert triple in found
    assert f"axes {other}, {other + 1} " in found
    assert found.endswith(pair)
    back = triple_and_pair(exact_model(reverse(chain)))
    assert back is not None
    assert f"axes {5 - first}, {6 - first}, {7 - first} " in back
    assert f"axes {6 - other}, {7 - other} " in back


@pytest.mark.parametrize("kind", KINDS, ids=str)
@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_signs_tell_the_postures_apart(
    kind: tuple[str, int, str, int], seed: int
) -> None:
    """Of a pose no two postures agree in the signs of the factors of det J.

    There are three factors at least, at most eight postures, and some pose has more
    than two.
    """
    chain = structured(*kind, seed)
    signs = factors_of(chain)
    assert len(signs) >= 3
    solver, most = PostureSolver.of(chain), 0
    given = np.random.default_rng(seed).uniform(-np.pi, np.pi, (24, 6))
    for postures in solver.solve(solver.poses(given)):
        points = points_of(chain, postures)
        seen = {tuple(row) for row in np.sign([s(points) for s in signs]).T}
        assert len(seen) == len(postures) <= 8
        most = max(most, len(postures))
    assert most > 2


@pytest.mark.parametrize("kind", KINDS, ids=str)
def test_a_hair_is_noticed(kind: tuple[str, int, str, int]) -> None:
    """A part of the structure that is off by 1e-9 ends it."""
    triple, first, pair, other = kind
    tilt = Rotation(X_AXIS, Angle(radians=Fraction(1, 10**9)))
    off = shift(Fraction(1, 10**9), 0, 0)
    for joint, motion in (
        (first + 1, tilt if triple == PLANAR else off),
        (other, tilt if pair == "parallel" else off),
    ):
        joints = list(structured(*kind).joints)
        joints[joint] = replace(joints[joint], before=(*joints[joint].before, motion))
        chain = structured(*kind).with_joints(joints)
        assert triple_and_pair(exact_model(chain)) is None


def test_a_triple_alone_or_a_pair_alone_is_nothing() -> None:
    """Neither three parallel axes nor two that meet decide an arm."""
    a, d = ("0.3", "0.5", "0.6", "0.7", "0.4", 0), ("0.1", 0, 0, "0.2", "0.3", 0)
    assert reduction_of(exact_model(arm(a, d, (60, 0, 0, 60, 120, 0)))) is None
    meet = (0, *a[1:])
    assert reduction_of(exact_model(arm(meet, d, (60, 45, 60, 60, 120, 0)))) is None


def test_an_arm_without_rank_is_no_arm() -> None:
    """Five parallel axes have the structure, and det J = 0 everywhere."""
    a, d = ("0.3", "0.5", "0.6", "0.7", "0.4", 0), ("0.1", 0, 0, "0.2", "0.3", 0)
    assert triple_and_pair(exact_model(arm(a, d, (0, 0, 60, 60, 0, 0)))) is not None
    assert triple_and_pair(exact_model(arm(a, d, (0, 0, 0, 0, 60, 0)))) is None
    assert triple_and_pair(exact_model(arm(a, d, (0, 0, 0, 60, 0, 0)))) is None
