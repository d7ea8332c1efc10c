"""Three-joint arms of the literature, and theorems about families of them."""

from __future__ import annotations

import json
import math
import random
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest
from short_tables import Number, arm, ask, numbers

from cuspaudit.algebra.numeric import numeric_values
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.ring import rational as flint_rational
from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.deciders.certify import find_witness
from cuspaudit.cuspidality.surface_path import posture_angles
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.geometry.crit import crit
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.kinematics.polynomial_map import reduced_map
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap
from cuspaudit.surface.graph_isotop import graph_isotop
from cuspaudit.surface.sample_points import sample_points

Row = tuple[Number, ...]
ISSAC = ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
FOUR_POSTURES = (
    (-2.8852048972, -2.9963502969, -0.2465089356),
    (-1.7799857728, -2.8236320365, 1.8411895544),
    (-0.8634020676, -0.6750230595, 2.4979711033),
    (0.1727026484, -0.3293582051, -1.8783542865),
)


def fraction(value: float) -> Fraction:
    """Two decimals, exactly."""
    return Fraction(round(value * 100), 100)


def wrapped(angles: np.ndarray) -> np.ndarray:
    """The angles in (-pi, pi]."""
    return np.remainder(angles + np.pi, 2 * np.pi) - np.pi


# the published arms ---------------------------------------------------------------

PUBLISHED = {
    # a, d, alpha (deg), (verdict, aspects, postures, cusps, nodes); None: not said
    "ISSAC 2022": (*ISSAC, ("cuspidal", 2, 4, 4, 0)),
    "ISSAC 2022 mirrored": (*ISSAC[:2], (90, -90, 0), ("cuspidal", 2, 4, 4, 0)),
    "WT1": ((1, ".7", ".3"), (0, ".2", 0), (-90, 90, 0), ("noncuspidal", 2, 2, 0, 0)),
    "WT2": ((1, "1.5", ".7"), (0, ".5", 0), (-90, 90, 0), ("cuspidal", 2, 4, 4, 2)),
    "WT5": ((1, 3, 4), (0, 3, 0), (-90, 90, 0), ("cuspidal", 5, 4, 2, 1)),
    "WT8": ((1, ".5", ".8"), (0, ".2", 0), (-90, 90, 0), ("noncuspidal", 4, 4, 0, 0)),
    "WT9": ((1, ".5", "1.3"), (0, ".2", 0), (-90, 90, 0), ("noncuspidal", 4, 4, 0, 2)),
    "fig. 20a": ((1, 2, 1), (0, 1, 0), (-30, 90, 0), ("cuspidal", 2, 4, 4, None)),
    "fig. 4b": (
        *((4, 2, 6), (0, 1, 0), (-90, 90, 0)),
        ("noncuspidal", None, None, None, None),
    ),
    "ARK 2022": (
        *((1, 2, "1.5"), (0, "2.828", ".5"), (30, 60, 0)),
        ("cuspidal", None, 4, 4, None),
    ),
    "8 cusps": (
        *((1, ".7", ".7"), (0, ".3", ".9"), (-90, 90, 0)),
        ("cuspidal", None, 4, 8, None),
    ),
    "a3 = 0.5, erratum 4": (
        *((1, 2, ".5"), (0, 1, 0), (-90, 90, 0)),
        ("cuspidal", None, 4, 4, None),
    ),
    "a3 = 0.1": (
        *((1, 2, ".1"), (0, 1, 0), (-90, 90, 0)),
        ("noncuspidal", 2, 2, 0, 0),
    ),
    "PUMA's arm": (
        *((0, ".4318", ".4331"), (0, ".15005", 0), (-90, 0, 0)),
        ("noncuspidal", None, 4, None, None),
    ),
    "the same with an offset": (
        *((".05", 1, ".9"), (0, ".3", 0), (-90, 0, 0)),
        ("noncuspidal", None, 4, None, None),
    ),
}


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_arms(name: str) -> None:
    """Verdict, aspects, postures, cusps and nodes are those of docs/facts.md."""
    a, d, alpha, expected = PUBLISHED[name]
    found = numbers(ask(arm(a, d, alpha)))
    for value, wanted in zip(found, expected, strict=True):
        assert wanted is None or value == wanted


def test_figure_20b_snapped_angle() -> None:
    """MMT 2022, figure 20b: noncuspidal with 4 postures, 4 aspects, 0 cusps."""
    chain, _ = snap(open_robot("salunkhe-2022-fig20b").chain)
    assert numbers(ask(chain))[:4] == ("noncuspidal", 4, 4, 0)


def test_the_four_postures_of_the_paper() -> None:
    """Over p = (2.5, 0, 0.5) the ISSAC arm has the four published postures."""
    chain = arm(*ISSAC)
    found = ask(chain)
    assert found.decision is not None
    value = (Fraction(5, 2) ** 2 + Fraction(1, 4), Fraction(1, 2))
    fiber = sample_points(
        found.decision.fibers, (flint_rational(value[0]), flint_rational(value[1]))
    )
    rest = [posture_angles(found.decision, p) for p in fiber.postures]
    assert len(rest) == 4
    for published in FOUR_POSTURES:
        distance = [np.abs(wrapped(p - np.array(published[1:]))).max() for p in rest]
        assert min(distance) < 1e-9
    graph = graph_isotop(found.decision.roadmap, found.decision.delta, fiber.postures)
    assert sorted(vertex[1] for vertex in graph.vert(fiber)) == [-1, -1, 1, 1]
    assert [graph.aspect(p) for p in fiber.postures].count(graph.aspects[0, 1]) == 2


@pytest.mark.parametrize(
    ("table", "published"),
    [
        (
            ISSAC,
            [(1.3555, 0.5047), (1.3555, -0.5047), (2.4656, 1.9987), (2.4656, -1.9987)],
        ),
        (
            ((1, 2, 1), (0, 1, 0), (-30, 90, 0)),
            [(1.4721, 0.8521), (1.762, 1.6871), (2.0817, 0.5825), (2.5197, 0.8558)],
        ),
    ],
    ids=["ISSAC 2022", "fig. 20a"],
)
def test_cusps_stand_at_the_published_points(
    table: tuple[Row, Row, Row], published: list[tuple[float, float]]
) -> None:
    """A numeric search finds the published cusps to 4 digits, as many as are proved."""
    chain = arm(*table)
    found = sorted((round(r, 6), round(z, 6)) for r, z in numeric_cusps(chain))
    assert np.allclose(found, sorted(published), atol=6e-5)
    assert numbers(ask(chain))[3] == len(found)


def numeric_cusps(chain: Chain) -> list[tuple[float, float]]:
    """(rho, z) where the image of the critical curve turns back on itself.

    The curve is walked in small steps of theta3, on both branches of
    det J = P cos theta2 + Q sin theta2 + S = 0.
    """
    theta3 = np.linspace(-np.pi, np.pi, 20001)

    def height(theta2: float) -> np.ndarray:
        return numeric(determinant, np.full_like(theta3, theta2))[:, 0]

    def numeric(polynomials: Sequence[Polynomial], theta2: np.ndarray) -> np.ndarray:
        columns = (np.cos(theta2), np.sin(theta2), np.cos(theta3), np.sin(theta3))
        return numeric_values(variety.ring, polynomials, np.stack(columns, axis=1))

    variety, mapping = reduced_map(exact_model(chain))
    determinant = crit(variety, mapping)
    ahead, back, side = height(0.0), height(np.pi), height(np.pi / 2)
    P, S = (ahead - back) / 2, (ahead + back) / 2
    Q = side - S
    found = []
    for sign in (1, -1):
        with np.errstate(invalid="ignore"):
            theta2 = np.arctan2(Q, P) + sign * np.arccos(-S / np.hypot(P, Q))
        image = numeric(mapping.components, theta2)
        steps = np.diff(image, axis=0)
        turned = np.flatnonzero((steps[1:] * steps[:-1]).sum(axis=1) < 0)
        found += [image[k + 1] for k in turned]
    return [(math.sqrt(u - v * v), v) for u, v in found]


# the closed form of orthogonal arms -----------------------------------------------


def surfaces(a2: float, d2: float) -> dict[str, float]:
    """The values of a3 at which an orthogonal arm changes its type."""
    A, B = math.hypot(a2 + 1, d2), math.hypot(a2 - 1, d2)
    S = a2 * a2 + d2 * d2
    inner = (S - (S * S - a2 * a2 + d2 * d2) / (A * B)) / 2
    return {
        "C1": math.sqrt(max(inner, 0)),
        "C2": a2 * A / (1 + a2),
        "C34": a2 * B / abs(a2 - 1),
        "E1": (A - B) / 2,
        "E2": a2,
        "E3": (A + B) / 2,
    }


def closed_form(a2: float, a3: float, d2: float) -> tuple[object, ...]:
    """(verdict, aspects, postures, cusps, nodes) by the table of docs/facts.md."""
    at = surfaces(a2, d2)
    if a3 < at["C1"]:
        zone, cusps, postures, nodes = 1, 0, 2, 0
    elif a3 < at["C2"]:
        nodes = 0 if at["E1"] < a3 < at["E2"] else 2
        zone, cusps, postures = 2, 4, 4
    elif a3 < at["C34"]:
        zone, cusps, postures, nodes = 3, 2, 4, 1 if a3 < at["E3"] else 3
    elif a2 > 1:
        zone, cusps, postures, nodes = 4, 4, 4, 4
    else:
        zone, cusps, postures, nodes = 5, 0, 4, 0 if a3 < at["E3"] else 2
    verdict = "cuspidal" if zone in (2, 3, 4) else "noncuspidal"
    aspects = 2 if a3 < a2 else {2: 6, 3: 5, 4: 6, 5: 4}[zone]
    return verdict, aspects, postures, cusps, nodes


def orthogonal_arms(seed: int, count: int) -> list[tuple[Fraction, Fraction, Fraction]]:
    """Random (a2, a3, d2) with two decimals, 0.03 away from every surface."""
    rng = random.Random(seed)
    found: list[tuple[Fraction, Fraction, Fraction]] = []
    while len(found) < count:
        a2, a3, d2 = (fraction(rng.uniform(*r)) for r in ((0.2, 3), (0.2, 4), (0.1, 2)))
        if abs(a2 - 1) < Fraction(1, 20):
            continue
        gaps = (abs(float(a3) - v) for v in surfaces(float(a2), float(d2)).values())
        if min(gaps) > 0.03:
            found.append((a2, a3, d2))
    return found


def check_closed_form(a2: Fraction, a3: Fraction, d2: Fraction) -> None:
    """The engine's five numbers are those of the closed form."""
    found = ask(arm((1, a2, a3), (0, d2, 0), (-90, 90, 0)))
    assert numbers(found) == closed_form(float(a2), float(a3), float(d2))


@pytest.mark.parametrize(("a2", "a3", "d2"), orthogonal_arms(1, 16))
def test_orthogonal_closed_form(a2: Fraction, a3: Fraction, d2: Fraction) -> None:
    """Random orthogonal arms have the five numbers of the closed form."""
    check_closed_form(a2, a3, d2)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2, 7))
def test_orthogonal_closed_form_many(seed: int) -> None:
    """Seventy more random orthogonal arms have the numbers of the closed form."""
    for a2, a3, d2 in orthogonal_arms(seed, 14):
        check_closed_form(a2, a3, d2)


def test_the_closed_form_reaches_every_workspace_type() -> None:
    """The random arms are of at least seven of the nine workspace types."""
    arms = [a for seed in range(1, 7) for a in orthogonal_arms(seed, 16)]
    types = {closed_form(*map(float, a))[2:] for a in arms}
    assert len(types) >= 7


# theorems -------------------------------------------------------------------------

TWISTS = (-90, -60, -45, -30, 30, 45, 60, 90)


def geometric_arms(seed: int) -> list[tuple[str, tuple[Row, Row, Row]]]:
    """Random members of the families that are noncuspidal by geometry."""
    rng = random.Random(seed)

    def length() -> Fraction:
        return fraction(rng.uniform(0.2, 2))

    def twist() -> int:
        return rng.choice(TWISTS)

    one = rng.choice((30, 60, 90))
    return [
        (
            "1 || 2",
            ((length(), length(), length()), (0, length(), length()), (0, 90, 0)),
        ),
        (
            "1 || 2, opposite",
            ((length(), length(), length()), (0, length(), length()), (180, -90, 0)),
        ),
        (
            "2 || 3",
            ((length(), length(), length()), (0, length(), length()), (twist(), 0, 0)),
        ),
        ("a1 = 0", ((0, length(), length()), (0, length(), length()), (-90, one, 0))),
        ("a2 = 0", ((length(), 0, length()), (0, length(), length()), (one, 90, 0))),
        (
            "alpha1 = 90, d2 = d3 = 0",
            ((length(), length(), length()), (0, 0, 0), (90, twist(), 0)),
        ),
        (
            "orthogonal, d2 = 0",
            ((length(), length(), length()), (0, 0, length()), (-90, 90, 0)),
        ),
    ]


GEOMETRIC = [pair for seed in (1, 2) for pair in geometric_arms(seed)]


@pytest.mark.parametrize("case", GEOMETRIC, ids=lambda case: case[0])
def test_noncuspidal_by_geometry(case: tuple[str, tuple[Row, Row, Row]]) -> None:
    """Wenger's geometric conditions give noncuspidal arms [Robotica 2007]."""
    assert ask(arm(*case[1])).verdict is Verdict.NONCUSPIDAL


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3, 15))
def test_noncuspidal_by_geometry_many(seed: int) -> None:
    """Eighty more random arms that are noncuspidal by geometry."""
    for name, table in geometric_arms(seed):
        assert ask(arm(*table)).verdict is Verdict.NONCUSPIDAL, name


def general_arms(seed: int, count: int) -> list[Chain]:
    """Random arms with no special number, twists not in a quadratic field."""
    rng = random.Random(seed)
    tables = []
    for _ in range(count):
        a = (1, fraction(rng.uniform(0.2, 2.5)), fraction(rng.uniform(0.2, 2.5)))
        d = (0, fraction(rng.uniform(-1.5, 1.5)), fraction(rng.uniform(-1.5, 1.5)))
        alpha = [rng.choice((-1, 1)) * rng.randrange(20, 160) for _ in range(2)]
        tables.append(arm(a, d, (*alpha, 0)))
    return tables


def check_generic_theorem(chain: Chain) -> None:
    """Cuspidal if and only if there is a cusp; at most 4 postures; parity."""
    found = ask(chain)
    assert found.cusps is not None
    assert found.cusps.proved == found.model.is_exact
    assert (found.verdict is Verdict.CUSPIDAL) == (found.cusps.count > 0)
    assert found.postures is not None
    assert found.postures.count <= 4
    check_parity(found)


def check_parity(found: Answer) -> None:
    """As many postures have det J > 0 as < 0 [facts, erratum 9]."""
    assert found.decision is not None
    for fiber in found.decision.samples:
        signs = [vertex[1] for vertex in found.decision.graph.vert(fiber)]
        assert sum(signs) == 0


@pytest.mark.parametrize("chain", general_arms(1, 8))
def test_generic_arms_are_cuspidal_exactly_with_a_cusp(chain: Chain) -> None:
    """A generic arm is cuspidal if and only if it has a cusp [MMT 2022]."""
    check_generic_theorem(chain)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2, 7))
def test_generic_arms_are_cuspidal_exactly_with_a_cusp_many(seed: int) -> None:
    """The same for forty more random general arms."""
    for chain in general_arms(seed, 8):
        check_generic_theorem(chain)


def test_parity_on_arms_with_special_numbers() -> None:
    """Over every sample value as many postures have det J > 0 as < 0."""
    for a, d, alpha, _ in PUBLISHED.values():
        check_parity(ask(arm(a, d, alpha)))


# arms hostile to sampling ---------------------------------------------------------

HOSTILE = [
    # a crossing of singular curves that a grid jumps through, opened by very little
    ((".05", 1, ".9"), (0, ".3", 0), (-90, 0, 0), "noncuspidal"),
    (("1/1000000000", 1, ".9"), (0, ".3", 0), (-90, 0, 0), "noncuspidal"),
    ((1, ".7", ".3"), (0, "1/1000000", 0), (-90, 90, 0), None),
    # a3 beside a2, a hair to either side: the aspects change from 2 to more
    ((1, 2, "1.999999"), (0, 1, 0), (-90, 90, 0), "cuspidal"),
    ((1, 2, "2.000001"), (0, 1, 0), (-90, 90, 0), "cuspidal"),
]


@pytest.mark.parametrize(("a", "d", "alpha", "verdict"), HOSTILE)
def test_arms_hostile_to_sampling(
    a: Row, d: Row, alpha: Row, verdict: str | None
) -> None:
    """Where a fine grid fails, the exact answer stands and a witness proves it."""
    found = ask(arm(a, d, alpha))
    assert verdict is None or found.verdict.value == verdict
    check_parity(found)
    if found.verdict is Verdict.CUSPIDAL:
        assert find_witness(found, found.model.chain).verification.accepted


def test_aspects_change_where_a3_passes_a2() -> None:
    """2 aspects for a3 < a2, 6 for a3 > a2, however near (zone 2)."""
    below, above = (
        ask(arm((1, 2, a3), (0, 1, 0), (-90, 90, 0)))
        for a3 in ("1.999999999", "2.000000001")
    )
    assert below.aspects is not None
    assert above.aspects is not None
    assert (below.aspects.count, above.aspects.count) == (2, 6)


def test_c1_is_sharp() -> None:
    """At C1 the arm turns cuspidal: decided 1e-6 below and above it."""
    c1 = surfaces(2, 1)["C1"]
    for step, verdict in ((-1e-6, Verdict.NONCUSPIDAL), (1e-6, Verdict.CUSPIDAL)):
        a3 = Fraction(str(round(c1 + step, 9)))
        assert ask(arm((1, 2, a3), (0, 1, 0), (-90, 90, 0))).verdict is verdict


# the witness of the paper ---------------------------------------------------------


def test_the_published_path_is_nonsingular() -> None:
    """The straight (theta2, theta3) segment of the paper keeps the sign of det J."""
    chain = arm(*ISSAC)
    path = np.linspace((-0.742, 2.628), (-3.0, -0.5), 400)
    signs = {np.sign(np.linalg.det(jacobian(chain, (0.0, *p)))) for p in path}
    assert len(signs) == 1


def test_published_postures_hold_the_tool_in_one_place() -> None:
    """The four postures of the jsonl have one tip position."""
    tips = [frames(arm(*ISSAC), p)[-1, :3, 3] for p in FOUR_POSTURES]
    assert np.allclose(tips, [2.5, 0, 0.5], atol=1e-9)


def test_json_numbers_stay_json() -> None:
    """The five numbers of an arm are plain and can be written down."""
    assert json.dumps(numbers(ask(arm(*ISSAC)))) == '["cuspidal", 2, 4, 4, 0]'


@pytest.mark.slow
def test_parallel_axes_and_a_twist_of_30_degrees() -> None:
    """Over Q(sqrt 3) with a discriminant that is not square-free (slow: 15 s)."""
    table = (("1.05", ".88", ".58"), (0, "1.08", "1.81"), (180, 30, 0))
    assert numbers(ask(arm(*table)))[:4] == ("noncuspidal", 4, 4, 0)
