from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import yaml

DOCS = Path(__file__).parents[2] / "docs"


def run(*words: str) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "cuspaudit", "atlas", *words],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def test_the_command_builds_a_site_and_says_what_it_did(tmp_path: Path) -> None:
    """Exit code 0 whatever the verdicts; one line."""
    site = tmp_path / "site"
    done = run("anthropomorphic-offset", "-o", str(site), "--timeout", "20")
    assert done.returncode == 0, done.stderr
    assert "1 robots, 1 audited now, 1 with a certificate, 0 not" in done.stdout
    assert (site / "index.html").is_file()
    again = run("anthropomorphic-offset", "-o", str(site), "--timeout", "20")
    assert "0 audited now" in again.stdout


def test_bad_input_is_one_line_and_exit_2(tmp_path: Path) -> None:
    """Nothing named, and a robot that nobody knows."""
    for words in ((), ("no-such-robot",)):
        done = run(*words, "-o", str(tmp_path / "site"))
        assert done.returncode == 2
        assert done.stderr.count("\n") == 1


def test_the_workflow_of_the_documentation_is_well_formed() -> None:
    """YAML with steps, and the commands in it are those of the command line."""
    text = (DOCS / "atlas.md").read_text()
    (block,) = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
    steps = yaml.safe_load(block)["jobs"]["arms"]["steps"]
    commands = [step["run"].split()[1] for step in steps if "run" in step][1:3]
    assert commands == ["check", "atlas"]
