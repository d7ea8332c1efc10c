"""Algorithm 1 of the paper, for a map from a surface to the plane."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from flint import fmpq, fmpq_poly

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.algebra.univariate import RealRoot, Univariate
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.sample_points_rational import sample_points_rational
from cuspaudit.surface.atypical_values import atypical_values
from cuspaudit.surface.fibers import FiberPolynomials, fiber_polynomials
from cuspaudit.surface.graph_isotop import RoadmapGraph, graph_isotop
from cuspaudit.surface.roadmap import SurfaceRoadmap, orient, roadmap
from cuspaudit.surface.sample_points import Fiber, FiberPosture, sample_points
from cuspaudit.surface.surface import Surface, product_factors

__all__ = [
    "SurfaceCouple",
    "SurfaceDecision",
    "decide_surface",
    "generic_values",
    "oriented",
]


@dataclass(frozen=True, eq=False)
class SurfaceCouple:
    """Two postures of one value in one aspect: a cuspidal couple.

    Attributes:
        value: the value (u, v) of the map at both.
        postures: the two postures.
        sign: the sign of Delta in their aspect.
    """

    value: tuple[fmpq, fmpq]
    postures: tuple[FiberPosture, FiberPosture]
    sign: int


@dataclass(frozen=True, eq=False)
class SurfaceDecision:
    """What Algorithm 1 found, step by step.

    Attributes:
        verdict: CUSPIDAL if there is a couple, else NONCUSPIDAL.
        delta: det jac(f, R), reduced on V.
        fibers: the fiber polynomials of R.
        atypical: polynomials g in K[u, v] with the atypical values among their zeros.
        samples: the fiber of one rational value, at least, in every cell.
        roadmap: the roadmap of V - {Delta = 0}.
        graph: its graph, with every posture of ``samples`` placed.
        couples: all couples among ``samples``.
    """

    verdict: Verdict
    delta: Polynomial
    fibers: FiberPolynomials
    atypical: list[Polynomial]
    samples: list[Fiber]
    roadmap: SurfaceRoadmap
    graph: RoadmapGraph
    couples: list[SurfaceCouple]

    @property
    def surface(self) -> Surface:
        """V with its charts."""
        return self.fibers.surface

    @property
    def aspects(self) -> int:
        """The number of connected components of V - {Delta = 0}, proved."""
        return self.graph.number_of_aspects

    @property
    def max_postures(self) -> int:
        """The largest number of postures over a regular value, proved."""
        return max(len(fiber.postures) for fiber in self.samples)


def decide_surface(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    progress: Callable[[str], None] = lambda step: None,
) -> SurfaceDecision:
    """Decide whether the restriction of R to V_R is cuspidal.

    [Paper, Algorithm 1], for V a product of two circles or lines, R to the plane and
    Delta affine along one factor. Exact: the verdict follows from Proposition 10 of
    the paper, with assumption (A) true of such V.

    Args:
        variety: V = {f = 0}.
        mapping: R = (r_1, r_2).
        progress: called with the name of each step before it runs.

    Raises:
        DegenerateMapError: Delta vanishes identically on V.
        UnableError: V, R or Delta is outside what this engine handles.
    """
    progress("crit")
    surface, delta = oriented(variety, mapping)
    progress("atypical_values")
    fibers = fiber_polynomials(surface, mapping)
    atypical = atypical_values(fibers)
    progress("roadmap")
    road = roadmap(surface, delta)
    progress("sample_points_rational")
    values = sample_points_rational(
        fibers.ring, atypical, ("u", "v"), generic_values(fibers, road.critical)
    )
    progress("sample_points")
    samples = [sample_points(fibers, (u, v)) for u, v in values]
    progress("graph_isotop")
    postures = [posture for fiber in samples for posture in fiber.postures]
    graph = graph_isotop(road, delta, postures)
    couples = list(_couples(graph, samples))
    verdict = Verdict.CUSPIDAL if couples else Verdict.NONCUSPIDAL
    return SurfaceDecision(
        verdict, delta, fibers, atypical, samples, road, graph, couples
    )


def oriented(
    variety: PolynomialSystem, mapping: PolynomialMap
) -> tuple[Surface, Polynomial]:
    """V with its charts, Delta affine along the fiber; and Delta, reduced on V.

    Raises:
        DegenerateMapError: Delta vanishes identically on V.
        UnableError: V is no product of two factors, R no map to the plane, or Delta
            affine along neither factor.
    """
    if len(mapping.components) != 2:
        raise UnableError("decide_surface", "this engine decides maps to the plane")
    surface = Surface(variety.ring, *product_factors(variety))
    minors = [surface.reduce(minor) for minor in crit(variety, mapping)]
    delta = minors[0] if minors else variety.ring.constant(0)
    if delta == 0:
        raise DegenerateMapError(
            "det J vanishes at every posture: the map never has full rank"
        )
    return orient(surface, delta), delta


def _couples(graph: RoadmapGraph, samples: list[Fiber]) -> Iterator[SurfaceCouple]:
    for fiber in samples:
        placed = zip(fiber.postures, graph.vert(fiber), strict=True)
        for (a, vertex_a), (b, vertex_b) in combinations(placed, 2):
            if graph.connected(vertex_a, vertex_b):
                yield SurfaceCouple(fiber.value, (a, b), vertex_a[1])


def generic_values(
    fibers: FiberPolynomials, lines: Sequence[RealRoot]
) -> Callable[[tuple[fmpq, ...]], bool]:
    """True for values whose postures all lie in the charts and over none of ``lines``.

    The second coordinate of each follows from its linear equation s_1 t + s_0 = 0.
    """
    ring = fibers.ring
    gap, slope = fibers.chart_gap(), fibers.linear_factor[0]
    polynomial = fibers.polynomial
    along_base = polynomial if fibers.separating == "x" else fibers.eliminant("x")

    def accept(value: tuple[fmpq, ...]) -> bool:
        at = dict(zip(("u", "v"), value, strict=True))
        if ring.substitute(gap, at) == 0:
            return False
        own, linear = (special(p, at, fibers.separating) for p in (polynomial, slope))
        if own.gcd(linear).degree() > 0:
            return False
        postures = special(along_base, at, "x").numer()
        return all(postures.gcd(root.polynomial).degree() == 0 for root in lines)

    def special(p: Polynomial, at: dict[str, fmpq], name: str) -> fmpq_poly:
        return Univariate.from_polynomial(ring, ring.substitute(p, at), name).norm

    return accept
