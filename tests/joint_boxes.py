"""Joint limits in one line, for tests: boxes of three-joint arms, in degrees."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from flint import fmpq
from short_tables import Number, arm

from cuspaudit.cuspidality.box_decision import (
    BoxDecision,
    decide_box,
    decide_box_of_slide,
)
from cuspaudit.cuspidality.box_values import ValuesDecision, decide_box_by_values
from cuspaudit.cuspidality.surface_path import SurfacePath
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.kinematics.tip_circles import tip_across, tip_circles
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.surface.box_edges import Limit, Range
from cuspaudit.surface.first_joint import FirstJoint, FirstMotion

Limits = Sequence[Sequence[Number] | None]

FACTS: dict[str, Any] = json.loads(
    (Path(__file__).parent / "conformance" / "limits_3r.json").read_text()
)


def limit(value: Number, slides: bool = False) -> Limit:
    """A limit in degrees, or in units of length, exactly."""
    number = fmpq(*Fraction(value).as_integer_ratio())
    return Limit(fmpq(0), number) if slides else Limit(number / 180, fmpq(0))


def joint_range(ends: Sequence[Number] | None, slides: bool = False) -> Range | None:
    """A range in degrees; None for none."""
    return None if ends is None else Range(*(limit(end, slides) for end in ends))


def first_joint(chain: Chain, ends: Sequence[Number] | None) -> FirstJoint | None:
    """What joint 1 does, with the length of its range."""
    if ends is None:
        return None
    found = tip_circles(exact_model(chain))
    slides = chain.joints[0].kind == "prismatic"
    return FirstJoint(
        kind="line" if slides else "circle",
        axis=found.axis,
        second=found.second,
        origin=found.origin,
        height=found.height,
        square=found.square,
        across=found.across,
        width=limit(Fraction(ends[1]) - Fraction(ends[0]), slides),
    )


def within(chain: Chain, limits: Limits) -> BoxDecision:
    """The decision by pairs."""
    kinds = [kind == "prismatic" for kind in chain.kinds]
    second, third = (
        joint_range(ends, slides)
        for ends, slides in zip(limits[1:], kinds[1:], strict=True)
    )
    pair = reduced_map(exact_model(chain))
    return decide_box(*pair, (second, third), first_joint(chain, limits[0]))


def within_by_values(chain: Chain, limits: Limits) -> ValuesDecision:
    """The decision by sample values, for joints 2 and 3 alone."""
    kinds = [kind == "prismatic" for kind in chain.kinds]
    second, third = (
        joint_range(ends, slides)
        for ends, slides in zip(limits[1:], kinds[1:], strict=True)
    )
    return decide_box_by_values(*reduced_map(exact_model(chain)), (second, third))


def of_slide(chain: Chain, limits: Limits) -> BoxDecision:
    """The decision by pairs of an arm whose second joint slides."""
    model, kinds = exact_model(chain), [kind == "prismatic" for kind in chain.kinds]
    second, third = (
        joint_range(ends, slides)
        for ends, slides in zip(limits[1:], kinds[1:], strict=True)
    )
    first = None
    if limits[0] is not None:
        width = limit(Fraction(limits[0][1]) - Fraction(limits[0][0]), kinds[0])
        kind: Literal["circle", "line"] = "line" if kinds[0] else "circle"
        first = FirstMotion(kind=kind, across=tip_across(model), width=width)
    return decide_box_of_slide(*reduced_map(model), (second, third), first)


def arm_of(name: str) -> Chain:
    """An arm of the recorded facts."""
    table = FACTS["arms"][name]
    a, d = ([str(x) for x in table[key]] for key in ("a", "d"))
    return arm(a, d, [degrees(text) for text in table["alpha"]])


def degrees(text: str) -> int:
    """A recorded twist such as -pi/2, in degrees."""
    if "pi" not in text:
        return int(text)
    below = int(text.partition("/")[2] or 1)
    return (-180 if text.startswith("-") else 180) // below


def check_path(chain: Chain, limits: Limits, path: SurfacePath) -> None:
    """Hold the way points to the limits, det J to one sign, the ends to one place."""
    for column, ends, kind in zip(
        path.points.T, limits[1:], chain.kinds[1:], strict=True
    ):
        if ends is not None:
            low, high = (float(Fraction(end)) for end in ends)
            if kind == "revolute":
                low, high = np.radians([low, high])
            assert low < column.min() <= column.max() < high
    ends = path.points[[0, -1]]
    moved = np.abs(np.exp(1j * ends[0]) - np.exp(1j * ends[1]))
    assert moved.max() > 1e-6
    tips = [frames(chain, np.r_[0.0, end])[-1, :3, 3] for end in ends]
    radii = [np.hypot(*tip[:2]) for tip in tips]
    assert radii[0] == pytest.approx(radii[1], abs=1e-8)
    assert tips[0][2] == pytest.approx(tips[1][2], abs=1e-8)
    shares = np.linspace(0, 1, 200)[:, None]
    points = np.vstack([a + shares * (b - a) for a, b in pairwise(path.points)])
    signs = {np.sign(np.linalg.det(jacobian(chain, np.r_[0.0, q]))) for q in points}
    assert len(signs) == 1
