from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from cuspaudit.auditing.systems.file import read_system
from cuspaudit.errors import InvalidInputError
from cuspaudit.parallel.mechanism import Mechanism
from cuspaudit.parallel.reading import is_mechanism, mechanism_from_entries

LENGTH = {"kind": "length", "base": ["0", "0"], "anchor": ["1/2", "0"]}
CRANK = {"kind": "crank", "base": ["0", "0"], "arm": "1", "rod": "3/2"}
SLIDER = {"kind": "slider", "base": ["0", "0"], "along": ["0", "1"], "rod": "2"}
OWN = sorted((Path(__file__).parents[2] / "mechanisms").glob("*.yaml"))


def read(legs: object, **entries: object) -> Mechanism:
    """A planar mechanism with these legs, its platform a point."""
    given = {"mechanism": "planar", "platform": "point", "legs": legs} | entries
    return mechanism_from_entries("m.yaml", given)


def test_numbers_are_exact_and_what_is_missing_has_its_default() -> None:
    """A rod of 3/2 is that; the problem is the direct one; the name is the file's."""
    found = read([CRANK, SLIDER])
    assert found.legs[0].rod == Fraction(3, 2)
    assert found.legs[1].along == (0, 1)
    assert (found.problem, found.name, found.freedoms) == ("direct", "m", 2)


def test_a_fixed_leg_takes_a_freedom() -> None:
    """Three legs of a body, one with a rod: two freedoms and two actuators."""
    found = read([{**LENGTH, "rod": "2"}, LENGTH, LENGTH], platform="body")
    assert found.freedoms == 2
    assert [leg.is_actuated for leg in found.legs] == [False, True, True]


@pytest.mark.parametrize(
    ("legs", "entries", "message"),
    [
        ([CRANK], {}, "1 actuated legs for a platform with 2 freedoms"),
        ([CRANK, CRANK, CRANK], {}, "3 actuated legs"),
        ([CRANK, {**CRANK, "rod": "0"}], {}, r"legs\[1\] rod: no length"),
        ([CRANK, {**CRANK, "rod": "-2"}], {}, "write a positive number"),
        ([CRANK, {**SLIDER, "along": ["0", "0"]}], {}, "no direction"),
        ([CRANK, {**CRANK, "base": ["0"]}], {}, r"write 2 numbers: \[0, 0\]"),
        ([CRANK, {**CRANK, "base": ["0", "x"]}], {}, "a length such as"),
        ([CRANK, {**CRANK, "anchor": ["0", "0"]}], {}, "leave it out"),
        ([CRANK, {"kind": "crank", "base": ["0", "0"]}], {}, 'no "arm", "rod"'),
        ([CRANK, {**CRANK, "wheel": "1"}], {}, 'unknown key "wheel"'),
        ([CRANK, {**CRANK, "kind": "wheel"}], {}, "write one of length, crank"),
        ([CRANK, "crank"], {}, "not a mapping"),
        ("legs", {}, "no list of legs"),
        ([CRANK, CRANK], {"mechanism": "flat"}, "planar, spatial"),
        ([CRANK, CRANK], {"platform": "body", "mechanism": "spatial"}, "in space"),
        ([CRANK, CRANK], {"problem": "other"}, "direct, inverse"),
        ([CRANK, CRANK], {"joints": []}, 'unknown key "joints"'),
        ([CRANK] * 7, {}, "1 to 6 legs"),
        (
            [{**CRANK, "base": ["0", "0", "0"]}] * 3,
            {"mechanism": "spatial"},
            "a crank in space",
        ),
    ],
)
def test_what_is_wrong_is_said_in_one_line(
    legs: object, entries: dict[str, object], message: str
) -> None:
    """The message has the leg, what was found and what to write."""
    with pytest.raises(InvalidInputError, match=message) as caught:
        read(legs, **entries)
    assert "\n" not in str(caught.value)
    assert "m.yaml" in str(caught.value)


def test_a_system_is_no_mechanism() -> None:
    """Legs make the difference."""
    assert is_mechanism({"legs": []})
    assert not is_mechanism({"variables": ["x"], "map": ["x"]})


@pytest.mark.parametrize("path", OWN, ids=lambda path: path.stem)
def test_our_mechanisms_are_read_as_systems(path: Path) -> None:
    """Each has as many equations as its configurations need, and its loops beside."""
    system = read_system(path)
    assert system.loops is not None
    assert system.variety.dimension == system.mapping.dimension


def test_there_are_some_of_ours() -> None:
    """The folder was found."""
    assert len(OWN) >= 5
