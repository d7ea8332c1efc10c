from __future__ import annotations

import random
from itertools import product
from typing import Any

import pytest

from cuspaudit.algebra import msolve_points
from cuspaudit.algebra.points import zero_dimensional
from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.points.zero_dimensional import solve_zero_dimensional
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.errors import NotZeroDimensionalError, UnableError

RING = Ring(["x", "y"])
X, Y = RING.gens


def solved(
    *equations: Polynomial, nonzero: Polynomial | None = None
) -> ZeroDimensionalParametrization:
    """All solutions of the equations where ``nonzero`` does not vanish."""
    return solve_zero_dimensional(PolynomialSystem(RING, equations), nonzero=nonzero)


@pytest.mark.parametrize(
    ("equations", "degree", "real"),
    [
        ((X**2 + Y**2 - 25, 3 * X + 4 * Y), 2, 2),
        ((X**2 + Y**2 + 1, X - Y), 2, 0),
        ((X**2, X * Y, Y**2), 1, 1),
        ((X**3 - Y**2, X * Y), 1, 1),
        (((X - 1) ** 2, (Y**2 - 3 * Y) ** 3), 2, 2),
        ((X**2 - 1, Y**2 - 1), 4, 4),
        ((X**4 - 2, Y**2 - X), 8, 2),
        ((X, X - 1), 0, 0),
        ((X - Y, RING.constant(1)), 0, 0),
        ((X, Y), 1, 1),
    ],
)
def test_points_counted_by_hand(
    equations: tuple[Polynomial, ...], degree: int, real: int
) -> None:
    """Distinct points, complex and real; multiple ones once; the empty set."""
    found = solved(*equations)
    assert (found.degree, len(found.real_points())) == (degree, real)
    assert all(found.vanishes(RING, p) for p in equations)
    assert found.grounds


def test_nonzero_removes_a_curve() -> None:
    """On {xy = 0, x(x-1) = 0, x != 0} only (1, 0) is left of a line and a point."""
    found = solved(X * Y, X * (X - 1), nonzero=X)
    assert found.degree == 1 and found.contains((1, 0))
    assert found.variables == ("x", "y")


def test_infinitely_many_points_are_an_error() -> None:
    """A line, the plane, and a line left by ``nonzero``."""
    for equations, nonzero in (((X * Y,), None), ((), None), ((X * Y,), X)):
        with pytest.raises(NotZeroDimensionalError) as caught:
            solved(*equations, nonzero=nonzero)
        assert caught.value.dimension == (1 if equations else 2)


@pytest.fixture
def without_exact_bases(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every exact Groebner basis is too large: msolve must be asked."""

    def refuse(*_: Any) -> None:
        raise UnableError("groebner_basis", "refused by the test")

    monkeypatch.setattr(zero_dimensional, "groebner_basis", refuse)


def answering(monkeypatch: pytest.MonkeyPatch, answer: str) -> None:
    """Let msolve say ``answer`` whatever it is asked."""
    monkeypatch.setattr(msolve_points, "run_msolve", lambda *_: answer)


#: what msolve says of {x^2 = 2, y = x}, with t = 3 x
TRUE = """[0, [0, 3, 2, ['x0', 'x1', 't'], [0, 0, 1], [1,
[[2, [-18, 0, 1]], [1, [0, 2]], [[[1, [-12, 0]], 1], [[1, [-12, 0]], 1]]]]]]:"""


@pytest.mark.usefixtures("without_exact_bases")
def test_a_true_answer_is_proved_complete(monkeypatch: pytest.MonkeyPatch) -> None:
    """The two points (±√2, ±√2) are accepted, on a ground other than msolve."""
    answering(monkeypatch, TRUE)
    found = solved(X**2 - 2, Y - X)
    assert found.degree == 2 and found.vanishes(RING, X**2 - 2)
    assert found.grounds == ("Bezout number met",)
    assert solved(X**2 - 2, Y - X, X * Y - 2).grounds == (
        "rank of multiples modulo 2^61 - 1",
    )


@pytest.mark.usefixtures("without_exact_bases")
@pytest.mark.parametrize(
    ("answer", "why"),
    [
        (TRUE.replace("-12", "-11", 1), "does not solve"),
        (TRUE.replace("-12", "12", 1), "does not solve"),
        (TRUE.replace("-18", "-17"), "is wrong|does not solve"),
        (TRUE.replace("[-18, 0, 1]", "[0, 0, 1]"), "not square-free"),
        (TRUE.replace("[-18, 0, 1]", "[-18, 0]"), "unreadable|wrong|solve"),
        (TRUE[:-30], "unreadable"),
        (TRUE.replace("'x1'", "'z'"), "lacks a variable"),
        ("[1, 2, -1, []]:", "infinitely many"),
        ("[-1]:", "0 points found; not proved"),
        ("Segmentation fault", "unreadable"),
    ],
)
def test_a_wrong_answer_is_an_error(
    monkeypatch: pytest.MonkeyPatch, answer: str, why: str
) -> None:
    """An answer altered, cut or empty is refused, never returned."""
    answering(monkeypatch, answer)
    with pytest.raises(UnableError, match=why):
        solve_zero_dimensional(PolynomialSystem(RING, (X**2 - 2, Y - X)), timeout=1)


@pytest.mark.usefixtures("without_exact_bases")
@pytest.mark.parametrize("equations", [((X**2 - 2) * X, Y - X), (X**4 - 4, Y - X)])
def test_an_answer_without_all_points_is_refused(
    monkeypatch: pytest.MonkeyPatch, equations: tuple[Polynomial, ...]
) -> None:
    """Two points of three, or of four, solve the system and are not returned."""
    answering(monkeypatch, TRUE)
    with pytest.raises(UnableError, match="2 points found; not proved"):
        solve_zero_dimensional(PolynomialSystem(RING, equations), timeout=1)


@pytest.mark.usefixtures("without_exact_bases")
def test_many_points_on_a_curve_are_not_taken_for_all(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """(±√2, ±√2) on the line y = x are as many as Bezout allows, but not isolated."""
    answering(monkeypatch, TRUE)
    with pytest.raises(UnableError, match="not proved"):
        solve_zero_dimensional(
            PolynomialSystem(RING, (X - Y, (X - Y) * (X + 1))), timeout=1
        )


@pytest.mark.usefixtures("without_exact_bases")
def test_emptiness_is_proved_without_msolve_s_word() -> None:
    """1 is a combination of multiples of x y - 1, x and of x - 1, x modulo p."""
    for equations in ((X * Y - 1, X), (X - 1, X)):
        found = solved(*equations)
        assert found.degree == 0
        assert found.grounds == ("rank of multiples modulo 2^61 - 1",)


def dense(ring: Ring, degree: int, chosen: random.Random) -> Polynomial:
    """A polynomial with small random coefficients on every monomial."""
    powers = product(range(degree + 1), repeat=len(ring.variables))
    return ring.context.from_dict(
        {e: chosen.randint(-3, 3) for e in powers if sum(e) <= degree}
    )


@pytest.mark.parametrize("seed", range(6))
def test_both_routes_agree_on_random_systems(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Conics and cubics, two or three in the plane, cut with h != 0: the same sets."""
    chosen = random.Random(seed)
    system = [dense(RING, 2, chosen), dense(RING, 1 + seed % 3, chosen)]
    h = dense(RING, 1, chosen) if seed % 2 else None
    exact = solved(*system, nonzero=h)

    def refuse(*_: Any) -> None:
        raise UnableError("groebner_basis", "refused by the test")

    monkeypatch.setattr(zero_dimensional, "groebner_basis", refuse)
    other = solved(*system, nonzero=h)
    assert exact.grounds != other.grounds
    assert exact.same_points(other)


def test_critical_points_on_the_torus_are_all_found() -> None:
    """A function on the torus of degree (1, 1) has eight critical points in C."""
    ring = Ring(["c", "s", "C", "S"])
    c, s, big_c, big_s = ring.gens
    h = 3 * c * big_c - s * big_s + 2 * c * big_s + 5 * s - big_c + 7
    circles = (c**2 + s**2 - 1, big_c**2 + big_s**2 - 1)
    turned = (
        c * h.derivative("s") - s * h.derivative("c"),
        big_c * h.derivative("S") - big_s * h.derivative("C"),
    )
    system = PolynomialSystem(ring, (*circles, *turned))
    found = solve_zero_dimensional(system, nonzero=h)
    assert found.degree == 8
    assert found.vanishes_nowhere(ring, h)
    values = [point.sign(h, ring) for point in found.real_points()]
    assert values.count(1) >= 2


def test_names_of_the_user_do_not_matter() -> None:
    """Variables called A, t, v, x0 are solved for, by either route."""
    ring = Ring(["A", "t", "v", "x0"])
    a, t, v, x0 = ring.gens
    system = PolynomialSystem(ring, (a**2 - 2, t - a, v * t - 1, x0 - v))
    found = solve_zero_dimensional(system, nonzero=a - 5)
    assert found.variables == ring.variables and found.degree == 2
    other = msolve_points.msolve_points(ring, system.equations, ring.variables, 10, 1)
    assert other.same_points(found)


def test_only_rational_coefficients() -> None:
    """Over Q(sqrt 2) the solver says that it is unable."""
    ring = Ring(["x"], radicand=2)
    with pytest.raises(UnableError, match="sqrt2"):
        solve_zero_dimensional(PolynomialSystem(ring, (ring.gens[0] - ring.surd,)))
