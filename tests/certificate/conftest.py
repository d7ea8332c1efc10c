"""The known arms, each certified once."""

from __future__ import annotations

import pytest
from certified_arms import ARMS

from cuspaudit.certificate import PathCertificate


@pytest.fixture(scope="session")
def certified() -> dict[str, PathCertificate]:
    """A true certificate of each known arm."""
    return {name: make() for name, make in ARMS.items()}


@pytest.fixture
def arm3(certified: dict[str, PathCertificate]) -> PathCertificate:
    """The ISSAC 2022 example, certified."""
    return certified["issac"]


@pytest.fixture
def arm6(certified: dict[str, PathCertificate]) -> PathCertificate:
    """The FANUC CRX-10iA/L, certified."""
    return certified["crx"]
