"""Whether every run of a tool path is known, those born on the way included.

**Three joints.** The number of postures of a value changes only at an atypical value
(`surface.atypical_values`): a zero of finitely many polynomials, which along a leg are
polynomials in its parameter. Their real roots cut the path into intervals; in the
interior of each the postures are constant in number and every one lies on a run. So if
at one rational parameter of every interval the postures, counted exactly, are as many
as the runs alive there, no run is missing. One that is missing is followed from there.

Other arms: a run that is born on the way and reaches neither end of the path, nor is
joined to one that does, would not be seen; that is said.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

import numpy as np
from flint import arb, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.ring import Polynomial, Ring, rational
from cuspaudit.algebra.univariate import Univariate, real_roots
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.errors import AssumptionError, RetryableError, UnableError
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.surface.atypical_values import atypical_values
from cuspaudit.surface.fibers import fiber_polynomials
from cuspaudit.toolpath.leg_system import LegSystem
from cuspaudit.toolpath.reduced_value import reduced_value
from cuspaudit.toolpath.runs import loop_runs
from cuspaudit.toolpath.starts import Solved, solve_pose
from cuspaudit.toolpath.strand import looped
from cuspaudit.toolpath.strands import Followed, known_postures
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import Pose, ToolPath

__all__ = ["complete_runs"]

_NARROWEST = 1e-7
_NOT_COUNTED = (
    "runs that are born on the way and meet neither end of the path are not looked for"
)


def complete_runs(
    arm: TracedArm,
    path: ToolPath,
    legs: Sequence[LegSystem],
    first: Solved,
    last: Solved,
    found: Followed,
) -> tuple[bool, list[str]]:
    """Look for runs that no end of the path shows, and add them to ``found``.

    Returns:
        whether all runs are known, proved; and what a reader should know.
    """
    remarks = [
        f"the postures of the {side} pose may not be all: {solved.why}"
        for side, solved in (("first", first), ("last", last))
        if not solved.complete
    ]
    if len(arm.chain.joints) != 3:
        return False, [*remarks, _NOT_COUNTED]
    if not (first.complete and last.complete):
        return False, remarks
    try:
        between = list(_samples(arm, path))
    except (AssumptionError, RetryableError, UnableError) as limit:
        return False, [f"{_NOT_COUNTED}: {limit}"]
    complete = True
    for leg, s in between:
        complete = _is_complete(arm, path, legs, leg, s, found) and complete
    if not complete:
        remarks.append("at some parameter of the path not every posture has a run")
    return complete, remarks


def _samples(arm: TracedArm, path: ToolPath) -> Iterator[tuple[int, Fraction]]:
    """A leg and a parameter in every interval between roots, but the outer two.

    Raises:
        UnableError: the path runs along atypical values, or roots are too close.
    """
    walls = _Walls(arm)
    last: tuple[int, arb] | None = None
    for leg, (a, b) in enumerate(pairwise(path.poses)):
        if a.position == b.position:
            continue
        for root in walls.roots(a, b):
            if last is not None:
                yield _between(last, (leg, root))
            last = leg, root


def _between(a: tuple[int, arb], b: tuple[int, arb]) -> tuple[int, Fraction]:
    """A rational parameter between two roots.

    Raises:
        UnableError: they are too close.
    """
    leg, low = a[0], float(a[1].upper())
    high = float(b[1].lower()) if b[0] == leg else 1.0
    if b[0] != leg and high - low < _NARROWEST:
        leg, low, high = b[0], 0.0, float(b[1].lower())
    if high - low < _NARROWEST:
        raise UnableError("births", f"two events within 1e-7 near {leg + low:.9g}")
    return leg, Fraction((low + high) / 2).limit_denominator(10**9)


class _Walls:
    """The polynomials whose zeros hold the atypical values, on a leg."""

    def __init__(self, arm: TracedArm) -> None:
        model = arm.model
        variety, mapping = reduced_map(model)
        surface, _ = oriented(variety, mapping)
        fibers = fiber_polynomials(surface, mapping)
        self._model, self._source = model, fibers.ring
        self._walls = atypical_values(fibers)
        self._ring = Ring(["s"], self._source.radicand)

    def roots(self, a: Pose, b: Pose) -> list[arb]:
        """The roots in [0, 1], increasing, over all the polynomials.

        Raises:
            UnableError: a polynomial vanishes on the whole leg.
        """
        ring, s = self._ring, self._ring.gen("s")
        place = [
            ring.constant(rational(x)) + s * rational(y - x)
            for x, y in zip(a.position, b.position, strict=True)
        ]
        u, v = reduced_value(self._model, ring, place)
        surd = [ring.surd] if ring.radicand else []
        zero = ring.constant(0)
        found: list[Univariate] = []
        for wall in self._walls:
            value: Polynomial = wall.compose(zero, zero, u, v, *surd, ctx=ring.context)
            along = Univariate.from_polynomial(ring, ring.reduce(value), "s")
            if along.is_zero:
                raise UnableError("births", "the path runs along critical values")
            if _may_vanish(along.norm):
                found.append(along)
        if not found:
            return []
        with ctx.workprec(128):
            balls = [root.enclosure(128) for root in real_roots(*found)]
        return [ball for ball in balls if not (ball < 0 or ball > 1)]


def _may_vanish(polynomial: fmpq_poly) -> bool:
    """False if the polynomial has no root in [0, 1], by Descartes' rule of signs.

    The positive roots of (1 + t)^d p(1 / (1 + t)) are the roots of p in (0, 1).
    """
    if polynomial(fmpq(0)) == 0 or polynomial(fmpq(1)) == 0:
        return True
    shifted = fmpq_poly(polynomial.coeffs()[::-1])(fmpq_poly([1, 1]))
    signs = [c > 0 for c in shifted.coeffs() if c != 0]
    return any(a != b for a, b in pairwise(signs))


def _is_complete(
    arm: TracedArm,
    path: ToolPath,
    legs: Sequence[LegSystem],
    leg: int,
    s: Fraction,
    found: Followed,
) -> bool:
    """Whether all postures at a parameter have a run; missing runs are added."""
    a, b = path.poses[leg], path.poses[leg + 1]
    x, y, z = (p + s * (q - p) for p, q in zip(a.position, b.position, strict=True))
    solved = solve_pose(arm, Pose((x, y, z)))
    if not solved.complete:
        return False
    at = leg + float(s)
    if len(solved.postures) == _alive(found, at):
        return True
    for known in known_postures(arm, legs[leg], solved, float(s)):
        if known.knot is None:
            return False
        if _has_run(arm, found, at, known.values):
            continue
        links = looped(legs, leg, known.knot)
        if links is None:
            return False
        found.runs += loop_runs(legs, links)
    return len(solved.postures) == _alive(found, at)


def _alive(found: Followed, at: float) -> int | None:
    """How many runs are alive; None where that cannot be told of one."""
    states = [run.is_alive(at) for run in found.runs]
    return None if None in states else states.count(True)


def _has_run(arm: TracedArm, found: Followed, at: float, values: np.ndarray) -> bool:
    """Whether a run passes near a posture at a parameter: for searching."""
    for run in found.runs:
        if not run.is_alive(at):
            continue
        rows = run.points
        order = np.argsort(rows[:, -1], kind="stable")
        rows = rows[order]
        k = min(max(int(np.searchsorted(rows[:, -1], at)), 1), len(rows) - 1)
        low, high = rows[k - 1], rows[k]
        gap = high[-1] - low[-1]
        share = (at - low[-1]) / gap if gap else 0.0
        near = low[:-1] + share * (high[:-1] - low[:-1])
        size = max(0.05, float(np.abs(high[:-1] - low[:-1]).max()))
        turns = np.where(arm.turning, np.round((near - values) / (2 * np.pi)), 0)
        if np.abs(near - values - 2 * np.pi * turns).max() < size:
            return True
    return False
