from __future__ import annotations

from pathlib import Path

import pytest

import cuspaudit
from cuspaudit.family.family_file import read_family

FAMILIES = sorted((Path(cuspaudit.__file__).parents[1] / "families").glob("*.yaml"))


@pytest.mark.parametrize("file", FAMILIES, ids=lambda file: file.stem)
def test_every_family_of_ours_can_be_read(file: Path) -> None:
    """The families shipped as examples are read, and their first member is a robot."""
    family = read_family(file)
    assert len(family.robot(next(family.indices())).chain.joints) == 3
