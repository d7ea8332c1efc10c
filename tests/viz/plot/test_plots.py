from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from cuspaudit.errors import InvalidInputError
from cuspaudit.viz.plot.data import (
    Aspect,
    Figures,
    JointPlane,
    Landscape,
    Leaf,
    Slice,
    ValuePlane,
)
from cuspaudit.viz.plot.files import figure, page_text, save_plot, svg_text
from cuspaudit.viz.plot.six_joints import landscape_sheet
from cuspaudit.viz.plot.style import RED
from cuspaudit.viz.plot.three_joints import LAYERS


def circle(radius: float) -> np.ndarray:
    """A closed polyline about the origin."""
    angles = np.linspace(0, 2 * np.pi, 60)
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def value() -> ValuePlane:
    """A plane of values made by hand."""
    return ValuePlane(
        labels=("ρ (m)", "z (m)"),
        window=(0.0, 2.0, -2.0, 2.0),
        curve=(circle(1.0),),
        points=np.array([[0.5, 0.5]]),
        cusps=np.array([[1.0, 0.0]]),
        nodes=np.array([[0.0, 1.0]]),
        samples=np.array([[0.4, 0.1]]),
        sample_postures=np.array([4]),
        focus=np.array([0.4, 0.1]),
        grid=np.array([[0, 2], [4, 16]]),
        beyond=0,
    )


def joint() -> JointPlane:
    """A plane of joints made by hand."""
    middle = np.zeros(2)
    return JointPlane(
        labels=("θ₂ (rad)", "d₃ (m)"),
        window=(-np.pi, np.pi, -1.0, 1.0),
        is_turn=(True, False),
        aspects=(
            Aspect(1, 1, (circle(0.9),), (circle(0.5),), middle),
            Aspect(2, -1, (circle(0.4),), (), middle),
        ),
        curve=(circle(0.9),),
        postures=np.array([[0.1, 0.2], [3, 1]]),
        posture_aspects=(1, 1),
        paths=(np.array([[0.1, 0.2], [3.0, 1.0]]),),
    )


def both() -> Figures:
    """Both planes of an arm with a hostile name."""
    title = "<script>alert('$x_1$')</script>: cuspidal"
    return Figures(title, ("Two & three.",), value(), joint())


@pytest.mark.parametrize("ending", [".png", ".svg", ".html"])
def test_each_format_is_written(ending: str, tmp_path: Path) -> None:
    """PNG, SVG and HTML files begin as such files do and are not empty."""
    path = tmp_path / f"planes{ending}"
    save_plot(both(), path)
    content = path.read_bytes()
    begins = {".png": b"\x89PNG", ".svg": b"<?xml", ".html": b"<!DOCTYPE html>"}
    assert content.startswith(begins[ending])
    assert len(content) > 10_000


def test_other_endings_and_folders_are_refused(tmp_path: Path) -> None:
    """An unknown ending and a missing folder are input errors that say what to do."""
    with pytest.raises(InvalidInputError, match=r"\.png, \.svg, \.html"):
        save_plot(both(), tmp_path / "planes.gif")
    with pytest.raises(InvalidInputError, match="folder that exists"):
        save_plot(both(), tmp_path / "nowhere" / "planes.html")


def test_marks_of_the_svg_say_what_they_are() -> None:
    """Cusp, sample point, posture and region each carry a title."""
    titles = {
        element.text or ""
        for element in ElementTree.fromstring(svg_text(both())).iter()
        if element.tag.endswith("title")
    }
    for begins in ("cusp at", "node at", "sample point", "posture A", "aspect 1"):
        assert any(title.startswith(begins) for title in titles), begins


def test_the_svg_is_the_same_every_time() -> None:
    """Two drawings of one arm are equal byte for byte."""
    assert svg_text(both()) == svg_text(both())


def test_the_page_stands_alone_and_a_name_is_only_a_name() -> None:
    """One script of our own, no link to elsewhere, and the arm's name is escaped."""
    page = page_text(both())
    assert page.count("<script") == 2
    assert "<script>alert" not in page
    assert "&lt;script&gt;" in page
    assert "Two &amp; three." in page
    assert 'src="http' not in page and 'href="http' not in page


def test_every_layer_that_is_drawn_can_be_hidden() -> None:
    """Each mark belongs to a layer, and each layer of this arm has its box."""
    side = np.array([[-1.0, -1.0], [-1.0, 1.0]])
    shown = replace(both(), joint=replace(joint(), limits=(side,)))
    page, svg = page_text(shown), svg_text(shown)
    for layer in LAYERS:
        assert f'id="{layer}-' in svg
        assert f'id="show-{layer}"' in page
    empty = replace(both(), joint=replace(joint(), paths=()))
    assert 'id="show-path"' not in page_text(empty)
    assert 'id="show-limits"' not in page_text(empty)


def test_the_page_knows_the_postures_of_every_cell() -> None:
    """The numbers of the grid are on the page, from the top, a digit a cell."""
    text = page_text(both()).split('id="sheet">')[1].split("</script>")[0]
    assert json.loads(text) == {"window": [0, 2, -2, 2], "cells": ["4g", "02"]}


def test_axes_are_labelled_and_lengths_are_to_scale() -> None:
    """Labels carry units; (rho, z) has equal scales; a turn has ticks at pi."""
    left, right = figure(both()).axes
    assert left.get_xlabel() == "ρ (m)"
    assert left.get_aspect() == 1.0
    assert [tick.get_text() for tick in right.get_xticklabels()][-1] == "π"
    assert right.get_box_aspect() == 1


def test_the_critical_curve_is_red_and_the_legend_names_everything() -> None:
    """The legend has the curve, cusps with their number, cells and both aspects."""
    left, right = figure(both()).axes
    assert left.lines[0].get_color() == RED
    names = [
        text.get_text()
        for axes in (left, right)
        for text in axes.get_legend().get_texts()
    ]
    for name in (
        *("critical values", "cusps: 1", "nodes: 1", "out of reach", "4 postures"),
        *("aspect 1, Delta > 0", "aspect 2, Delta < 0", "roadmap"),
        *("singular postures", "nonsingular path of a couple"),
    ):
        assert name in names


def plane(*lines: np.ndarray) -> Slice:
    """A plane made by hand."""
    return Slice(
        title="through N",
        labels=("θ₂ (rad)", "θ₃ (rad)"),
        window=(-1.0, 1.0, -1.0, 1.0),
        heights=np.linspace(-1, 1, 64).reshape(8, 8),
        marks={"N": np.array([0.1, 0.2])},
        lines=lines,
    )


def test_the_name_of_a_mark_stays_inside_the_plane() -> None:
    """At the upper right corner the name stands to the lower left of its mark."""
    corner = replace(plane(), marks={"N": np.array([3.1, 3.1])})
    drawing = figure(landscape_sheet(replace(hills(), slices=(corner,))))
    drawing.draw_without_rendering()
    axes = drawing.axes[1]
    (name,) = (text for text in axes.texts if text.get_text() == "N")
    inner, outer = name.get_window_extent(), axes.get_window_extent()
    assert inner.x1 < outer.x1
    assert inner.y1 < outer.y1


def hills() -> Landscape:
    """A landscape made by hand."""
    return Landscape(
        title="<b>hills</b>: cuspidal",
        notes=("Found in floating point.",),
        leaves=(Leaf(1.0, 1, 1), Leaf(0.5, 1, 1), Leaf(0.7, -1, 2)),
        branches=(
            np.array([[0, 1], [0, 0.2], [1, 0.2], [1, 0.5]]),
            np.array([[0.5, 0], [0.5, 0.2]]),
            np.array([[2, 0], [2, 0.7]]),
        ),
        joins=np.array([[0.5, 0.2]]),
        clearance=0.1,
        ends={"A": np.array([0, 0.4]), "B": np.array([1, 0.3])},
        slices=(plane(circle(0.5)), plane()),
    )


def test_a_landscape_has_its_tree_its_planes_and_its_layers() -> None:
    """Every mark says what it is, every layer has its box, the name is escaped."""
    page = page_text(landscape_sheet(hills()))
    for says in (
        *("saddle: two groups join at 0.2000", "maximum of |det J|: 0.5000"),
        *("clearance of the witness: 0.1000", "A, at 0.4000 of the largest"),
        *("det J &lt; 0, aspect 2", "N (0.100, 0.200)"),
    ):
        assert f"<title>{says}" in page.replace("maximum of |det J|: 0.7000, ", "")
    for layer in ("tree", "maxima", "heights", "singular", "path", "postures"):
        assert f'id="show-{layer}"' in page
    assert "<b>hills" not in page


def test_a_landscape_without_a_witness_has_no_path() -> None:
    """No clearance and no line: no box for a path."""
    bare = replace(hills(), clearance=None, ends={}, slices=(plane(),))
    assert 'id="show-path"' not in page_text(landscape_sheet(bare))
