"""Where the browser tests leave what they saw."""

from __future__ import annotations

from pathlib import Path

import pytest

OUTPUT = Path(__file__).parents[2] / "test-output"


@pytest.fixture(scope="session")
def output() -> Path:
    """The folder of screenshots, for a person to look at."""
    OUTPUT.mkdir(exist_ok=True)
    return OUTPUT
