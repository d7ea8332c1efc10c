from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.pictures.landscape import landscape, picture_of
from cuspaudit.robot.library import open_robot
from cuspaudit.viz.plot.data import Figures, Landscape


@cache
def audited(name: str) -> FinishedAudit:
    """The audit of a robot of the library."""
    return audit(open_robot(name))


@cache
def drawn(name: str) -> Landscape:
    """Its landscape."""
    return landscape(audited(name))


@pytest.mark.parametrize("name", ["ur5", "fanuc-crx-10ia-l"])
def test_the_tree_has_as_many_roots_as_there_are_aspects(name: str) -> None:
    """Branches that reach 0 are the aspects; each leaf says which one it is in."""
    shown, aspects = drawn(name), audited(name).answer.aspects
    assert aspects is not None and aspects.proved
    roots = [line for line in shown.branches if line[:, 1].min() == 0]
    assert len(roots) == aspects.count
    assert {leaf.aspect for leaf in shown.leaves} == set(range(1, aspects.count + 1))


def test_an_aspect_has_one_sign_and_no_leaf_between_those_of_another() -> None:
    """The leaves of an aspect stand together, and det J has one sign at them."""
    leaves = drawn("fanuc-crx-10ia-l").leaves
    numbers = [leaf.aspect for leaf in leaves]
    assert numbers == sorted(numbers)
    assert len({(leaf.aspect, leaf.sign) for leaf in leaves}) == 2
    assert max(leaf.level for leaf in leaves) == pytest.approx(1)


def test_the_saddles_of_a_crx_are_the_published_ones() -> None:
    """Maxima join at 0.0588, the groups at 0.0188 of the largest |det J|."""
    levels = np.sort(drawn("fanuc-crx-10ia-l").joins[:, 1])
    assert levels.round(4).tolist() == [0.0188] * 2 + [0.0588] * 4


def test_the_branches_of_the_tree_only_fall() -> None:
    """A join is below all that it joins."""
    for line in drawn("fanuc-crx-10ia-l").branches:
        assert line[:, 1].min() <= min(line[0, 1], line[-1, 1])
        if len(line) == 4:
            assert line[1, 1] == line[2, 1] == line[:, 1].min()


def test_the_witness_stands_in_one_tree_above_its_clearance() -> None:
    """Both ends climb to maxima of one aspect, and are no lower than the clearance."""
    shown = drawn("fanuc-crx-10ia-l")
    assert shown.clearance is not None
    leaves = [shown.leaves[int(place[0])] for place in shown.ends.values()]
    assert leaves[0].aspect == leaves[1].aspect
    assert min(p[1] for p in shown.ends.values()) > 0.99 * shown.clearance


def test_the_plane_through_the_path_holds_its_ends_in_one_sign() -> None:
    """At A, N and B the drawn det J has the sign of the witness."""
    shown, witness = drawn("fanuc-crx-10ia-l"), audited("fanuc-crx-10ia-l").witness
    assert witness is not None
    plane = shown.slices[0]
    left, right, bottom, top = plane.window
    for place in plane.marks.values():
        share = (place - (left, bottom)) / (right - left, top - bottom)
        column, row = (share * plane.heights.shape[0]).astype(int)
        assert np.sign(plane.heights[row, column]) == witness.sign


def test_slices_without_a_path_go_through_a_maximum() -> None:
    """Nothing in the plane is higher than the mark."""
    for plane in drawn("ur5").slices:
        assert np.abs(plane.heights).max() == pytest.approx(1, abs=1e-3)
        assert not plane.lines


def test_a_plane_says_where_the_other_joints_stand() -> None:
    """The joints that a plane does not turn are in its title, at the mark's angles."""
    first, second, third = drawn("ur5").slices
    (two, three), (_, four), (_, five) = (p.marks["M"] for p in (first, second, third))
    for plane, held in (
        (first, {"₄": four, "₅": five}),
        (second, {"₂": two, "₅": five}),
        (third, {"₂": two, "₃": three}),
    ):
        said = ", ".join(f"θ{k} = {angle:.2f}" for k, angle in held.items())
        assert plane.title.endswith("\n" + said.replace("-", "−") + " rad")
    across = drawn("fanuc-crx-10ia-l").slices[0].title
    assert "N: θ₂ = " in across
    assert across.count("=") == 4


def test_an_arm_is_drawn_by_what_decides_it() -> None:
    """A spherical wrist gives the planes of its three joints, a UR5 its landscape."""
    wrist = picture_of(open_robot("puma-560"), None, Options())
    assert isinstance(wrist, Figures)
    assert isinstance(picture_of(open_robot("ur5"), None, Options()), Landscape)
