from __future__ import annotations

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real and hostile robot files, which no checkout contains."""
    beside = Path(__file__).parents[2] / "shared" / "corpus"
    folder = Path(os.environ.get("CUSPAUDIT_CORPUS", beside))
    if not folder.is_dir():
        pytest.skip("no corpus: set CUSPAUDIT_CORPUS")
    return folder
