"""V with a height on it, seen through linear charts.

Near a point p of V, where jac f has rank n - d, take d orthonormal rows T that span the
tangent space there. x -> T x is a chart of V as long as J = (jac f; T) is regular. The
columns of J^-1 that belong to T, N, move along V at unit speed of the chart; with the
multipliers L = dG/dx J^-1 (the columns that belong to f),

    gradient of G in the chart = N^T dG/dx,
    Hessian of G in the chart  = N^T (Hess G - sum L_i Hess f_i) N,

at every point of the chart, critical or not (differentiate f(x(t)) = 0 twice). The
same lines serve doubles and balls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from flint import arb, arb_mat
from numpy.typing import NDArray

from cuspaudit.algebra.evaluation import Differentiable, Jets, Table
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.heights.height import Height
from cuspaudit.geometry.lifts.lifting import Chart

__all__ = ["ChartedHeight", "LinearForms", "Tangent"]

Array = NDArray[np.float64]
_NEWTON = 6


@dataclass(frozen=True, eq=False)
class LinearForms:
    """d linear forms on R^n.

    Attributes:
        matrix: (d, n) doubles, exact as they stand.
    """

    matrix: Array

    @cached_property
    def rows(self) -> list[list[arb]]:
        """The coefficients as balls of radius 0."""
        return [[arb(float(e)) for e in row] for row in self.matrix]

    def values(self, box: Sequence[arb]) -> list[arb]:
        """Enclosures of the forms over ``box``."""
        return [
            sum((a * x for a, x in zip(row, box, strict=True)), arb(0))
            for row in self.rows
        ]

    def jacobian(self, box: Sequence[arb]) -> list[list[arb]]:
        """The matrix itself."""
        return self.rows

    def floats(self, point: Array) -> tuple[Array, Array]:
        """Values and derivatives in doubles."""
        return self.matrix @ point, self.matrix


@dataclass(frozen=True, eq=False)
class Tangent:
    """A linear chart of V.

    Attributes:
        forms: T.
        chosen: the numbers of the n - d equations of f in use.
        chart: F = (f, T x) for lifting.
    """

    forms: LinearForms
    chosen: tuple[int, ...]
    chart: Chart


@dataclass(frozen=True, eq=False)
class ChartedHeight:
    """A variety V of dimension d and a height G on it.

    Attributes:
        variety: V.
        dimension: d.
        height: G.
    """

    variety: PolynomialSystem
    dimension: int
    height: Height

    @property
    def codimension(self) -> int:
        """The rank n - d of jac f."""
        return len(self.variety.ring.variables) - self.dimension

    def tangent(self, point: Array) -> Tangent:
        """The chart that is tangent to V at ``point`` (roughly on V)."""
        _, J, _ = self._equations.floats(point)
        rows = np.linalg.svd(J.reshape(-1, len(point)))[2]
        chosen = self._independent(J)
        forms = LinearForms(np.ascontiguousarray(rows[self.codimension :]))
        return Tangent(forms, chosen, Chart(self._systems(chosen), forms))

    def aligned(self, tangent: Tangent, direction: Array) -> Tangent:
        """The same chart with orthonormal rows, the first along ``direction``.

        Args:
            tangent: the chart T.
            direction: (d,) a vector of values of T.
        """
        d = self.dimension
        rows = np.linalg.qr(np.column_stack([direction, np.eye(d)]))[0].T[:d]
        turned = LinearForms(np.ascontiguousarray(rows @ tangent.forms.matrix))
        chart = Chart(tangent.chart.equations, turned)
        return Tangent(turned, tangent.chosen, chart)

    def value_at(self, point: Array) -> float:
        """G at a point, in doubles; minus infinity where P = 0."""
        (P, W), *_ = self.height.jets.floats(point)
        if P == 0:
            return -np.inf
        return float(self.height.power * np.log(abs(P)) - self.height.decay * np.log(W))

    def sign_at(self, point: Array) -> int:
        """The sign of P at a point, in doubles."""
        return int(np.sign(self.height.jets.floats(point)[0][0]))

    def slopes(self, tangent: Tangent, point: Array) -> tuple[Array, Array]:
        """Gradient and Hessian of G in a chart, in doubles."""
        jets = self._equations.floats(point)
        J = np.vstack([jets[1][list(tangent.chosen)], tangent.forms.matrix])
        own = self.height.derivatives(self.height.jets.floats(point))
        gradient, hessian, _ = self._in_chart(tangent, jets, np.linalg.inv(J), own)
        return gradient, hessian

    def enclosed_slopes(
        self, tangent: Tangent, box: Sequence[arb]
    ) -> tuple[Table, Table, Table] | None:
        """Gradient, Hessian and the velocities N over a box of V, in balls.

        Returns:
            None where J or P may be singular.
        """
        jets = self._equations.balls(box)
        own = self.height.jets.balls(box)
        if own[0][0].contains(0):
            return None
        chosen = jets[1][list(tangent.chosen)].tolist()
        try:
            inverse = arb_mat([*chosen, *tangent.forms.jacobian(box)]).inv()
        except ZeroDivisionError:
            return None
        table = np.array(inverse.tolist(), dtype=object)
        return self._in_chart(tangent, jets, table, self.height.derivatives(own))

    def equation_jets(
        self, box: Sequence[arb], chosen: tuple[int, ...]
    ) -> tuple[Table, Table, Table]:
        """Values, gradients and Hessians of the chosen equations over a box."""
        values, gradients, hessians = self._equations.balls(box)
        rows = list(chosen)
        return values[rows], gradients[rows], hessians[rows]

    def retract(self, tangent: Tangent, point: Array) -> Array | None:
        """The point of V over the chart's value of ``point``, by Newton, or None."""
        x, target = point.copy(), tangent.forms.matrix @ point
        chosen = list(tangent.chosen)
        if not chosen:
            return x
        for _ in range(_NEWTON):
            f, J, _ = self._equations.floats(x)
            defect = np.concatenate([f[chosen], tangent.forms.matrix @ x - target])
            try:
                step = np.linalg.solve(
                    np.vstack([J[chosen], tangent.forms.matrix]), defect
                )
            except np.linalg.LinAlgError:
                return None
            x = x - step
            if np.abs(step).max() < 1e-13 * (1 + np.abs(x).max()):
                return x
        return None

    def _in_chart(
        self,
        tangent: Tangent,
        jets: tuple[Table, Table, Table],
        inverse: Table,
        own: tuple[Table, Table],
    ) -> tuple[Table, Table, Table]:
        gradient, hessian = own
        cut = self.codimension
        N, multipliers = inverse[:, cut:], gradient @ inverse[:, :cut]
        for number, factor in zip(tangent.chosen, multipliers, strict=True):
            hessian = hessian - factor * jets[2][number]
        return gradient @ N, N.T @ hessian @ N, N

    def _independent(self, J: Array) -> tuple[int, ...]:
        """The n - d rows of jac f that span the largest volume."""
        choices = combinations(range(len(J)), self.codimension)

        def volume(chosen: tuple[int, ...]) -> float:
            rows = J[list(chosen)]
            return float(np.linalg.det(rows @ rows.T))

        return max(choices, key=volume)

    @cached_property
    def _equations(self) -> Jets:
        return Jets(self.variety.ring, self.variety.equations)

    @cached_property
    def _chosen(self) -> dict[tuple[int, ...], Differentiable]:
        return {}

    def _systems(self, chosen: tuple[int, ...]) -> Differentiable:
        if chosen not in self._chosen:
            equations = [self.variety.equations[i] for i in chosen]
            self._chosen[chosen] = Differentiable(self.variety.ring, equations)
        return self._chosen[chosen]
