"""Circles that go round without anything happening: a rotation of everything.

Let c, s occur in one equation of V only, c^2 + s^2 = r with r > 0, and in no minor once
it is reduced modulo the circles. Then V = S x V', S the circle, and
V - {Delta = 0} = S x (V' - {Delta = 0}), whose components are those of
V' - {Delta = 0}, because S is connected. So components are counted on V', in two
variables less, and a path on V goes along V' first and then round the circle. For a
robot this is the turn of its first joint; nothing here knows of robots.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem

__all__ = ["Essential", "without_idle_circles"]

Array = NDArray[np.float64]

_TURN = 24


@dataclass(frozen=True, eq=False)
class Essential:
    """V = V' x circles, Delta a function on V'.

    Attributes:
        whole: V.
        variety: V', in the variables that are left.
        dimension: that of V'.
        minors: Delta, or several minors, on V'.
        circles: the pairs of variables left out.
    """

    whole: PolynomialSystem
    variety: PolynomialSystem
    dimension: int
    minors: tuple[Polynomial, ...]
    circles: tuple[tuple[str, str], ...]

    @cached_property
    def places(self) -> list[int]:
        """Where the variables of V' stand among those of V."""
        own = self.whole.ring.variables
        return [own.index(name) for name in self.variety.ring.variables]

    def lifted(self, path: Array, first: Array, last: Array) -> Array:
        """Way points on V over a path on V', from ``first`` to ``last``.

        Args:
            path: (m, n') way points on V', from that of ``first`` to that of ``last``.
            first: (n,) a point of V.
            last: (n,) likewise.
        """
        along = np.tile(first, (len(path), 1))
        along[:, self.places] = path
        if not self.circles:
            return along
        ways = np.linspace(0.0, 1.0, _TURN)[1:]
        round_ = np.tile(along[-1], (len(ways), 1))
        for pair in self.circles:
            i, j = (self.whole.ring.variables.index(name) for name in pair)
            size = np.hypot(first[i], first[j])
            begins, ends = (np.arctan2(p[j], p[i]) for p in (first, last))
            turn = (ends - begins + np.pi) % (2 * np.pi) - np.pi
            round_[:, i] = size * np.cos(begins + ways * turn)
            round_[:, j] = size * np.sin(begins + ways * turn)
        return np.concatenate([along, round_])


def without_idle_circles(
    variety: PolynomialSystem, dimension: int, minors: Sequence[Polynomial]
) -> Essential:
    """V and its minors without the circles on which nothing depends.

    Args:
        variety: V = {f = 0}.
        dimension: that of V.
        minors: those of ``crit``.

    >>> ring = Ring(["c", "s", "x"])
    >>> c, s, x = ring.gens
    >>> circle = PolynomialSystem(ring, (c**2 + s**2 - 1,))
    >>> found = without_idle_circles(circle, 2, [-2 * c**2 * x - 2 * s**2 * x])
    >>> found.variety.ring.variables, found.minors, found.circles
    (('x',), (-2*x,), (('c', 's'),))
    """
    ring = variety.ring
    found = list(_circles(variety))
    reduced = list(minors)
    for equation, _ in found:
        reduced = [divmod(p, equation)[1] for p in reduced]
    idle = [
        (equation, pair)
        for equation, pair in found
        if all(p.derivative(name) == 0 for p in reduced for name in pair)
    ]
    gone = {name for _, pair in idle for name in pair}
    if not idle or not set(ring.variables) - gone:
        return Essential(variety, variety, dimension, tuple(minors), ())
    left = Ring([x for x in ring.variables if x not in gone], ring.radicand)
    equations = [
        left.from_other(f, ring)
        for f in variety.equations
        if not any(f == equation for equation, _ in idle)
    ]
    own: list[Polynomial] = []
    for p in reduced:
        minor = left.from_other(p, ring)
        if minor != 0 and minor not in own:
            own.append(minor)
    if not own:
        return Essential(variety, variety, dimension, tuple(minors), ())
    return Essential(
        variety,
        PolynomialSystem(left, tuple(equations)),
        dimension - len(idle),
        tuple(own),
        tuple(pair for _, pair in idle),
    )


def _circles(variety: PolynomialSystem) -> Iterator[tuple[Polynomial, tuple[str, str]]]:
    """The equations a (c^2 + s^2 - r), r > 0 in Q, and (c, s), in no other equation."""
    ring = variety.ring
    for equation in variety.equations:
        names = [x for x in ring.variables if equation.derivative(x) != 0]
        if len(names) != 2:
            continue
        c, s = names
        lead = equation.derivative(c).derivative(c) / 2
        rest = equation - lead * (ring.gen(c) ** 2 + ring.gen(s) ** 2)
        if not (lead.is_constant() and rest.is_constant() and lead != 0 != rest):
            continue
        radius = _number(rest) / _number(lead)
        others = [f for f in variety.equations if f is not equation]
        alone = all(f.derivative(x) == 0 for f in others for x in names)
        if alone and radius is not None and radius < 0:
            yield equation, (c, s)


def _number(p: Polynomial) -> fmpq:
    (value,) = p.to_dict().values()
    return value
