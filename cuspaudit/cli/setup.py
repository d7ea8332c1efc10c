"""`cuspaudit setup`: what a wheel does not bring, and what is there."""

from __future__ import annotations

import typer

__all__ = ["setup"]


def setup() -> None:
    """Install msolve, which `decide` and the routing engine need; say what is there."""
    from cuspaudit.algebra.msolve_setup import check_msolve, install_msolve
    from cuspaudit.auditing.record import PACKAGES
    from cuspaudit.robot.library import example_robot_data
    from cuspaudit.runtime.versions import versions

    program = install_msolve()
    check_msolve()
    for name, version in versions(PACKAGES).items():
        place = f" ({program})" if name == "msolve" else ""
        typer.echo(f"{name:20} {version or 'not installed by pip'}{place}")
    share = example_robot_data()
    typer.echo(f"{'URDFs by name':20} {share or 'none; give files'}")
    typer.echo("ready")
