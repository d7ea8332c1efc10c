from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.count import Count
from cuspaudit.errors import CrossCheckError, InvalidInputError, UnableError
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.pictures.critical_curve import pieces, trace, wall_pieces
from cuspaudit.pictures.figures import figures
from cuspaudit.pictures.joint_surface import JointSurface
from cuspaudit.pictures.value_plane import count_postures
from cuspaudit.robot.library import open_robot
from cuspaudit.robot.snapping import snap
from cuspaudit.viz.plot.data import Figures

ISSAC = "chablat-2022-3r-mirror"
ARMS = (
    *(ISSAC, "chablat-2022-3r", "baili-2004-wt1", "baili-2004-wt2", "baili-2004-wt5"),
    *("baili-2004-wt9", "salunkhe-2022-fig4b", "wenger-2007-8-cusps"),
    *("puma-560-arm", "anthropomorphic-offset", "kuka-kr-6-r900", "abb-irb-120"),
)
CUSPS = {
    ISSAC: [(1.3555, -0.5047), (1.3555, 0.5047), (2.4656, -1.9987), (2.4656, 1.9987)],
    "salunkhe-2022-fig20a": [
        *((1.4721, 0.8521), (1.762, 1.6871), (2.0817, 0.5825), (2.5197, 0.8558)),
    ],
}
SLIDES = {
    "PRR": "- {type: prismatic, a: 1, alpha: pi/2, theta: 0}\n"
    "  - {type: revolute, a: 2, alpha: pi/2, d: 1}\n"
    "  - {type: revolute, a: 3/2, alpha: 0, d: 0}",
    "RPR": "- {type: revolute, a: 1, alpha: pi/2, d: 0}\n"
    "  - {type: prismatic, a: 1, alpha: pi/2, theta: pi/6}\n"
    "  - {type: revolute, a: 1, alpha: 0, d: 0}",
    "RRP": "- {type: revolute, a: 1, alpha: pi/2, d: 0}\n"
    "  - {type: revolute, a: 1, alpha: pi/2, d: 1}\n"
    "  - {type: prismatic, a: 0, alpha: 0, theta: 0}",
}


@cache
def answer_of(name: str) -> Answer:
    """The exact answer for a robot of the library."""
    return answer(exact_model(snap(open_robot(name).chain)[0]))


@cache
def drawn(name: str) -> Figures:
    """Its figures."""
    return figures(answer_of(name))


def surface_of(found: Answer) -> JointSurface:
    """The surface of joints 2 and 3 of an answer."""
    reduction = found.reduction
    model = found.model if reduction is None else reduction.regional
    assert found.decision is not None and model is not None
    return JointSurface(found.decision, model)


def slide(kinds: str, folder: Path) -> Answer:
    """The answer for an arm with a prismatic joint."""
    path = folder / f"{kinds}.yaml"
    path.write_text(
        f"name: {kinds}\nconvention: standard\nunits: m\ntask: position\n"
        f"joints:\n  {SLIDES[kinds]}\n"
    )
    return answer(exact_model(open_robot(path).chain))


@pytest.mark.parametrize("name", CUSPS)
def test_published_cusps_are_found_and_lie_on_the_drawn_curve(name: str) -> None:
    """The four published cusps are located to 4 digits, on the curve that is drawn."""
    plane = drawn(name).value
    found = plane.cusps[np.lexsort(plane.cusps.round(3).T[::-1])]
    assert np.abs(found - CUSPS[name]).max() < 6e-5
    curve = np.vstack(plane.curve)
    for cusp in found:
        assert np.linalg.norm(curve - cusp, axis=1).min() < 0.02


@pytest.mark.parametrize("name", ARMS)
def test_every_drawn_point_is_singular_and_its_value_critical(name: str) -> None:
    """On the traced curve Delta = 0 and the map has rank below 2, to rounding."""
    surface = surface_of(answer_of(name))
    for piece in [*pieces(surface), *wall_pieces(surface)]:
        _, points = trace(piece)
        slopes = surface.slopes(points)[:, :, 1:]
        scale = max(1.0, float(np.abs(slopes).max()))
        assert np.abs(surface.delta(points)).max() < 1e-11 * scale**2
        assert np.abs(np.linalg.det(slopes)).max() < 1e-10 * scale**2


@pytest.mark.parametrize("name", ARMS)
def test_what_is_drawn_has_the_proved_numbers(name: str) -> None:
    """Aspects, cusps, nodes and postures are as many as the exact engine proves."""
    found, shown = answer_of(name), drawn(name)
    decision = found.decision
    assert decision is not None and found.cusps is not None and found.nodes is not None
    assert len(shown.joint.aspects) == decision.aspects
    assert len(shown.value.cusps) == found.cusps.count
    assert len(shown.value.nodes) == found.nodes.count
    assert len(shown.joint.postures) == decision.max_postures
    assert bool(shown.joint.paths) == bool(decision.couples)


@pytest.mark.parametrize("name", ARMS)
def test_regions_of_an_aspect_have_its_sign_and_fill_the_torus(name: str) -> None:
    """Delta has the aspect's sign on its roadmap, and all areas add up to 4 pi^2."""
    found, shown = answer_of(name), drawn(name)
    surface, area = surface_of(found), 0.0
    zeros = surface.joint_values(np.zeros((1, 2)))
    seen: set[tuple[float, ...]] = set()
    for aspect in shown.joint.aspects:
        for line in aspect.roadmap:
            points = surface.points_at(line - zeros)[1:-1]
            assert (aspect.sign * surface.delta(points) > -1e-12).all()
        for polygon in aspect.regions:
            x, y = (polygon - polygon[0]).T
            key = (*np.round(np.exp(1j * polygon.mean(axis=0)), 6), round(x @ y, 6))
            if key not in seen:
                seen.add(key)
                area += abs(x @ np.roll(y, 1) - y @ np.roll(x, 1)) / 2
    assert area == pytest.approx(4 * np.pi**2, rel=1e-3)


@pytest.mark.parametrize("name", ARMS)
def test_sample_points_are_off_the_curve_and_counted_alike(name: str) -> None:
    """No sample value is critical, and the background has its proved postures."""
    found, plane = answer_of(name), drawn(name).value
    surface = surface_of(found)
    counted = count_postures(surface, surface.values_at(plane.samples))
    assert counted.tolist() == plane.sample_postures.tolist()
    curve = np.vstack([*plane.curve, plane.points])
    for sample in plane.samples:
        assert np.linalg.norm(curve - sample, axis=1).min() > 1e-6


@pytest.mark.parametrize("name", [ISSAC, "baili-2004-wt5", "salunkhe-2022-fig20a"])
def test_the_drawn_path_joins_two_postures_off_the_red_curve(name: str) -> None:
    """Along the path Delta keeps its sign, and its ends are two of the postures."""
    surface, shown = surface_of(answer_of(name)), drawn(name).joint
    zeros = surface.joint_values(np.zeros((1, 2)))
    path = surface.points_at(shown.paths[0] - zeros)
    fine = np.linspace(0, len(path) - 1, 2000)
    dense = np.stack([np.interp(fine, range(len(path)), c) for c in path.T], axis=1)
    heights = surface.delta(dense)
    assert abs(np.sign(heights).sum()) == len(heights)
    for end in (shown.paths[0][0], shown.paths[0][-1]):
        turned = np.abs(np.exp(1j * end) - np.exp(1j * shown.postures)).max(axis=1)
        assert turned.min() < 1e-9


def test_the_postures_of_the_published_point_can_be_drawn() -> None:
    """At (2.5, 0.5) the four postures are the published ones, two in each aspect."""
    shown = figures(answer_of(ISSAC), (Fraction(5, 2), Fraction(1, 2)))
    published = {(-2.99635, -0.24651), (-2.82363, 1.84119), (-0.67502, 2.49797)}
    published |= {(-0.32936, -1.87835)}
    assert {tuple(p) for p in shown.joint.postures.round(5).tolist()} == published
    assert sorted(shown.joint.posture_aspects) == [1, 1, 2, 2]
    assert shown.value.focus.tolist() == [2.5, 0.5]


def test_points_without_postures_or_on_the_curve_are_refused() -> None:
    """A point out of reach and a critical one are named, with what to do."""
    with pytest.raises(InvalidInputError, match="out of reach"):
        figures(answer_of(ISSAC), (Fraction(50), Fraction(1, 3)))
    with pytest.raises(InvalidInputError, match="near it"):
        figures(answer_of("puma-560-arm"), (Fraction("0.15005"), Fraction(0)))


def test_a_wrong_count_is_a_cross_check_error() -> None:
    """One cusp more than there are is noticed before anything is drawn."""
    wrong = replace(answer_of(ISSAC), cusps=Count(5, True))
    with pytest.raises(CrossCheckError, match="4 cusps"):
        figures(wrong)


def test_an_arm_that_no_three_joints_decide_is_refused() -> None:
    """UR5 is settled by a theorem: there is nothing to draw."""
    with pytest.raises(UnableError, match="plot"):
        figures(answer_of("ur5"))


@pytest.mark.parametrize("kinds", SLIDES)
def test_arms_with_a_slide_are_drawn(kinds: str, tmp_path: Path) -> None:
    """A slide gives a line: finite curves, its own labels, as many aspects."""
    found = slide(kinds, tmp_path)
    shown = figures(found)
    assert found.aspects is not None
    assert len(shown.joint.aspects) == found.aspects.count
    assert all(np.isfinite(line).all() for line in (*shown.value.curve,))
    assert all(np.isfinite(line).all() for line in (*shown.joint.curve,))
    assert ("across" in shown.value.labels[0]) == (kinds[0] == "P")
    assert sum("(m)" in label for label in shown.joint.labels) == kinds[1:].count("P")
