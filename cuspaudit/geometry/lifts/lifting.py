"""One certified step on a variety: lift a set of values through a chart.

Let F = (f, g): R^n -> R^n, f the equations of V and g = (g_1, ..., g_d) a chart,
which may be the map R itself or linear forms. Where det jac F != 0 on V, g is a local
diffeomorphism of V. The theorem below proves, in one test, that a whole box of values
has a continuous lift to V.

**Theorem** (Krawczyk 1969; Neumaier 1990, Theorem 5.1.8, with a parameter). Let X be a
box with centre m, T a box of values, A an enclosure of F'(X) and Y any matrix. If

    K = m - Y (F(m) - (0, T)) + (1 - Y A) (X - m)

lies in the interior of X, then for every y in T there is exactly one x(y) in X with
f(x) = 0 and g(x) = y; it lies in K; jac F is regular on X; and y -> x(y) is analytic
on T (implicit functions). The proof is the classical one for each y of T: K holds the
Krawczyk box of every single y.

Hence two lifts over boxes of values that share a value y continue each other as soon
as one point over y lies in both boxes X: it is *the* solution in each.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from flint import arb, arb_mat, ctx
from numpy.typing import NDArray

from cuspaudit.algebra.evaluation import Table

__all__ = ["Chart", "Coordinates", "Lift", "contains", "lift", "sharpen"]

_INFLATIONS = 4
_NEWTON = 6
_CHORDS = 4

Array = NDArray[np.float64]
Box = tuple[arb, ...]


class Coordinates(Protocol):
    """Functions on R^n with first derivatives in balls."""

    def values(self, box: Sequence[arb]) -> list[arb]:
        """Enclosures of the functions over ``box``."""

    def jacobian(self, box: Sequence[arb]) -> list[list[arb]]:
        """Enclosures of the derivatives over ``box``, a row for each function."""

    def floats(self, point: Array) -> tuple[Table, Table]:
        """Values and derivatives at a point, in doubles."""


@dataclass(frozen=True)
class Chart:
    """F = (f, g) with as many rows as variables.

    Attributes:
        equations: n - d equations of V.
        coordinates: the d functions g.
    """

    equations: Coordinates
    coordinates: Coordinates

    def values(self, box: Sequence[arb]) -> arb_mat:
        """F over ``box``, a column."""
        rows = [*self.equations.values(box), *self.coordinates.values(box)]
        return arb_mat([[value] for value in rows])

    def jacobian(self, box: Sequence[arb]) -> arb_mat:
        """F' over ``box``."""
        return arb_mat([*self.equations.jacobian(box), *self.coordinates.jacobian(box)])

    def newton(self, point: Array, values: Array) -> Array:
        """Newton steps in doubles towards the lift of ``values``; a guess.

        Raises:
            LinAlgError: a Jacobian matrix is singular.
        """
        for _ in range(_NEWTON):
            f, J = self.equations.floats(point)
            g, T = self.coordinates.floats(point)
            defect = np.concatenate([f, g - values])
            step = np.linalg.solve(np.vstack([J, T]), defect)
            point = point - step
            if not np.abs(step).max() > 1e-14 * (1 + np.abs(point).max()):
                break
        return point


@dataclass(frozen=True)
class Lift:
    """The lift of a box of values.

    Attributes:
        values: T, d balls.
        box: X, n balls: exactly one point of V over each value in T.
        image: K, n balls inside X: all these points.
    """

    values: Box
    box: Box
    image: Box

    def holds(self, values: Sequence[arb], point: Sequence[arb]) -> bool:
        """Whether every point of V in ``point`` with values in ``values`` is lifted."""
        return contains(self.values, values) and contains(self.box, point)


def lift(
    chart: Chart,
    guess: Sequence[arb],
    values: Sequence[arb],
    reach: Sequence[arb] = (),
) -> Lift | None:
    """The lift of the box of ``values`` near ``guess``, or None without a proof.

    Args:
        chart: F = (f, g).
        guess: a point close to the lift of the middle of ``values``.
        values: T.
        reach: balls that X is asked to contain, as far as sizes go.
    """
    try:
        middle, Y = _centre(chart, guess, [y.mid() for y in values])
    except (ZeroDivisionError, np.linalg.LinAlgError):
        return None
    size = len(middle)
    defect = Y * (chart.values(middle) - _column(size, values))
    if not all(e.is_finite() for e in defect.entries()):
        return None
    sides = [abs(e).upper() * 5 / 4 + _grain() for e in defect.entries()]
    for i, x in enumerate(reach):
        sides[i] = sides[i].max(abs(x - middle[i]).upper() * 9 / 8)
    for _ in range(_INFLATIONS):
        offsets = [arb(0, side) for side in sides]
        # m has no more bits than the precision: m + offset is X without rounding
        box = tuple(m + offset for m, offset in zip(middle, offsets, strict=True))
        rest = _unit(size) - Y * chart.jacobian(box)
        moved = (rest * arb_mat([[offset] for offset in offsets]) - defect).entries()
        if not all(e.is_finite() for e in moved):
            return None
        if all(x.contains_interior(k) for x, k in zip(offsets, moved, strict=True)):
            image = tuple(m + k for m, k in zip(middle, moved, strict=True))
            return Lift(tuple(values), box, image)
        sides = [
            side.max(abs(k).upper() * 9 / 8)
            for side, k in zip(sides, moved, strict=True)
        ]
    return None


def sharpen(chart: Chart, over: Lift, values: Sequence[arb]) -> Box | None:
    """A small box of the points of ``over`` above ``values``, a part of its values.

    Returns:
        Balls that hold the x(y) of ``over`` for each y in ``values``; None without a
        proof.
    """
    point = lift(chart, over.image, values)
    if point is None:
        return None
    same = contains(over.box, point.image) or contains(point.box, over.image)
    return point.image if same else None


def contains(outer: Sequence[arb], inner: Sequence[arb]) -> bool:
    """Whether each ball holds its partner."""
    return all(a.contains(b) for a, b in zip(outer, inner, strict=True))


def _centre(
    chart: Chart, guess: Sequence[arb], values: Sequence[arb]
) -> tuple[list[arb], arb_mat]:
    """A point close to the lift of ``values``, and the inverse of F' there, nearly.

    By Newton's method in doubles, then by chords at the working precision.
    """
    start, goal = (np.array([float(x.mid()) for x in row]) for row in (guess, values))
    rough = chart.newton(start, goal)
    if not np.isfinite(rough).all():
        raise ZeroDivisionError
    point, target = [arb(float(x)) for x in rough], _column(len(guess), values)
    Y = chart.jacobian(point).mid().inv().mid()
    for _ in range(_CHORDS):
        step = (Y * (chart.values(point) - target)).entries()
        point = [(x - e).mid() for x, e in zip(point, step, strict=True)]
        if all(abs(e) < _grain() for e in step):
            break
    return point, Y


def _column(size: int, values: Sequence[arb]) -> arb_mat:
    zeros = [arb(0)] * (size - len(values))
    return arb_mat([[value] for value in (*zeros, *values)])


def _grain() -> arb:
    """A side far above rounding, far below anything geometric."""
    return arb(2) ** (-5 * ctx.prec // 8)


def _unit(size: int) -> arb_mat:
    return arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
