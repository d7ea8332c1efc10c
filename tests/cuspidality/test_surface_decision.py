from __future__ import annotations

import math
from itertools import combinations

import pytest
from flint import ctx, fmpq
from short_tables import arm

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import SurfaceDecision, decide_surface
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError, UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map

RING = Ring(["x", "y"])
X, Y = RING.gens
PLANE = PolynomialSystem(RING)
ROUND = Ring(["c", "s", "q"])
C, S, Q = ROUND.gens
CYLINDER = PolynomialSystem(ROUND, (C**2 + S**2 - 1,))

#: maps of the plane decided by hand: (R, verdict, aspects, postures)
BY_HAND = {
    "identity": ((X, Y), "noncuspidal", 1, 1),
    "fold": ((X**2, Y), "noncuspidal", 2, 2),
    "fold on a slope": ((Y + (X - Y) ** 2, Y + 3 * (X - Y) ** 2), "noncuspidal", 2, 2),
    "Whitney cusp": ((X**3 + X * Y, Y), "cuspidal", 2, 3),
    "Whitney cusp, exchanged": ((X, Y**3 + X * Y), "cuspidal", 2, 3),
    # three monotone pieces
    "cubic": ((X**3 - 3 * X, Y), "noncuspidal", 3, 3),
    # convex in x
    "quartic": ((X**4 + X * Y, Y), "noncuspidal", 2, 2),
    # not proper over u = 0; y = +-sqrt(v / u), where Delta = 2 x y has either sign
    "not proper": ((X, X * Y**2), "noncuspidal", 4, 2),
    # 1 + 2 x y at the two postures is +-sqrt(1 + 4 u v)
    "not proper, hyperbola": ((X + X**2 * Y, Y), "noncuspidal", 3, 2),
    # x + y and x y: x and y exchanged
    "symmetric": ((X * Y, X + Y), "noncuspidal", 2, 2),
    "blow-up": ((X * Y, Y), "noncuspidal", 2, 1),
    # y (x^2 - 1) = x is critical; two postures, with signs of either kind
    "broken hyperbola": ((X * (X * Y - 1) + Y, X * Y), "noncuspidal", 4, 2),
}


def run(system: PolynomialSystem, *components: object) -> SurfaceDecision:
    """The decision for a map."""
    return decide_surface(system, PolynomialMap(system.ring, components))


@pytest.mark.parametrize("name", BY_HAND)
def test_maps_of_the_plane(name: str) -> None:
    """The verdict, aspects and postures found by hand [mathematics 4]."""
    mapping, verdict, aspects, postures = BY_HAND[name]
    found = run(PLANE, *mapping)
    assert found.verdict.value == verdict
    assert (found.aspects, found.max_postures) == (aspects, postures)


def test_maps_of_the_cylinder() -> None:
    """Polar coordinates twice over, and a fold of a cylinder."""
    polar = run(CYLINDER, C * Q, S * Q)
    assert (polar.verdict, polar.aspects) == (Verdict.NONCUSPIDAL, 2)
    fold = run(CYLINDER, S, Q + C)
    assert (fold.verdict, fold.aspects) == (Verdict.NONCUSPIDAL, 2)


def test_the_complex_square_is_refused_by_name() -> None:
    """A critical set of codimension 2 is left to the general engine, by name."""
    with pytest.raises(UnableError) as error:
        run(PLANE, X**2 - Y**2, 2 * X * Y)
    assert error.value.step == "roadmap"


def test_two_folds_are_refused() -> None:
    """Postures alike two by two in either coordinate are left to it as well."""
    with pytest.raises(UnableError):
        run(PLANE, X**2, Y**2)


@pytest.mark.parametrize(
    "name", [n for n, case in BY_HAND.items() if case[1] == "cuspidal"]
)
def test_the_couple_is_a_couple(name: str) -> None:
    """Two distinct postures of the value, in one aspect, with the sign that is said."""
    mapping = PolynomialMap(RING, BY_HAND[name][0])
    check_couples(decide_surface(PLANE, mapping), mapping)


@pytest.mark.parametrize("alpha", [(-90, 90, 0), (-30, 90, 0), (45, -45, 0)])
def test_the_couples_of_arms_are_couples(alpha: tuple[int, ...]) -> None:
    """The same for arms, over Q, Q(sqrt 3) and Q(sqrt 2)."""
    variety, mapping = reduced_map(exact_model(arm((1, 2, "3/2"), (0, 1, 0), alpha)))
    found = decide_surface(variety, mapping)
    assert found.verdict is Verdict.CUSPIDAL
    check_couples(found, mapping)


def check_couples(found: SurfaceDecision, mapping: PolynomialMap) -> None:
    """Value, distinctness, aspect and sign of every couple, to 300 bits."""
    numerator, _ = found.surface.chart(found.delta)
    assert found.couples
    saved, ctx.prec = ctx.prec, 300
    for couple in found.couples:
        places = [posture.coordinates(300) for posture in couple.postures]
        assert any(not a.overlaps(places[1][name]) for name, a in places[0].items())
        for place in places:
            for component, wanted in zip(mapping.components, couple.value, strict=True):
                assert (mapping.ring.evaluate(component, place) - wanted).contains(0)
        assert {p.sign(numerator) for p in couple.postures} == {couple.sign}
        assert len({found.graph.aspect(p) for p in couple.postures}) == 1
    ctx.prec = saved


def test_couples_are_exactly_the_pairs_in_one_aspect() -> None:
    """No pair is left out and none is invented."""
    variety, mapping = reduced_map(exact_model(arm((1, 3, 4), (0, 3, 0), (-90, 90, 0))))
    found = decide_surface(variety, mapping)
    pairs = sum(
        found.graph.aspect(a) == found.graph.aspect(b)
        for fiber in found.samples
        for a, b in combinations(fiber.postures, 2)
    )
    assert pairs == len(found.couples) > 0


def test_more_postures_than_aspects_is_cuspidal() -> None:
    """Pigeon-hole: 4 postures in 2 aspects."""
    found = decide_surface(
        *reduced_map(exact_model(arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))))
    )
    assert found.max_postures > found.aspects
    assert found.verdict is Verdict.CUSPIDAL


def test_degenerate_and_foreign_maps() -> None:
    """No rank, or not to the plane: an error that says which."""
    with pytest.raises(DegenerateMapError):
        run(PLANE, X + Y, (X + Y) ** 2)
    with pytest.raises(UnableError, match="maps to the plane"):
        run(PLANE, X)
    with pytest.raises(DegenerateMapError):
        run(CYLINDER, C, 2 * C)


def test_sample_values_avoid_what_is_special() -> None:
    """Every sample has all its postures in the charts, with simple roots."""
    found = run(PLANE, *BY_HAND["broken hyperbola"][0])
    for fiber in found.samples:
        derivative = fiber.polynomial.rational.derivative()
        assert fiber.polynomial.rational.gcd(derivative).degree() == 0
        for posture in fiber.postures:
            assert all(math.isfinite(float(ball.mid())) for ball in posture.chart(128))


def test_a_decision_over_a_field() -> None:
    """(x^3 - 2 sqrt 2 x + x y, y): the Whitney cusp, moved by an irrational amount."""
    ring = Ring(["x", "y"], 2)
    x, y = ring.gens
    mapping = PolynomialMap(ring, (x**3 - 2 * ring.surd * x + x * y, y))
    found = decide_surface(PolynomialSystem(ring), mapping)
    assert (found.verdict, found.aspects) == (Verdict.CUSPIDAL, 2)
    check_couples(found, mapping)


def test_a_hair_decides() -> None:
    """x^3 - 3 x + e x y: cuspidal as soon as e is not 0, however small."""
    for e, verdict in ((fmpq(0), "noncuspidal"), (fmpq(1, 10**8), "cuspidal")):
        found = run(PLANE, X**3 - 3 * X + e * X * Y, Y)
        assert found.verdict.value == verdict
