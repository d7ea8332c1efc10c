"""The strip under the animation: det J along the path, as an inline drawing.

The curve lives in a box of 1000 by 100, stretched to the page's width; its labels are
text beside the box, so they keep their size on a phone. When det J comes much closer
to zero than it goes far from it, a root of det J is drawn instead, and the label says
so: a reader must see that the curve stays off the zero line.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cuspaudit.robot.chain import Chain
from cuspaudit.viz.page_rows import number
from cuspaudit.viz.scene.camera import nice_step
from cuspaudit.viz.scene.motion import PathFrames

__all__ = ["DeterminantStrip", "Tick", "build_strip"]

Matrix = NDArray[np.float64]
SCALES = {1: "", 2: "square-root scale", 3: "cube-root scale", 5: "fifth-root scale"}
LABEL = 12.0  # height of a label, per cent of the box
CLEAR = 0.09  # the curve stays at least this part of its own height off the zero line


@dataclass(frozen=True, slots=True)
class Tick:
    """A labelled height, ``top`` in per cent of the box from above."""

    top: float
    label: str


@dataclass(frozen=True, slots=True)
class DeterminantStrip:
    """The drawing of det J.

    Attributes:
        points: for an SVG polyline in the box of 1000 by 100.
        area: for an SVG polygon between the curve and zero.
        stems: for separate postures, (x, y, y of zero) of each.
        zero: height of the zero line, per cent from above.
        ticks: labelled heights other than zero.
        heights: height of the curve at each posture, per cent from above.
        unit: unit of det J, as text, or "".
        scale: name of the scale when it is not linear.
        smallest: the smallest abs(det J) drawn.
        smallest_at: where along the path it is, 0 to 1.
        smallest_top: its height, per cent from above.
        sign: "positive", "negative" or "of both signs".
    """

    points: str
    area: str
    stems: tuple[tuple[float, float, float], ...]
    zero: float
    ticks: tuple[Tick, ...]
    heights: tuple[float, ...]
    unit: str
    scale: str
    smallest: float
    smallest_at: float
    smallest_top: float
    sign: str


def build_strip(chain: Chain, shown: PathFrames) -> DeterminantStrip:
    """Draw det J over the postures ``shown`` of ``chain``."""
    values = shown.determinants
    sizes = np.abs(values)
    largest = float(sizes.max()) or 1.0
    root = _root(float(sizes.min()) / largest)
    bent = np.sign(values) * sizes ** (1.0 / root)
    low, high = min(0.0, float(bent.min())), max(0.0, float(bent.max()))
    margin = 0.16 * ((high - low) or 1.0)
    low, high = low - margin, high + margin

    def top(height: float) -> float:
        return round(100.0 * (high - height) / (high - low), 3)

    heights = tuple(top(float(y)) for y in bent)
    xs = _places(len(values), is_path=shown.is_path)
    at = int(np.argmin(sizes))
    zero = top(0.0)
    points = " ".join(f"{x:.2f},{y:.2f}" for x, y in zip(xs, heights, strict=True))
    return DeterminantStrip(
        points=points,
        area=f"{xs[0]:.2f},{zero} {points} {xs[-1]:.2f},{zero}",
        stems=tuple((x, y, zero) for x, y in zip(xs, heights, strict=True)),
        zero=zero,
        ticks=_apart(
            [
                Tick(top(np.sign(v) * abs(v) ** (1.0 / root)), number(v))
                for v in _tick_values(values, root)
            ],
            zero,
        ),
        heights=heights,
        unit=_unit(chain),
        scale=SCALES[root],
        smallest=float(sizes[at]),
        smallest_at=xs[at] / 1000.0,
        smallest_top=heights[at],
        sign=_sign(values),
    )


def _root(ratio: float) -> int:
    """The first root that lifts the smallest value off the zero line."""
    for root in SCALES:
        if ratio ** (1.0 / root) >= CLEAR:
            return root
    return 1 if ratio == 0.0 else max(SCALES)


def _places(count: int, *, is_path: bool) -> list[float]:
    """Where each posture stands in the box; single ones keep off its ends."""
    if is_path:
        return [1000.0 * i / max(1, count - 1) for i in range(count)]
    if count == 1:
        return [500.0]
    return [50.0 + 900.0 * i / (count - 1) for i in range(count)]


def _tick_values(values: Matrix, root: int) -> list[float]:
    """A few round values within the range, never zero."""
    ticks = []
    for sign in (1.0, -1.0):
        reach = float(np.max(sign * values))
        if reach <= 0:
            continue
        step = nice_step(reach)
        if root == 1:
            ticks += [sign * step, sign * step / 2] if step < reach else [sign * step]
        else:
            ticks += [sign * step, sign * nice_step(step / 2**root)]
    return ticks


def _apart(ticks: list[Tick], zero: float) -> tuple[Tick, ...]:
    """The ticks whose labels stay clear of zero's and of those before them."""
    kept: list[Tick] = []
    for tick in ticks:
        taken = [zero, *(other.top for other in kept)]
        if all(abs(tick.top - top) >= LABEL for top in taken):
            kept.append(tick)
    return tuple(kept)


def _unit(chain: Chain) -> str:
    """The unit of det J: each length in it comes from a turning joint's arm."""
    slides = sum(kind == "prismatic" for kind in chain.kinds)
    power = 3 - slides
    raised = {0: "", 1: chain.unit, 2: f"{chain.unit}²", 3: f"{chain.unit}³"}
    return raised.get(power, f"{chain.unit}^{power}")


def _sign(values: Matrix) -> str:
    if np.all(values > 0):
        return "positive"
    return "negative" if np.all(values < 0) else "of both signs"
