"""Cusps of the curve of critical values, counted exactly.

At a critical posture with a one-dimensional kernel k of dR, the curve of critical
values has a cusp when k is tangent to the critical curve: Delta = 0 and
k . grad Delta = 0. With k = (-d_x r_i, d_y r_i) for either row i of dR this reads

    kappa_i = d_x Delta d_y r_i - d_y Delta d_x r_i = 0,    i = 1, 2.

Over a point x of the base, Delta = P c + Q s + S vanishes at the two points of the
circle with (P^2 + Q^2)(c, s) = -S (P, Q) +- sqrt(D) (-Q, P), D = P^2 + Q^2 - S^2, and
on a line at q = -S/P. So on the critical curve kappa_i = X_i +- Y_i sqrt(D) with
X_i, Y_i polynomials on the base, and cusps are counted among the real zeros of
K_i = X_i^2 - Y_i^2 D: which sign vanishes follows from the exact signs of X_i, Y_i.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap
from cuspaudit.algebra.univariate import RealRoot, Univariate, real_roots
from cuspaudit.count import Count
from cuspaudit.surface.roadmap import SurfaceRoadmap
from cuspaudit.surface.surface import ROTATIONS, Factor, Surface

__all__ = ["cusps"]

_RING_NAMES = ("w", "x")


@dataclass(frozen=True)
class _Branches:
    """A function X +- Y sqrt(D) on the critical curve, over the base.

    Attributes:
        plain: X.
        root: Y; 0 on a line, where the critical curve has one branch.
        norm: X^2 - Y^2 D on a circle, X on a line.
    """

    plain: Univariate
    root: Univariate
    norm: Univariate

    def zeros(self, at: RealRoot, change: Univariate) -> set[int]:
        """The signs of sqrt(D) with which the function vanishes at a zero of norm."""
        plain = self.plain.sign_at(at)
        root = self.root.sign_at(at) * abs(change.sign_at(at))
        if plain == root == 0:
            return {1, -1}
        return {-plain * root} - {0}


def cusps(road: SurfaceRoadmap, mapping: PolynomialMap, delta: Polynomial) -> Count:
    """The number of cusps of R: simple tangencies of ker dR and the critical curve.

    Proved when every common zero of kappa_1 and kappa_2 on the critical curve is
    either simple or a singular point of that curve (where it crosses itself, and its
    image has no cusp of this kind), and no cusp can lie on a fiber that is critical
    as a whole.
    """
    is_line = road.surface.fiber.kind == "line"
    surface = _without_cusp_at_infinity(road.surface, delta, mapping)
    if surface is None:
        return Count(0, False)
    change, branches = _on_critical_curve(surface, delta, mapping)
    if change.is_zero or any(branch.norm.is_zero for branch in branches):
        return Count(0, False)
    total, proved = 0, _walls_have_no_cusp(road, mapping)
    for root in real_roots(branches[0].norm):
        order = min(branch.norm.multiplicity(root) for branch in branches)
        if order == 0 or change.multiplicity(root) > 1 or change.sign_at(root) < 0:
            continue
        signs = {1, -1}
        for branch in branches:
            signs &= branch.zeros(root, change)
        number = (
            min(len(signs), 1) if is_line or not change.sign_at(root) else len(signs)
        )
        total += number
        proved = proved and number in (0, order)
    return Count(total, proved)


def _without_cusp_at_infinity(
    surface: Surface, delta: Polynomial, mapping: PolynomialMap
) -> Surface | None:
    """The surface with a chart of the base whose missing point carries no cusp.

    Whether one lies there is seen in the chart that is given, where the missing point
    of any other chart has a rational coordinate.
    """
    if surface.base.kind == "line":
        return surface
    _, branches = _on_critical_curve(surface, delta, mapping)
    c, s = surface.base.rotation
    for rotation in ROTATIONS:
        cosine = -(rotation[0] * c + rotation[1] * s)
        sine = rotation[0] * s - rotation[1] * c
        if cosine != -1:
            missing = sine / (1 + cosine)
            if any(branch.norm.sign(missing) != 0 for branch in branches):
                return replace(surface, base=replace(surface.base, rotation=rotation))
    return None


def _on_critical_curve(
    surface: Surface, delta: Polynomial, mapping: PolynomialMap
) -> tuple[Univariate, list[_Branches]]:
    """(D, the branches of kappa_1 and kappa_2)."""
    parts = surface.affine_parts(delta)
    assert parts is not None, "orient chose a fiber along which Delta is affine"
    ring = Ring(_RING_NAMES, surface.ring.radicand)
    placed = _to_base(surface, ring, parts)
    if surface.fiber.kind == "line":
        p, s = placed
        place, below, change = [-s], p, p * p
    else:
        p, q, s = placed
        w = ring.gen("w")
        below, change = p * p + q * q, p * p + q * q - s * s
        place = [-s * p - w * q, -s * q + w * p]
    found = []
    for component in mapping.components:
        tangency = _tangency(surface, delta, component)
        value = _substitute(surface, ring, tangency, place, below)
        plain, root = _split(ring, value, change)
        norm = plain
        if surface.fiber.kind == "circle":
            norm = ring.reduce(plain * plain - root * root * change)
        found.append(_Branches(*(_univariate(ring, v) for v in (plain, root, norm))))
    return _univariate(ring, change), found


def _tangency(surface: Surface, delta: Polynomial, component: Polynomial) -> Polynomial:
    ring, y, x = surface.ring, surface.fiber, surface.base
    return surface.reduce(
        _along(ring, x, delta) * _along(ring, y, component)
        - _along(ring, y, delta) * _along(ring, x, component)
    )


def _along(ring: Ring, factor: Factor, function: Polynomial) -> Polynomial:
    """The derivative by the angle of a circle or the coordinate of a line."""
    if factor.kind == "line":
        return function.derivative(factor.names[0])
    c, s = (ring.gen(name) for name in factor.names)
    by_c, by_s = (function.derivative(name) for name in factor.names)
    return c * by_s - s * by_c


def _to_base(
    surface: Surface, ring: Ring, functions: Sequence[Polynomial]
) -> list[Polynomial]:
    """Functions on the base as polynomials in x, over one positive denominator."""
    numerators, _ = surface.on_base(functions)
    return [ring.from_other(n, surface.chart_ring) for n in numerators]


def _substitute(
    surface: Surface,
    ring: Ring,
    function: Polynomial,
    place: list[Polynomial],
    below: Polynomial,
) -> Polynomial:
    """``function`` at place / below on the fiber, times positive factors."""
    if function == 0:
        return ring.constant(0)
    parts = surface.ring.coefficients(function, surface.fiber.names)
    degree = max(sum(key) for key in parts)
    degree += degree % 2
    coefficients = _to_base(surface, ring, tuple(parts.values()))
    total = ring.constant(0)
    for key, coefficient in zip(parts, coefficients, strict=True):
        term = coefficient * below ** (degree - sum(key))
        for value, exponent in zip(place, key, strict=True):
            term *= value**exponent
        total += term
    return ring.reduce(total)


def _split(
    ring: Ring, value: Polynomial, change: Polynomial
) -> tuple[Polynomial, Polynomial]:
    """(X, Y) with value = X + Y w modulo w^2 = D."""
    halves = [ring.constant(0), ring.constant(0)]
    for (power,), coefficient in ring.coefficients(value, ["w"]).items():
        halves[power % 2] += coefficient * change ** (power // 2)
    return ring.reduce(halves[0]), ring.reduce(halves[1])


def _univariate(ring: Ring, polynomial: Polynomial) -> Univariate:
    return Univariate.from_polynomial(ring, polynomial, "x")


def _walls_have_no_cusp(road: SurfaceRoadmap, mapping: PolynomialMap) -> bool:
    """Whether no cusp can lie on a fiber where P = Q = S = 0.

    There kappa_i vanishes where Delta/f does (a crossing) or where d_y R = 0: nowhere
    if the two components of d_y R are independent on that fiber; a crossing again if
    one component does not depend on y at all; and if d_y R = 0 on the whole fiber, its
    image is one point.
    """
    surface, walls = road.surface, road.walls
    if not walls:
        return True
    slopes = [surface.affine_parts(r) for r in mapping.components]
    ring = Ring(_RING_NAMES, surface.ring.radicand)
    if any(slope is None for slope in slopes) or surface.fiber.kind == "line":
        return False
    rows = [_to_base(surface, ring, slope[:-1]) for slope in slopes if slope]
    if any(all(entry == 0 for entry in row) for row in rows):
        return True
    (a, b), (c, d) = rows
    cross = _univariate(ring, ring.reduce(a * d - b * c))
    entries = [_univariate(ring, entry) for entry in (a, b, c, d)]
    return all(
        cross.sign_at(root) != 0 or all(e.sign_at(root) == 0 for e in entries)
        for root in walls.values()
    )
