"""Random arms of six joints with one to three slides: verdicts beside a numeric count.

    python tests/slides_table.py [COUNT] [--seed N] [--timeout S]

Half of the arms are special (parallel and meeting axes, right angles), half general.
For each, Newton's method meets postures of random poses, and those of one pose with one
sign of det J are tried to be joined by straight lines on which det J keeps its sign. A
line found for an arm that was called noncuspidal would refute the verdict.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.errors import CuspauditError
from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    JointKind,
    Motion,
    Rotation,
    Translation,
)
from cuspaudit.robot.frames import frames, jacobian
from cuspaudit.robot.proposals import is_regular
from cuspaudit.robot.robot import Robot

Matrix = NDArray[np.float64]

_STARTS, _STEPS, _POSES, _POINTS = 24, 25, 3, 60
_QUARTERS = [Fraction(k, 2) for k in (0, 0, 1, 1, -1)]


@dataclass(frozen=True)
class Row:
    """One arm.

    Attributes:
        kinds: of its joints, such as PRRRRR.
        is_special: whether its axes were drawn from right angles and zeros.
        verdict: of the audit, or "refused".
        why: the reason that it gives.
        most: the most postures of one pose that were met, by sign of det J.
        is_joined: whether a line joined two postures of one pose.
    """

    kinds: str
    is_special: bool
    verdict: str
    why: str
    most: tuple[int, int]
    is_joined: bool

    @property
    def is_wrong(self) -> bool:
        """Whether the numeric line refutes the verdict."""
        return self.verdict == "noncuspidal" and self.is_joined


def arms(count: int, seed: int) -> Iterator[tuple[str, bool, Chain]]:
    """Regular arms: kinds, whether special, chain."""
    rng = np.random.default_rng(seed)
    made = 0
    while made < count:
        kinds = ["R"] * 6
        for slide in rng.choice(6, size=int(rng.integers(1, 4)), replace=False):
            kinds[slide] = "P"
        special = bool(rng.integers(2))
        chain = _chain("".join(kinds), special, rng)
        if is_regular(chain):
            made += 1
            yield "".join(kinds), special, chain


def table(count: int, seed: int, timeout: float) -> Iterator[Row]:
    """A row for each of ``count`` arms."""
    for number, (kinds, special, chain) in enumerate(arms(count, seed)):
        try:
            answer = audit(Robot("arm", "arm", chain), Options(timeout=timeout)).answer
            verdict, why = answer.verdict.value, answer.why
        except CuspauditError as error:
            verdict, why = "refused", str(error)
        most, joined = _numeric(chain, np.random.default_rng(number))
        yield Row(kinds, special, verdict, why, most, joined)


def _chain(kinds: str, special: bool, rng: np.random.Generator) -> Chain:
    """A random standard table."""
    names: dict[str, JointKind] = {"R": "revolute", "P": "prismatic"}

    def length() -> Fraction:
        zero = special and rng.random() < 0.5
        return Fraction(0) if zero else Fraction(int(rng.integers(2, 12)), 10)

    def turn() -> Angle:
        if special:
            return Angle(_QUARTERS[int(rng.integers(len(_QUARTERS)))])
        return Angle(radians=Fraction(int(rng.integers(-28, 29)), 10))

    joints = []
    before: tuple[Motion, ...] = ()
    for k, kind in enumerate(kinds, 1):
        joints.append(Joint(f"j{k}", names[kind], before))
        theta = (Rotation(Z_AXIS, turn()),) if kind == "P" else ()
        step = Translation((length(), Fraction(0), length()))
        before = tuple(
            motion
            for motion in (*theta, step, Rotation(X_AXIS, turn()))
            if isinstance(motion, Translation) or not motion.angle.is_zero
        )
    return Chain("arm", tuple(joints), before, "pose")


def _numeric(chain: Chain, rng: np.random.Generator) -> tuple[tuple[int, int], bool]:
    """The most postures of a pose by sign, and whether a line joins two of one."""
    most, joined = (0, 0), False
    for _ in range(_POSES):
        goal = frames(chain, rng.uniform(-2, 2, 6))[-1]
        met = _postures(chain, goal, rng)
        signs = [np.sign(np.linalg.det(jacobian(chain, q))) for q in met]
        count = (signs.count(1.0), signs.count(-1.0))
        most = max(most, count, key=sum)
        joined = joined or any(
            _keeps_sign(chain, p, q)
            for i, p in enumerate(met)
            for j, q in enumerate(met[:i])
            if signs[i] == signs[j]
        )
    return most, joined


def _postures(chain: Chain, goal: Matrix, rng: np.random.Generator) -> list[Matrix]:
    """The postures of a pose that Newton's method meets from random starts."""
    slides = np.array([kind == "prismatic" for kind in chain.kinds])
    found: list[Matrix] = []
    for _ in range(_STARTS):
        q = rng.uniform(-3, 3, 6)
        for _ in range(_STEPS):
            tip = frames(chain, q)[-1]
            skew = goal[:3, :3] @ tip[:3, :3].T
            skew = (skew - skew.T) / 2
            error = np.r_[goal[:3, 3] - tip[:3, 3], skew[2, 1], skew[0, 2], skew[1, 0]]
            if np.abs(error).max() < 1e-12:
                break
            J = jacobian(chain, q)
            step = J.T @ np.linalg.solve(J @ J.T + 1e-9 * np.eye(6), error)
            q = q + step * min(1.0, 1.0 / max(np.abs(step).max(), 1e-300))
        q = np.where(slides, q, np.angle(np.exp(1j * q)))
        if np.abs(frames(chain, q)[-1] - goal).max() < 1e-9 and not any(
            np.abs(_between(p, q, slides)).max() < 1e-5 for p in found
        ):
            found.append(q)
    return found


def _between(p: Matrix, q: Matrix, slides: NDArray[np.bool_]) -> Matrix:
    """The way from p to q, the short way round."""
    way: Matrix = np.where(slides, q - p, np.angle(np.exp(1j * (q - p))))
    return way


def _keeps_sign(chain: Chain, p: Matrix, q: Matrix) -> bool:
    """Whether det J keeps its sign on the straight line, well away from 0."""
    slides = np.array([kind == "prismatic" for kind in chain.kinds])
    way = _between(p, q, slides)
    values = [
        np.linalg.det(jacobian(chain, p + t * way)) for t in np.linspace(0, 1, _POINTS)
    ]
    least = min(values) if values[0] > 0 else -max(values)
    return bool(least > 1e-3 * np.abs(values).max())


def show(rows: list[Row]) -> str:
    """The table by kind of arm and verdict."""
    lines = []
    for special in (True, False):
        verdicts = Counter(row.verdict for row in rows if row.is_special == special)
        said = ", ".join(f"{count} {name}" for name, count in verdicts.most_common())
        lines.append(f"{'special' if special else 'general'}: {said}")
    undecided = sum(row.verdict == "undecided" for row in rows)
    lines.append(f"undecided: {undecided} of {len(rows)}")
    lines.append(f"wrong: {sum(row.is_wrong for row in rows)}")
    return "\n".join(lines)


def main() -> None:
    """Print a line for each arm, then the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("count", nargs="?", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--timeout", type=float, default=2.0)
    chosen = parser.parse_args()
    rows = []
    for row in table(chosen.count, chosen.seed, chosen.timeout):
        rows.append(row)
        kind = "special" if row.is_special else "general"
        print(row.kinds, kind, row.verdict, row.most, row.is_joined, row.why[:90])
        sys.stdout.flush()
    print(show(rows))


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))
    main()
