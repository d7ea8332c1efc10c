"""`cuspaudit audit` and `plot` of a parallel mechanism."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from cuspaudit.cli.app import app_for
from cuspaudit.errors import InvalidInputError, UnableError

OWN = Path(__file__).parents[2] / "mechanisms"
SLICE = str(OWN / "3-rpr-slice.yaml")


def run(*arguments: str) -> tuple[int, str]:
    """Exit code and standard output."""
    result = CliRunner().invoke(app_for(list(arguments[:1])), list(arguments))
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.exit_code, result.stdout


def test_an_audit_writes_the_page_and_its_animation(tmp_path: Path) -> None:
    """Cuspidal, exit code 1; the page has a frame for each way point, closed loops."""
    page = tmp_path / "page.html"
    code, output = run("audit", SLICE, "--html", str(page), "--json", "-")
    record = json.loads(output)
    assert (code, record["verdict"]) == (1, "cuspidal")
    text = page.read_text()
    frames = json.loads(
        re.search(r'id="frames">(.*?)</script>', text, re.DOTALL)[1]  # type: ignore[index]
    )
    assert len(frames) == len(record["witness"]["path"])
    for frame in frames:
        (base, _, anchor), *_ = frame["legs"]
        length = sum((a - b) ** 2 for a, b in zip(base, anchor, strict=True)) ** 0.5
        assert abs(length - 17) < 1e-4
    assert "://" not in text.replace("http://www.w3.org/2000/svg", "")


def test_critical_values_are_drawn_for_two_actuators(tmp_path: Path) -> None:
    """A picture of the slice; of three actuators a line that says why not."""
    file = tmp_path / "values.svg"
    code, _ = run("plot", SLICE, "-o", str(file))
    assert code == 0
    text = file.read_text()
    for words in (
        "square of length 2 (the file's unit squared)",
        "Values at which modes are born or die",
        "Leg 1 has the fixed length 17.",
    ):
        assert words in text
    with pytest.raises(UnableError, match="d = 3"):
        run("plot", str(OWN / "orthoglide.yaml"), "-o", str(file))


def test_options_of_arms_are_refused() -> None:
    """A tip means nothing here."""
    with pytest.raises(InvalidInputError, match="--tip with a parallel mechanism"):
        run("audit", SLICE, "--tip", "tool0")
