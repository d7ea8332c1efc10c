from __future__ import annotations

import numpy as np
import pytest
from surfaces import Array, arm_map, cylinder, decided, delta_of, plane

from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.count import Count
from cuspaudit.surface.nodes import nodes

Pair = tuple[PolynomialSystem, PolynomialMap]


def count(pair: Pair) -> Count:
    """The nodes of a map."""
    decision = decided(pair)
    return nodes(decision.fibers, decision.roadmap, pair[1])


ARMS = [
    # a, d, alpha, nodes: the workspace types of Baili, Wenger, Chablat 2004
    ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0), 0),
    ((1, "3/2", "7/10"), (0, "1/2", 0), (-90, 90, 0), 2),
    ((1, 3, 4), (0, 3, 0), (-90, 90, 0), 1),
    ((1, ".5", "1.3"), (0, ".2", 0), (-90, 90, 0), 2),
    ((1, ".5", ".8"), (0, ".2", 0), (-90, 90, 0), 0),
]
GENERAL = [
    ((1, "1.3", ".9"), (0, ".4", "-.7"), (70, 110, 0)),
    ((1, "3/2", 1), (0, 1, "1/2"), (45, -45, 0)),
    ((1, ".7", "1.6"), (0, ".3", ".4"), (-60, 60, 0)),
    ((1, "1.2", "1.9"), (0, "-.6", ".3"), (100, 65, 0)),
]


@pytest.mark.parametrize(("a", "d", "alpha", "wanted"), ARMS)
def test_published_arms(
    a: tuple[int, ...], d: tuple[int, ...], alpha: tuple[int, ...], wanted: int
) -> None:
    """The nodes of the workspace types."""
    assert count(arm_map(a, d, alpha)) == Count(wanted, True)


def critical_polylines(pair: Pair, size: int = 3001) -> list[Array]:
    """The curve of critical values, walked in theta3 on both branches."""
    variety, mapping = pair
    delta = delta_of(pair)
    theta3 = np.linspace(-np.pi, np.pi, size)

    def at(theta2: Array, polynomials: object) -> Array:
        columns = (np.cos(theta2), np.sin(theta2), np.cos(theta3), np.sin(theta3))
        return numeric_values(variety.ring, polynomials, np.stack(columns, axis=1))

    ahead, back, side = (
        at(np.full(size, t), [delta])[:, 0] for t in (0.0, np.pi, np.pi / 2)
    )
    P, S = (ahead - back) / 2, (ahead + back) / 2
    Q = side - S
    with np.errstate(invalid="ignore"):
        turn = np.arccos(-S / np.hypot(P, Q))
    upper, lower = (
        at(np.arctan2(Q, P) + k * turn, mapping.components) for k in (1, -1)
    )
    real = np.isfinite(turn)
    if real.all():
        return [upper, lower]
    # start in a gap; each stretch without gap is a closed curve, up and back
    start = int(np.argmin(real))
    upper, lower, real = (np.roll(x[:-1], -start, axis=0) for x in (upper, lower, real))
    loops = []
    for stretch in np.split(np.arange(len(real)), np.flatnonzero(~real)):
        inside = stretch[real[stretch]]
        if len(inside):
            loop = np.vstack([upper[inside], lower[inside][::-1]])
            loops.append(np.vstack([loop, loop[:1]]))
    return loops


def crossings(lines: list[Array]) -> int:
    """The proper crossings of the segments of polylines."""
    starts = np.vstack([line[:-1] for line in lines])
    ends = np.vstack([line[1:] for line in lines])
    keep = np.isfinite(starts).all(axis=1) & np.isfinite(ends).all(axis=1)
    starts, ends = starts[keep], ends[keep]
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    found: list[Array] = []
    for i in range(len(starts)):
        near = np.flatnonzero(
            (low[i + 1 :] <= high[i]).all(axis=1)
            & (high[i + 1 :] >= low[i]).all(axis=1)
        )
        for j in near + i + 1:
            p, r = starts[i], ends[i] - starts[i]
            q, s = starts[j], ends[j] - starts[j]
            cross = r[0] * s[1] - r[1] * s[0]
            if abs(cross) < 1e-18:
                continue
            t = ((q - p)[0] * s[1] - (q - p)[1] * s[0]) / cross
            w = ((q - p)[0] * r[1] - (q - p)[1] * r[0]) / cross
            if 0 < t < 1 and 0 < w < 1:
                place = p + t * r
                if all(np.abs(place - other).max() > 1e-3 for other in found):
                    found.append(place)
    return len(found)


@pytest.mark.parametrize("table", GENERAL)
def test_general_arms_by_walking_the_curve(
    table: tuple[tuple[int, ...], ...],
) -> None:
    """The proved count is that of crossings of the curve drawn in small steps."""
    pair = arm_map(*table)
    found = count(pair)
    assert found.proved
    assert found.count == crossings(critical_polylines(pair))


def test_few_postures_have_no_node() -> None:
    """Below degree 4 no value has two double postures."""
    assert count(plane(lambda x, y: (x**3 + x * y, y))) == Count(0, True)


def test_outside_the_generic_case_nothing_is_proved() -> None:
    """A quartic on a line, or in the other coordinate, is counted without proof."""
    line = count(plane(lambda x, y: (x**4 - x**2 + x * y, y)))
    assert line == Count(0, False)
    planar = arm_map((0, "1/2", 1), (0, 1, "1/2"), (-90, 90, 0))
    assert decided(planar).fibers.separating == "y"
    assert count(planar).proved is False


def test_a_wall_of_one_value_is_a_node_when_the_curve_crosses_it() -> None:
    """a3 > a2: the tip stands on axis 2 at two theta3; what meets there is counted."""
    pair = arm_map((1, 3, 4), (0, 3, 0), (-90, 90, 0))
    decision = decided(pair)
    assert len(decision.roadmap.walls) == 2
    assert nodes(decision.fibers, decision.roadmap, pair[1]).proved


def test_a_circle_of_values_at_a_wall_is_no_node() -> None:
    """A wall whose image is a curve has no value of its own."""
    pair = cylinder(lambda c, s, q: (c * (q**2 + 1), s * (q**2 + 1)))
    assert count(pair).count == 0
