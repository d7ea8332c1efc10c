from __future__ import annotations

import pickle
from fractions import Fraction
from pathlib import Path

import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.family.family import Family
from cuspaudit.family.family_file import read_family
from cuspaudit.robot.chain import Rotation, Translation

ROBOT = """\
family: orthogonal-3r
robot:
  convention: standard
  units: m
  task: position
  joints:
    - {type: revolute, a: 1,  alpha: -pi/2, d: 0}
    - {type: revolute, a: a2, alpha: pi/2,  d: d2}
    - {type: revolute, a: "(a2 + a3)/2", alpha: 0, d: 0}
"""
GRID = """\
parameters:
  a2: {range: [0.2, 3], steps: 15}
  a3: {range: [0.2, 3], steps: 15}
  d2: {values: [1/2, 1]}
"""


def family(tmp_path: Path, text: str) -> Family:
    """The family of a text."""
    file = tmp_path / "family.yaml"
    file.write_text(text)
    return read_family(file)


def test_a_grid_is_the_product_with_its_ends(tmp_path: Path) -> None:
    """The last parameter runs fastest, values are exact, both ends are members."""
    grid = family(tmp_path, ROBOT + GRID)
    assert (grid.shape, grid.size) == ((15, 15, 2), 450)
    low, high = Fraction(1, 5), Fraction(3)
    assert grid.values(0) == {"a2": low, "a3": low, "d2": Fraction(1, 2)}
    assert grid.values(449) == {"a2": high, "a3": high, "d2": Fraction(1)}
    assert grid.values(2) == {"a2": low, "a3": Fraction(2, 5), "d2": Fraction(1, 2)}
    assert grid.index_of((0, 1, 0)) == 2


def test_a_member_is_a_robot_with_exact_numbers(tmp_path: Path) -> None:
    """Names and expressions become the numbers of a robot file, exactly."""
    chain = family(tmp_path, ROBOT + GRID).robot(3).chain
    assert [m.vector[0] for m in chain.tool if isinstance(m, Translation)] == [
        Fraction(3, 10)
    ]
    assert any(isinstance(m, Rotation) for m in chain.joints[1].before)


def test_constraints_leave_the_numbering(tmp_path: Path) -> None:
    """An excluded point keeps its index and is no member."""
    some = family(tmp_path, ROBOT + GRID + 'constraints: ["a3 <= a2"]\n')
    members = list(some.indices())
    assert len(members) == 15 * 16
    assert 2 not in members
    assert some.values(2) is None


def test_random_parameters_are_drawn_together_by_the_seed(tmp_path: Path) -> None:
    """All random parameters are one axis; the draws depend on seed, name and number."""
    lines = (
        "parameters:\n  d2: {values: [1/2, 1]}\n"
        "  a2: {random: [0.1, 2], count: 100}\n  a3: {random: [0.1, 2], count: 100}\n"
    )
    one = family(tmp_path, ROBOT + lines + "seed: 7\n")
    same = family(tmp_path, ROBOT + lines + "seed: 7\n")
    other = family(tmp_path, ROBOT + lines + "seed: 8\n")
    assert one.shape == (2, 100)
    drawn = [one.values(k) for k in range(200)]
    assert drawn == [same.values(k) for k in range(200)]
    assert drawn != [other.values(k) for k in range(200)]
    assert all(Fraction(1, 10) <= v["a2"] <= 2 for v in drawn if v)  # type: ignore[operator]
    assert len({v["a2"] for v in drawn if v}) > 90
    first, again = drawn[3], drawn[103]
    assert first and again
    assert first["a2"] == again["a2"] != first["a3"]


def test_angles_are_parameters_too(tmp_path: Path) -> None:
    """A range of angles has exact angles; the text reads back."""
    text = ROBOT.replace("alpha: -pi/2", 'alpha: "-tilt"')
    some = family(
        tmp_path,
        text
        + GRID.replace("d2: {", "tilt: {range: [30 deg, 90 deg], steps: 3}\n  d2: {"),
    )
    texts = {some.table(some.values(k) or {}).rows[0]["alpha"] for k in range(6)}
    assert texts == {"-pi/6", "-pi/3", "-pi/2"}


def test_derived_names_follow_from_the_parameters(tmp_path: Path) -> None:
    """A derived name is exact, may use those above it, and serves rows and limits."""
    text = ROBOT.replace('"(a2 + a3)/2"', "half").replace("d: 0}", "d: gap}")
    lines = "derived: {half: (a2 + a3)/2, gap: half - a2/2}\nconstraints: [gap <= 1]\n"
    some = family(tmp_path, text + GRID + lines)
    values = some.values(3)
    assert values is not None and set(values) == {"a2", "a3", "d2"}
    assert some.known(values) == values | {
        "half": Fraction(3, 10),
        "gap": Fraction(1, 5),
    }
    rows = some.table(values).rows
    assert [row["a"] for row in rows] == ["1", "0.2", "0.3"]
    assert [row["d"] for row in rows] == ["0.2", "1", "0.2"]
    admitted = [some.values(k) for k in some.indices()]
    assert 0 < len(admitted) < some.size
    assert all(v and v["a3"] <= 2 for v in admitted)  # type: ignore[operator]


def test_a_constraint_without_value_leaves_a_member(tmp_path: Path) -> None:
    """Where a constraint divides by zero there is a member, and its robot says why."""
    some = family(tmp_path, ROBOT + GRID + 'constraints: ["1/(a2 - 3) < 0"]\n')
    assert len(list(some.indices())) == some.size
    with pytest.raises(InvalidRobotError, match="divides by zero"):
        some.robot(some.size - 1)


def test_a_family_is_read_lazily_and_travels(tmp_path: Path) -> None:
    """A billion members cost nothing to read, and the family can be sent away."""
    text = GRID.replace("steps: 15", "steps: 30000")
    huge = pickle.loads(pickle.dumps(family(tmp_path, ROBOT + text)))
    assert huge.size == 1_800_000_000
    assert huge.values(huge.size - 1)["a2"] == 3


def test_the_hash_is_of_what_is_said(tmp_path: Path) -> None:
    """A comment does not change the hash; a number does."""
    hashes = [
        family(tmp_path, text + GRID).hash
        for text in (ROBOT, "# a remark\n" + ROBOT, ROBOT.replace("a: 1,", "a: 2,"))
    ]
    assert hashes[0] == hashes[1] != hashes[2]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("a: a2,", "a: a4 + a2,", '"a4" is no parameter'),
        ("a: a2,", "a: a2/(a2 - a2),", "divides by zero"),
        ("parameters:", "derived: {b: c, c: a2}\nparameters:", "not derived above"),
        ("parameters:", "derived: {a2: a3}\nparameters:", "no new name"),
        ("parameters:", "derived: {verdict: a3}\nparameters:", "not free as a name"),
        ("parameters:", "derived: {b: 'a2**2'}\nparameters:", "cannot be read"),
        ("parameters:", "derived: [a2]\nparameters:", "no mapping"),
        ("a: a2,", "a: q2,", "row 2"),
        ("alpha: -pi/2", "alpha: a2", "no unit"),
        ("steps: 15}\n  d2", "steps: many}\n  d2", "whole number"),
        ("a3: {range", "verdict: {range", "not free as a name"),
        ("a3: {range", "pi: {range", "not free as a name"),
        ("{values: [1/2, 1]}", "[1/2, 1]", "no mapping"),
        ("{values: [1/2, 1]}", "{values: [1/2, 0.5]}", "twice"),
        ("{values: [1/2, 1]}", "{values: [1, 1 deg]}", "one list"),
        ("{values: [1/2, 1]}", "{random: [0, 1]}", "the keys"),
        ("{values: [1/2, 1]}", '{values: ["__import__(1)"]}', "cannot be read"),
        ("family:", "famly:", "unknown name"),
        ("robot:\n", "robots:\n", "unknown name"),
        ("    - {type: revolute, a: 1,  alpha: -pi/2, d: 0}\n", "", "2 joints"),
        ("parameters:", "record: [colour]\nparameters:", "unknown name"),
        ("parameters:", 'constraints: ["a2 < b"]\nparameters:', '"b" is no parameter'),
        ("parameters:", "adaptive: {parameters: [d2], levels: 1}\nparameters:", "name"),
    ],
)
def test_mistakes_are_named_in_one_line(
    tmp_path: Path, old: str, new: str, words: str
) -> None:
    """A mistake in the file is one line that names the place."""
    text = (ROBOT + GRID).replace(old, new)
    assert text != ROBOT + GRID
    with pytest.raises(InvalidRobotError, match="(?i)" + words.replace('"', ".")) as it:
        family(tmp_path, text)
    assert "\n" not in str(it.value)
