from __future__ import annotations

import pytest
from flint import fmpq

from cuspaudit.algebra.polynomial_text import parse_polynomial
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.decision import decide
from cuspaudit.cuspidality.decision_result import Decision
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import InvalidSystemError, UnableError
from cuspaudit.geometry.angles import check_angles, rolled, unrolled
from cuspaudit.geometry.crit import crit

Text = tuple[str, list[str], list[str], list[tuple[str, str]]]

CIRCLE = "c^2 + s^2 - 1"
FIVE_BAR = [
    *("a^2 + b^2 - 1", CIRCLE),
    *("(x - 2*a)^2 + (y - 2*b)^2 - 9", "(x - 3 - 2*c)^2 + (y - 2*s)^2 - 9"),
]


def system(text: Text) -> tuple[PolynomialSystem, PolynomialMap]:
    """V and R from variables, equations, components and angles."""
    variables, equations, components, angles = text
    ring = Ring(variables.split())

    def read(p: str) -> object:
        return parse_polynomial(ring, p)

    return (
        PolynomialSystem(ring, tuple(map(read, equations))),
        PolynomialMap(
            ring,
            tuple(map(read, components)),
            tuple((read(c), read(s)) for c, s in angles),
        ),
    )


def run(text: Text) -> Decision:
    """The decision of a map given as text."""
    return decide(*system(text))


def test_the_row_of_an_angle_is_its_differential() -> None:
    """d(theta) = c ds - s dc, twice that for the doubled angle."""
    for angle, factor in ((("c", "s"), 1), (("c^2 - s^2", "2*c*s"), 2)):
        variety, mapping = system(("c s", [CIRCLE], [], [angle]))
        (minor,) = crit(variety, mapping)
        point = {"c": fmpq(3, 5), "s": fmpq(4, 5)}
        value = variety.ring.substitute(minor, point)
        assert value == 2 * factor


def test_a_circle_onto_itself_is_noncuspidal() -> None:
    """The identity of the circle is one to one: one aspect and one posture."""
    found = run(("c s", [CIRCLE], [], [("c", "s")]))
    assert found.verdict is Verdict.NONCUSPIDAL
    assert (found.components, found.most_points) == (1, 1)


def test_the_double_turn_is_cuspidal() -> None:
    """Theta -> 2 theta has no singularity and two points everywhere.

    A half-angle chart would cut the circle, and find noncuspidal.
    """
    found = run(("c s", [CIRCLE], [], [("c^2 - s^2", "2*c*s")]))
    assert found.verdict is Verdict.CUSPIDAL
    assert found.components == 1
    assert found.couple is not None
    assert len(found.couple.points[0].parametrization.variables) == 2


def test_a_fold_beside_a_turn_is_noncuspidal() -> None:
    """(theta, x^2): the two points have x of opposite signs."""
    found = run(("c s x", [CIRCLE], ["x^2"], [("c", "s")]))
    assert found.verdict is Verdict.NONCUSPIDAL
    assert (found.components, found.most_points) == (2, 2)


def test_a_cusp_beside_a_turn_is_found_first() -> None:
    """(theta, x^3 + x y, y) is the Whitney cusp times a circle."""
    found = run(("c s x y", [CIRCLE], ["x^3 + x*y", "y"], [("c", "s")]))
    assert found.engine == "couple"
    assert found.verdict is Verdict.CUSPIDAL


@pytest.mark.slow
def test_the_cranks_of_a_five_bar_have_two_assembly_modes() -> None:
    """The sign of Delta parts the two assembly modes, whatever the aspects are."""
    found = run(("a b c s x y", FIVE_BAR, [], [("a", "b"), ("c", "s")]))
    assert found.verdict is Verdict.NONCUSPIDAL
    assert found.most_points == 2
    assert found.most_is_proved


def test_what_is_no_angle_is_refused() -> None:
    """The pair (c, x) is on no circle."""
    with pytest.raises(InvalidSystemError, match="must follow from the equations"):
        check_angles(*system(("c s x", [CIRCLE], [], [("c", "x")])))


def test_the_roadmap_is_not_glued() -> None:
    """Asked for the roadmap, an angle is undecided and the reason said."""
    found = decide(*system(("c s", [CIRCLE], [], [("c", "s")])), "roadmap")
    assert isinstance(found.failure, UnableError)
    assert "angles" in str(found.failure)


def test_charts_and_values_fit() -> None:
    """The value of t = 1/2 is (3/5, 4/5), and V' has it over that point alone."""
    variety, mapping = system(("c s x", [CIRCLE], ["x"], [("c", "s")]))
    assert rolled(mapping, [fmpq(7), fmpq(1, 2)]) == (7, fmpq(3, 5), fmpq(4, 5))
    larger, charted = unrolled(variety, mapping)
    assert larger.ring.variables == ("c", "s", "x", "t1")
    at = {"c": fmpq(-1), "s": fmpq(0)}
    left = [larger.ring.substitute(f, at) for f in larger.equations]
    assert any(f != 0 and f.is_constant() for f in left)
    assert [str(r) for r in charted.components] == ["x", "t1"]
