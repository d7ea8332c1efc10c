from __future__ import annotations

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.errors import NotSquareError
from cuspaudit.geometry.lifts.continuation import continue_point

PLANE = Ring(["x", "y"])
SPACE = Ring(["x", "y", "z"])
x, y = PLANE.gens
X, Y, Z = SPACE.gens
SQUARE = PolynomialMap(PLANE, (x**2 - y**2, 2 * x * y))
SPHERE = PolynomialSystem(SPACE, (X**2 + Y**2 + Z**2 - 1,))
SHADOW = PolynomialMap(SPACE, (X, Y))


def path(*values: tuple[float, ...]) -> list[list[fmpq]]:
    """Way points with rational coordinates in hundredths."""
    return [[fmpq(round(100 * v), 100) for v in value] for value in values]


def point(*coordinates: float) -> list[arb]:
    """An exact point."""
    return [arb(c) for c in coordinates]


def close(box: tuple[arb, ...], *expected: float) -> bool:
    """Whether the small box is that of the point ``expected``."""
    return all(abs(b - e) < 1e-12 for b, e in zip(box, expected, strict=True))


def test_a_loop_round_the_branch_point_changes_the_square_root() -> None:
    """Once round 0 the root of z^2 becomes its negative; twice, and it is back."""
    loop = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 0)]
    once = continue_point(PolynomialSystem(PLANE), SQUARE, point(1, 0), path(*loop))
    assert once is not None
    assert close(once.end, -1, 0)
    again = path(*loop, *loop[1:])
    twice = continue_point(PolynomialSystem(PLANE), SQUARE, point(1, 0), again)
    assert twice is not None
    assert close(twice.end, 1, 0)
    assert close(twice.points[4], -1, 0)


def test_a_path_through_a_critical_value_is_not_proved() -> None:
    """Straight through 0, or to the fold x = 0 and no further: no lift."""
    plane = PolynomialSystem(PLANE)
    across = path((1, 0), (-1, 0))
    assert continue_point(plane, SQUARE, point(1, 0), across) is None
    fold = PolynomialMap(PLANE, (x**2, y))
    assert continue_point(plane, fold, point(1, 0), path((1, 0), (0, 0))) is None


def test_close_to_a_critical_value_the_steps_shrink() -> None:
    """Past 0 at a millionth: proved, and by the side on which the path passes."""
    for side in (-1, 1):
        way = [[fmpq(1), fmpq(0)], [fmpq(-1), fmpq(side, 10**6)]]
        done = continue_point(PolynomialSystem(PLANE), SQUARE, point(1, 0), way)
        assert done is not None
        assert done.end[1] * side > 0.999


def test_the_lift_on_the_sphere_is_the_square_root() -> None:
    """Over (3/5, 0) from the north pole: z = 4/5, enclosed to many digits."""
    done = continue_point(SPHERE, SHADOW, point(0, 0, 1), path((0, 0), (0.6, 0)))
    assert done is not None
    assert close(done.end, 0.6, 0, 0.8)
    with ctx.workprec(200):
        assert done.end[2].contains(arb(fmpq(4, 5)))
    assert done.end[2].rad() < 1e-18
    assert all(box[2] > 0 for box in done.boxes)


def test_the_sphere_by_two_equations() -> None:
    """A redundant equation, singular on the sphere's equator x = 0, changes nothing."""
    twice = PolynomialSystem(SPACE, (X * SPHERE.equations[0], SPHERE.equations[0]))
    done = continue_point(twice, SHADOW, point(0, 0, -1), path((0, 0), (0.6, 0)))
    assert done is not None
    assert close(done.end, 0.6, 0, -0.8)


def test_a_field_with_a_square_root() -> None:
    """On the line y = sqrt2 x: the lift of the value 3 of x y."""
    ring = Ring(["x", "y"], radicand=2)
    a, b = ring.gens
    line = PolynomialSystem(ring, (b - ring.surd * a,))
    start = [arb(1), arb(2).sqrt()]
    map_ = PolynomialMap(ring, (a,))
    done = continue_point(line, map_, start, path((1,), (3,)))
    assert done is not None
    assert abs(done.end[1] - 3 * arb(2).sqrt()) < 1e-12


def test_a_start_that_is_not_one_point_is_refused() -> None:
    """A ball with both square roots of 1, and a ball with none."""
    line = Ring(["t"])
    t = line.gens[0]
    both = PolynomialMap(line, (t**2,))
    assert continue_point(PolynomialSystem(line), both, [arb(0, 2)], path((1,))) is None
    none = [arb(3, 0.1)]
    assert continue_point(PolynomialSystem(line), both, none, path((1,))) is None


def test_too_few_equations() -> None:
    """Two coordinates of three need one equation."""
    with pytest.raises(NotSquareError):
        continue_point(PolynomialSystem(SPACE), SHADOW, point(0, 0, 0), path((0, 0)))


@settings(max_examples=15, deadline=None)
@given(st.lists(st.tuples(*[st.integers(-60, 60)] * 2), min_size=1, max_size=3))
def test_there_and_back_is_the_start(places: list[tuple[int, int]]) -> None:
    """A lift followed back along its own path ends where it began."""
    values = [[fmpq(a, 100), fmpq(b, 100)] for a, b in [(0, 0), *places]]
    done = continue_point(SPHERE, SHADOW, point(0, 0, 1), [*values, *reversed(values)])
    assert done is not None
    assert close(done.end, 0, 0, 1)
