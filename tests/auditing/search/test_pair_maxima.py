"""Pairs of postures: a third way to the verdict, against the exact engine."""

from __future__ import annotations

import random
from fractions import Fraction

import numpy as np
import pytest
from flint import arb
from short_tables import arm, ask, with_wrist

from cuspaudit.algebra.angles import separation
from cuspaudit.algebra.numeric import NumericPolynomial
from cuspaudit.auditing.search.pair_maxima import PROVED, PairRecord, pair_maxima
from cuspaudit.auditing.search.pair_space import PairSpace
from cuspaudit.cuspidality.pair_decision import decide_pairs
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus.function import TorusFunction
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel, exact_model, revolute_circles
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap


def model_of(name: str) -> ExactModel:
    """The exact model of a robot of the library."""
    return exact_model(snap(open_robot(name).chain)[0])


def space_of(chain: Chain) -> PairSpace:
    """The pairs of an arm."""
    model = exact_model(chain)
    h = TorusFunction.from_polynomial(
        model.ring, revolute_circles(model), jacobian_determinant(model)
    )
    zeros = model.zeros
    return PairSpace.of(chain, h, zeros)


def counts(record: PairRecord) -> tuple[int, int]:
    """(maxima, those with both ends in one aspect)."""
    return len(record.maxima), record.together


@pytest.mark.parametrize("name", ["chablat-2022-3r", "ufactory-xarm6"])
def test_pairs_have_one_pose_and_one_sign(name: str) -> None:
    """Random pairs and maxima hold the tip in one place, in different postures."""
    chain = model_of(name).chain
    space = space_of(chain)
    pairs = space.random_pairs(150, np.random.default_rng(1))
    assert len(pairs) > 3
    found = space.maxima(pairs[:10])
    for first, second in (*pairs[:10], *found.pairs):
        apart = frames(chain, first)[-1] - frames(chain, second)[-1]
        shown = apart if chain.task == "pose" else apart[:3, 3:]
        assert np.abs(shown).max() < 1e-7
        assert separation(first, second).max() > 1e-3
        assert np.prod(space.h(np.array([first, second]) + space.zeros)) > 0


@pytest.mark.parametrize("name", ["chablat-2022-3r", "ufactory-xarm6"])
def test_the_slope_is_that_of_the_height(name: str) -> None:
    """Central differences along W agree with the slope, and vanish at a maximum."""
    space = space_of(model_of(name).chain)
    pairs = space.random_pairs(150, np.random.default_rng(2))[:4]
    slope, follow = space.slopes(pairs)
    step = 1e-6
    for k in range(len(space.zeros)):
        e = np.eye(len(space.zeros))[k]
        both = step * np.stack([np.tile(e, (len(pairs), 1)), follow @ e], 1)
        ends = [space.heights(space.settle(pairs + s * both, 6)[0]) for s in (1, -1)]
        assert (ends[0] - ends[1]) / (2 * step) == pytest.approx(slope[:, k], abs=1e-3)
    top = space.maxima(pairs).pairs
    assert np.abs(space.slopes(top)[0]).max() < 1e-5
    beside = top.copy()
    beside[:, 0, 1] += 0.05
    settled, reached = space.settle(beside, 8)
    assert (space.heights(settled) < space.heights(top))[reached].all()


@pytest.mark.parametrize(
    ("name", "maxima", "together"),
    [
        ("baili-2004-wt1", 0, 0),
        ("chablat-2022-3r", 2, 2),
        ("salunkhe-2022-fig4b", 4, 0),
        ("puma-560-arm", 2, 0),
    ],
)
def test_published_arms(name: str, maxima: int, together: int) -> None:
    """Noncuspidal arms have no maximum with both ends in one aspect, cuspidal ones do.

    An arm of two postures a pose has no pair of one sign at all.
    """
    model = model_of(name)
    record = pair_maxima(model, starts=192)
    assert counts(record) == (maxima, together)
    assert (ask(model.chain).verdict is Verdict.CUSPIDAL) == (together > 0)
    assert record.missed in (0.0, None)


def test_counts_add_up_and_the_seed_is_kept() -> None:
    """Every ascent is lost or counted at one maximum; the same seed repeats itself."""
    model = model_of("baili-2004-wt5")
    record = pair_maxima(model, seed=3, starts=128)
    assert record.seed == 3
    assert sum(found.found for found in record.maxima) + record.lost == record.pairs
    assert record == pair_maxima(model, seed=3, starts=128)
    assert [found.level for found in record.maxima] == sorted(
        (found.level for found in record.maxima), reverse=True
    )


def test_an_end_of_time_keeps_what_was_met() -> None:
    """A step that is refused ends the search between two rounds."""

    def stop(step: str) -> None:
        if step.startswith("pairs: round 2"):
            raise UnableError(step, "the time limit has passed")

    model = model_of("chablat-2022-3r")
    short = pair_maxima(model, progress=stop, starts=128)
    assert 0 < short.pairs < pair_maxima(model, starts=128).pairs


def test_a_failure_of_floating_point_is_no_crash(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A singular matrix met on the way ends the search with its reason."""

    def singular(self: PairSpace, pairs: np.ndarray) -> None:
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr(PairSpace, "maxima", singular)
    with pytest.raises(UnableError, match="Singular matrix"):
        pair_maxima(model_of("chablat-2022-3r"), starts=8)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(24))
def test_random_arms_agree_with_the_exact_engine(seed: int) -> None:
    """Both ends in one aspect, if and only if Algorithm 1 says cuspidal: 3R arms."""
    rng = random.Random(seed)
    a = [Fraction(rng.randrange(2, 40), 10) for _ in range(3)]
    d = [Fraction(rng.randrange(0, 20), 10) for _ in range(3)]
    twists = [rng.choice((30, -45, 60, 90, -90)) for _ in range(2)]
    chain = arm(a, d, (*twists, 0))
    exact = ask(chain)
    record = pair_maxima(exact_model(chain))
    assert (record.together > 0) == (exact.verdict is Verdict.CUSPIDAL)


def aspects_missed(record: PairRecord, model: ExactModel) -> set[tuple[int, int]]:
    """The two aspects of every exact pair that no maximum joins."""
    variety, mapping = reduced_map(model)
    decision = decide_pairs(variety, mapping)
    delta = NumericPolynomial(variety.ring, decision.delta)
    zeros = model.zeros
    c, s = (float(x.p / x.q) for x in decision.surface.base.rotation)
    assert decision.surface.base.names == ("c3", "s3")

    def aspect(posture: tuple[float, ...]) -> int:
        second, third = (q + z for q, z in zip(posture[1:], zeros[1:], strict=True))
        at = [f(q) for q in (second, third) for f in (np.cos, np.sin)]
        strip = decision.roadmap.strip_of(
            arb(np.tan((third - np.arctan2(s, c)) / 2)), 64
        )
        return decision.graph.aspects[strip, int(np.sign(delta([at])[0]))]

    exact = {tuple(sorted(map(decision.graph.aspect, p))) for p in decision.pairs}
    met = {tuple(sorted(map(aspect, m.postures))) for m in record.maxima}
    assert met <= exact
    return exact - met


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 8, 13, 24, 30, 33])
def test_what_ascents_miss_is_what_they_say_they_may_miss(seed: int) -> None:
    """Maxima join aspects that exact pairs join; all, where none was met only once."""
    rng = random.Random(seed)
    a = [Fraction(rng.randrange(2, 40), 10) for _ in range(3)]
    d = [Fraction(rng.randrange(0, 20), 10) for _ in range(3)]
    right = (90, -90) if seed % 2 else (30, -45, 60, 90, -90)
    model = exact_model(arm(a, d, (*(rng.choice(right) for _ in range(2)), 0)))
    record = pair_maxima(model)
    assert record.pairs > 0
    assert not aspects_missed(record, model) or record.missed


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "cuspidal"),
    [("ur5", False), ("fanuc-crx-10ia-l", True), ("kinova-jaco-gen2", True)],
)
def test_six_joint_arms(name: str, cuspidal: bool) -> None:
    """UR5: no maximum has both ends in one aspect; CRX and JACO: all that are met."""
    record = pair_maxima(model_of(name), starts=256)
    assert record.aspects == PROVED
    assert record.maxima
    assert record.together == (len(record.maxima) if cuspidal else 0)


@pytest.mark.slow
def test_a_wrist_keeps_the_verdict_of_its_arm() -> None:
    """A spherical wrist on a noncuspidal arm of four postures: none together."""
    chain = with_wrist(arm((1, ".5", ".8"), (0, ".2", 0), (-90, 90, 0)))
    record = pair_maxima(exact_model(chain), starts=256)
    assert record.pairs > 20
    assert record.together == 0
