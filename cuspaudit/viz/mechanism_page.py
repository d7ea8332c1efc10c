"""A parallel mechanism on its way from one mode to another, as one offline page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markupsafe import Markup

from cuspaudit.viz.offline import asset, environment, policy

__all__ = ["DrawnWayPoint", "MechanismPage", "mechanism_page"]

Pair = tuple[float, float]


@dataclass(frozen=True)
class DrawnWayPoint:
    """One way point, in the plane of the drawing.

    Attributes:
        legs: for each leg its base, the end of its crank or slide, and its anchor.
        platform: the corners of the platform, in the order of the legs.
    """

    legs: Sequence[tuple[Pair, Pair, Pair]]
    platform: Sequence[Pair]


@dataclass(frozen=True)
class MechanismPage:
    """What the page shows.

    Attributes:
        title: the mechanism.
        verdict: one of three.
        facts: name -> what is known, in their order.
        frames: along the witness; none without one.
    """

    title: str
    verdict: str
    facts: Mapping[str, str]
    frames: Sequence[DrawnWayPoint]


def mechanism_page(page: MechanismPage) -> str:
    """The page: the verdict, the facts, and the mechanism, moved by a slider."""
    script = asset("mechanism.js")
    frames = [
        {"legs": [list(leg) for leg in f.legs], "platform": list(f.platform)}
        for f in page.frames
    ]
    return (
        environment()
        .get_template("mechanism.html")
        .render(
            page=page,
            frames=frames,
            style=Markup(asset("page.css")),
            script=Markup(script),
            policy=policy([script]),
        )
    )
