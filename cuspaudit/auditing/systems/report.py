"""The decision of a polynomial system as JSON, in the schema of an audit."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from cuspaudit.algebra.points.parametrization import RealPoint
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.auditing.record import PACKAGES, SCHEMA
from cuspaudit.auditing.systems.file import SystemFile
from cuspaudit.cuspidality.decision import Engine, decide
from cuspaudit.cuspidality.decision_result import Decision
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.runtime.own_process import run_in_own_process
from cuspaudit.runtime.steps import Step
from cuspaudit.runtime.versions import versions

__all__ = ["decide_system"]

_BITS = 53
_SETTLE = (
    "more time or memory, the other engine, or an equivalent system of less degree"
)


def decide_system(
    system: SystemFile,
    engine: Engine = "auto",
    *,
    complete: bool = False,
    seed: int = 1,
    timeout: float | None = None,
    memory: int | None = None,
    progress: Callable[[str], None] = lambda step: None,
) -> dict[str, Any]:
    """The record of one run of Algorithm 1, ``robot`` null, in a process of its own.

    Args:
        system: V and R.
        engine: the route to connectivity; "auto" looks for a couple first.
        complete: whether "auto" is to make the whole run although there is a couple.
        seed: of every random choice.
        timeout: in s, or None. What is not done by then is undecided, at its step.
        memory: bytes of the process, or None; likewise.
        progress: called with the name of the step under way.

    Raises:
        AssumptionError: a hypothesis of the algorithm fails for this system.
    """
    started = time.perf_counter()
    shared: dict[str, Any] = {"engine": engine, "complete": complete}
    shared |= {"seed": seed, "timeout": timeout}
    seen = _Seen(progress)

    def work(report: Callable[[str], None]) -> dict[str, Any]:
        run = decide(system.variety, system.mapping, **shared, progress=report)
        return _record(system, run, seed)

    record: dict[str, Any]
    try:
        record = run_in_own_process(work, timeout=timeout, memory=memory, progress=seen)
    except UnableError as limit:
        run = Decision(
            system.variety, system.mapping, failure=limit, steps=seen.steps()
        )
        record = _record(system, run, seed)
    total = time.perf_counter() - started
    record["seconds"] |= {"total": round(total, 4), "decide": round(total, 4)}
    return record


class _Seen:
    """The steps of another process, as seen from here: without their memory."""

    def __init__(self, progress: Callable[[str], None]) -> None:
        self._progress = progress
        self._begun: list[tuple[str, float]] = []

    def __call__(self, name: str) -> None:
        if not self._begun or self._begun[-1][0] != name:
            self._begun.append((name, time.perf_counter()))
        self._progress(name)

    def steps(self) -> tuple[Step, ...]:
        """The steps so far, the last one until now."""
        ends = [begun for _, begun in self._begun[1:]] + [time.perf_counter()]
        return tuple(
            Step(name, end - begun, None)
            for (name, begun), end in zip(self._begun, ends, strict=True)
        )


def _record(system: SystemFile, run: Decision, seed: int) -> dict[str, Any]:
    return {
        "schema": SCHEMA,
        "robot": None,
        "system": {
            "name": system.name,
            "file": system.file,
            "variables": list(system.variety.ring.variables),
            "equations": [str(f) for f in system.variety.equations],
            "map": [
                *(str(r) for r in system.mapping.components),
                *(f"angle [{c}, {s}]" for c, s in system.mapping.angles),
            ],
        },
        "verdict": run.verdict.value,
        "proof": _proof(run),
        "aspects": {"count": run.components, "proved": run.components is not None},
        "postures": _postures(run),
        "singular": {
            "determinant": "; ".join(map(str, run.minors)),
            "factors": _factors(run.minors),
            "cusps": None,
            "nodes": None,
        },
        "witness": _witness(run),
        "models": {"literal": run.verdict.value, "snapped": run.verdict.value},
        **dict.fromkeys(("limits", "cusp", "structures", "margin", "tolerance")),
        "crosscheck": None,
        "undecided": _undecided(run),
        "steps": [_step(step) for step in run.steps],
        "seconds": {"total": 0.0, "import": 0.0, "decide": 0.0, "certify": 0.0}
        | {"crosscheck": 0.0},
        "versions": versions(PACKAGES),
        "seed": seed,
    }


def _step(step: Step) -> dict[str, Any]:
    megabytes = None if step.megabytes is None else round(step.megabytes, 1)
    return {
        "name": step.name,
        "seconds": round(step.seconds, 4),
        "megabytes": megabytes,
    }


def _proof(run: Decision) -> dict[str, Any]:
    kind = {Verdict.CUSPIDAL: "witness", Verdict.NONCUSPIDAL: "exact"}
    return {
        "kind": kind.get(run.verdict, "none"),
        "engine": run.engine,
        "reduction": None,
        "rests_on": list(run.rests_on),
        "why": _why(run),
    }


def _why(run: Decision) -> str:
    count = len(run.samples)
    if run.couple is not None:
        value = ", ".join(map(str, run.couple.value))
        return f"two points over ({value}) lie in one component of V - {{Delta = 0}}"
    if run.failure is not None:
        return str(run.failure)
    cells = f"over {count} sample values, one at least in every cell without atypical "
    if run.engine == "signs":
        return f"{cells}values, the factors of Delta differ in sign at any two points"
    return (
        f"{cells}values, all points of a fiber lie in different ones of the "
        f"{run.components} components of V - {{Delta = 0}}"
    )


def _postures(run: Decision) -> dict[str, Any]:
    known = run.verdict is not Verdict.UNDECIDED
    most = run.most_points if known else None
    return {"max": most, "proved": known and run.most_is_proved}


def _factors(minors: tuple[Polynomial, ...]) -> list[str]:
    if len(minors) != 1:
        return []
    return [f"({p})^{n}" if n > 1 else str(p) for p, n in minors[0].factor()[1]]


def _witness(run: Decision) -> dict[str, Any] | None:
    if run.couple is None:
        return None
    couple = run.couple
    return {
        "sign": couple.sign,
        "postures": [_floats(point) for point in couple.points],
        "path": [[float(x) for x in row] for row in couple.path],
        "value": [str(q) for q in couple.value],
        "clearance": None,
        "certificate": None,
    }


def _floats(point: RealPoint) -> list[float]:
    return [float(ball.mid()) for ball in point.ball(_BITS).values()]


def _undecided(run: Decision) -> dict[str, Any] | None:
    if run.failure is None:
        return None
    return {
        "step": run.failure.step,
        "why": str(run.failure),
        "looked_for": [],
        "would_settle": _SETTLE,
    }
