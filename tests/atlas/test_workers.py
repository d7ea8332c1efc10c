from __future__ import annotations

import os
from pathlib import Path

import pytest

from cuspaudit.atlas import workers
from cuspaudit.atlas.arm import AtlasArm, Made
from cuspaudit.atlas.entry import Entry
from cuspaudit.atlas.site import build_site
from cuspaudit.atlas.workers import made_here, made_on_cluster
from cuspaudit.errors import InvalidInputError


def short(arm: AtlasArm, key: str) -> list[Made]:
    """An audit that takes no time, and dies for one arm."""
    if arm.slug == "deadly" and "inside" in key:
        os._exit(1)
    return [Made(Entry(arm.slug, arm.slug, arm.source, verdict="undecided", key=key))]


def arms(*slugs: str, key: str = "") -> list[tuple[AtlasArm, str]]:
    """Arms of these names."""
    return [(AtlasArm(f"{slug}.yaml", slug, 1.0), key) for slug in slugs]


@pytest.mark.parametrize("processes", [1, 3])
def test_every_robot_is_made_once(processes: int) -> None:
    """By this process or by several, in whatever order."""
    names = [f"arm-{k}" for k in range(7)]
    made = [each.entry.slug for (each,) in made_here(arms(*names), processes, short)]
    assert sorted(made) == names


def test_a_process_that_dies_is_a_line_of_the_table() -> None:
    """And so is what it takes along; nothing is lost in silence."""
    work = arms("one", "deadly", "two", key="inside")
    made = {group[0].entry.slug: group[0].entry for group in made_here(work, 2, short)}
    assert set(made) == {"one", "deadly", "two"}
    assert "died" in made["deadly"].error
    assert not made["deadly"].key, "it is tried again by the next run"


def test_nobody_at_the_address_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """What to start, and no traceback."""
    pytest.importorskip("distributed")
    monkeypatch.setattr(workers, "_PATIENCE", "1s")
    with pytest.raises(InvalidInputError, match="no scheduler"):
        list(made_on_cluster(arms("one"), "tcp://127.0.0.1:9", short))


@pytest.mark.slow
def test_a_cluster_gives_the_same_site(tmp_path: Path) -> None:
    """Two workers behind a scheduler, and one process: the same table."""
    distributed = pytest.importorskip("distributed")
    names = ["anthropomorphic-offset", "puma-560-arm", "adept-cobra-600"]
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None
    ) as cluster:
        address = cluster.scheduler_address
        build_site(names, tmp_path / "far", scheduler=address, timeout=20)
    build_site(names, tmp_path / "near", timeout=20)
    for name in ("atlas.json", "index.html"):
        far, near = ((tmp_path / f / name).read_bytes() for f in ("far", "near"))
        assert far == near
