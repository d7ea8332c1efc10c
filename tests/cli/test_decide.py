"""`cuspaudit decide`: a file in, a verdict and its exit code out."""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from typer.testing import CliRunner

from cuspaudit.cli.app import app_for
from cuspaudit.errors import AssumptionError

SYSTEMS = Path(__file__).parents[1] / "systems"


def run(*arguments: str) -> tuple[int, str]:
    """Exit code and standard output of the command."""
    result = CliRunner().invoke(app_for(["decide"]), ["decide", *arguments])
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.exit_code, result.stdout


@pytest.mark.parametrize(
    ("name", "code"), [("whitney-cusp", 1), ("fold", 0), ("complex-square", 1)]
)
@pytest.mark.parametrize("engine", ["auto", "roadmap", "routing"])
def test_exit_code_and_schema(name: str, code: int, engine: str) -> None:
    """The exit code is the verdict's, and the JSON is an audit without robot."""
    found, output = run(
        str(SYSTEMS / f"{name}.yaml"), "--engine", engine, "--json", "-"
    )
    record: dict[str, Any] = json.loads(output)
    schema = json.loads(
        resources.files("cuspaudit.auditing").joinpath("schema.json").read_text()
    )
    jsonschema.validate(record, schema)
    assert found == code
    assert record["robot"] is None
    assert record["proof"]["engine"] == ("roadmap" if engine == "auto" else engine)
    assert (record["witness"] is not None) == (code == 1)
    assert record["steps"][0]["name"] == "crit"


def test_the_whole_run_on_request() -> None:
    """With --complete a cuspidal map has its samples in every cell as well."""
    file = str(SYSTEMS / "whitney-cusp.yaml")
    code, output = run(file, "--complete", "--json=-")
    record = json.loads(output)
    assert code == 1
    assert record["proof"]["engine"] == "roadmap"
    assert record["postures"] == {"max": 3, "proved": True}


def test_a_summary_for_people() -> None:
    """Without --json the verdict, its reason and the steps are printed."""
    code, output = run(str(SYSTEMS / "fold.yaml"), "--exit-zero")
    assert code == 0
    assert "noncuspidal" in output
    assert "check_assumption_a" in output


def test_no_time_is_undecided_naming_the_step() -> None:
    """A run past its time limit exits 3 and names the step it was at."""
    file = str(SYSTEMS / "issac-2022.yaml")
    code, output = run(file, "--complete", "--timeout", "1", "--json=-")
    record = json.loads(output)
    assert code == 3
    assert record["verdict"] == "undecided"
    assert record["undecided"]["step"] in record["undecided"]["why"]
    why = record["undecided"]["why"]
    assert "time limit" in why or "no answer within" in why


def test_a_failing_hypothesis_is_named(tmp_path: Path) -> None:
    """A violation of assumption (A) is an error with its name and the file's."""
    file = tmp_path / "double.yaml"
    file.write_text("variables: [x, y]\nequations: [x^2]\nmap: [y]\n")
    with pytest.raises(AssumptionError, match=r"double\.yaml: NotRadicalError: "):
        run(str(file))
