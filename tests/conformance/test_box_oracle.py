"""Random arms of three joints within random limits, against brute force.

The oracle (`box_oracle`) shares nothing with the package. Its "cuspidal" is two
postures joined on a grid; its "noncuspidal" may have missed a narrow couple. So a
NONCUSPIDAL of the package must meet no "cuspidal", and a CUSPIDAL has to come with a
path inside the limits that the checker of certificates accepts.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
import pytest
from box_oracle import Arm, Range, verdict
from short_tables import arm, degrees

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.limits.limits_witness import first_proved, paths_of_cells
from cuspaudit.auditing.limits.three_in_box import decide_three
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import AssumptionError
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.runtime.clock import Clock

KINDS = ["RRR"] * 6 + ["RRP", "PRR", "RPR", "RPP", "PRP", "PPR"]
Ends = tuple[Fraction, Fraction] | None


@dataclass(frozen=True)
class Drawn:
    """A table with twists in degrees, and limits in degrees or units of length."""

    kinds: str
    a: list[Fraction]
    d: list[Fraction]
    alpha: list[int]
    limits: list[Ends]

    @property
    def model(self) -> ExactModel:
        """For the package."""
        chain = arm(self.a, self.d, self.alpha, self.kinds)
        joints = []
        for joint, ends in zip(chain.joints, self.limits, strict=True):
            slides = joint.kind == "prismatic"
            limits = ends if ends is None or slides else tuple(map(degrees, ends))
            joints.append(replace(joint, limits=limits))
        return exact_model(chain.with_joints(joints))

    @property
    def oracle(self) -> tuple[Arm, list[Range]]:
        """For the oracle."""
        rows = tuple(
            (float(a), float(np.radians(twist)), float(d))
            for a, twist, d in zip(self.a, self.alpha, self.d, strict=True)
        )
        limits: list[Range] = []
        for kind, ends in zip(self.kinds, self.limits, strict=True):
            pair = None if ends is None else (float(ends[0]), float(ends[1]))
            if pair is not None and kind == "R":
                pair = (float(np.radians(pair[0])), float(np.radians(pair[1])))
            limits.append(pair)
        return Arm(rows, self.kinds), limits


def drawn(seed: int) -> Drawn:
    """An arm of every kind, half of them with zeros and right angles."""
    rng = random.Random(seed)
    kinds = rng.choice(KINDS)
    if seed % 2:
        a = [Fraction(rng.randint(0, 30), 10) for _ in range(3)]
        d = [Fraction(rng.randint(-20, 20), 10) for _ in range(3)]
        alpha = [rng.choice([90, -90, 30, 60, -45, 120]) for _ in range(3)]
    else:
        a = [Fraction(rng.choice([0, 1, 1, 2, 2]), 2) for _ in range(3)]
        d = [Fraction(rng.choice([0, 0, 1, 2]), 2) for _ in range(3)]
        alpha = [rng.choice([0, 90, -90, 90, 60, 45]) for _ in range(3)]
    limits = [_ends(rng, kind, k) for k, kind in enumerate(kinds)]
    return Drawn(kinds, a, d, alpha, limits)


def _ends(rng: random.Random, kind: str, k: int) -> Ends:
    """Short, long, over a turn, at right angles, or none; joint 1 often short."""
    if kind == "P":
        low = Fraction(rng.randint(-30, 20), 10)
        return (
            None
            if rng.random() < 0.2
            else (low, low + Fraction(rng.randint(2, 40), 10))
        )
    if k == 0:
        width = rng.choice([None, None, 2, 10, 45, 90, 135, 181, 400])
        return None if width is None else (Fraction(7), Fraction(7 + width))
    share = rng.random()
    if share < 0.2:
        return None
    if share < 0.4:
        low = Fraction(rng.randint(-300, 100))
        return low, low + rng.randint(360, 700)
    if share < 0.6:
        low = Fraction(rng.choice([-180, -90, 0, 90, -135]))
        return low, low + rng.choice([90, 180, 270, 360])
    low = Fraction(rng.randint(-200, 150))
    return low, low + rng.randint(5, 300)


@pytest.mark.parametrize(
    "seed",
    [2, 3, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, *range(4, 26)))],
)
def test_brute_force_refutes_no_verdict(seed: int) -> None:
    """No line of the oracle joins postures of a box that was called noncuspidal."""
    case = drawn(seed)
    model = case.model
    try:
        found = decide_three(model, Clock())
    except AssumptionError:
        return  # det J vanishes at every posture
    assert found.verdict is not Verdict.UNDECIDED
    if found.verdict is Verdict.CUSPIDAL:
        paths = paths_of_cells(Answer(model, found.verdict, ""), found)
        witness = first_proved(paths, (model.chain,))
        assert witness is not None
        assert witness.certificate.limits is not None
    else:
        assert verdict(*case.oracle, places=60)[0] != "cuspidal"
