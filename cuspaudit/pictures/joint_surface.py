"""The surface of joints 2 and 3 and its map in floating point, for drawing only.

A point of V = fiber x base is a pair (y, x): an angle in rad on a circle, a coordinate
on a line, in the variables of the exact model. Over x, Delta = P cos y + Q sin y + S,
so {Delta > 0} is the arc of half-width acos(-S / sqrt(P^2 + Q^2)) about the angle of
(P, Q); on a line, Delta = P y + S. The critical curve is the boundary of these arcs.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.numeric import NumericPolynomial, numeric_values
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.univariate import RealRoot
from cuspaudit.cuspidality.surface_decision import SurfaceDecision
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.kinematics.transform import dot
from cuspaudit.surface.surface import Factor

__all__ = ["Array", "JointSurface"]

Array = NDArray[np.float64]


class JointSurface:
    """V, Delta and R of a three-joint arm at many points at once.

    Attributes:
        decision: the run of Algorithm 1 that is drawn.
        model: the three-joint model it is about.
        reach: how far a coordinate on a line is followed, either way.
    """

    def __init__(self, decision: SurfaceDecision, model: ExactModel) -> None:
        self.decision, self.model = decision, model
        surface = decision.surface
        self.fiber, self.base = surface.fiber, surface.base
        self.ring = surface.ring
        parts = surface.affine_parts(decision.delta)
        assert parts is not None, "orient chose the fiber so"
        self._parts = parts
        self._map = reduced_map(model)[1].components
        functions = (decision.delta, *self._map)
        self._functions = [NumericPolynomial(self.ring, f) for f in functions]
        self._slopes = [
            [NumericPolynomial(self.ring, self._along(a, f)) for f in functions]
            for a in (self.fiber, self.base)
        ]
        place = self.ring.variables.index
        self._is_swapped = place(self.fiber.names[0]) > place(self.base.names[0])
        self.reach = self._reach()

    def delta(self, points: Array) -> Array:
        """Delta at (m, 2) points (y, x): (m,)."""
        return self._functions[0](self._variables(points))

    def values(self, points: Array) -> Array:
        """The reduced map R = (u, v) at (m, 2) points: (m, 2)."""
        variables = self._variables(points)
        return np.stack([f(variables) for f in self._functions[1:]], axis=1)

    def slopes(self, points: Array) -> Array:
        """Derivatives by y and x of Delta, u and v at (m, 2) points: (m, 2, 3)."""
        variables = self._variables(points)
        rows = [np.stack([f(variables) for f in row], axis=1) for row in self._slopes]
        return np.stack(rows, axis=1)

    def arcs(self, base: Array) -> tuple[Array, Array]:
        """Middle and half-width of {Delta > 0} over base coordinates, on a circle.

        The half-width is 0 where Delta < 0 on the whole fiber, pi where Delta > 0.
        """
        p, q, s = self._affine(base)
        radius = np.hypot(p, q)
        ratio = np.divide(-s, radius, out=-np.sign(s), where=radius > 0)
        return np.arctan2(q, p), np.arccos(np.clip(ratio, -1, 1))

    def edges(self, base: Array) -> tuple[Array, Array]:
        """Slope of Delta along a line fiber, and where it vanishes (inf: nowhere)."""
        p, s = self._affine(base)
        return p, np.divide(-s, p, out=np.full_like(p, np.inf), where=p != 0)

    def base_at(self, root: RealRoot | float) -> float:
        """The base coordinate at a coordinate of the base's chart."""
        if self.base.kind == "line":
            return float(root)
        c, s = (float(int(v.p) / int(v.q)) for v in self.base.rotation)
        return math.atan2(s, c) + 2 * math.atan(float(root))

    def joint_values(self, points: Array) -> Array:
        """(m, 2) values of joints 2 and 3 at points (y, x); angles not reduced."""
        ordered = points[:, ::-1] if self._is_swapped else points
        zeros = self.model.zeros[1:]
        return np.asarray(ordered - np.array(zeros))

    def points_at(self, variables: Array) -> Array:
        """Points (y, x) at coordinates given in the order of the ring."""
        return np.asarray(variables[:, ::-1] if self._is_swapped else variables)

    def plane(self, values: Array) -> Array:
        """The plane that is drawn, at (m, 2) values (u, v) of R.

        A revolute first joint: (rho, z), distance from its axis and height along it
        from the origin of its frame. A prismatic one: the two coordinates across it.
        """
        joint = self.model.joints[0]
        u, v = values.T
        if joint.kind == "prismatic":
            return np.asarray(values / np.linalg.norm(self.directions[0]))
        rho = np.sqrt(np.maximum(u - v * v, 0))
        return np.stack([rho, v + self.rise], axis=1)

    def values_at(self, plane: Array) -> Array:
        """(m, 2) values (u, v) of R at points of the plane that is drawn."""
        if self.model.joints[0].kind == "prismatic":
            return np.asarray(plane * np.linalg.norm(self.directions[0]))
        rho, z = plane[:, 0], plane[:, 1] - self.rise
        return np.stack([rho**2 + z**2, z], axis=1)

    @property
    def directions(self) -> Array:
        """The two directions across a prismatic first joint, as `reduced_map` has."""
        axis = self._numbers(self.model.joints[0].axis)
        across = next(w for w in np.cross(axis, np.eye(3)) if np.any(w))
        return np.array([across, np.cross(axis, across)])

    @property
    def rise(self) -> float:
        """Height of the origin of `reduced_map` above the first joint's frame."""
        first, second = self.model.joints[:2]
        along = dot(self.model.ring, first.axis, second.before.translation)
        return float(self._numbers((along,))[0])

    def _numbers(self, entries: tuple[Polynomial, ...]) -> Array:
        ring = self.model.ring
        return np.array([float(ring.evaluate(entry, {}).mid()) for entry in entries])

    def _reach(self) -> float:
        steps = [self._numbers(j.before.translation) for j in self.model.joints]
        size = sum(float(np.linalg.norm(step)) for step in steps)
        size += float(np.linalg.norm(self._numbers(self.model.tool.translation)))
        roots = [abs(self.base_at(root)) for root in self.decision.roadmap.critical]
        return 2 * max([size or 1.0, *(roots if self.base.kind == "line" else [])])

    def _affine(self, base: Array) -> Array:
        points = np.stack([np.zeros_like(base), base], axis=1)
        return numeric_values(self.ring, self._parts, self._variables(points)).T

    def _variables(self, points: Array) -> Array:
        columns: dict[str, Array] = {}
        for factor, values in zip((self.fiber, self.base), points.T, strict=True):
            if factor.kind == "line":
                columns[factor.names[0]] = values
            else:
                columns[factor.names[0]] = np.cos(values)
                columns[factor.names[1]] = np.sin(values)
        return np.stack([columns[name] for name in self.ring.variables], axis=1)

    def _along(self, factor: Factor, function: Polynomial) -> Polynomial:
        """The derivative by the angle of a circle or the coordinate of a line."""
        if factor.kind == "line":
            return function.derivative(factor.names[0])
        c, s = (self.ring.gen(name) for name in factor.names)
        return c * function.derivative(factor.names[1]) - s * function.derivative(
            factor.names[0]
        )
