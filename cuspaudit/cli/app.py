"""The commands: arguments in, exit code out; no mathematics.

One command a file, registered here. Heavy rooms are imported inside the commands, so
that ``--help`` and ``verify`` do not wait for a robotics library.
"""

from __future__ import annotations

from typing import Annotated

import typer

import cuspaudit
from cuspaudit.cli.audit import audit
from cuspaudit.cli.check import check
from cuspaudit.cli.decide import decide
from cuspaudit.cli.families import sweep
from cuspaudit.cli.import_ import import_
from cuspaudit.cli.plot import plot
from cuspaudit.cli.show import show
from cuspaudit.cli.verify import verify

__all__ = ["app"]

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Decide, with a proof, whether a robot arm is cuspidal: whether it can change "
    "posture without ever meeting a singularity.\n\nExit codes: 0 noncuspidal (verify, "
    "check: all good), 1 cuspidal (verify: rejected; check: a mismatch), 2 bad input, "
    "3 undecided, 4 an error that nobody foresaw.",
)


def _print_version(asked: bool) -> None:
    if asked:
        typer.echo(f"cuspaudit {cuspaudit.__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option(
            "--version",
            help="Show the version and end.",
            is_eager=True,
            callback=_print_version,
        ),
    ] = False,
    debug: Annotated[
        bool,
        typer.Option(
            "--debug", help="Print the traceback of an error that nobody foresaw."
        ),
    ] = False,
) -> None:
    del version, debug  # `main` takes --debug from wherever it stands


_COMMANDS = (
    ("audit", audit, "my_robot.urdf --tip tool0 --html audit.html"),
    ("verify", verify, "chablat-2022-3r.certificate.json"),
    ("decide", decide, "whitney-cusp.yaml --engine routing"),
    ("show", show, "chablat-2022-3r --html witness.html"),
    ("plot", plot, "chablat-2022-3r -o figure.png"),
    ("import", import_, "ur5_robot --to msolve > ik.ms"),
    ("check", check, "robots/ -j 2 --junit report.xml"),
    ("sweep", sweep, "family.yaml -o table -j 2"),
)
for _name, _command, _example in _COMMANDS:
    app.command(_name, epilog=f"Example: cuspaudit {_name} {_example}")(_command)
