"""The height G = log(h^2 w) on V - {Delta = 0}, and its critical points.

h^2 is Delta^2, or the sum of the squares of the minors when there are several, and
w = 1 / (1 + |x - a|^2)^k. So G = m log|P| - k log W with polynomials P and W. G tends
to minus infinity at {Delta = 0}, and at infinity on V when V is bounded (nothing to
tend to) or k > deg Delta; then every set {G >= c} is compact.

G has a critical point on V where its gradient lies in the row space of jac f. When the
equations fall into blocks without common variables, jac f is block diagonal, and that
means block by block: all minors of size s_B + 1 of jac(f_B, G) in the variables of the
block vanish. For circles that is one equation each, c dG/ds - s dG/dc = 0.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

import networkx as nx
from flint import arb, fmpq

from cuspaudit.algebra.evaluation import Jets, Table
from cuspaudit.algebra.matrix import determinant
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import DegenerateMapError
from cuspaudit.runtime.clock import check_time

__all__ = ["Height", "critical_system", "heights", "is_visibly_bounded", "plain_height"]

_WEIGHTS = 4


@dataclass(frozen=True, eq=False)
class Height:
    """G = ``power`` log|P| - ``decay`` log W.

    Attributes:
        ring: the ring of V.
        base: P; h^2 = |P|^power.
        power: 2 for one minor, 1 for a sum of squares.
        weight: W = 1 + |x - a|^2.
        decay: k; 0 for w = 1.
    """

    ring: Ring
    base: Polynomial
    power: int
    weight: Polynomial
    decay: int

    @cached_property
    def jets(self) -> Jets:
        """P and W with their derivatives."""
        return Jets(self.ring, (self.base, self.weight))

    @property
    def numerators(self) -> tuple[Polynomial, ...]:
        """P W dG/dx_i: polynomials; with k = 0, dP/dx_i."""
        P, W = self.base, self.weight
        names = self.ring.variables
        if self.decay == 0:
            return tuple(P.derivative(x) for x in names)
        return tuple(
            self.power * W * P.derivative(x) - self.decay * P * W.derivative(x)
            for x in names
        )

    def value(self, box: Sequence[arb]) -> arb | None:
        """An enclosure of G over ``box``, None when P may vanish there."""
        P, W = self.jets.values(box)
        if not (P > 0 or P < 0):
            return None
        return self.power * abs(P).log() - self.decay * W.log()

    def derivatives(self, jets: tuple[Table, Table, Table]) -> tuple[Table, Table]:
        """Gradient and Hessian of G in R^n from the jets of (P, W)."""
        (P, W), (dP, dW), (ddP, ddW) = jets
        dP, dW = dP / P, dW / W
        gradient = self.power * dP - self.decay * dW
        hessian = self.power * (ddP / P - dP[:, None] * dP[None, :])
        return gradient, hessian - self.decay * (ddW / W - dW[:, None] * dW[None, :])


def plain_height(ring: Ring, minors: Sequence[Polynomial]) -> Height:
    """G = log h^2, without a weight.

    Raises:
        DegenerateMapError: no minors.
    """
    if not minors:
        raise DegenerateMapError("all minors of jac(f, R) vanish identically")
    if len(minors) == 1:
        return Height(ring, minors[0], 2, ring.constant(1), 0)
    squares = ring.total(minor * minor for minor in minors)
    return Height(ring, squares, 1, ring.constant(1), 0)


def heights(
    variety: PolynomialSystem, minors: Sequence[Polynomial], seed: int
) -> Iterator[Height]:
    """Heights to try, the simplest first; every {G >= c} is compact on V.

    Without weight when V is visibly bounded; then with random centres a.
    """
    ring = variety.ring
    plain = plain_height(ring, minors)
    bounded = is_visibly_bounded(variety)
    if bounded:
        yield plain
    decay = 1 if bounded else int(plain.power * plain.base.total_degree()) // 2 + 1
    for number in range(seed, seed + _WEIGHTS):
        yield replace(plain, weight=_weight(ring, number), decay=decay)


def critical_system(
    variety: PolynomialSystem, dimension: int, height: Height
) -> PolynomialSystem:
    """V cut by the equations of the critical points of G on it.

    Args:
        variety: V = {f = 0}.
        dimension: d, that of V.
        height: G.

    Guarantee: where jac f has rank n - d and P W != 0, exactly the critical points.
    """
    ring = variety.ring
    gradient = dict(zip(ring.variables, height.numerators, strict=True))
    equations = list(variety.equations)
    for names, own, rank in _blocks(variety, dimension):
        rows = [[f.derivative(x) for x in names] for f in own]
        last = [gradient[x] for x in names]
        for chosen in combinations(rows, rank):
            for columns in combinations(range(len(names)), rank + 1):
                check_time("critical_system")
                matrix = [[row[j] for j in columns] for row in (*chosen, last)]
                equations.append(determinant(ring, matrix))
    return PolynomialSystem(ring, tuple(e for e in equations if e != 0))


def is_visibly_bounded(variety: PolynomialSystem) -> bool:
    """Whether the leading forms of the equations show that V is bounded.

    Sufficient, not necessary. Where some variables are bounded already, an equation
    bounds its others if its part of highest degree in them has constant coefficients
    and is zero only at 0: a power of one variable, or a sum of even monomials with
    positive coefficients, a pure power of each among them.

    >>> ring = Ring(["c", "s", "x"])
    >>> c, s, x = ring.gens
    >>> is_visibly_bounded(PolynomialSystem(ring, (c**2 + s**2 - 1,)))
    False
    >>> is_visibly_bounded(PolynomialSystem(ring, (c**2 + s**2 - 1, c * x - s)))
    False
    >>> is_visibly_bounded(PolynomialSystem(ring, (c**2 + s**2 - 1, x - c * s)))
    True
    """
    ring, bounded = variety.ring, set[str]()
    while True:
        shown = {
            name
            for equation in variety.equations
            for name in _newly_bounded(ring, equation, bounded)
        }
        if not shown:
            return bounded == set(ring.variables)
        bounded |= shown


def _newly_bounded(ring: Ring, equation: Polynomial, bounded: set[str]) -> list[str]:
    """The variables that ``equation`` bounds when those of ``bounded`` are."""
    names = [x for x in _names(ring, equation) if x not in bounded]
    if not names or (ring.radicand and equation.degrees()[-1] > 0):
        return []
    places = [ring.variables.index(x) for x in names]
    terms = [(tuple(map(int, e)), c) for e, c in equation.to_dict().items()]
    degree = max(sum(e[i] for i in places) for e, _ in terms)
    top = {e: c for e, c in terms if sum(e[i] for i in places) == degree}
    if any(sum(e) > degree for e in top):
        return []
    pure = {e.index(degree) for e in top if degree in e} == set(places)
    even = all(exponent % 2 == 0 for e in top for exponent in e)
    definite = even and len({c > 0 for c in top.values()}) == 1
    return names if pure and (definite or len(names) == 1) else []


def _weight(ring: Ring, seed: int) -> Polynomial:
    """1 + |x - a|^2 with a random centre, a_i in tenths between -1 and 1."""
    chance = random.Random(seed)
    centre = [fmpq(chance.randint(-10, 10), 10) for _ in ring.variables]
    moved = [x - a for x, a in zip(ring.gens, centre, strict=True)]
    return ring.total(x * x for x in moved) + 1


def _blocks(
    variety: PolynomialSystem, dimension: int
) -> Iterator[tuple[list[str], list[Polynomial], int]]:
    """Variables, equations and rank of jac f of each block; one block if s > n - d."""
    ring, equations = variety.ring, variety.equations
    rank = len(ring.variables) - dimension
    if len(equations) > rank:
        yield list(ring.variables), list(equations), rank
        return
    graph: nx.Graph[str | int] = nx.Graph()
    graph.add_nodes_from(ring.variables)
    for number, equation in enumerate(equations):
        graph.add_edges_from((number, name) for name in _names(ring, equation))
    for part in nx.connected_components(graph):
        names = [name for name in ring.variables if name in part]
        own = [f for i, f in enumerate(equations) if i in part]
        yield names, own, len(own)


def _names(ring: Ring, polynomial: Polynomial) -> set[str]:
    degrees = zip(ring.variables, polynomial.degrees(), strict=False)
    return {name for name, degree in degrees if degree > 0}
