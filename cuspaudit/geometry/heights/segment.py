"""The height along one lifted segment of chart values, by Taylor's formula.

Let x(t), 0 <= t <= 1, be the lift of T x(t) = T x(0) + t v. With u = x'(t) and J the
Jacobian matrix of (f, T x),

    J u = (0, v),   J x'' = -(Hess f (u, u), 0),
    (p o x)' = dp u,   (p o x)'' = Hess p (u, u) + dp x''

for a polynomial p. The values at t = 0 are known sharply, the second derivative is
enclosed over a box around the segment; so p o x and its first derivative are enclosed
to the second order in the length of the segment, and G = m log|P| - k log W after them.
In a narrow corridor of {P != 0} that counts: a box is as wide as the step is long.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb, arb_mat

from cuspaudit.algebra.evaluation import Table
from cuspaudit.geometry.heights.charted_height import ChartedHeight, Tangent

__all__ = ["Segment", "segment"]


@dataclass(frozen=True)
class Segment:
    """G o x on [0, 1]; P != 0 there.

    Attributes:
        value: G at t = 0.
        slope: dG/dt at t = 0.
        bend: the second derivative on [0, 1].
    """

    value: arb
    slope: arb
    bend: arb

    def is_above(self, level: arb) -> bool:
        """Whether G > ``level`` on [0, 1].

        G(t) >= value + slope t + m t^2 / 2 with m <= 0 a lower bound of the second
        derivative: a concave function, least at one of the ends.
        """
        least = self.bend.lower().min(arb(0))
        return bool(self.value > level and self.value + self.slope + least / 2 > level)


def segment(
    landscape: ChartedHeight,
    tangent: Tangent,
    begin: Sequence[arb],
    over: Sequence[arb],
    v: Sequence[arb],
) -> Segment | None:
    """G along a lifted segment, or None unless P != 0 on it is proved.

    Args:
        landscape: V and G.
        tangent: the chart T.
        begin: a box around x(0).
        over: a box around x(t) for all t in [0, 1].
        v: the change of the values of T.
    """
    start = _derivatives(landscape, tangent, begin, v)
    whole = _derivatives(landscape, tangent, over, v)
    if start is None or whole is None:
        return None
    pairs = zip(*start[:2], whole[2], strict=True)
    (P, dP), (W, dW) = (_ranges(*triple) for triple in pairs)
    p, w = start[0]
    if P.contains(0) or not W > 0:
        return None
    m, k = landscape.height.power, landscape.height.decay
    ddP, ddW = whole[2]
    dP, dW = dP / P, dW / W
    return Segment(
        m * abs(p).log() - k * w.log(),
        m * start[1][0] / p - k * start[1][1] / w,
        m * (ddP / P - dP * dP) - k * (ddW / W - dW * dW),
    )


def _ranges(value: arb, first: arb, second: arb) -> tuple[arb, arb]:
    """A function on [0, 1] and its derivative, from value and derivative at 0."""
    low = value.lower().min((value + first + second.min(arb(0)) / 2).lower())
    high = value.upper().max((value + first + second.max(arb(0)) / 2).upper())
    return low.union(high), first.union(first + second)


def _derivatives(
    landscape: ChartedHeight, tangent: Tangent, box: Sequence[arb], v: Sequence[arb]
) -> tuple[Table, Table, Table] | None:
    """Values, first and second derivatives of (P, W) along v, for x(t) in ``box``."""
    _, rows, bends = landscape.equation_jets(box, tangent.chosen)
    values, gradients, hessians = landscape.height.jets.balls(box)
    J = arb_mat([*rows.tolist(), *tangent.forms.jacobian(box)])
    try:
        u = _solve(J, [*([arb(0)] * len(rows)), *v])
        turn = [-(u @ bend @ u) for bend in bends]
        bent = _solve(J, [*turn, *([arb(0)] * len(v))])
    except ZeroDivisionError:
        return None
    second = [u @ H @ u for H in hessians]
    return values, gradients @ u, np.array(second) + gradients @ bent


def _solve(J: arb_mat, right: Sequence[arb]) -> Table:
    return np.array(J.solve(arb_mat([[e] for e in right])).entries(), dtype=object)
