from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from flint import arb, fmpq

from cuspaudit.algebra.common_form import common_forms
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.geometry.torus.walls import Walls

RING = Ring(["c", "s"])
C, S = RING.gens


def walls(function: Polynomial) -> Walls:
    """The zeros of a function on the circle."""
    forms = common_forms(RING, [("c", "s")], function, function)
    return Walls(RING, ("c", "s"), tuple(forms))


FUNCTIONS = {
    "positive": 2 + C,
    "cosine": C,
    "sine": S,
    "touching pi": 1 + C,
    "touching 0": 1 - C,
    "four": (5 * C - 3) * (13 * S - 5),
    "five": (5 * C - 3) * (13 * S - 5) * (1 + C),
}
ZEROS = {"positive": 0, "cosine": 2, "sine": 2, "touching pi": 1, "touching 0": 1}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_arcs_are_numbered_along_the_circle(name: str) -> None:
    """Once round, the arc changes as often as there are zeros, and never back."""
    wall = walls(FUNCTIONS[name])
    zeros = ZEROS.get(name, 5 if name == "five" else 4)
    assert wall.number_of_arcs == max(1, zeros)
    turns = np.linspace(-np.pi + 0.003, np.pi - 0.003, 400)
    arcs = [wall.arc(arb(float(np.cos(t))), arb(float(np.sin(t)))) for t in turns]
    assert set(arcs) == set(range(wall.number_of_arcs))
    changes = sum(a != b for a, b in pairwise(arcs))
    around = arcs[0] != arcs[-1]
    assert changes + around == (zeros if zeros > 1 else 0)


def test_the_point_without_tangent_lies_in_the_arc_across_it() -> None:
    """The point pi is in one arc with its neighbours unless it is a zero."""
    near = (arb(fmpq(-1)), arb(0, 1e-12))
    assert walls(FUNCTIONS["cosine"]).arc(*near) == 0
    assert walls(2 + C).arc(*near) == 0
    assert walls(S).arc(*near) is None


def test_a_ball_on_a_zero_lies_in_no_arc() -> None:
    """A ball that meets a zero is not placed."""
    assert walls(C).arc(arb(0, 1e-9), arb(1)) is None
