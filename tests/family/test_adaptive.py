from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import product
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import small_families as families

from cuspaudit.family.adaptive import waves
from cuspaudit.family.family import Family
from cuspaudit.family.family_file import read_family
from cuspaudit.family.sweep import sweep

LINES = """\
parameters:
  a2: {range: [0.2, 3], steps: STEPS}
  a3: {range: [0.2, 3], steps: STEPS}
  d2: {values: [1]}
"""


def family(tmp_path: Path, steps: int, more: str = "") -> Family:
    """The orthogonal family on a coarse grid, refined by ``more``."""
    file = tmp_path / "family.yaml"
    file.write_text(families.ORTHOGONAL + LINES.replace("STEPS", str(steps)) + more)
    return read_family(file)


def at(some: Family, index: int) -> tuple[float, float]:
    """(a2, a3) of a member."""
    values = some.values(index)
    assert values is not None
    a2, a3 = (float(values[name]) for name in ("a2", "a3"))  # type: ignore[arg-type]
    return a2, a3


def is_cuspidal_at(a2: float, a3: float, d2: float = 1) -> bool:
    """The closed form of the orthogonal family [Wenger, Robotica 2007]."""
    A, B, S = sqrt((a2 + 1) ** 2 + d2**2), sqrt((a2 - 1) ** 2 + d2**2), a2**2 + d2**2
    C1 = sqrt((S - (S**2 - a2**2 + d2**2) / (A * B)) / 2)
    return a3 > C1 and not (a2 < 1 and a3 > a2 * B / (1 - a2))


def is_cuspidal(some: Family, index: int) -> bool:
    """The closed form at a member."""
    return is_cuspidal_at(*at(some, index))


def boundary_error(some: Family, members: Iterable[int]) -> float:
    """The share of arms, of 4,900 spread evenly, unlike their nearest member."""
    known = np.array([(*at(some, k), is_cuspidal(some, k)) for k in members])
    spread = np.random.default_rng(1).uniform(-0.5, 0.5, (4900, 2))
    grid = (np.array(list(product(range(70), repeat=2))) + 0.5 + spread) / 70
    arms = 0.2 + 2.8 * grid
    nearest = [((known[:, :2] - arm) ** 2).sum(axis=1).argmin() for arm in arms]
    truth = [is_cuspidal_at(a2, a3) for a2, a3 in arms]
    return float(np.mean(known[nearest, 2] != truth))


def decided(some: Family, value: Callable[[Family, int], Any]) -> dict[int, tuple[Any]]:
    """What an adaptive sweep decides where ``value`` decides."""
    found: dict[int, tuple[Any]] = {}
    for wave in waves(some, found):
        found.update({k: (value(some, k),) for k in wave if k not in found})
    return found


@pytest.mark.parametrize(
    ("steps", "levels", "share"), [(8, 2, 0.26), (15, 2, 0.17), (8, 3, 0.13)]
)
def test_refining_needs_a_quarter_of_the_grid(
    tmp_path: Path, steps: int, levels: int, share: float
) -> None:
    """The boundary error of the grid, for these shares of its members."""
    more = f"adaptive: {{parameters: [a2, a3], levels: {levels}, on: verdict}}\n"
    some = family(tmp_path, steps, more)
    found = decided(some, is_cuspidal)
    assert len(found) <= share * some.size
    coarse = family(tmp_path, steps)
    error = boundary_error(some, found)
    assert error == boundary_error(some, range(some.size))
    assert error < boundary_error(coarse, range(coarse.size)) / (2**levels * 0.7)


def test_no_boundary_is_missed(tmp_path: Path) -> None:
    """Nearly every cell of the grid that the boundary crosses has all its corners."""
    more = "adaptive: {parameters: [a2, a3], levels: 3, on: verdict}\n"
    some = family(tmp_path, 8, more)
    assert some.shape == (57, 57, 1)
    found = decided(some, is_cuspidal)
    sharp = missed = 0
    for x, y in product(range(56), repeat=2):
        corners = [some.index_of((x + i, y + j, 0)) for i in (0, 1) for j in (0, 1)]
        if len({is_cuspidal(some, k) for k in corners}) > 1:
            sharp += 1
            missed += any(k not in found for k in corners)
    assert sharp > 80
    assert missed <= sharp / 50


def test_nothing_is_refined_where_nothing_differs(tmp_path: Path) -> None:
    """Where all corners agree, only the coarse grid is decided."""
    more = "adaptive: {parameters: [a2], levels: 2}\n"
    some = family(tmp_path, 4, more)
    assert some.shape == (13, 4, 1)
    assert len(decided(some, lambda f, k: "same")) == 16


def test_an_adaptive_sweep_is_taken_up_where_it_stopped(tmp_path: Path) -> None:
    """Stopped after a wave and continued: the same members as in one go."""
    more = "adaptive: {parameters: [a2, a3], levels: 1, on: [verdict]}\n"
    family(tmp_path, 3, more)
    file = tmp_path / "family.yaml"

    class Stop(Exception):  # noqa: N818 - not an error
        pass

    def stop(done: int, size: int) -> None:
        if done == 11:
            raise Stop

    with pytest.raises(Stop):
        sweep(file, tmp_path / "out", 1, stop)
    again = sweep(file, tmp_path / "out", 2)
    assert again.kept == 11
    sweep(file, tmp_path / "whole", 2)
    assert families.table(tmp_path / "out") == families.table(tmp_path / "whole")
    rows = families.table(tmp_path / "whole")
    assert len({row["index"] for row in rows}) == len(rows)
    assert 9 < again.kept + again.added < 25
