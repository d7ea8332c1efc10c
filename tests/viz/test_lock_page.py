from __future__ import annotations

import math
import re
from itertools import pairwise
from typing import Any

import pytest

from cuspaudit.viz.lock_page import arcs_of, render_lock_page


def record(lower: float, upper: float, *cuts: float) -> dict[str, Any]:
    """A record with stretches that alternate between cuspidal and open."""
    ends = [lower, *cuts, upper]
    stretches = [
        {
            "lower": a,
            "upper": b,
            "verdict": "undecided" if k % 2 else "cuspidal",
            "proof": "none",
            "why": "<script>alert(1)</script>",
            "witness": None,
        }
        for k, (a, b) in enumerate(pairwise(ends))
    ]
    return {
        "robot": {"name": "arm", "joints": ["a", "b"], "task": "pose"},
        "joint": "a<b",
        "within_limits": False,
        "domain": {"lower": lower, "upper": upper},
        "verdict": "cuspidal",
        "why": "of 360 deg",
        "degrees": {"cuspidal": 300.0, "noncuspidal": 0.0, "open": 60.0},
        "stretches": stretches,
        "stopped": None,
    }


def test_an_arc_stands_at_the_angle_of_its_values() -> None:
    """0 is to the right and 90 deg on top; the arc ends where its stretch does."""
    [first, _] = arcs_of(record(0.0, math.pi, math.pi / 2))
    x, y = map(float, re.findall(r"M(\S+) (\S+)", first.path)[0])
    assert (x, y) == (150.0, 0.0)
    assert "L0.000 -116.000" in first.path
    assert first.label == "0° to 90°: cuspidal"


def test_a_whole_circle_and_more_than_a_turn() -> None:
    """A whole circle is drawn in two halves; what goes on is a smaller ring."""
    [whole] = arcs_of(record(-math.pi, math.pi))
    assert whole.path.count("M") == 2
    arcs = list(arcs_of(record(-2 * math.pi, 2 * math.pi)))
    assert len(arcs) == 2
    assert "A108 108" in arcs[1].path


def test_the_page_escapes_and_has_every_stretch() -> None:
    """Names and reasons are escaped; each stretch has an arc and a row."""
    page = render_lock_page(record(-1.0, 1.0, 0.0, 0.5), [None] * 3)
    assert "<script>alert" not in page
    assert "a&lt;b" in page
    assert page.count('<path class="arc') == 3
    assert page.count("<tr class=") == 3
    assert "http" not in re.sub(r"http-equiv|http://www.w3.org\S*", "", page)


@pytest.mark.parametrize("lower", [-math.pi, 0.0])
def test_no_arc_is_lost(lower: float) -> None:
    """The spans of the arcs add up to the domain, whatever the cuts."""
    cuts = [lower + 0.3, lower + 3.5, lower + 6.4]
    arcs = list(arcs_of(record(lower, lower + 7.0, *cuts)))
    assert {arc.stretch for arc in arcs} == {0, 1, 2, 3}
