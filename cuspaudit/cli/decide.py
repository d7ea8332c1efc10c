"""`cuspaudit decide`: Algorithm 1 on a polynomial system and map, no robot."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

from cuspaudit.cli.exit_codes import OF_VERDICT
from cuspaudit.cli.options import Engine, EngineName, Seed
from cuspaudit.cli.outlet import JsonFile, check_outlets, write_json
from cuspaudit.cli.running import progress_bar
from cuspaudit.cli.summary import COLOUR
from cuspaudit.errors import AssumptionError

__all__ = ["STEPS", "decide", "print_decision"]

#: of Algorithm 1, in the order of the paper
STEPS = (
    *("crit", "check_assumption_a", "find_couple"),
    *("atypical_values", "sample_points_rational"),
    *("sample_points", "roadmap", "routing", "graph_connected"),
)


def decide(
    system: Annotated[
        Path,
        typer.Argument(
            metavar="SYSTEM",
            help=r"A YAML file: variables: \[x, y], equations: \[], "
            r"map: \[x^3 + x*y, y].",
        ),
    ],
    json_file: JsonFile = None,
    engine: EngineName = Engine.auto,
    complete: Annotated[
        bool,
        typer.Option("--complete", help="The whole run although a couple was found."),
    ] = False,
    seed: Seed = 1,
    timeout: Annotated[
        float, typer.Option(min=0.0, help="Seconds after which it is undecided.")
    ] = 3600.0,
    memory: Annotated[
        float, typer.Option(min=0.5, help="GiB after which it is undecided.")
    ] = 8.0,
    exit_zero: Annotated[
        bool, typer.Option("--exit-zero", help="Exit 0 whatever the verdict.")
    ] = False,
) -> None:
    """Decide whether a polynomial map R on V = {f = 0} is cuspidal: Algorithm 1.

    Two engines tell which points of V are connected without meeting a critical point:
    the sheets of R over the cells of its values (roadmap), and the maxima and saddles
    of |Delta| (routing). auto looks for a couple first, which alone makes R cuspidal;
    else, or with --complete, it takes the first engine, and the second where that is
    unable.
    """
    from cuspaudit.auditing.systems.file import read_system
    from cuspaudit.auditing.systems.report import decide_system
    from cuspaudit.runtime.waiting import waited

    check_outlets(json_file)
    read = read_system(system)
    try:
        with progress_bar(STEPS) as step:
            record = decide_system(
                read,
                engine.value,
                complete=complete,
                seed=seed,
                timeout=timeout,
                memory=int(memory * 2**30),
                progress=step,
            )
    except AssumptionError as error:
        name = type(error).__name__
        raise AssumptionError(f"{system}: {name}: {error}") from error
    record["seconds"]["total"] = round(waited(), 4)
    if write_json(json_file, record):
        print_decision(record, json_file)
    raise typer.Exit(0 if exit_zero else OF_VERDICT[record["verdict"]])


def print_decision(record: dict[str, Any], json_file: str | None) -> None:
    """The decision of a system for people."""
    table = Table.grid(padding=(0, 2))
    system, verdict, proof = record["system"], record["verdict"], record["proof"]
    rows: dict[str, Any] = {
        "system": f"{system['name']}: {len(system['variables'])} variables, "
        f"{len(system['equations'])} equations, map to R^{len(system['map'])}",
        "verdict": Text(verdict, style=COLOUR[verdict]),
        "why": proof["why"],
        "proof": ", ".join([str(proof["engine"]), *proof["rests_on"]])
        if proof["engine"]
        else None,
        "aspects": record["aspects"]["count"],
        "postures": _postures(record["postures"]),
        "Delta": " · ".join(f"({f})" for f in record["singular"]["factors"])
        or record["singular"]["determinant"],
    }
    if record["witness"]:
        for name, point in zip("pq", record["witness"]["postures"], strict=True):
            rows[f"point {name}"] = ", ".join(f"{x:.6g}" for x in point)
        rows["path"] = f"{len(record['witness']['path'])} points, with --json"
    if record["undecided"]:
        rows["settled by"] = record["undecided"]["would_settle"]
    rows["steps"] = ", ".join(
        f"{step['name']} {step['seconds']:.2f} s" for step in record["steps"]
    )
    rows["JSON"] = json_file
    rows["time"] = f"{record['seconds']['total']:.2f} s"
    for name, value in rows.items():
        if value not in (None, ""):
            shown = value if isinstance(value, Text) else Text(str(value))
            table.add_row(Text(name, style="dim"), shown)
    Console(highlight=False, soft_wrap=True).print(table)


def _postures(found: dict[str, Any]) -> str:
    """The largest fiber; the largest that was seen where it may not be that."""
    if found["max"] is None:
        return ""
    return f"{found['max']}" if found["proved"] else f"{found['max']} seen"
