"""Maps on products of circles and lines, and numeric second routes, for tests."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from short_tables import Number, arm

from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import SurfaceDecision, decide_surface
from cuspaudit.geometry.crit import crit
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.surface.roadmap import SurfaceRoadmap, orient, roadmap
from cuspaudit.surface.surface import Surface, product_factors

Array = NDArray[np.float64]
Build = Callable[..., tuple[Polynomial, ...]]


def plane(
    build: Build, radicand: int | None = None
) -> tuple[PolynomialSystem, PolynomialMap]:
    """The map (x, y) -> build(x, y) on R^2."""
    ring = Ring(["x", "y"], radicand)
    return PolynomialSystem(ring), PolynomialMap(ring, build(*ring.gens))


def torus(
    build: Build, radicand: int | None = None
) -> tuple[PolynomialSystem, PolynomialMap]:
    """The map build(c2, s2, c3, s3) on two circles."""
    ring = Ring(["c2", "s2", "c3", "s3"], radicand)
    c2, s2, c3, s3 = ring.gens
    circles = (c2**2 + s2**2 - 1, c3**2 + s3**2 - 1)
    return PolynomialSystem(ring, circles), PolynomialMap(ring, build(*ring.gens))


def cylinder(build: Build) -> tuple[PolynomialSystem, PolynomialMap]:
    """The map build(c, s, q) on a circle and a line."""
    ring = Ring(["c", "s", "q"])
    c, s, _ = ring.gens
    return (
        PolynomialSystem(ring, (c**2 + s**2 - 1,)),
        PolynomialMap(ring, build(*ring.gens)),
    )


def road_of(variety: PolynomialSystem, delta: Polynomial) -> SurfaceRoadmap:
    """The roadmap of {delta != 0} on a product of circles and lines."""
    surface = Surface(variety.ring, *product_factors(variety))
    reduced = surface.reduce(delta)
    return roadmap(orient(surface, reduced), reduced)


def arm_map(
    a: tuple[Number, ...],
    d: tuple[Number, ...],
    alpha: tuple[Number, ...],
    kinds: str = "",
) -> tuple[PolynomialSystem, PolynomialMap]:
    """The reduced map of a three-joint arm."""
    return reduced_map(exact_model(arm(a, d, alpha, kinds)))


def decided(pair: tuple[PolynomialSystem, PolynomialMap]) -> SurfaceDecision:
    """The decision for a map."""
    return decide_surface(*pair)


def delta_of(pair: tuple[PolynomialSystem, PolynomialMap]) -> Polynomial:
    """The determinant det jac(f, R)."""
    return crit(*pair)[0]


def flood_fill(variety: PolynomialSystem, delta: Polynomial, size: int = 250) -> int:
    """The components of {delta != 0} on the torus, by a grid (right if generic)."""
    # an irrational shift, so that no symmetry puts a zero on the grid
    angles = np.linspace(-np.pi, np.pi, size, endpoint=False) + 0.0123456
    first, second = (a.ravel() for a in np.meshgrid(angles, angles, indexing="ij"))
    columns = (np.cos(first), np.sin(first), np.cos(second), np.sin(second))
    values = numeric_values(variety.ring, [delta], np.stack(columns, axis=1))
    signs = np.sign(values[:, 0]).astype(int).reshape(size, size)
    return len(np.unique(labels(signs, around=True)))


def labels(signs: NDArray[np.int_], around: bool) -> NDArray[np.int_]:
    """A number for each connected piece of equal signs on a grid, closed up or not."""
    rows, columns = signs.shape
    sign = signs.ravel().tolist()
    label = [-1] * len(sign)
    for start in range(len(sign)):
        if label[start] >= 0:
            continue
        label[start], stack = start, [start]
        while stack:
            i, j = divmod(stack.pop(), columns)
            for k, m in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                inside = 0 <= k < rows and 0 <= m < columns
                if not (inside or around):
                    continue
                at = k % rows * columns + m % columns
                if label[at] < 0 and sign[at] == sign[start]:
                    label[at] = start
                    stack.append(at)
    return np.array(label).reshape(signs.shape)
