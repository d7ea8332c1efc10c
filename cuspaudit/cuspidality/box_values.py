"""Within joint limits by sample values: the second route.

Let the plane of values be cut by the atypical values of R (its critical ones among
them) and by the images of the limits: R at the limits of the fiber, over all of the
base, and R over the limits of the base. While a value moves in a cell of what is left,
the postures over it move without a break, none over a zero of Delta, none through a
limit. So each of their windings in the box stays in its aspect, and R is cuspidal
within the box if and only if two postures over one of the sample values, one in every
cell, have windings in one aspect. [Paper, Proposition 10, with limits]

The cells of pairs (`cuspidality.box_decision`) and these share no polynomial, and this
route handles a second joint that slides. What joint 1 must do between two postures is
no function of the value, so its limits are not looked at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import combinations

from flint import arb, ctx

from cuspaudit.algebra.elimination import resultant
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.count import Count
from cuspaudit.cuspidality.box_decision import Winding
from cuspaudit.cuspidality.surface_decision import generic_values, oriented
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.geometry.sample_points_rational import sample_points_rational
from cuspaudit.surface.atypical_values import atypical_values
from cuspaudit.surface.box_aspects import (
    Box,
    BoxAspects,
    Ranges,
    box_aspects,
    charted_box,
    of_factors,
)
from cuspaudit.surface.box_edges import start_of
from cuspaudit.surface.box_stability import count_between
from cuspaudit.surface.fiber_pieces import AtBall
from cuspaudit.surface.fibers import FiberPolynomials, fiber_polynomials
from cuspaudit.surface.sample_points import FiberPosture, sample_points
from cuspaudit.surface.surface import Surface

__all__ = ["ValueCouple", "ValuesDecision", "decide_box_by_values"]


@dataclass(frozen=True, eq=False)
class ValueCouple:
    """Two postures of one value with windings in one aspect of the box.

    Attributes:
        postures: over one sample value.
        windings: one of each.
        sign: of Delta.
    """

    postures: tuple[FiberPosture, FiberPosture]
    windings: tuple[Winding, Winding]
    sign: int


@dataclass(frozen=True, eq=False)
class ValuesDecision:
    """What the sample values say of a box.

    Attributes:
        verdict: as `BoxDecision.verdict`.
        surface: V with the charts of the box.
        delta: det jac(f, R), reduced on V.
        found: the aspects of the box that decided.
        aspects: of the box between the longer and the shorter one.
        samples: how many values were looked at.
        couples: those that decided; empty unless CUSPIDAL.
    """

    verdict: Verdict
    surface: Surface
    delta: Polynomial
    found: BoxAspects
    aspects: Count
    samples: int
    couples: list[ValueCouple]


def decide_box_by_values(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    ranges: Ranges,
    progress: Callable[[str], None] = lambda step: None,
) -> ValuesDecision:
    """Decide whether R is cuspidal within limits of its own two factors.

    Args:
        variety: V = {f = 0}, a product of two circles or lines.
        mapping: R = (r_1, r_2).
        ranges: of the two factors of V, in the order of its ring; None for no limits.
        progress: called with the name of each step before it runs.

    Raises:
        DegenerateMapError: Delta vanishes identically on V.
        UnableError: V, R or Delta is outside what this route handles.
        RetryableError: a chart or the place of a posture could not be told.
    """
    progress("limits: aspects")
    surface, delta = oriented(variety, mapping)
    ranges = of_factors(surface, ranges)
    surface, outer, inner = charted_box(surface, delta, ranges)
    wide = box_aspects(surface, delta, outer)
    narrow = None if inner is None else box_aspects(surface, delta, inner)
    aspects = count_between(wide, narrow, ranges)
    progress("limits: sample values")
    fibers = fiber_polynomials(surface, mapping)
    values = _Values(fibers, atypical_values(fibers), surface.chart(delta)[0])
    verdict, deciding = Verdict.NONCUSPIDAL, wide
    samples, couples = values.ask(wide)
    if couples:
        verdict, couples = Verdict.UNDECIDED, []
        if narrow is not None:
            again = values.ask(narrow)
            if again[1]:
                verdict, deciding = Verdict.CUSPIDAL, narrow
                samples, couples = again
    return ValuesDecision(verdict, surface, delta, deciding, aspects, samples, couples)


@dataclass(frozen=True, eq=False)
class _Values:
    """The values of a map, to be asked of several boxes."""

    fibers: FiberPolynomials
    atypical: list[Polynomial]
    delta: Polynomial

    def ask(self, aspects: BoxAspects) -> tuple[int, list[ValueCouple]]:
        """The number of sample values, and the couples over them."""
        curves = [*self.atypical, *_images(self.fibers, aspects.box)]
        accept = generic_values(self.fibers, aspects.events)
        values = sample_points_rational(self.fibers.ring, curves, ("u", "v"), accept)
        couples = [
            couple
            for u, v in values
            for couple in self._couples(
                sample_points(self.fibers, (u, v)).postures, aspects
            )
        ]
        return len(values), couples

    def _couples(
        self, postures: tuple[FiberPosture, ...], aspects: BoxAspects
    ) -> Iterator[ValueCouple]:
        signs = {posture: posture.sign(self.delta) for posture in postures}
        places = {p: self._places(p, aspects, sign) for p, sign in signs.items()}
        for a, b in combinations(postures, 2):
            if signs[a] != signs[b]:
                continue
            for one in places[a]:
                for two in places[b]:
                    if aspects.aspects[one.place] == aspects.aspects[two.place]:
                        yield ValueCouple((a, b), (one, two), signs[a])

    def _places(
        self, posture: FiberPosture, aspects: BoxAspects, sign: int
    ) -> list[Winding]:
        fiber = self.fibers.surface.fiber

        def angle(bits: int) -> arb:
            y, saved = posture.chart(bits)[0], ctx.prec
            ctx.prec = bits
            try:
                return y if fiber.kind == "line" else start_of(fiber) + 2 * y.atan()
            finally:
                ctx.prec = saved

        at = AtBall(lambda bits: posture.chart(bits)[1])
        places = aspects.places(at, angle, sign)
        return [Winding(place, turns) for place, turns in places]


def _images(fibers: FiberPolynomials, box: Box) -> Iterator[Polynomial]:
    """Nonzero polynomials of K[u, v] that vanish on the images of the limits."""
    sides = [("y", "x", edge) for edge in box.fiber or ()]
    sides += [("x", "y", edge) for edge in box.base or ()]
    for fixed, free, edge in sides:
        first, second = (
            fibers.ring.substitute(equation, {fixed: edge.t})
            for equation in fibers.equations
        )
        image = resultant(fibers.ring, first, second, free)
        if image == 0:
            raise UnableError("limits", "the image of a joint limit was not found")
        yield image
