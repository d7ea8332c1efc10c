"""The commands: arguments in, exit code out; no mathematics.

One command a file, listed here. Only the file of the command that is asked for is
loaded, and heavy rooms inside it, so that ``--help`` and ``verify`` do not wait for a
robotics library.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import Annotated

import typer

import cuspaudit

__all__ = ["app_for"]

#: name, file beside this one, function in it, and an example
_COMMANDS = (
    ("audit", "audit", "audit", "my_robot.urdf --tip tool0 --html audit.html"),
    ("verify", "verify", "verify", "chablat-2022-3r.certificate.json"),
    ("decide", "decide", "decide", "whitney-cusp.yaml --engine routing"),
    ("show", "show", "show", "chablat-2022-3r --html witness.html"),
    ("plot", "plot", "plot", "chablat-2022-3r -o figure.png"),
    ("import", "import_", "import_", "ur5_robot --to msolve > ik.ms"),
    ("atlas", "atlas", "atlas", "robots/ --library -o site -j 2"),
    ("check", "check", "check", "robots/ -j 2 --junit report.xml"),
    ("trace", "trace", "trace", "crx.urdf --tip tool0 weld.csv --json trace.json"),
    ("setup", "setup", "setup", ""),
    ("postures", "postures", "postures", "ur5_robot --joints 0.1,-1,1.2,0.3,0.4,0"),
    ("same", "same", "same", "chablat-2022-3r --from 2.9,3,0.3 --to 0.8,0.5,-2.5"),
    ("sweep", "families", "sweep", "family.yaml -o table -j 2"),
)


def app_for(arguments: Sequence[str]) -> typer.Typer:
    """The command line with the command that ``arguments`` name, or with all."""
    app = typer.Typer(
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
        rich_markup_mode="rich",
        context_settings={"help_option_names": ["-h", "--help"]},
        help="Decide, with a proof, whether a robot arm is cuspidal: whether it can "
        "change posture without ever meeting a singularity.\n\nExit codes: 0 "
        "noncuspidal (verify, check: all good), 1 cuspidal (verify: rejected; check: a "
        "mismatch), 2 bad input, 3 undecided, 4 an error that nobody foresaw.",
    )
    app.callback()(_options)
    first = next((word for word in arguments if not word.startswith("-")), None)
    asked = [entry for entry in _COMMANDS if entry[0] == first]
    for name, file, function, example in asked or _COMMANDS:
        command = getattr(import_module(f"cuspaudit.cli.{file}"), function)
        app.command(name, epilog=f"Example: cuspaudit {name} {example}".rstrip())(
            command
        )
    return app


def _print_version(asked: bool) -> None:
    if asked:
        typer.echo(f"cuspaudit {cuspaudit.__version__}")
        raise typer.Exit


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
