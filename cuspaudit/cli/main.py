"""The command line: arguments in, exit code out; no mathematics.

Heavy rooms are imported inside the commands, so that ``--help`` and ``verify`` do not
wait for a robotics library.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer
from rich.console import Console

import cuspaudit
from cuspaudit.cli.families import Colour, Fix, X, Y, plot_family, sweep
from cuspaudit.cli.plot import At, plot_robot
from cuspaudit.cli.summary import print_summary, print_understood
from cuspaudit.errors import CuspauditError, InvalidInputError

if TYPE_CHECKING:
    from cuspaudit.audit.report import Audit
    from cuspaudit.kinematics.chain import Chain
    from cuspaudit.kinematics.robot import Robot

__all__ = ["main"]

EXIT = {"noncuspidal": 0, "cuspidal": 1, "undecided": 3}
BAD_INPUT = 2

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Decide, with a proof, whether a robot arm is cuspidal: whether it can change "
    "posture without ever meeting a singularity.\n\nExit codes: 0 noncuspidal (verify, "
    "check: all good), 1 cuspidal (verify: rejected; check: a mismatch), 2 bad input, "
    "3 undecided.",
)


class Engine(StrEnum):
    """How connectivity is decided."""

    auto = "auto"
    roadmap = "roadmap"


class Form(StrEnum):
    """What `import` can write."""

    dh = "dh"
    poly = "poly"
    msolve = "msolve"


RobotName = Annotated[
    str,
    typer.Argument(
        metavar="ROBOT",
        help="A .urdf, a .yaml or .csv D-H table, or a name from `import --list`.",
    ),
]
Base = Annotated[str | None, typer.Option(help="Base link of a URDF.")]
Tip = Annotated[str | None, typer.Option(help="Tip link of a URDF.")]
TaskName = Annotated[
    str | None,
    typer.Option("--task", help="position (3 joints) or pose (6 joints)."),
]
Lock = Annotated[
    list[str] | None,
    typer.Option(
        metavar="JOINT=VALUE", help="Fix a joint, e.g. joint_3=pi/4; may be repeated."
    ),
]
Convention = Annotated[
    str | None,
    typer.Option(help="D-H convention of a CSV that does not say: standard, modified."),
]
AngleUnit = Annotated[
    str | None, typer.Option(help="Unit of bare angles in a D-H table: rad, deg.")
]
Snap = Annotated[
    str,
    typer.Option(
        metavar="none|default|FILE",
        help="Which rounded numbers are made exact; FILE is YAML with any of angle, "
        "length, axis, printed.",
    ),
]
EngineName = Annotated[Engine, typer.Option(help="Route of the decision.")]
Seed = Annotated[int, typer.Option(help="Seed of every random choice.")]
Timeout = Annotated[
    float | None,
    typer.Option(min=0.0, help="Seconds after which no further step is begun."),
]


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
) -> None:
    del version


@app.command(
    epilog="Example: cuspaudit audit my_robot.urdf --tip tool0 --html audit.html"
)
def audit(
    robot: RobotName,
    base: Base = None,
    tip: Tip = None,
    task: TaskName = None,
    lock: Lock = None,
    convention: Convention = None,
    angle_unit: AngleUnit = None,
    json_file: Annotated[
        str | None,
        typer.Option("--json", metavar="FILE", help="Write the audit; - is stdout."),
    ] = None,
    html: Annotated[
        Path | None, typer.Option(help="Write an offline page with the animation.")
    ] = None,
    certificate: Annotated[
        Path | None,
        typer.Option(
            help="Write the proof: the certificate of a cuspidal verdict, else the "
            "record of the exact run."
        ),
    ] = None,
    engine: Annotated[
        Engine, typer.Option(help="Route of the decision.")
    ] = Engine.auto,
    snap: Snap = "default",
    seed: Seed = 0,
    timeout: Timeout = None,
    exit_zero: Annotated[
        bool, typer.Option("--exit-zero", help="Exit 0 whatever the verdict.")
    ] = False,
) -> None:
    """Import, decide, certify, cross-check and report: the main job."""
    del engine
    from cuspaudit.audit.proof_record import proof_record
    from cuspaudit.audit.writing import check_writable, write_text

    files = [f for f in (html, certificate) if f is not None]
    if json_file not in (None, "-"):
        files.append(Path(json_file or ""))
    for file in files:
        check_writable(file)
    opened, locked = _open(robot, base, tip, task, lock, convention, angle_unit)
    result = _audit(opened, locked, seed, timeout, snap)
    proof = _certificate_text(result)
    written = str(certificate) if certificate and proof else None
    record = result.record(written)
    if certificate:
        write_text(certificate, proof or proof_record(result.answer))
    if html:
        write_text(html, _page(record, result, proof))
    if json_file == "-":
        typer.echo(json.dumps(record, indent=1, allow_nan=False))
    else:
        if json_file:
            write_text(Path(json_file), json.dumps(record, indent=1, allow_nan=False))
        kept = {"page": html, "certificate": written, "JSON": json_file}
        if certificate and not proof:
            kept["record of the run"] = str(certificate)
        print_summary(record, kept)
    raise typer.Exit(0 if exit_zero else EXIT[record["verdict"]])


@app.command(epilog="Example: cuspaudit verify chablat-2022-3r.certificate.json")
def verify(
    certificate: Annotated[Path, typer.Argument(help="A certificate file.")],
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the result as JSON.")
    ] = False,
) -> None:
    """Re-prove a witness from the certificate alone, in ball arithmetic."""
    from dataclasses import asdict

    from cuspaudit.certificate import read_certificate
    from cuspaudit.certificate import verify as prove

    claim = read_certificate(certificate)
    result = prove(claim)
    if as_json:
        typer.echo(json.dumps({"file": str(certificate), **asdict(result)}, indent=1))
    else:
        word = "accepted" if result.accepted else "REJECTED"
        typer.echo(f"{word}: {claim.robot_name}: {result.reason}")
    raise typer.Exit(0 if result.accepted else 1)


@app.command(epilog="Example: cuspaudit show chablat-2022-3r --html witness.html")
def show(
    source: Annotated[
        str, typer.Argument(metavar="ROBOT|AUDIT.json", help="A robot or an audit.")
    ],
    base: Base = None,
    tip: Tip = None,
    task: TaskName = None,
    lock: Lock = None,
    convention: Convention = None,
    angle_unit: AngleUnit = None,
    html: Annotated[
        Path | None, typer.Option(help="Write one offline page instead of serving it.")
    ] = None,
    no_open: Annotated[
        bool, typer.Option("--no-open", help="Serve without opening a browser.")
    ] = False,
    port: Annotated[int, typer.Option(help="First port to try, on loopback.")] = 7000,
    snap: Snap = "default",
    seed: Seed = 0,
) -> None:
    """Show the witness path in a browser, or the postures of one pose."""
    from cuspaudit.audit.writing import check_writable, write_text
    from cuspaudit.viz import serve

    if html:
        check_writable(html)
    if source.endswith(".json") and (saved := _saved_audit(Path(source))) is not None:
        source, base, tip = saved["file"], saved["base"], saved["tip"]
        task, seed, snap = saved["task"], saved["seed"], saved["snap"]
        lock = [f"{joint}={value}" for joint, value in saved["locked"].items()]
        if not source.endswith((".urdf", ".xml")):
            base = tip = None
    opened, locked = _open(source, base, tip, task, lock, convention, angle_unit)
    result = _audit(opened, locked, seed, None, snap)
    page = _page(result.record(), result, _certificate_text(result))
    if html:
        write_text(html, page)
        typer.echo(f"page: {html}")
    else:
        serve(page, port, open_browser=not no_open)


@app.command(epilog="Example: cuspaudit plot chablat-2022-3r -o figure.png")
def plot(
    robot: RobotName,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="A .png, .svg or .html file.")
    ],
    base: Base = None,
    tip: Tip = None,
    task: TaskName = None,
    at: At = None,
    x: X = None,
    y: Y = None,
    colour: Colour = "verdict",
    fix: Fix = None,
) -> None:
    """Draw an arm that three joints decide, or the phase diagram of a sweep's DIR.

    Of an arm: the critical values and the aspects. Of a sweep: two parameters, with
    verdict or a count as colour; `cuspaudit plot DIR -o phases.html --fix d2=1`.
    """
    if Path(robot).is_dir():
        plot_family(Path(robot), output, x=x, y=y, colour=colour, fix=fix)
        return
    plot_robot(robot, output, base=base, tip=tip, task=task, at=at)


@app.command("import", epilog="Example: cuspaudit import ur5_robot --to msolve > ik.ms")
def import_(
    robot: Annotated[str | None, typer.Argument(metavar="ROBOT")] = None,
    base: Base = None,
    tip: Tip = None,
    task: TaskName = None,
    lock: Lock = None,
    convention: Convention = None,
    angle_unit: AngleUnit = None,
    to: Annotated[
        Form | None,
        typer.Option(
            help="dh: a robot file with the same forward kinematics. poly: f, R and "
            "det J. msolve: inverse kinematics of a real pose."
        ),
    ] = None,
    snap: Snap = "default",
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False,
    names: Annotated[
        bool, typer.Option("--list", help="List the robots known by name.")
    ] = False,
    seed: Seed = 0,
) -> None:
    """Show what was understood: chain, polynomial map, snapped numbers."""
    from cuspaudit.audit.descriptions import description_names
    from cuspaudit.audit.library import library

    if names:
        for name, path in library():
            typer.echo(f"{name:28} {path}")
        for name in description_names():
            typer.echo(f"{name:28} robot_descriptions")
        return
    if robot is None:
        _fail("import: no robot named; give ROBOT, or --list for the names known")
    square = to in (Form.poly, Form.msolve)
    opened, _ = _open(
        robot, base, tip, task, lock, convention, angle_unit, square=square
    )
    from cuspaudit.audit.understood import understood
    from cuspaudit.kinematics import snap as snap_chain
    from cuspaudit.kinematics.dh_writing import table_text
    from cuspaudit.kinematics.exact_model import exact_model
    from cuspaudit.kinematics.export import msolve_system, poly_text
    from cuspaudit.kinematics.snap_policy import policy_from_name

    policy = policy_from_name(snap)
    chain = snap_chain(opened.chain, policy)[0]
    if to is Form.dh:
        numbers = "as in the file" if policy.name == "none" else "snapped"
        source = opened.source or f"{Path(opened.file).name}, numbers {numbers}"
        typer.echo(table_text(chain, opened.title, source), nl=False)
    elif to is Form.poly:
        typer.echo(poly_text(exact_model(chain)), nl=False)
    elif to is Form.msolve:
        typer.echo(msolve_system(exact_model(chain), seed), nl=False)
    else:
        found = understood(opened, policy)
        typer.echo(json.dumps(found, indent=1)) if as_json else print_understood(found)


@app.command(epilog="Example: cuspaudit check robots/ -j 2 --junit report.xml")
def check(
    paths: Annotated[
        list[Path], typer.Argument(metavar="DIR|FILE...", help="Robot files.")
    ],
    junit_file: Annotated[
        Path | None, typer.Option("--junit", help="Write the results as JUnit XML.")
    ] = None,
    workers: Annotated[int, typer.Option("-j", min=1, help="Processes.")] = 1,
    strict: Annotated[
        bool, typer.Option("--strict", help="Count undecided as a mismatch.")
    ] = False,
    annotations: Annotated[
        bool,
        typer.Option(
            "--annotations",
            envvar="GITHUB_ACTIONS",
            help="Print GitHub annotations beside the lines they are about.",
        ),
    ] = False,
    update: Annotated[
        bool,
        typer.Option(
            "--update", help="Write what was found into files that expect nothing."
        ),
    ] = False,
) -> None:
    """Hold every robot file to the verdict and counts recorded in it."""
    from cuspaudit.audit.expectation import annotation, write_expectation
    from cuspaudit.audit.family import check_robots, junit, robot_files
    from cuspaudit.audit.writing import check_writable, write_text

    if junit_file:
        check_writable(junit_file)
    results = []
    for result in check_robots(robot_files(paths), workers):
        results.append(result)
        typer.echo(f"{result.status:14} {result.file}: {result.detail}")
        if annotations and (
            line := annotation(result.file, result.status, result.detail)
        ):
            typer.echo(line)
    if update:
        for result in results:
            if result.status == "no expectation" and (
                result.found.get("verdict") != "undecided"
                and write_expectation(Path(result.file), result.found)
            ):
                typer.echo(f"expectation written: {result.file}")
    bad = [r for r in results if r.is_failure or (strict and r.status == "undecided")]
    counts = {
        s: sum(r.status == s for r in results) for s in {r.status for r in results}
    }
    typer.echo(", ".join(f"{n} {status}" for status, n in sorted(counts.items())))
    if junit_file:
        write_text(junit_file, junit(results))
    raise typer.Exit(1 if bad else 0)


app.command(epilog="Example: cuspaudit sweep family.yaml -o table -j 2")(sweep)


def _open(
    name: str,
    base: str | None,
    tip: str | None,
    task: str | None,
    lock: list[str] | None,
    convention: str | None,
    angle_unit: str | None,
    square: bool = True,
) -> tuple[Robot, dict[str, str]]:
    from cuspaudit.audit.library import open_robot

    locked = {}
    for entry in lock or []:
        joint, equals, value = entry.partition("=")
        if not (joint and equals and value):
            _fail(f"--lock {entry}: not JOINT=VALUE; write for example joint_3=pi/4")
        locked[joint] = value
    robot = open_robot(
        name,
        base=base,
        tip=tip,
        task=task,
        lock=locked,
        convention=convention,
        angle_unit=angle_unit,
        square=square,
    )
    return robot, locked


def _audit(
    robot: Robot,
    locked: Mapping[str, str],
    seed: int,
    timeout: float | None,
    snap: str,
) -> Audit:
    from cuspaudit.audit.report import Options
    from cuspaudit.audit.report import audit as run
    from cuspaudit.kinematics.snap_policy import policy_from_name

    policy = policy_from_name(snap)
    with _progress() as step:
        return run(robot, Options(seed, timeout, locked, step, policy))


@contextmanager
def _progress() -> Iterator[Callable[[str], None]]:
    """A line with the name of the running step, on a terminal only."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda step: None
        return
    with console.status("import") as status:
        yield lambda step: status.update(step)


def _certificate_text(result: Audit) -> str | None:
    from cuspaudit.certificate import text_from_certificate

    if result.witness is None:
        return None
    return text_from_certificate(result.witness.certificate)


def _page(record: Mapping[str, Any], result: Audit, proof: str | None) -> str:
    from cuspaudit.audit.library import example_robot_data
    from cuspaudit.audit.shown import shown_postures
    from cuspaudit.kinematics.visuals import visuals
    from cuspaudit.viz import build_scene, render_page, sample_path, sample_postures

    chain: Chain = result.chain
    if result.witness is not None:
        chain = result.witness.chain
        frames = sample_path(chain, result.witness.path.tolist())
    else:
        frames = sample_postures(chain, *shown_postures(result))
    share = example_robot_data()
    shapes = (
        visuals(result.robot, [share] if share else []) if result.robot.urdf else ()
    )
    scene = build_scene(chain, frames, shapes)
    return render_page(record, scene, certificate=proof)


def _saved_audit(path: Path) -> dict[str, Any] | None:
    """What a saved audit says of its robot; None when the file is a D-H table."""
    try:
        record = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise InvalidInputError(
            file=str(path),
            found=f"cannot be read as JSON ({error})",
            expected="name an audit written with --json, or a robot",
        ) from error
    if not isinstance(record, dict) or record.get("schema") != "cuspaudit/audit/1":
        return None
    robot = record["robot"]
    return {
        "file": robot["file"],
        "base": robot["base"],
        "tip": robot["tip"],
        "task": robot["task"],
        "locked": robot.get("locked", {}),
        "seed": record["seed"],
        "snap": robot.get("snap_policy", {}).get("name", "default"),
    }


def _fail(message: str) -> NoReturn:
    typer.echo(f"cuspaudit: {message}", err=True)
    raise typer.Exit(BAD_INPUT)


def main() -> None:
    """Run the command line; no traceback reaches the user."""
    try:
        app()
    except CuspauditError as error:
        line = " ".join(str(error).split())
        typer.echo(f"cuspaudit: {line}", err=True)
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        typer.echo("cuspaudit: interrupted; nothing was written", err=True)
        sys.exit(130)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(BAD_INPUT)
