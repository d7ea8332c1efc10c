"""What a figure is drawn from: plain numbers, sampled by ``pictures``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Array",
    "Aspect",
    "Figures",
    "JointPlane",
    "Landscape",
    "Leaf",
    "Slice",
    "ValuePlane",
    "Window",
]

Array = NDArray[np.float64]

Window = tuple[float, float, float, float]
"""(left, right, bottom, top) of a drawing."""


@dataclass(frozen=True, eq=False)
class ValuePlane:
    """The plane of values, sampled; lengths in the arm's unit.

    Attributes:
        labels: of the two axes, with units.
        window: (left, right, bottom, top) of the drawing.
        curve: (m, 2) polylines of critical values, one a smooth piece.
        points: (k, 2) critical values that are the whole image of a critical fiber.
        cusps: (k, 2), as many as are proved.
        nodes: (k, 2), as many as are proved; none when their number is not.
        samples: (k, 2) rational values, one at least in every cell of the plane.
        sample_postures: (k,) the proved number of postures of each.
        focus: (2,) the value whose postures are drawn in the plane of joints.
        grid: (rows from the bottom, columns) number of postures, in floating point.
        beyond: how many of ``samples`` lie outside the window.
        limits: (m, 2) polylines: the images of the limits of joints 2 and 3.
    """

    labels: tuple[str, str]
    window: Window
    curve: tuple[Array, ...]
    points: Array
    cusps: Array
    nodes: Array
    samples: Array
    sample_postures: NDArray[np.int64]
    focus: Array
    grid: NDArray[np.int64]
    beyond: int
    limits: tuple[Array, ...] = ()


@dataclass(frozen=True, eq=False)
class Aspect:
    """One singularity-free component.

    Attributes:
        number: 1, 2, ... as the postures refer to it.
        sign: of Delta in it.
        regions: (m, 2) polygons that cover it, with their copies.
        roadmap: (m, 2) polylines: the silhouette, and the fibers through postures.
        label: (2,) a place well inside it.
    """

    number: int
    sign: int
    regions: tuple[Array, ...]
    roadmap: tuple[Array, ...]
    label: Array


@dataclass(frozen=True, eq=False)
class JointPlane:
    """The plane of joints 2 and 3, sampled; rad, or the arm's unit for a slide.

    Attributes:
        labels: of the two axes, with units.
        window: (left, right, bottom, top): one turn about 0.
        is_turn: whether each axis is an angle.
        aspects: as many as are proved.
        curve: (m, 2) polylines of the critical curve, with their copies.
        postures: (k, 2) the postures of the value in focus, inside the window.
        posture_aspects: the number of the aspect of each.
        paths: (m, 2) copies of the path between two postures of one aspect; () when
            no two share one.
        limits: (m, 2) copies of the sides of the box that joint limits make.
    """

    labels: tuple[str, str]
    window: Window
    is_turn: tuple[bool, bool]
    aspects: tuple[Aspect, ...]
    curve: tuple[Array, ...]
    postures: Array
    posture_aspects: tuple[int, ...]
    paths: tuple[Array, ...]
    limits: tuple[Array, ...] = ()


@dataclass(frozen=True, eq=False)
class Figures:
    """Both planes of one arm.

    Attributes:
        title: the arm's name and its verdict.
        notes: what the figures leave out or show of another arm, one sentence each.
        value: the plane of values, the paper's Figure 2.
        joint: the plane of joints 2 and 3, the paper's Figure 3.
    """

    title: str
    notes: tuple[str, ...]
    value: ValuePlane
    joint: JointPlane


@dataclass(frozen=True)
class Leaf:
    """A maximum of |det J|, at the foot of the tree's branches.

    Attributes:
        level: |det J| there over the largest.
        sign: of det J.
        aspect: 1, 2, ...: the group of maxima that it belongs to.
    """

    level: float
    sign: int
    aspect: int


@dataclass(frozen=True, eq=False)
class Slice:
    """A plane through the torus of the joints that det J depends on.

    Attributes:
        title: what the plane goes through, and where the other joints stand.
        labels: of the two axes.
        window: (left, right, bottom, top), rad.
        heights: (rows from the bottom, columns) det J over the largest |det J|.
        marks: (2,) places by name.
        lines: (m, 2) the witness path, seen along the other joints.
    """

    title: str
    labels: tuple[str, str]
    window: Window
    heights: Array
    marks: dict[str, Array]
    lines: tuple[Array, ...]


@dataclass(frozen=True, eq=False)
class Landscape:
    """What is drawn of a six-joint arm.

    Attributes:
        title: the arm's name and its verdict.
        notes: what the reader must know, one sentence each.
        leaves: the maxima, in the order of the tree.
        branches: (m, 2) polylines (place among the leaves, level).
        joins: (k, 2) where branches join.
        clearance: of the witness, if there is one.
        ends: (2,) the ends of the witness by name: the maximum they climb to, their
            level.
        slices: planes through the torus.
    """

    title: str
    notes: tuple[str, ...]
    leaves: tuple[Leaf, ...]
    branches: tuple[Array, ...]
    joins: Array
    clearance: float | None
    ends: dict[str, Array]
    slices: tuple[Slice, ...]
