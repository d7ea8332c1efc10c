"""The plane of values of a three-joint arm: what the paper's Figure 2 shows.

The curve of critical values with its cusps and nodes, the rational sample values with
their proved numbers of postures, and how many postures every value has. The last is
counted in floating point on a fine grid and is background only.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.algebra.ring import Rational
from cuspaudit.pictures.critical_curve import CurvePiece
from cuspaudit.pictures.cusps_and_nodes import CriticalPoints
from cuspaudit.pictures.joint_surface import Array, JointSurface
from cuspaudit.pictures.limit_lines import limit_sides
from cuspaudit.surface.sample_points import Fiber
from cuspaudit.viz.plot.data import ValuePlane, Window

__all__ = ["count_postures", "finite_runs", "value_plane"]

_GRID = 480
_MARGIN = 0.12
_TURN = 0.3719  # of the chart, so that no root of a symmetric arm stays at infinity
_POINT = 1e-9


def value_plane(
    surface: JointSurface,
    traced: list[tuple[CurvePiece, Array, Array]],
    special: CriticalPoints,
    focus: Fiber,
) -> ValuePlane:
    """The plane of values of ``surface``.

    Args:
        surface: of joints 2 and 3.
        traced: the pieces of the critical curve with `trace` of each.
        special: its cusps and nodes.
        focus: the fiber that is drawn in the plane of joints.
    """
    curve = [line for *_, p in traced for line in finite_runs(_image(surface, p))]
    lines = tuple(c for c in curve if np.ptp(c, axis=0).max() > _POINT)
    dots = [c[0] for c in curve if np.ptp(c, axis=0).max() <= _POINT]
    fibers = [f for f in surface.decision.samples if _is_real(surface, f)]
    samples = surface.plane(_values(fibers))
    cusps = surface.plane(surface.values(special.cusps))
    window = _window(surface, curve, samples, cusps)
    inside = (samples >= window[::2]) & (samples <= window[1::2])
    return ValuePlane(
        labels=_labels(surface),
        window=window,
        curve=lines,
        points=np.array(dots).reshape(-1, 2),
        cusps=cusps,
        nodes=surface.plane(special.nodes),
        samples=samples,
        sample_postures=np.array([len(f.postures) for f in fibers], dtype=np.int64),
        focus=surface.plane(_values([focus]))[0],
        grid=_counts(surface, window),
        beyond=int((~inside.all(axis=1)).sum()),
        limits=tuple(_image(surface, side) for side in limit_sides(surface)),
    )


def count_postures(surface: JointSurface, values: Array) -> NDArray[np.int64]:
    """The number of real roots of F at (m, 2) values (u, v), in floating point.

    By Sturm's sequence, all values at once: enough for colouring, not for a verdict.
    """
    fibers = surface.decision.fibers
    ring, name = fibers.ring, fibers.separating
    parts = ring.coefficients(fibers.polynomial, [name])
    points = np.zeros((len(values), 4))
    points[:, [ring.variables.index("u"), ring.variables.index("v")]] = values
    degree = max(int(power) for (power,) in parts)
    turned = np.zeros((len(values), degree + 1))
    column = numeric_values(ring, list(parts.values()), points).T
    for (power,), numbers in zip(parts, column, strict=True):
        basis = np.poly1d([1, _TURN]) ** int(power)
        basis = basis * np.poly1d([-_TURN, 1]) ** (degree - int(power))
        coefficients = np.r_[np.zeros(degree - basis.order), basis.coeffs]
        turned += numbers[:, None] * coefficients
    return _sturm(turned)


def finite_runs(points: Array) -> list[Array]:
    """The stretches of a polyline without nan, of two points or more."""
    good = np.isfinite(points).all(axis=1)
    cuts = np.flatnonzero(np.diff(good.astype(int))) + 1
    return [r for r in np.split(points, cuts) if len(r) > 1 and np.isfinite(r).all()]


def _sturm(polynomials: Array) -> NDArray[np.int64]:
    """Numbers of real roots of (m, d + 1) coefficients, the highest power first."""
    degree = polynomials.shape[1] - 1
    first = polynomials / np.abs(polynomials).max(axis=1, keepdims=True)
    second = first[:, :-1] * np.arange(degree, 0, -1)
    leads = [first[:, 0], second[:, 0]]
    with np.errstate(all="ignore"):
        while second.shape[1] > 1:
            slope = first[:, :1] / second[:, :1]
            rest = first[:, 1:].copy()
            rest[:, :-1] -= slope * second[:, 1:]
            rest = rest[:, 1:] - (rest[:, :1] / second[:, :1]) * second[:, 1:]
            rest /= -np.abs(rest).max(axis=1, keepdims=True)
            first, second = second, rest
            leads.append(second[:, 0])
    right = np.sign(np.stack(leads, axis=1))
    left = right * (-1.0) ** np.arange(degree, -1, -1)
    changes = [(s[:, 1:] * s[:, :-1] < 0).sum(axis=1) for s in (left, right)]
    return np.asarray(changes[0] - changes[1], dtype=np.int64)


def _image(surface: JointSurface, points: Array) -> Array:
    return surface.plane(surface.values(points))


def _values(fibers: list[Fiber]) -> Array:
    return np.array([[_float(x) for x in f.value] for f in fibers]).reshape(-1, 2)


def _is_real(surface: JointSurface, fiber: Fiber) -> bool:
    """Whether the value belongs to a point of space: |p|^2 >= z^2."""
    u, v = fiber.value
    return surface.model.joints[0].kind == "prismatic" or bool(u >= v * v)


def _float(value: Rational) -> float:
    return int(value.p) / int(value.q)


def _window(
    surface: JointSurface, curve: list[Array], samples: Array, cusps: Array
) -> Window:
    """Around the curve; around the samples and cusps where it runs out of reach."""
    is_compact = "line" not in (surface.fiber.kind, surface.base.kind)
    shown = np.vstack(curve if is_compact and curve else [samples, cusps])
    (left, bottom), (right, top) = shown.min(axis=0), shown.max(axis=0)
    margin = _MARGIN * max(right - left, top - bottom, 1e-6)
    left = left - margin
    if surface.model.joints[0].kind == "revolute":
        left = 0.0
    return (
        float(left),
        float(right + margin),
        float(bottom - margin),
        float(top + margin),
    )


def _counts(surface: JointSurface, window: Window) -> NDArray[np.int64]:
    left, right, bottom, top = window
    scale = _GRID / max(right - left, top - bottom)
    columns, rows = (
        math.ceil(scale * (right - left)),
        math.ceil(scale * (top - bottom)),
    )
    x = left + (right - left) * (np.arange(columns) + 0.5) / columns
    y = bottom + (top - bottom) * (np.arange(rows) + 0.5) / rows
    plane = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    return count_postures(surface, surface.values_at(plane)).reshape(rows, columns)


def _labels(surface: JointSurface) -> tuple[str, str]:
    first, unit = surface.model.joints[0].name, surface.model.chain.unit
    first = first.replace("_", " ")
    if surface.model.joints[0].kind == "revolute":
        return (
            f"ρ: distance from the axis of {first} ({unit})",
            f"z: height along the axis of {first} ({unit})",
        )
    x, y = (", ".join(f"{w + 0.0:.3g}" for w in d) for d in surface.directions)
    return f"across {first}, along ({x}) ({unit})", f"along ({y}) ({unit})"
