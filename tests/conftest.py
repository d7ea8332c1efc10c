from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

import cuspaudit
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.formats.read_robot import read_robot

#: conftest files are no modules with doctests, and several share their name
collect_ignore_glob = ["*conftest.py"]

settings.register_profile(
    "same every time",
    derandomize=True,
    deadline=None,
    max_examples=12,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)
settings.load_profile("same every time")


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real and hostile robot files, which no checkout contains."""
    beside = Path(__file__).parents[2] / "shared" / "corpus"
    folder = Path(os.environ.get("CUSPAUDIT_CORPUS", beside))
    if not folder.is_dir():
        pytest.skip("no corpus: set CUSPAUDIT_CORPUS")
    return folder


@pytest.fixture(scope="session")
def seven_joints() -> Callable[[str], Chain]:
    """A reader of the chains of ``robots/seven-joints/`` by name."""
    folder = Path(cuspaudit.__file__).parents[1] / "robots" / "seven-joints"
    return lambda name: read_robot(folder / f"{name}.yaml").chain


@pytest.fixture(scope="session")
def output() -> Path:
    """The folder of screenshots and tables, for a person to look at."""
    folder = Path(__file__).parents[1] / "test-output"
    folder.mkdir(exist_ok=True)
    return folder
