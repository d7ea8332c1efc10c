from __future__ import annotations

import pytest

from cuspaudit.auditing.audit import Options, audit
from cuspaudit.cli.running import STEPS
from cuspaudit.robot.library import open_robot


@pytest.mark.parametrize("name", ["chablat-2022-3r", "kuka-kr-6-r900"])
def test_the_bar_knows_the_steps_of_an_audit(name: str) -> None:
    """Each announced step is one of the bar's, and they come in its order."""
    heard: list[str] = []
    audit(open_robot(name), Options(progress=heard.append))
    places = [STEPS.index(step.partition(":")[0]) for step in heard]
    assert places == sorted(set(places))
