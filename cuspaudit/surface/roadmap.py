"""Roadmap of the complement of the critical curve on a surface (``SurfaceRoadmap``).

On V = fiber x base the function Delta is affine in the variables of the fiber:
Delta = P c + Q s + S on a circle, P q + S on a line, with P, Q, S functions on the
base. (For a chain of three joints whose second is revolute this is a theorem: seen from
the link after it, only the column of the first joint depends on the second, and that
affinely.) So over a point x of the base the set {Delta > 0} is empty, one arc or the
whole fiber, and likewise {Delta < 0}; what it is changes only at the real zeros of

    D = P^2 + Q^2 - S^2  (circle),    D = P^2  (line).

Over a zero of D with S != 0 one arc, of the sign of S, reaches from one side to the
other; with S = 0 the whole fiber is critical and nothing passes. The components of
{Delta != 0} are then known from signs at one rational point between neighbouring
zeros of D. As curves: the silhouette (in every fiber the point of each arc where
|Delta| is largest, which runs without a break through the arcs over a zero of D that
pass), and the fibers through query points, along which a point reaches the silhouette.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from flint import arb, fmpq

from cuspaudit.algebra.rationals import rationals_between
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.univariate import (
    RealRoot,
    Univariate,
    disjoint_balls,
    real_roots,
)
from cuspaudit.errors import RetryableError, UnableError
from cuspaudit.surface.surface import ROTATIONS, Surface

__all__ = ["Strip", "SurfaceRoadmap", "orient", "roadmap"]


@dataclass(frozen=True)
class Strip:
    """The part of V over an open interval of the base without zeros of D.

    Attributes:
        sample: a rational point of the interval, in the chart of the base.
        signs: the signs Delta takes; one arc of each over every point.
    """

    sample: fmpq
    signs: tuple[int, ...]


@dataclass(frozen=True)
class SurfaceRoadmap:
    """The connectivity of {Delta != 0} along the base.

    Attributes:
        surface: V with the chart in which everything is written.
        parts: numerators of P, Q, S (or P, S) in the chart of the base, over one
            positive denominator.
        change: the numerator of D.
        critical: the zeros of D, increasing.
        passing: for each zero, the sign of Delta that passes over it; 0 for none.
        strips: between them: strip i lies left of zero i, the last one right of all;
            on a circle the first and the last are two halves of one.
    """

    surface: Surface
    parts: tuple[Univariate, ...]
    change: Univariate
    critical: tuple[RealRoot, ...]
    passing: tuple[int, ...]
    strips: tuple[Strip, ...]

    @property
    def is_closed(self) -> bool:
        """Whether the base is a circle."""
        return self.surface.base.kind == "circle"

    @property
    def walls(self) -> dict[int, RealRoot]:
        """The zeros of D, by number, over which Delta vanishes on the whole fiber."""
        return {
            index: root
            for index, (root, sign) in enumerate(
                zip(self.critical, self.passing, strict=True)
            )
            if sign == 0 and all(part.sign_at(root) == 0 for part in self.parts)
        }

    def strip_of(self, x: arb, bits: int) -> int | None:
        """The strip of a point of the base, or None when ``x`` is too wide."""
        for index, root in enumerate(self.critical):
            ball = root.enclosure(bits)
            if x < ball:
                return index
            if not x > ball:
                return None
        return len(self.critical)


def orient(surface: Surface, delta: Polynomial) -> Surface:
    """Choose fiber and base, and a chart of the base that misses no zero of D.

    Raises:
        UnableError: Delta is affine in neither factor.
    """
    for fiber, base in (
        (surface.fiber, surface.base),
        (surface.base, surface.fiber),
    ):
        candidate = Surface(surface.ring, fiber, base)
        if candidate.affine_parts(delta) is None:
            continue
        return _choose_chart(candidate, delta)
    raise UnableError("roadmap", "Delta is affine in neither factor of V")


def roadmap(surface: Surface, delta: Polynomial) -> SurfaceRoadmap:
    """The roadmap of V - {Delta = 0}, in the chart of ``surface``.

    [Paper, routine Roadmap, for a surface and Delta affine along the fiber].

    Args:
        surface: as returned by ``orient``.
        delta: the determinant, not identically zero on V.

    Guarantee: exact. Every zero of D is isolated and the sign of S there is exact.
    """
    function, tells_both = _change(surface, delta)
    ring = surface.chart_ring
    change = Univariate.from_polynomial(ring, surface.chart(function)[0], "x")
    numerators, _ = surface.on_base(surface.affine_parts(delta) or ())
    parts = tuple(Univariate.from_polynomial(ring, n, "x") for n in numerators)
    critical = real_roots(change)
    balls = disjoint_balls(critical)
    strips = []
    for low, high in zip([None, *balls], [*balls, None], strict=True):
        sample = next(rationals_between(low, high))
        if tells_both and change.sign(sample) > 0:
            strips.append(Strip(sample, (1, -1)))
        else:
            strips.append(Strip(sample, (parts[-1].sign(sample),)))
    passing = tuple(parts[-1].sign_at(root) for root in critical)
    return SurfaceRoadmap(
        surface, parts, change, tuple(critical), passing, tuple(strips)
    )


def _choose_chart(surface: Surface, delta: Polynomial) -> Surface:
    if surface.base.kind == "line":
        return surface
    for rotation in ROTATIONS:
        base = replace(surface.base, rotation=rotation)
        candidate = replace(surface, base=base)
        numerator, denominator = candidate.chart(_change(candidate, delta)[0])
        if _degree(candidate, numerator) == _degree(candidate, denominator):
            return candidate
    raise RetryableError("every chart of the base misses a zero of D")


def _degree(surface: Surface, polynomial: Polynomial) -> int:
    position = surface.chart_ring.context.variable_to_index("x")
    return int(polynomial.degrees()[position])


def _change(surface: Surface, delta: Polynomial) -> tuple[Polynomial, bool]:
    """(D, True), or (S, False) when D vanishes identically; in the ring of V."""
    parts = surface.affine_parts(delta) or ()
    squares = [part * part for part in parts]
    if surface.fiber.kind == "line":
        change = surface.reduce(squares[0])
    else:
        change = surface.reduce(squares[0] + squares[1] - squares[2])
    return (change, True) if change != 0 else (parts[-1], False)
