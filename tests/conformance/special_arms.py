"""Random special arms, written in ways that hide what is special about them.

An arm is a list of links (a, alpha in degrees, d) as in a D-H table. What makes it
special is a relation that holds exactly: a twist of a multiple of 30 or 45 degrees, a
length that is 0 or equals another. It is written as turns that cancel, as a direction
that a turn undoes, or as a URDF with link frames at random, at so many digits. Nothing
here uses the package.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

Links = tuple[tuple[Fraction, int, Fraction], ...]


@dataclass(frozen=True)
class SpecialArm:
    """An arm that is special.

    Attributes:
        kind: what is special about its first three joints, or about all six.
        links: a, alpha (degrees), d for each joint.
        writing: how the file has it.
        seed: of what is random in the writing.
    """

    kind: str
    links: Links
    writing: str
    seed: int

    @property
    def regional(self) -> Links:
        """The first three joints."""
        return self.links[:3]

    def file(self) -> tuple[str, str]:
        """The text of the robot file and its ending."""
        if self.writing.startswith("frames"):
            return _urdf(self.links, int(self.writing.split()[1]), self.seed), ".urdf"
        return _table(self.links, self.writing, self.seed), ".yaml"


KINDS = (
    *("axes 1, 2 parallel", "axes 2, 3 parallel", "axes 1, 2 meet", "axes 2, 3 meet"),
    *("square without offsets", "orthogonal without offset", "equal lengths", "twists"),
)
NONCUSPIDAL = KINDS[:6]
"""Three joints that theorems decide [Wenger, Robotica 2007], all noncuspidal."""
SIX = ("wrist", "UR pattern", "triple and pair")
WRITINGS = (
    *("plain", "degrees that cancel", "radians that cancel", "directions twice"),
    *("frames 17", "frames 9", "frames 6", "frames 5"),
)


def special_arms(count: int, joints: int, seed: int) -> list[SpecialArm]:
    """So many arms, of all kinds in all writings."""
    rng = random.Random(seed)
    arms = []
    for number in range(count):
        writing = WRITINGS[number % len(WRITINGS)]
        kind = KINDS[(number // len(WRITINGS) + number) % len(KINDS)]
        links = _three(rng, kind)
        if joints == 6:
            kind, links = _six(rng, SIX[number % len(SIX)], kind, links)
        arms.append(SpecialArm(kind, links, writing, rng.randrange(10**6)))
    return arms


def _length(rng: random.Random) -> Fraction:
    return Fraction(rng.choice((3, 4, 5, 6, 7, 8, 9, 10, 12)), 10)


def _three(rng: random.Random, kind: str) -> Links:
    twists = rng.choice(((30, 60, 90, 120, 150), (45, 90, 135)))
    alpha = [rng.choice(twists) * rng.choice((1, -1)) for _ in range(2)]
    a = [_length(rng) for _ in range(3)]
    d = [Fraction(0), rng.choice((Fraction(0), _length(rng))), _length(rng)]
    match kind:
        case "axes 1, 2 parallel":
            alpha[0] = rng.choice((0, 180))
        case "axes 2, 3 parallel":
            alpha[1] = rng.choice((0, 180))
        case "axes 1, 2 meet":
            a[0] = Fraction(0)
        case "axes 2, 3 meet":
            a[1] = Fraction(0)
        case "square without offsets":
            alpha[0], d[1], d[2] = 90, Fraction(0), Fraction(0)
        case "orthogonal without offset":
            alpha, d[1] = [90, rng.choice((90, -90))], Fraction(0)
        case "equal lengths":
            a[1] = a[2] = a[0]
            d[2] = rng.choice((Fraction(0), d[1]))
    if alpha[0] in (0, 180):
        alpha[1] = rng.choice((90, 60, 45))
    return ((a[0], alpha[0], d[0]), (a[1], alpha[1], d[1]), (a[2], 0, d[2]))


def _six(
    rng: random.Random, kind: str, regional: str, three: Links
) -> tuple[str, Links]:
    zero, tip = Fraction(0), _length(rng)
    if kind == "UR pattern":
        a, d = (_length(rng), _length(rng)), [_length(rng) for _ in range(3)]
        links = (
            *((zero, 90, zero), (a[0], 0, zero), (a[1], rng.choice((0, 180)), zero)),
            *((zero, 90, d[0]), (zero, -90, d[1]), (zero, 0, d[2])),
        )
        return kind, links
    if kind == "triple and pair":
        a, d = [_length(rng) for _ in range(4)], [_length(rng) for _ in range(4)]
        links = (
            *(
                (a[0], rng.choice((60, 90, 45)), zero),
                (a[1], 0, d[0]),
                (a[2], 180, zero),
            ),
            *((a[3], 90, d[1]), (zero, rng.choice((90, -90)), d[2]), (zero, 0, d[3])),
        )
        return kind, links
    # the tip of three joints becomes the point of the wrist, axis 4 along a turn of it
    (first, second, (a3, _, d3)) = three
    wrist = ((zero, -90, zero), (zero, 90, zero), (zero, 0, tip))
    links = (first, second, (a3, rng.choice((90, -90)), d3), *wrist)
    return f"wrist: {regional}", links


def _motions(links: Links) -> list[list[str]]:
    """Before each joint, and after the last one: moves, then turns about x."""
    steps: list[list[str]] = [[]]
    for a, alpha, d in links:
        step = [f"move {a} 0 {d}"]
        steps.append([*step, f"turn {alpha} deg about 1 0 0"] if alpha else step)
    return steps


def _table(links: Links, writing: str, seed: int) -> str:
    rng, rows, steps = random.Random(seed), [], _motions(links)
    axes = ["0 0 1"] * len(links)
    if writing.endswith("cancel"):
        steps = [_cancelled(rng, step, writing.split()[0]) for step in steps[:-1]] + [
            steps[-1]
        ]
    if writing == "directions twice":
        for k in range(1, len(links)):
            half = rng.choice((1, -1))
            # in a frame turned by 45 degrees about x, z is (0, +-1, 1)
            steps[k].append(f"turn {45 * half} deg about 1 0 0")
            axes[k] = f"0 {half} 1"
            steps[k + 1].insert(0, f"turn {-45 * half} deg about 1 0 0")
    for step, axis in zip(steps, axes, strict=False):
        before = f"before: [{', '.join(step)}], " if step else ""
        rows.append(f"  - {{type: revolute, {before}axis: {axis}}}")
    task = "position" if len(links) == 3 else "pose"
    head = f"name: special\nconvention: standard\nunits: m\ntask: {task}\njoints:\n"
    return head + "\n".join(rows) + f"\ntool: [{', '.join(steps[-1])}]\n"


def _cancelled(rng: random.Random, step: list[str], unit: str) -> list[str]:
    """A step with three turns more, which sum to nothing."""
    x, y = rng.randrange(11, 80), rng.randrange(11, 80)
    parts = [f"{n} deg" for n in (x + y, -x, -y)]
    if unit == "radians":
        parts = [f"{n / 100} rad" for n in (x + y, -x, -y)]
    return [*step, *(f"turn {part} about 1 0 0" for part in parts)] if step else step


def transform(a: Fraction, alpha: int, d: Fraction) -> np.ndarray:
    """Tz(d) Tx(a) Rx(alpha), with cosines of right angles exactly 0."""
    c, s = np.round((np.cos(np.radians(alpha)), np.sin(np.radians(alpha))), 16)
    return np.array(
        [[1, 0, 0, float(a)], [0, c, -s, 0], [0, s, c, float(d)], [0, 0, 0, 1.0]]
    )


def _urdf(links: Links, digits: int, seed: int) -> str:
    """The arm with link frames at random, as CAD programs write it."""
    rng = np.random.default_rng(seed)
    rows, back, placed = ['<robot name="special"><link name="base"/>'], np.eye(4), None
    steps = [np.eye(4), *(transform(*link) for link in links)]
    for number, step in enumerate(steps[:-1], 1):
        frame = np.eye(4)
        frame[:3, :3] = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        frame[:3, :3] *= np.linalg.det(frame[:3, :3])
        frame[2, 3] = rng.uniform(-0.3, 0.3)
        placed = np.linalg.inv(back) @ step @ frame
        axis = frame[:3, :3].T @ [0, 0, 1]
        parent = "base" if number == 1 else f"l{number - 1}"
        rows.append(
            f'<link name="l{number}"/><joint name="j{number}" type="continuous">'
            f'<parent link="{parent}"/><child link="l{number}"/>'
            f'{_origin(placed, digits)}<axis xyz="{_numbers(axis, digits)}"/></joint>'
        )
        back = frame
    tip = np.linalg.inv(back) @ steps[-1]
    rows.append(
        f'<link name="tip"/><joint name="tool" type="fixed"><parent link='
        f'"l{len(links)}"/><child link="tip"/>{_origin(tip, digits)}</joint></robot>'
    )
    return "\n".join(rows)


def _origin(placed: np.ndarray, digits: int) -> str:
    R = placed[:3, :3]
    roll, yaw = np.arctan2(R[2, 1], R[2, 2]), np.arctan2(R[1, 0], R[0, 0])
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    xyz = _numbers(placed[:3, 3], digits)
    return f'<origin xyz="{xyz}" rpy="{_numbers((roll, pitch, yaw), digits)}"/>'


def _numbers(values: object, digits: int) -> str:
    return " ".join(f"{value:.{digits}g}" for value in np.asarray(values))


def rewritten(arm: SpecialArm, writing: str) -> SpecialArm:
    """The same arm, written otherwise."""
    return replace(arm, writing=writing)
