"""The orthogonal 3R arms against their closed form [Wenger, Robotica 2007]."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import inf, sqrt
from pathlib import Path

import pytest
from small_families import ORTHOGONAL, UR_PATTERN

from cuspaudit.family.family import Family
from cuspaudit.family.family_file import read_family
from cuspaudit.family.row import decide_member

RANDOM_LENGTHS = """\
parameters:
  a2: {random: [0.1, 1], count: 10}
  a3: {random: [0.1, 1], count: 10}
  d5: {random: [0.05, 0.2], count: 10}
"""
NEAR = 0.02


@dataclass(frozen=True)
class Known:
    """What the closed form says of an arm, and how near it is to a surface."""

    verdict: str
    cusps: int
    nodes: int
    aspects: int
    max_postures: int
    zone: int
    distance: float


def known(a2: float, a3: float, d2: float) -> Known:
    """The zone of an orthogonal arm, a1 = 1, and its type within the zone."""
    A, B, S = sqrt((a2 + 1) ** 2 + d2**2), sqrt((a2 - 1) ** 2 + d2**2), a2**2 + d2**2
    C1 = sqrt((S - (S**2 - a2**2 + d2**2) / (A * B)) / 2)
    C2 = a2 * A / (1 + a2)
    C3 = a2 * B / (a2 - 1) if a2 > 1 else inf
    C4 = a2 * B / (1 - a2) if a2 < 1 else inf
    E1, E2, E3 = (A - B) / 2, a2, (A + B) / 2
    distance = min(abs(a3 - x) for x in (C1, C2, C3, C4, E1, E2, E3))
    if a3 < C1:
        zone, nodes = 1, 0
    elif a3 < C2:
        zone, nodes = 2, 0 if E1 < a3 < E2 else 2
    elif a3 < min(C3, C4):
        zone, nodes = 3, 1 if a3 < E3 else 3
    elif a2 > 1:
        zone, nodes = 4, 4
    else:
        zone, nodes = 5, 0 if a3 < E3 else 2
    return Known(
        verdict="cuspidal" if zone in (2, 3, 4) else "noncuspidal",
        cusps={2: 4, 3: 2, 4: 4}.get(zone, 0),
        nodes=nodes,
        aspects=2 if a3 < a2 else {2: 6, 3: 5, 4: 6, 5: 4}[zone],
        max_postures=2 if zone == 1 else 4,
        zone=zone,
        distance=distance,
    )


def orthogonal(folder: Path, lines: str) -> Family:
    """The family with these parameters."""
    file = folder / "family.yaml"
    file.write_text(ORTHOGONAL + lines)
    return read_family(file)


def agree(family: Family) -> set[int]:
    """Hold every member away from the surfaces to the closed form; the zones met."""
    zones = set()
    for index in family.indices():
        values = family.values(index) or {}
        numbers = [v for v in values.values() if isinstance(v, Fraction)]
        form = known(*map(float, numbers))
        if form.distance < NEAR:
            continue
        row = decide_member(family, index)
        found = tuple(
            row.get(key)
            for key in ("verdict", "cusps", "nodes", "aspects", "max_postures")
        )
        wanted = (form.verdict, form.cusps, form.nodes, form.aspects, form.max_postures)
        assert found == wanted, f"a2, a3, d2 = {numbers}: {row.get('error')}"
        zones.add(form.zone)
    return zones


def test_the_closed_form_knows_the_published_arms() -> None:
    """The closed form of these tests gives the six published types."""
    published = {
        (2, 1.5, 1): (2, 4, 0, 2),
        (0.7, 0.3, 0.2): (1, 0, 0, 2),
        (1.5, 0.7, 0.5): (2, 4, 2, 2),
        (3, 4, 3): (3, 2, 1, 5),
        (0.5, 0.8, 0.2): (5, 0, 0, 4),
        (0.5, 1.3, 0.2): (5, 0, 2, 4),
    }
    for arm, wanted in published.items():
        form = known(*arm)
        assert (form.zone, form.cusps, form.nodes, form.aspects) == wanted


@pytest.mark.parametrize("d2", ["1", "1/2", "2"])
def test_a_coarse_grid_agrees_with_the_closed_form(tmp_path: Path, d2: str) -> None:
    """Verdict, cusps, nodes, aspects and postures on a coarse grid, in all zones."""
    lines = (
        "parameters: {a2: {values: [0.3, 0.7, 1.6, 2.7]}, "
        f"a3: {{values: [0.15, 0.6, 1.8, 3.4]}}, d2: {{values: [{d2}]}}}}\n"
    )
    assert len(agree(orthogonal(tmp_path, lines))) >= 4


@pytest.mark.slow
@pytest.mark.parametrize("d2", ["1", "1/2", "2"])
def test_a_grid_agrees_with_the_closed_form(tmp_path: Path, d2: str) -> None:
    """The same on 15 by 15 arms."""
    lines = (
        "parameters: {a2: {range: [0.21, 3.01], steps: 15}, "
        f"a3: {{range: [0.23, 4.43], steps: 15}}, d2: {{values: [{d2}]}}}}\n"
    )
    assert agree(orthogonal(tmp_path, lines)) >= {2, 3, 4, 5}


def test_all_nine_types_are_met() -> None:
    """The grids above meet every one of the nine types (zone, nodes) somewhere."""
    steps = [k / 20 for k in range(4, 100)]
    types = {
        (form.zone, form.nodes, form.aspects)
        for a2, a3, d2 in product(steps, steps, (0.5, 1, 2))
        if a2 != 1 and (form := known(a2, a3, d2)).distance > NEAR
    }
    assert len({(zone, nodes) for zone, nodes, _ in types}) == 8
    assert len(types) >= 9


def test_the_ur_pattern_is_noncuspidal_by_theorem(tmp_path: Path) -> None:
    """Ten arms of the UR pattern: noncuspidal by theorem, with 8 aspects each."""
    file = tmp_path / "family.yaml"
    file.write_text(UR_PATTERN + RANDOM_LENGTHS)
    family = read_family(file)
    rows = [decide_member(family, index) for index in family.indices()]
    assert len(rows) == 10
    assert {(row["verdict"], row["proof"]) for row in rows} == {
        ("noncuspidal", "reduction")
    }
    assert {row["aspects"] for row in rows} == {8}


PUBLISHED = {
    "UR3": ("0.2437", "0.2133", "0.0854"),
    "UR5, series 1": ("0.425", "0.39243", "0.093"),
    "UR5, series 2": ("0.425", "0.39225", "0.09475"),
    "UR5, series 3": ("0.425", "0.39225", "0.09465"),
    "UR10": ("0.6127", "0.5716", "0.1157"),
    "UR3e": ("0.24355", "0.2132", "0.08535"),
    "UR5e": ("0.425", "0.3922", "0.0997"),
    "UR10e": ("0.6127", "0.57155", "0.11985"),
    "UR20": ("0.8620", "0.7287", "0.1593"),
}
"""(a2, a3, d5) in m without signs [Universal Robots: CB3 manual, app. B; D-H page]."""


@pytest.mark.parametrize("name", PUBLISHED)
def test_the_arms_of_the_ur_series_have_eight_aspects(
    tmp_path: Path, name: str
) -> None:
    """The published lengths of the UR series: 8 aspects and no cuspidal arm."""
    a2, a3, d5 = PUBLISHED[name]
    lines = f"parameters: {{a2: {{values: [{a2}]}}, a3: {{values: [{a3}]}}, "
    file = tmp_path / "family.yaml"
    file.write_text(f"{UR_PATTERN}{lines}d5: {{values: [{d5}]}}}}\n")
    row = decide_member(read_family(file), 0)
    assert (row["verdict"], row["aspects"]) == ("noncuspidal", 8)
