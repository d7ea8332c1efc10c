"""Whether every run of a tool path is known, those born on the way included.

**Three joints.** The number of postures of a value changes only at an atypical value
(`surface.atypical_values`): a zero of finitely many polynomials, which along a leg are
polynomials in its parameter. Their real roots cut the path into intervals; in the
interior of each the postures are constant in number and every one lies on a run. So if
at one rational parameter of every interval each posture, all of them found exactly,
has a knot in a tube of a known run, no run is missing. One that is missing is followed
from there. In the first and last interval the postures of the first and last pose
serve: each must have its run, or be singular itself, a root.

Other arms: runs that meet neither end of the path, nor are joined to one that does, are
looked for (`on_the_way`), and may be missed; that is said.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

from flint import arb, ctx, fmpq, fmpq_poly

from cuspaudit.algebra.ring import Polynomial, Ring, rational
from cuspaudit.algebra.univariate import Univariate, real_roots
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.errors import AssumptionError, RetryableError, UnableError
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.runtime.clock import check_time, time_is_up
from cuspaudit.surface.atypical_values import atypical_values
from cuspaudit.surface.fibers import fiber_polynomials
from cuspaudit.toolpath.following.leg_system import LegSystem
from cuspaudit.toolpath.following.on_the_way import look_on_the_way
from cuspaudit.toolpath.following.reduced_value import reduced_value
from cuspaudit.toolpath.following.runs import loop_runs
from cuspaudit.toolpath.following.starts import Solved, solve_pose
from cuspaudit.toolpath.following.strand import TubeLink, looped
from cuspaudit.toolpath.following.strands import (
    Followed,
    has_run,
    known_postures,
    sort_links,
)
from cuspaudit.toolpath.traced_arm import TracedArm
from cuspaudit.toolpath.waypoints import Pose, ToolPath

__all__ = ["complete_runs"]

_NARROWEST = 1e-7
_GRID = 2**30
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
        return False, [*remarks, *look_on_the_way(arm, legs, found)]
    if not (first.complete and last.complete):
        return False, remarks
    try:
        between = list(_samples(arm, path))
    except (AssumptionError, RetryableError, UnableError) as limit:
        return False, [f"{_NOT_COUNTED}: {limit}"]
    complete = True
    links: dict[int, list[TubeLink]] = defaultdict(list)
    sort_links(found.runs, links)
    for leg, s in between:
        if time_is_up():
            return False, [f"{_NOT_COUNTED}: the time was up"]
        complete = _is_complete(arm, path, legs, leg, s, found, links) and complete
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
        check_time("births")
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
    return leg, Fraction(round((low + high) / 2 * _GRID), _GRID)


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
    links: dict[int, list[TubeLink]],
) -> bool:
    """Whether all postures at a parameter have a run; missing runs are added.

    Args:
        arm: the arm.
        path: the tool path.
        legs: its equations.
        leg: a leg, and
        s: a parameter on it, a double.
        found: the runs.
        links: theirs, by leg.
    """
    a, b = path.poses[leg], path.poses[leg + 1]
    x, y, z = (p + s * (q - p) for p, q in zip(a.position, b.position, strict=True))
    solved = solve_pose(arm, Pose((x, y, z)))
    if not solved.complete:
        return False
    for known in known_postures(arm, legs[leg], solved, float(s)):
        if known.knot is None:
            return False
        if has_run(arm, links[leg], known.knot):
            continue
        loop = looped(legs, leg, known.knot)
        if loop is None:
            return False
        runs = loop_runs(legs, loop)
        found.runs += runs
        sort_links(runs, links)
        if not has_run(arm, links[leg], known.knot):
            return False
    return True
