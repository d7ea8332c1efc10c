"""A parallel mechanism: a platform held by legs.

Each leg reaches from the base to a point of the platform, its *anchor*. Three kinds:

- ``length`` (RPR, UPS): a leg between two joints whose length is actuated, or fixed;
- ``crank`` (RRR, in a plane): an actuated arm turns round the base point, and a rod of
  fixed length goes from its end to the anchor;
- ``slider`` (PRR, PSS): an actuated slide moves along a direction, and a rod of fixed
  length goes from it to the anchor.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

__all__ = ["KINDS", "Kind", "Leg", "Mechanism", "Point", "Problem"]

Kind = Literal["length", "crank", "slider"]
KINDS: tuple[Kind, ...] = ("length", "crank", "slider")
Problem = Literal["direct", "inverse"]
Point = tuple[Fraction, ...]


@dataclass(frozen=True)
class Leg:
    """One leg; lengths in the unit of the file.

    Attributes:
        kind: what is actuated.
        base: a point of the base.
        anchor: where it holds the platform, in the platform's frame; the origin when
            the platform is a point.
        arm: length of the crank; None for the other kinds.
        along: what the slide moves by when its variable grows by 1; () for the others.
        rod: length of the rod; of a ``length`` leg its fixed length, None if actuated.
    """

    kind: Kind
    base: Point
    anchor: Point
    arm: Fraction | None = None
    along: Point = ()
    rod: Fraction | None = None

    @property
    def is_actuated(self) -> bool:
        """Whether it has an actuator."""
        return self.kind != "length" or self.rod is None


@dataclass(frozen=True)
class Mechanism:
    """Legs and a platform.

    Attributes:
        file: where it comes from.
        name: its name.
        space: 2 in a plane, 3 in space.
        body: whether the platform turns (in a plane only); else it is a point.
        legs: at least one; as many are actuated as the platform has freedoms.
        problem: "direct", from actuators to platform, or "inverse".
        expect: what the file records about the answer.
    """

    file: str
    name: str
    space: int
    body: bool
    legs: tuple[Leg, ...]
    problem: Problem
    expect: Mapping[str, str]

    @property
    def freedoms(self) -> int:
        """Of the platform, with the legs of fixed length attached."""
        held = sum(not leg.is_actuated for leg in self.legs)
        return self.space + self.body - held
