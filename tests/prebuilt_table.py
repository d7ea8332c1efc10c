"""The arms whose kinematics the package ssik carries, audited: verdicts by class.

    python tests/prebuilt_table.py [FOLDER] [--timeout S]

FOLDER is that of the unpacked package, by default where it is installed. Its modules
are read, never imported: lists of literal numbers, one transform before and one after
each joint, written by a program as floats. Lengths and axes are taken to nine decimals,
rotations as turns about z, y, x that snapping makes exact. Forward kinematics are held
to the pose at zero that each module states. Of seven joints one is locked at 0.
"""

from __future__ import annotations

import argparse
import ast
import importlib.util
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.errors import CuspauditError
from cuspaudit.robot.chain import (
    X_AXIS,
    Y_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    JointKind,
    Motion,
    Rotation,
    Translation,
    Vector,
)
from cuspaudit.robot.frames import frames
from cuspaudit.robot.proposals import fitting_locks
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.task import lock

Matrix = NDArray[np.float64]

_PLACES = 9
_KINDS: dict[str, JointKind] = {"revolute": "revolute", "prismatic": "prismatic"}


@dataclass(frozen=True)
class Row:
    """One arm.

    Attributes:
        name: vendor and model.
        joints: how many it has.
        verdict: of the audit, or "refused".
        ground: the theorem, or the kind of proof.
        why: the reason that is given.
    """

    name: str
    joints: int
    verdict: str
    ground: str
    why: str


def modules(folder: Path) -> list[Path]:
    """The modules of the arms."""
    return sorted((folder / "prebuilt").glob("*/*_ik.py"))


def installed() -> Path | None:
    """The folder of the installed package, without importing it."""
    spec = importlib.util.find_spec("ssik")
    places = spec.submodule_search_locations if spec else None
    return Path(next(iter(places))) if places else None


def read(path: Path) -> tuple[Chain, Matrix]:
    """The chain of a module, and the pose at zero that it states."""
    values: dict[str, Any] = {}
    for node in ast.parse(path.read_text("utf-8")).body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            name = node.targets[0].id
            if name.startswith("_JOINT_") or name == "T_HOME":
                values[name] = _literal(node.value)
    joints = []
    before: tuple[Motion, ...] = ()
    for k, name in enumerate(values["_JOINT_NAMES"]):
        before += _motions(values["_JOINT_T_LEFTS"][k])
        kind = _KINDS[values["_JOINT_TYPES"][k]]
        limits = _limits(values["_JOINT_LIMITS"][k])
        axis = _vector(values["_JOINT_AXES"][k])
        joints.append(Joint(name, kind, before, axis, limits))
        before = _motions(values["_JOINT_T_RIGHTS"][k])
    chain = Chain(path.stem, tuple(joints), before, "pose")
    return chain, np.array(values["T_HOME"], float)


def table(folder: Path, timeout: float) -> Iterator[Row]:
    """A row for each arm."""
    for path in modules(folder):
        name = f"{path.parent.name} {path.stem.removesuffix('_ik')}"
        chain, home = read(path)
        count = len(chain.joints)
        error = np.abs(frames(chain, np.zeros(count))[-1] - home).max()
        if error > 1e-6:
            yield Row(name, count, "refused", "", f"home pose differs by {error:.1e}")
            continue
        try:
            if count == 7:
                [names] = fitting_locks(chain, 1, 1)
                held = dict.fromkeys(names, "0")
                chain = replace(lock(chain, held), task="pose")
            robot = Robot(name, str(path), chain)
            found = audit(robot, Options(timeout=timeout)).answer
        except CuspauditError as refusal:
            yield Row(name, count, "refused", "", str(refusal))
            continue
        ground = found.reduction.kind if found.reduction else "general"
        yield Row(name, count, found.verdict.value, ground, found.why)


def show(rows: list[Row]) -> str:
    """How many arms of each class have which verdict."""
    classes = Counter((row.joints, row.ground, row.verdict) for row in rows)
    return "\n".join(
        f"{joints} joints, {ground or 'none'}: {count} {verdict}"
        for (joints, ground, verdict), count in sorted(classes.items())
    )


def _limits(pair: Any) -> tuple[Angle, Angle] | None:
    if pair is None:
        return None
    lower, upper = (Angle(radians=Fraction(str(value))) for value in pair)
    return lower, upper


def _literal(node: ast.expr) -> Any:
    """The value of lists, tuples and numbers, np.array(...) taken for its list."""
    if isinstance(node, ast.Call):
        return _literal(node.args[0])
    if isinstance(node, ast.List | ast.Tuple):
        return [_literal(entry) for entry in node.elts]
    return ast.literal_eval(node)


def _vector(values: Any) -> Vector:
    x, y, z = (Fraction(f"{value:.{_PLACES}f}") for value in values)
    return x, y, z


def _motions(rows: Any) -> tuple[Motion, ...]:
    """A transform as a step and turns about z, y, x."""
    T = np.array(rows, float)
    step = _vector(T[:3, 3])
    motions: list[Motion] = [Translation(step, "xyz")] if any(step) else []
    level = float(np.hypot(T[0, 0], T[1, 0]))
    pitch = float(np.arctan2(-T[2, 0], level))
    if level > 1e-9:
        yaw, roll = np.arctan2(T[1, 0], T[0, 0]), np.arctan2(T[2, 1], T[2, 2])
    else:
        yaw, roll = 0.0, np.arctan2(np.sign(pitch) * T[0, 1], T[1, 1])
    for axis, value in ((Z_AXIS, yaw), (Y_AXIS, pitch), (X_AXIS, roll)):
        radians = Fraction(f"{float(value):.12f}")
        if radians:
            motions.append(Rotation(axis, Angle(radians=radians), "turn"))
    return tuple(motions)


def main() -> None:
    """Print a line for each arm, then the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", nargs="?", type=Path, default=installed())
    parser.add_argument("--timeout", type=float, default=10.0)
    chosen = parser.parse_args()
    if chosen.folder is None:
        sys.exit("no package ssik: pip install --no-deps ssik, or give its folder")
    rows = []
    for row in table(chosen.folder, chosen.timeout):
        rows.append(row)
        ground = f"{row.joints} {row.verdict:12} {row.ground:18}"
        print(f"{row.name:34} {ground} {row.why[:60]}")
        sys.stdout.flush()
    print(show(rows))


if __name__ == "__main__":
    main()
