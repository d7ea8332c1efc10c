"""The names a Python program uses, and what they cost to import."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import cuspaudit

ROOT = Path(cuspaudit.__file__).parent
NAMES = {
    *("load", "audit", "decide", "verify", "sweep", "check"),
    *("Audit", "SystemAudit", "Robot", "Verdict", "Verification", "Checked", "Swept"),
    *("CuspauditError", "__version__"),
    *("postures", "same_aspect", "trace", "Postures", "Connection", "Trace"),
}


def module_names() -> list[str]:
    """Every module of the package, but for the one that runs the command line."""
    paths = (p.relative_to(ROOT.parent).with_suffix("") for p in ROOT.rglob("*.py"))
    names = {".".join(path.parts).removesuffix(".__init__") for path in paths}
    return sorted(names - {"cuspaudit.__main__"})


def test_the_public_names_are_these() -> None:
    """A name more or less is a decision, and `dir` and `*` know them all."""
    assert set(cuspaudit.__all__) == NAMES
    assert set(dir(cuspaudit)) >= NAMES


def test_no_module_shadows_a_public_name(tmp_path: Path) -> None:
    """After every module was imported, each public name is still what it was."""
    names = module_names()
    assert len(names) > 200
    for name in names:
        import_module(name)
    certificate = tmp_path / "c.json"
    audit = cuspaudit.audit(cuspaudit.load("ur5"))
    assert isinstance(audit, cuspaudit.Audit)
    audit.save_certificate(certificate)
    assert cuspaudit.verify(certificate).accepted
    found = cuspaudit.decide(variables=["x", "y"], map=["x^3 + x*y", "y"])
    assert isinstance(found, cuspaudit.SystemAudit)
    assert found.verdict == cuspaudit.Verdict.CUSPIDAL
    robots = ROOT.parent / "robots"
    assert [c.status for c in cuspaudit.check(robots / "ur5.yaml")] == ["ok"]
    family = tmp_path / "family.yaml"
    family.write_text(
        "family: one\nrobot:\n  convention: standard\n  units: m\n  task: position\n"
        "  joints:\n"
        "    - {type: revolute, a: a1, alpha: pi/2, d: 0}\n"
        "    - {type: revolute, a: 2, alpha: -pi/2, d: 1}\n"
        "    - {type: revolute, a: 3/2, alpha: 0, d: 0}\n"
        "parameters:\n  a1: {values: [1]}\n"
    )
    assert cuspaudit.sweep(family, tmp_path / "table").to_dict()["added"] == 1


def test_an_unknown_name_is_an_attribute_error() -> None:
    """The lazy door says what Python would say."""
    assert not hasattr(cuspaudit, "no_such_name")


def test_importing_the_package_loads_nothing_heavy() -> None:
    """`import cuspaudit` is under 0.1 s of processor time, and loads no library."""
    code = (
        "import time; before = time.process_time(); import cuspaudit\n"
        "import sys; spent = time.process_time() - before\n"
        "heavy = {'numpy', 'flint', 'networkx', 'sympy', 'pinocchio', 'typer'}\n"
        "print(spent, sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    spent, _, loaded = done.stdout.strip().partition(" ")
    assert float(spent) < 0.1
    assert loaded == "[]"
