"""All postures of random poses: the solver of the search beside a peer, ssik.

Run with ``pip install ssik`` and ``pytest tests/benchmarks/test_peers_benchmark.py
--benchmark-only``. ssik derives a solver for each new arm first, which takes minutes
for an arm without a wrist, and keeps it in the user's cache.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from short_tables import arm

from cuspaudit.kinematics.postures.numeric import PostureSolver

POSES = 50
TABLES = {
    "UR5": (
        (0, "-0.425", "-0.39225", 0, 0, 0),
        ("0.089159", 0, 0, "0.10915", "0.09465", "0.0823"),
        (90, 0, 0, 90, -90, 0),
    ),
    "PUMA 560": (
        (0, "0.4318", "0.0203", 0, 0, 0),
        (0, 0, "0.15005", "0.4318", 0, 0),
        (90, 0, -90, 90, -90, 0),
    ),
    "CRX-10iA/L": (
        (0, "0.71", 0, 0, 0, 0),
        ("0.245", 0, 0, "0.54", "0.15", "0.16"),
        (-90, 0, -90, 90, -90, 0),
    ),
    "general": (
        ("0.3", "0.5", "0.2", "0.4", "0.1", 0),
        ("0.2", "0.1", "0.3", "0.5", "0.2", "0.1"),
        (70, 50, 80, 65, 75, 0),
    ),
}


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize("peer", [False, True], ids=["own", "ssik"])
def test_all_postures(benchmark: Any, name: str, peer: bool) -> None:
    """Both find as many postures of every pose."""
    ssik = pytest.importorskip("ssik")
    a, d, alpha = TABLES[name]
    solver = PostureSolver.of(arm(a, d, alpha))
    given = np.random.default_rng(1).uniform(-np.pi, np.pi, (POSES, 6))
    poses = solver.poses(given)
    lengths, rises = (np.array(row, dtype=float) / solver.scale for row in (a, d))
    other = ssik.Manipulator.from_dh(np.radians(alpha), lengths, rises)
    other.prepare()

    def by_peer() -> list[int]:
        return [len(other.solve(pose, respect_limits=False)) for pose in poses]

    def own() -> list[int]:
        return [len(found) for found in solver.solve(poses)]

    counts = benchmark.pedantic(by_peer if peer else own, rounds=3, warmup_rounds=1)
    benchmark.extra_info["postures"] = sum(counts)
    assert counts == (own() if peer else by_peer())
