from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.descriptions import description_file, description_names
from cuspaudit.robot.library import open_robot

PACKAGE = """
from types import SimpleNamespace as N
DESCRIPTIONS = {
    "arm_description": N(has_urdf=True, tags={"arm"}, repository="arms"),
    "dog_description": N(has_urdf=True, tags={"quadruped"}, repository="dogs"),
    "arm_mj_description": N(has_urdf=False, tags={"arm"}, repository="arms"),
}
"""
REPOSITORIES = """
from types import SimpleNamespace as N
REPOSITORIES = {"arms": N(cache_path="arms"), "dogs": N(cache_path="dogs")}
"""


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The cache of a package laid out as robot_descriptions, with three robots."""
    package = tmp_path / "robot_descriptions"
    package.mkdir()
    (package / "__init__.py").write_text(PACKAGE)
    (package / "_repositories.py").write_text(REPOSITORIES)
    (package / "arm_description.py").write_text(
        f"URDF_PATH = {str(tmp_path / 'cache' / 'arms' / 'arm.urdf')!r}"
    )
    for name in [n for n in sys.modules if n.split(".")[0] == package.name]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("ROBOT_DESCRIPTIONS_CACHE", str(tmp_path / "cache"))
    yield tmp_path / "cache"
    for name in [n for n in sys.modules if n.split(".")[0] == package.name]:
        del sys.modules[name]


def test_only_arms_with_a_urdf_are_listed(cache: Path) -> None:
    """A quadruped and a MuJoCo model are not listed as arms."""
    assert description_names() == ["arm_description"]


def test_nothing_is_cloned(cache: Path) -> None:
    """An arm that was not fetched is refused with the command that fetches it."""
    with pytest.raises(InvalidRobotError, match="robot_descriptions pull arm_descr"):
        open_robot("arm_description")
    assert not cache.exists()


def test_a_fetched_arm_is_its_urdf(cache: Path) -> None:
    """Once its repository is in the cache, a name stands for its URDF."""
    (cache / "arms").mkdir(parents=True)
    assert description_file("arm_description") == cache / "arms" / "arm.urdf"
    assert description_file("arm_mj_description") is None
    assert description_file("ur5") is None
