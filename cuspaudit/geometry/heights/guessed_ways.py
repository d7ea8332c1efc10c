"""Ways between points of V - {Delta = 0}, guessed in floating point, never proved here.

From either point the height is climbed to a maximum. Points that reach the same one are
joined there; others over saddles, met by Newton's method from random points of V and
left on both sides uphill. What comes out is a list of way points for
``heights.proved_path``, which alone decides.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice, pairwise

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.evaluation import Jets
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.heights.ascent import climb
from cuspaudit.geometry.heights.charted_height import ChartedHeight
from cuspaudit.runtime.clock import check_time

__all__ = ["GuessedWays", "random_points"]

Array = NDArray[np.float64]

_REACH = 0.5
_NEWTON = 40
_STARTS = 60
_FAILURES = 50
_CLOSE = 1e-5
_OFF = 0.05
_LONGEST = 0.5


def random_points(
    variety: PolynomialSystem, seed: int, also: Sequence[Polynomial] = ()
) -> Iterator[Array]:
    """Points close to V: Gauss and Newton from random places.

    There is no end of them, unless fifty places in a row lead nowhere.

    Args:
        variety: V = {f = 0}.
        seed: of the places, normally distributed with deviations 1/2 to 4.
        also: polynomials to be small as well; with Delta, points near its zeros.
    """
    chance = np.random.default_rng(seed)
    equations = (*variety.equations, *also)
    jets = Jets(variety.ring, equations)
    size = len(variety.ring.variables)
    failed = 0
    while failed < _FAILURES:
        point = chance.normal(size=size) * 2.0 ** chance.integers(-1, 3)
        found = point if not equations else _landed(jets, point)
        failed = failed + 1 if found is None else 0
        if found is not None:
            yield found


def _landed(jets: Jets, point: Array) -> Array | None:
    for _ in range(_NEWTON):
        check_time("random_points")
        f, J, _ = jets.floats(point)
        if not np.isfinite(J).all() or np.abs(point).max() > 1e3:
            return None
        step = np.linalg.lstsq(J, f, rcond=1e-9)[0]
        point = point - step
        if np.abs(step).max() < 1e-12 * (1 + np.abs(point).max()):
            return point
    return None


@dataclass(eq=False)
class GuessedWays:
    """What is known of the maxima and saddles of a height.

    Attributes:
        landscape: V and G.
        seed: of every random choice.
        tops: the maxima met.
        graph: a vertex for each of them, by number; an edge where a saddle was met
            between two, with its ``level`` and the way points from the first.
    """

    landscape: ChartedHeight
    seed: int = 1
    tops: list[Array] = field(default_factory=list)
    graph: nx.Graph[int] = field(default_factory=nx.Graph)

    def climbed(self, start: Array) -> tuple[int, Array] | None:
        """The number of the maximum over ``start`` and way points to it, or None."""
        chance = np.random.default_rng(self.seed)
        try:
            with np.errstate(all="ignore"):
                places, at_top = climb(self.landscape, start, _REACH, chance)
        except np.linalg.LinAlgError:
            return None
        if not at_top:
            return None
        for number, top in enumerate(self.tops):
            if np.abs(top - places[-1]).max() < _CLOSE * (1 + np.abs(top).max()):
                return number, places
        self.tops.append(places[-1])
        self.graph.add_node(len(self.tops) - 1)
        return len(self.tops) - 1, places

    def join(self, points: Iterator[Array]) -> None:
        """Enter the saddles met from the next sixty of ``points``."""
        with np.errstate(all="ignore"):
            for start in islice(points, _STARTS):
                place = self._critical(start)
                if place is not None:
                    self._enter(place)

    def between(self, first: int, second: int) -> Array | None:
        """Way points from one maximum to another over high saddles, or None."""
        if first == second:
            return self.tops[first][None, :]
        if not nx.has_path(self.graph, first, second):
            return None
        tree = nx.maximum_spanning_tree(self.graph, weight="level")
        ways = [self.tops[first][None, :]]
        for u, v in pairwise(nx.shortest_path(tree, first, second)):
            begins, places = self.graph.edges[u, v]["way"]
            ways.append(places if begins == u else places[::-1])
        return np.concatenate(ways)

    def _critical(self, start: Array) -> Array | None:
        """A critical point of G with one positive eigenvalue, by Newton, or None."""
        point = start
        for _ in range(_NEWTON):
            try:
                tangent = self.landscape.tangent(point)
                gradient, hessian = self.landscape.slopes(tangent, point)
                step = -np.linalg.solve(hessian, gradient)
            except np.linalg.LinAlgError:
                return None
            size = float(np.abs(step).max())
            if not np.isfinite(step).all():
                return None
            step *= min(1.0, _LONGEST / max(size, 1e-300))
            moved = self.landscape.retract(tangent, point + step @ tangent.forms.matrix)
            if moved is None:
                return None
            point = moved
            if size < 1e-9:
                rising = int((np.linalg.eigvalsh(hessian) > 0).sum())
                return point if rising == 1 else None
        return None

    def _enter(self, place: Array) -> None:
        tangent = self.landscape.tangent(place)
        _, hessian = self.landscape.slopes(tangent, place)
        values, vectors = np.linalg.eigh(hessian)
        step = _OFF / np.sqrt(values[-1]) * vectors[:, -1] @ tangent.forms.matrix
        sides = []
        for sign in (1, -1):
            moved = self.landscape.retract(tangent, place + sign * step)
            side = None if moved is None else self.climbed(moved)
            if side is None:
                return
            sides.append(side)
        (a, down), (b, up) = sides
        level = self.landscape.value_at(place)
        known = self.graph.get_edge_data(a, b, {"level": -np.inf})
        if a != b and level > known["level"]:
            places = np.concatenate([down[::-1], place[None, :], up])
            self.graph.add_edge(a, b, level=level, way=(a, places))
