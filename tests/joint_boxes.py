"""Joint limits in one line, for tests: boxes of three-joint arms, in degrees."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from flint import fmpq
from short_tables import Number, arm

from cuspaudit.cuspidality.box_decision import BoxDecision, decide_box
from cuspaudit.cuspidality.box_values import ValuesDecision, decide_box_by_values
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.kinematics.tip_circles import tip_circles
from cuspaudit.robot.chain import Chain
from cuspaudit.surface.box_edges import Limit, Range
from cuspaudit.surface.first_joint import FirstJoint

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
        "line" if slides else "circle",
        found.axis,
        found.second,
        found.origin,
        found.height,
        found.square,
        found.across,
        limit(Fraction(ends[1]) - Fraction(ends[0]), slides),
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
