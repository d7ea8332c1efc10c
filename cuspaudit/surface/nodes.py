"""Nodes of the curve of critical values, counted with proof in the generic case.

A node is a value over which two different postures are critical: there F, a quartic in
the half-angle tangent of the base circle, is a square with two distinct real roots. As
a conic C in (c, s), F has a quadratic part that does not depend on the value, a linear
part of degree 1 in (u, v) and a constant of degree 2. F is a square on the circle when
a member lambda (c^2 + s^2 - 1) + C of the pencil is a double line: lambda is then one
of two constants, and (u, v) solves one linear and one quadratic equation.

One more kind: a fiber that is critical as a whole and has one value (the tip stands on
the joint axis). The rest of the critical curve crosses that fiber twice or not at all;
in the first case two of its branches meet in this value.
"""

from __future__ import annotations

from itertools import combinations

from flint import arb, ctx, fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap
from cuspaudit.algebra.univariate import PRECISIONS, RealRoot, Univariate
from cuspaudit.count import Count
from cuspaudit.surface.fibers import FiberPolynomials
from cuspaudit.surface.roadmap import SurfaceRoadmap

__all__ = ["nodes"]

Conic = tuple[Polynomial, ...]
_BITS = 128


def nodes(
    fibers: FiberPolynomials, road: SurfaceRoadmap, mapping: PolynomialMap
) -> Count:
    """The number of real values with two distinct real double postures.

    Proved when F is such a quartic on a base circle and every sign that decides is
    settled by ball arithmetic; a degenerate arm gives (what was found, False).
    """
    plain, walls = _on_the_circle(fibers), _at_walls(road, mapping)
    return Count(plain.count + walls.count, plain.proved and walls.proved)


def _at_walls(road: SurfaceRoadmap, mapping: PolynomialMap) -> Count:
    """Values of wholly critical fibers through which two critical branches pass."""
    values, proved = [], True
    for index, root in road.walls.items():
        value = _only_value(road, mapping, root)
        if value is None:
            continue
        left = road.strips[index].signs
        right = road.strips[(index + 1) % len(road.strips)].signs
        proved = (
            proved and road.change.multiplicity(root) == 2 and len(left) == len(right)
        )
        if len(left) == 2:
            values.append(value)
    distinct = all(
        any(not a.overlaps(b) for a, b in zip(p, q, strict=True))
        for p, q in combinations(values, 2)
    )
    return Count(len(values), proved and distinct)


def _only_value(
    road: SurfaceRoadmap, mapping: PolynomialMap, root: RealRoot
) -> tuple[arb, ...] | None:
    """R on the fiber over ``root`` if it is constant there."""
    ring, x = road.surface.chart_ring, root.enclosure(_BITS)
    value = []
    for component in mapping.components:
        parts = road.surface.affine_parts(component)
        if parts is None:
            return None
        numerators, below = road.surface.on_base(parts)
        *slopes, constant = (
            Univariate.from_polynomial(ring, n, "x") for n in numerators
        )
        if any(slope.sign_at(root) != 0 for slope in slopes):
            return None
        value.append(constant(x) / ring.evaluate(below, {"x": x}))
    return tuple(value)


def _on_the_circle(fibers: FiberPolynomials) -> Count:
    degree = fibers.polynomial.degrees()[
        fibers.ring.context.variable_to_index(fibers.separating)
    ]
    if degree < 4:
        return Count(0, True)
    if fibers.separating != "x" or fibers.surface.base.kind != "circle":
        return Count(0, False)
    conic = _conic(fibers)
    if conic is None:
        return Count(0, False)
    saved = ctx.prec
    try:
        for bits in PRECISIONS[:5]:
            ctx.prec = bits
            count = _count(fibers.ring, conic)
            if count is not None:
                return Count(count, True)
    finally:
        ctx.prec = saved
    return Count(0, False)


def _conic(fibers: FiberPolynomials) -> Conic | None:
    """(a, b, e, g, h, k): a c^2 + 2 b c s + e s^2 + 2 g c + 2 h s + k = 0 is F = 0.

    The circle is turned by a fixed angle first, so that b is not 0 by symmetry.
    """
    ring = fibers.ring
    parts = ring.coefficients(fibers.polynomial, [fibers.separating])
    f = [parts.get((i,), ring.constant(0)) for i in range(5)]
    square, middle = (f[0] + f[4] - f[2]) / 4, (f[0] + f[4] + f[2]) / 4
    mixed, along_c, along_s = (f[1] - f[3]) / 8, (f[0] - f[4]) / 4, (f[1] + f[3]) / 8
    p, q = fmpq(3, 5), fmpq(4, 5)
    a = square * p * p + 2 * mixed * p * q
    b = -square * p * q + mixed * (p * p - q * q)
    e = square * q * q - 2 * mixed * p * q
    g, h = along_c * p + along_s * q, along_s * p - along_c * q
    conic = (a, b, e, g, h, middle)
    constants, linear = conic[:3], conic[3:5]
    if any(not _degree_at_most(ring, entry, 0) for entry in constants):
        return None
    if any(not _degree_at_most(ring, entry, 1) for entry in linear):
        return None
    return conic if _degree_at_most(ring, middle, 2) else None


def _degree_at_most(ring: Ring, polynomial: Polynomial, degree: int) -> bool:
    return all(sum(key) <= degree for key in ring.coefficients(polynomial, ("u", "v")))


def _count(ring: Ring, conic: Conic) -> int | None:
    """The number of nodes, or None when the precision does not settle a sign."""
    a, b, e = (_value(ring, entry) for entry in conic[:3])
    spread = ((a - e) * (a - e) + 4 * b * b).sqrt()
    if b.contains(0) or spread.contains(0):
        return None
    total = 0
    for sign in (1, -1):
        found = _on_member(ring, conic, (-(a + e) + sign * spread) / 2)
        if found is None:
            return None
        total += found
    return total


def _on_member(ring: Ring, conic: Conic, member: arb) -> int | None:
    """Nodes whose double line belongs to one member of the pencil.

    With a' = a + lambda the rank is 1 when a' h = b g and a' (k - lambda) = g^2.
    """
    a, b = _value(ring, conic[0]) + member, _value(ring, conic[1])
    g, h, k = (_coefficients(ring, entry) for entry in conic[3:])
    line = {key: a * h.get(key, 0) - b * g.get(key, 0) for key in _MONOMIALS[:3]}
    quadric = {key: a * k.get(key, arb(0)) for key in _MONOMIALS}
    quadric[0, 0] -= a * member
    for left, x in g.items():
        for right, y in g.items():
            quadric[left[0] + right[0], left[1] + right[1]] -= x * y
    points = _intersect(line, quadric)
    if points is None:
        return None
    count = 0
    for u, v in points:
        at = g.get((1, 0), 0) * u + g.get((0, 1), 0) * v + g.get((0, 0), 0)
        meets = a * a + b * b - at * at
        if meets.contains(0):
            return None
        count += meets > 0
    return count


_MONOMIALS = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))


def _intersect(
    line: dict[tuple[int, int], arb], quadric: dict[tuple[int, int], arb]
) -> list[tuple[arb, arb]] | None:
    """The real points of a line and a conic in the plane, in balls; None: unsettled."""
    alpha, beta, gamma = line[1, 0], line[0, 1], line[0, 0]
    if alpha.contains(0) and beta.contains(0):
        return None
    flip = abs(beta.mid()) > abs(alpha.mid())
    if flip:
        alpha, beta = beta, alpha
    if alpha.contains(0):
        return None
    slope, start = -beta / alpha, -gamma / alpha
    q = {key[::-1] if flip else key: value for key, value in quadric.items()}
    q2 = q[2, 0] * slope * slope + q[1, 1] * slope + q[0, 2]
    q1 = 2 * q[2, 0] * slope * start + q[1, 1] * start + q[1, 0] * slope + q[0, 1]
    q0 = q[2, 0] * start * start + q[1, 0] * start + q[0, 0]
    square = q1 * q1 - 4 * q2 * q0
    if q2.contains(0) or square.contains(0):
        return None
    if square < 0:
        return []
    points = []
    for sign in (1, -1):
        second = (-q1 + sign * square.sqrt()) / (2 * q2)
        first = start + slope * second
        points.append((second, first) if flip else (first, second))
    return points


def _coefficients(ring: Ring, polynomial: Polynomial) -> dict[tuple[int, int], arb]:
    parts = ring.coefficients(polynomial, ("u", "v"))
    return {(key[0], key[1]): _value(ring, part) for key, part in parts.items()}


def _value(ring: Ring, constant: Polynomial) -> arb:
    return ring.evaluate(constant, {})
