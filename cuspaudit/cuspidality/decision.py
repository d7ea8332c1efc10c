"""Algorithm 1 of the paper on any variety and map, with two routes to connectivity.

    g <- AtypicalValues(R, f)
    Q <- SamplePointsRational(g)
    P <- Union over q in Q of P_q = SamplePoints((f, R - q), ())
    Delta <- Crit(R, f)
    G <- GraphIsotop(Roadmap(f, Delta, P), Delta, P)    or    Routing(f, Delta, P)
    for q in Q: a couple if two points of P_q are connected in G

Correct by Proposition 10 of the paper under assumption (A), which is checked. Points of
one fiber at which a factor of Delta has different signs are not connected, so they are
never asked for; where this parts all points of all fibers, R is noncuspidal whatever
the components are, and a route that is unable to list them does no harm.

A couple needs none of the lists that make this complete, so one is looked for first
(``cuspidality.couple_first``), unless the whole run promises to be as short; what the
verdict does not need is then left out, unless the whole run is asked for.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import combinations
from math import comb
from typing import Literal

from flint import fmpq

from cuspaudit.algebra.points.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
)
from cuspaudit.algebra.points.union import restricted
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.couple_first import (
    Couple,
    Value,
    find_couple,
    more_fibers,
)
from cuspaudit.cuspidality.decision_result import Connectivity, Decision
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import (
    DegenerateMapError,
    RetryableError,
    TimeLimitError,
    UnableError,
)
from cuspaudit.geometry.angles import check_angles, rolled, unrolled
from cuspaudit.geometry.assumption_a import check_assumption_a
from cuspaudit.geometry.atypical_values import AtypicalValues, atypical_values
from cuspaudit.geometry.cells.axis_order import axis_order
from cuspaudit.geometry.cells.open_cells import OpenCells, open_cells
from cuspaudit.geometry.crit import crit, without_units
from cuspaudit.geometry.fibers.degree import has_degree_at_most
from cuspaudit.geometry.fibers.generic_fiber import GenericFiber
from cuspaudit.geometry.idle_circles import without_idle_circles
from cuspaudit.geometry.roadmap import roadmap
from cuspaudit.geometry.routing import morse_graph, routing
from cuspaudit.runtime.clock import seconds_left, time_limit
from cuspaudit.runtime.steps import Steps

__all__ = ["Engine", "decide", "points_over"]

Engine = Literal["auto", "roadmap", "routing"]

_UNLIMITED = 1e6
#: seconds for what a verdict does not need: with a couple, for a proof among that, and
#: for the components where signs part all points
_EXTRA = 4.0
_BRIEF = 0.5
_COUNTING = 10.0
#: variables with which the whole run is tried before a couple, and for how long, in s
_FEW = 3
_BRIEFLY = 2.0
#: minors of jac f with which assumption (A) takes longer than to look for a couple
_MANY_MINORS = 40
_EXACT = ("FLINT resultants", "FLINT root isolation", "exact signs", "ball arithmetic")


def decide(
    variety: PolynomialSystem,
    mapping: PolynomialMap,
    engine: Engine = "auto",
    *,
    complete: bool = False,
    seed: int = 1,
    timeout: float | None = None,
    progress: Callable[[str], None] = lambda step: None,
) -> Decision:
    """Decide whether the restriction of R to V_R is cuspidal.

    [Paper, Algorithm 1].

    Args:
        variety: V = {f = 0} over Q, f empty for V = R^n.
        mapping: R: V -> R^d, d the dimension of V.
        engine: the route to connectivity; "auto" looks for a couple first, and then
            takes the roadmap, and the routing where that is unable.
        complete: whether "auto" is to make the whole run although there is a couple.
        seed: of every random choice.
        timeout: in s; looked at between steps and given to every program started.
        progress: called with the name of each step before it runs.

    Returns:
        The run. UNDECIDED, with ``failure`` naming the step, when one was too large or
        too long.

    Raises:
        AssumptionError: assumption (A) fails, R is singular everywhere on V, or the
            numbers of equations, components and variables do not fit.
    """
    run = Decision(variety, mapping)
    steps = Steps(progress, timeout)
    try:
        with time_limit(timeout):
            first = engine == "auto" and not complete
            decided = _check(run, steps, first)
            if first and decided and len(variety.ring.variables) <= _FEW:
                _briefly(run, steps, seed)
            if first and run.verdict is Verdict.UNDECIDED:
                _couple_first(run, steps, seed)
            if run.verdict is Verdict.UNDECIDED:
                if not decided:
                    _check(run, steps, first=False)
                _whole(run, steps, engine, seed)
    except TimeLimitError as limit:
        seconds = timeout if timeout is not None and not steps.left else limit.seconds
        run.failure = TimeLimitError(steps.current, seconds)
    except UnableError as limit:
        # what a routine was unable to do in its last moment, it had no time for
        run.failure = limit
        if timeout is not None and not steps.left:
            run.failure = TimeLimitError(steps.current, timeout)
    except RetryableError as unlucky:
        run.failure = UnableError(steps.current, str(unlucky))
    steps.end()
    run.steps = tuple(steps.done)
    return run


def _check(run: Decision, steps: Steps, first: bool) -> bool:
    """Steps 1 and 2: Delta, and whether assumption (A) was decided.

    A couple is one without it when V is given by n - d equations; so where a couple
    is looked for ``first``, a check that promises to be long is put off.
    """
    variety, dimension = run.variety, run.mapping.dimension
    check_angles(variety, run.mapping)
    steps.begin("crit")
    run.minors = without_units(variety, crit(variety, run.mapping))
    steps.begin("check_assumption_a")
    size = len(variety.ring.variables)
    needless = first and variety.dimension == dimension
    decided = not (needless and comb(size, dimension) > _MANY_MINORS)
    try:
        if decided:
            check_assumption_a(variety, dimension)
    except UnableError:
        if not needless:
            raise
        decided = False
    if not run.minors:
        raise DegenerateMapError("Delta vanishes identically: the map has no full rank")
    return decided


def _whole(run: Decision, steps: Steps, engine: Engine, seed: int) -> None:
    """The rest of the algorithm."""
    values = _prepare(run, steps, seed)
    if engine == "auto" and _are_parted(run):
        _by_signs(run, steps, values, seed)
    else:
        _connect(run, steps, values, engine, seed)


def _briefly(run: Decision, steps: Steps, seed: int) -> None:
    """The whole run of a small system, if two seconds are enough: it knows more."""
    try:
        with time_limit(_share(steps, 4, _BRIEFLY)()):
            _connect(run, steps, _prepare(run, steps, seed), "auto", seed)
    except (UnableError, RetryableError):
        run.atypical, run.samples, run.most_is_proved = [], {}, False


def _couple_first(run: Decision, steps: Steps, seed: int) -> None:
    """A verdict by one couple, in half of the time; and what is soon known besides."""
    variety, mapping, minors = run.variety, run.mapping, run.minors
    steps.begin("find_couple")
    essential = without_idle_circles(variety, mapping.dimension, minors)
    left = _share(steps, 2)
    try:
        with time_limit(left()):
            found = find_couple(essential, mapping, minors, left, seed)
    except (UnableError, RetryableError):
        return
    if found.couple is None:
        return
    run.couple, run.engine, run.verdict = found.couple, "couple", Verdict.CUSPIDAL
    run.rests_on = ("exact solutions", "exact signs", "ball arithmetic")
    with suppress(UnableError, RetryableError):
        steps.begin("sample_points")
        left = _share(steps, 4, _EXTRA)
        fibers = more_fibers(essential, mapping, minors, left, seed)
        run.samples = _regular(run, found.fibers | fibers)
        run.most_is_proved = _is_most(run, min(left(), _BRIEF))
        steps.begin("routing")
        with time_limit(_share(steps, 4, _EXTRA)()):
            run.components = morse_graph(
                essential.variety,
                essential.dimension,
                essential.minors,
                seed=seed,
                timeout=_EXTRA,
            ).number_of_components


def _regular(
    run: Decision, fibers: Mapping[Value, ZeroDimensionalParametrization]
) -> dict[Value, tuple[RealPoint, ...]]:
    """The real points of the fibers without a critical one."""
    ring = run.variety.ring
    return {
        value: fiber.real_points()
        for value, fiber in fibers.items()
        if all(
            any(point.sign(minor, ring) != 0 for minor in run.minors)
            for point in fiber.real_points()
        )
    }


def _is_most(run: Decision, seconds: float) -> bool:
    """Whether it was proved that no fiber has more regular points than those known."""
    most = run.most_points or 0
    value = next((v for v, p in run.samples.items() if len(p) == most), None)
    return value is not None and has_degree_at_most(
        run.variety, run.mapping, value, most, seconds
    )


def _prepare(run: Decision, steps: Steps, seed: int) -> tuple[GenericFiber, OpenCells]:
    """Steps 3 to 8 of the algorithm: g, Q and the points over Q."""
    variety, mapping = run.variety, run.mapping
    steps.begin("atypical_values")
    values = atypical_values(*unrolled(variety, mapping), _limit(steps), seed)
    run.atypical = values.polynomials
    steps.begin("sample_points_rational")
    fiber = values.fiber
    order = axis_order(fiber.ring, run.atypical, fiber.values)
    fiber = fiber.reordered(order)
    cells = open_cells(fiber.ring, AtypicalValues(fiber).polynomials, fiber.values)
    steps.begin("sample_points")
    for value in cells.samples.values():
        own = tuple(value[order.index(i)] for i in range(len(order)))
        points = points_over(fiber, value)
        if mapping.angles:
            points = restricted(points, variety.ring.variables, points.form, seed)
            own = rolled(mapping, own)
        run.samples[own] = points.real_points()
    run.most_is_proved = True
    return fiber, cells


def _are_parted(run: Decision) -> bool:
    """Whether the signs of the factors of Delta part all points of every fiber."""
    factors, ring = _factors(run.minors), run.variety.ring
    for points in run.samples.values():
        signs = {tuple(p.sign(f, ring) for f in factors) for p in points}
        if len(signs) < len(points):
            return False
    return True


def _by_signs(
    run: Decision, steps: Steps, values: tuple[GenericFiber, OpenCells], seed: int
) -> None:
    """Noncuspidal; and the components, where half of the time is enough for them."""
    run.engine, run.verdict, run.rests_on = "signs", Verdict.NONCUSPIDAL, _EXACT[:3]
    with (
        suppress(UnableError, RetryableError),
        time_limit(_share(steps, 2, _COUNTING)()),
    ):
        _connect(run, steps, values, "auto", seed)


def points_over(
    fiber: GenericFiber, value: tuple[fmpq, ...]
) -> ZeroDimensionalParametrization:
    """The points of V over a value with lc disc != 0 (the paper's P_q).

    Complete by the theorem of `geometry.fibers.generic_fiber`.
    """
    omega, rho = fiber.over(value)
    leading = omega[omega.degree()]
    return ZeroDimensionalParametrization(
        fiber.variety.ring.variables,
        omega / leading,
        tuple(p % omega / leading for p in rho),
        tuple(map(fmpq, fiber.form)),
        ("generic fiber",),
    )


def _connect(
    run: Decision,
    steps: Steps,
    values: tuple[GenericFiber, OpenCells],
    engine: Engine,
    seed: int,
) -> None:
    """Steps 9 to 14: connectivity by one route, or the other where that is unable."""
    routes = ("roadmap", "routing") if engine == "auto" else (engine,)
    if run.mapping.angles:  # the cells are those of a chart that cuts circles
        if engine == "roadmap":
            raise UnableError("roadmap", "the map has angles; the routing decides it")
        routes = ("routing",)
    for route in routes:
        try:
            steps.begin(route)
            graph = (
                _sheets(run, steps, *values, seed)
                if route == "roadmap"
                else _routed(run, steps, seed)
            )
            steps.begin("graph_connected")
            run.couple = next(_couples(run, graph), None)
        except (UnableError, RetryableError):
            if route == routes[-1] or steps.left == 0.0:
                raise
            continue
        run.engine, run.components = route, graph.number_of_components
        run.rests_on = (*_EXACT, *sorted(graph.grounds))
        run.verdict = Verdict.CUSPIDAL if run.couple else Verdict.NONCUSPIDAL
        return


def _sheets(
    run: Decision, steps: Steps, fiber: GenericFiber, cells: OpenCells, seed: int
) -> Connectivity:
    """The roadmap, on which the sample points are vertices from the start."""
    sheets = roadmap(
        run.variety,
        fiber.mapping,
        fiber=fiber,
        cells=cells,
        timeout=_limit(steps),
        seed=seed,
    )
    samples = zip(cells.samples.items(), run.samples.values(), strict=True)
    for (cell, value), points in samples:
        for i, point in enumerate(points):
            sheets.placed[point] = (cell, i), value
    return sheets


def _routed(run: Decision, steps: Steps, seed: int) -> Connectivity:
    limit = _limit(steps)
    return routing(run.variety, run.mapping, run.minors, timeout=limit, seed=seed)


def _couples(run: Decision, graph: Connectivity) -> Iterator[Couple]:
    factors = _factors(run.minors)
    ring = run.variety.ring
    for value, points in run.samples.items():
        signs = {p: tuple(p.sign(f, ring) for f in factors) for p in points}
        for a, b in combinations(points, 2):
            if signs[a] == signs[b] and graph.component(a) == graph.component(b):
                sign = a.sign(run.minors[0], ring) if len(run.minors) == 1 else 1
                yield Couple(value, (a, b), sign, graph.path(a, b))


def _factors(minors: Sequence[Polynomial]) -> list[Polynomial]:
    """Factors of Delta; none when several minors must vanish together."""
    return [f for f, _ in minors[0].factor()[1]] if len(minors) == 1 else []


def _limit(steps: Steps) -> float:
    return min(
        left for left in (steps.left, seconds_left(), _UNLIMITED) if left is not None
    )


def _share(steps: Steps, parts: int, most: float = _UNLIMITED) -> Callable[[], float]:
    """The seconds left of a part of the time left now, ``most`` s at most."""
    end = time.monotonic() + min(_limit(steps) / parts, most)
    return lambda: max(0.0, end - time.monotonic())
