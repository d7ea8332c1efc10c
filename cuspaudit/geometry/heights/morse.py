"""Nondegenerate critical points of the height, with proved neighbourhoods.

The index and the neighbourhoods are proved in ball arithmetic in the tangent chart T
of the point. A *basin* of a maximum M is the lift of a cube of chart values around
T M over which the Hessian of G in the chart is negative definite: there G is a concave
function of the chart values with its maximum at M, so on the straight segment from
the values of any point of the basin to T M it increases. An *exit* of a saddle S, whose
Hessian has exactly one positive eigenvalue, with eigenvector u: the lift of a segment
of values from T S along u or -u over which the second derivative of G is positive.
There G increases from its critical value on, and by the lemma of Morse the two exits
lead into the two pieces of {G > G(S)} near S.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb
from numpy.typing import NDArray

from cuspaudit.algebra.evaluation import Table
from cuspaudit.geometry.heights.charted_height import ChartedHeight, Tangent
from cuspaudit.geometry.heights.segment import segment
from cuspaudit.geometry.lifts.lifting import Box, Lift, lift, sharpen

__all__ = ["Basin", "CriticalPoint", "Exit", "basin", "critical_point", "exits"]

Array = NDArray[np.float64]

_HALVINGS = 40


@dataclass(frozen=True, eq=False)
class CriticalPoint:
    """A nondegenerate critical point of G on V with P != 0.

    Attributes:
        ball: a small box around it.
        tangent: the chart there.
        level: G, enclosed.
        rising: the number of positive eigenvalues of the Hessian, proved.
        axis: the approximate eigenvector of the largest eigenvalue, in the chart.
        sign: that of P, proved.
    """

    ball: Box
    tangent: Tangent
    level: arb
    rising: int
    axis: Array
    sign: int

    @property
    def place(self) -> Array:
        """The point in doubles."""
        return middle(self.ball)


@dataclass(frozen=True, eq=False)
class Basin:
    """A proved neighbourhood of a maximum in which every straight way leads up to it.

    Attributes:
        top: the maximum.
        lift: over a cube of chart values.
    """

    top: CriticalPoint
    lift: Lift

    def holds(self, box: Sequence[arb]) -> bool:
        """Whether every point of V in ``box`` belongs to the basin."""
        return self.lift.holds(self.top.tangent.forms.values(box), box)


@dataclass(frozen=True, eq=False)
class Exit:
    """A proved way from a saddle, uphill.

    Attributes:
        lift: over a segment of chart values that begins at the saddle.
        end: a small box around the point where it ends, higher than the saddle.
    """

    lift: Lift
    end: Box


def critical_point(landscape: ChartedHeight, ball: Box) -> CriticalPoint | None:
    """The critical point in ``ball``; None if the ball does not prove its index.

    Args:
        landscape: V and G.
        ball: a box around one critical point of G on V with P != 0.
    """
    tangent = landscape.tangent(middle(ball))
    slopes = landscape.enclosed_slopes(tangent, ball)
    level = landscape.height.value(ball)
    rising = None if slopes is None else inertia(slopes[1])
    if slopes is None or level is None or rising is None:
        return None
    axis = np.linalg.eigh(_middles(slopes[1]))[1][:, -1]
    sign = 1 if landscape.height.jets.values(ball)[0] > 0 else -1
    return CriticalPoint(ball, tangent, level, rising, axis, sign)


def basin(landscape: ChartedHeight, top: CriticalPoint) -> Basin | None:
    """A basin of a maximum, as large as halving finds one."""
    centre = top.tangent.forms.values(top.ball)
    size = _scale(landscape, top)
    for _ in range(_HALVINGS):
        values = [value + arb(0, size) for value in centre]
        found = lift(top.tangent.chart, top.ball, values, top.ball)
        if found is not None and found.holds(centre, top.ball):
            slopes = landscape.enclosed_slopes(top.tangent, found.image)
            if slopes is not None and inertia(slopes[1]) == 0:
                return Basin(top, found)
        size /= 2
    return None


def exits(landscape: ChartedHeight, saddle: CriticalPoint) -> tuple[Exit, Exit] | None:
    """The two exits of a saddle with one positive eigenvalue."""
    ahead, back = (_exit(landscape, saddle, sign) for sign in (1, -1))
    return (ahead, back) if ahead is not None and back is not None else None


def inertia(hessian: Table) -> int | None:
    """The number of positive eigenvalues of each symmetric matrix in ``hessian``.

    With C the approximate eigenvectors scaled to C^T H C = diag(+-1), nearly, each row
    of C^T H C is dominated by its diagonal (Gershgorin): C is regular, no eigenvalue
    is 0, and by Sylvester's law the signs of the diagonal are those of H.

    Returns:
        None when the balls do not prove it, as for a singular matrix.
    """
    rough = _middles(hessian)
    if not np.isfinite(rough).all():
        return None
    values, vectors = np.linalg.eigh(rough)
    if not values.all():
        return None
    C = vectors / np.sqrt(np.abs(values))
    exact = np.array([[arb(float(e)) for e in row] for row in C], dtype=object)
    D = exact.T @ hessian @ exact
    for i, row in enumerate(D):
        rest = sum((abs(e) for j, e in enumerate(row) if j != i), arb(0))
        if not abs(row[i]) > rest:
            return None
    return sum(1 for i in range(len(D)) if D[i, i] > 0)


def middle(box: Sequence[arb]) -> Array:
    """The midpoint of a box in doubles."""
    return np.array([float(x.mid()) for x in box])


def _exit(landscape: ChartedHeight, saddle: CriticalPoint, sign: int) -> Exit | None:
    tangent = landscape.aligned(saddle.tangent, sign * saddle.axis)
    start = tangent.forms.values(saddle.ball)
    axis = tangent.forms.matrix @ saddle.tangent.forms.matrix.T @ (sign * saddle.axis)
    size = _scale(landscape, saddle)
    for _ in range(_HALVINGS):
        change = [size * arb(float(u)) for u in axis]
        end = [a + b for a, b in zip(start, change, strict=True)]
        values = [a.union(b) for a, b in zip(start, end, strict=True)]
        found = lift(tangent.chart, saddle.ball, values, saddle.ball)
        if found is not None and found.holds(start, saddle.ball):
            along = segment(landscape, tangent, saddle.ball, found.image, change)
            point = sharpen(tangent.chart, found, end)
            if along is not None and along.bend > 0 and point is not None:
                return Exit(found, point)
        size /= 2
    return None


def _scale(landscape: ChartedHeight, point: CriticalPoint) -> arb:
    """A length on which G is likely to change much: where halving begins."""
    _, hessian = landscape.slopes(point.tangent, point.place)
    smallest = float(np.abs(np.linalg.eigvalsh(hessian)).min())
    return arb(2.0 / max(smallest, 1e-300) ** 0.5)


def _middles(table: Table) -> Array:
    return np.array([[float(e.mid()) for e in row] for row in table])
