"""Two arms with a path each, and audits as the audit room writes them."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np

from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Rotation,
    Translation,
)
from cuspaudit.robot.frames import frames

QUARTER = Angle(half_turns=Fraction(1, 2))
CRX_AXES = ((0, 0, 1), (0, 1, 0), (0, -1, 0), (-1, 0, 0), (0, -1, 0), (-1, 0, 0))
CRX_STEPS = (
    *(("0", "0", "0.245"), ("0", "0", "0"), ("0", "0", "0.71"), ("0", "0", "0")),
    *(("0.54", "-0.15", "0"), ("0.16", "0", "0"), ("0", "0", "0")),
)
# fanuc_crx10ial_couple of the project's list of known robots: two postures, one pose
CRX_COUPLE = (
    (-3.10159265359, -1.98, -1.36159265359, 0.47159265359, 0.32, -1.94),
    (
        *(-2.351541039862, -2.089140450037, -0.943744242273),
        *(4.202133156789, 0.36555118529, -5.061892439164),
    ),
)


def vector(*numbers: Any) -> tuple[Fraction, Fraction, Fraction]:
    """Three exact numbers from text, integers or fractions."""
    x, y, z = (Fraction(n) for n in numbers)
    return x, y, z


def issac_chain(name: str = "Orthogonal 3R, ISSAC 2022", unit: str = "m") -> Chain:
    """D-H standard: a = 1, 2, 3/2; d = 0, 1, 0; alpha = -90, 90, 0 degrees."""
    size = {"m": 1, "mm": 1000}[unit]
    rows = ((1, 0, -QUARTER), (2, 1, QUARTER), (Fraction(3, 2), 0, Angle()))
    joints, motions = [], ()
    for i, (a, d, alpha) in enumerate(rows):
        joints.append(Joint(f"joint_{i + 1}", "revolute", motions))
        motions = (
            Translation(vector(0, 0, d * size)),
            Translation(vector(a * size, 0, 0)),
            Rotation(X_AXIS, alpha),
        )
    return Chain(name, tuple(joints), motions, unit=unit)


def issac_path(chain: Chain, count: int = 60) -> list[list[float]]:
    """A straight line in (theta2, theta3); theta1 brings the tool home at the end."""
    start = np.array([-0.742, 2.628])
    end = same_place(chain, start, np.array([-3.0, -0.5]))
    points = [frames(chain, [0.0, *q])[-1, :3, 3] for q in (start, end)]
    bearing = [math.atan2(p[1], p[0]) for p in points]
    steps = np.linspace(0, 1, count)
    turn = (bearing[0] - bearing[1] + math.pi) % (2 * math.pi) - math.pi
    return [[turn * t, *(start + t * (end - start))] for t in steps]


def same_place(chain: Chain, given: Any, guess: Any) -> Any:
    """Newton's method from ``guess`` to where radius and height are those given."""

    def place(q: Any) -> Any:
        x, y, z = frames(chain, [0.0, *q])[-1, :3, 3]
        return np.array([math.hypot(x, y), z])

    for _ in range(8):
        steps = 1e-6 * np.eye(2)
        J = np.column_stack([place(guess + h) - place(guess - h) for h in steps])
        guess = guess - np.linalg.solve(J / 2e-6, place(guess) - place(given))
    return guess


def crx_chain() -> Chain:
    """The arm as products of exponentials: axes and steps in the base's directions."""
    joints = tuple(
        Joint(f"J{i + 1}", "revolute", (Translation(vector(*step)),), vector(*axis))
        for i, (axis, step) in enumerate(zip(CRX_AXES, CRX_STEPS, strict=False))
    )
    tool = (Translation(vector(*CRX_STEPS[-1])),)
    return Chain("FANUC CRX-10iA/L", joints, tool, task="pose", tip="tool0")


def slider_chain() -> Chain:
    """A turntable, a lift and a reach: R, P, P in mm."""
    return Chain(
        "Turntable, lift and reach",
        (
            Joint("turn", "revolute", ()),
            Joint("lift", "prismatic", (Translation(vector(0, 0, 300)),)),
            Joint("reach", "prismatic", (Translation(vector(0, 0, 100)),), X_AXIS),
        ),
        (Translation(vector(120, 0, 0)), Rotation(Z_AXIS, Angle())),
        unit="mm",
    )


def audit_of(chain: Chain, verdict: str, path: list[list[float]] | None) -> dict:
    """An audit with every key of schema cuspaudit/audit/2."""
    kinds = {"cuspidal": "witness", "noncuspidal": "exact", "undecided": "none"}
    witness = path and {
        "sign": 1 if chain.task == "position" else -1,
        "postures": [path[0], path[-1]],
        "path": path,
        "clearance": 0.058,
        "certificate": "audits/issac.certificate.json",
    }
    return {
        "schema": "cuspaudit/audit/2",
        "robot": {
            "name": chain.name,
            "file": "robots/arm.yaml",
            "joints": len(chain.joints),
            "base": chain.base,
            "tip": chain.tip,
            "task": chain.task,
            "exact": True,
            "snapped": [
                {"where": "joint_2 rpy[0]", "given": 1.5708, "used": "pi/2"},
                {"where": "joint_5 xyz[1]", "given": -0.1500001, "used": "-3/20"},
            ],
        },
        "verdict": verdict,
        "proof": {
            "kind": kinds[verdict],
            "engine": "roadmap",
            "reduction": "spherical wrist" if chain.task == "pose" else None,
            "rests_on": ["FLINT resultants", "ball arithmetic"],
            "why": {
                "cuspidal": "A certified path joins two postures of one aspect.",
                "noncuspidal": "Each posture of each sample point has its own aspect.",
                "undecided": "No decidable structure was found.",
            }[verdict],
        },
        "aspects": {"count": 2, "proved": True},
        "postures": {"max": 4, "proved": False},
        "singular": {
            "determinant": "18*c2*c3 + 24*c2 - 9*s3*c3 - 12*s3",
            "factors": ["3*c3 + 4", "2*c2 - s3"],
            "cusps": 4,
            "nodes": 0,
        },
        "witness": witness or None,
        "models": {"literal": verdict, "snapped": verdict},
        **dict.fromkeys(("limits", "cusp", "structures", "margin", "tolerance")),
        "crosscheck": {
            "engine": "pinocchio",
            "samples": 100,
            "max_relative_error": 1.3e-13,
            "singular_points_checked": 20,
            "agree": True,
        },
        "undecided": "no reduction applies" if verdict == "undecided" else None,
        "seconds": {
            **{"total": 1.84, "import": 0.01, "decide": 0.12},
            **{"certify": 0.4, "crosscheck": 0.7},
        },
        "versions": {"cuspaudit": "0.1.0", "python-flint": "0.9.0", "msolve": None},
        "seed": 0,
    }


def crx_urdf() -> str:
    """The same arm as a URDF whose meshes are nowhere."""

    def text(numbers: tuple[Any, ...]) -> str:
        return " ".join(str(number) for number in numbers)

    visual = '<visual><geometry><mesh filename="package://crx/{}.stl"/></geometry>'
    links = [
        f'<link name="l{i}">{visual.format(i)}</visual></link>' for i in range(7)
    ] + ['<link name="tool0"/>']
    joints = [
        f'<joint name="J{i + 1}" type="continuous"><parent link="l{i}"/>'
        f'<child link="l{i + 1}"/><origin xyz="{text(CRX_STEPS[i])}"/>'
        f'<axis xyz="{text(CRX_AXES[i])}"/></joint>'
        for i in range(6)
    ]
    tip = '<joint name="flange" type="fixed"><parent link="l6"/><child link="tool0"/>'
    flange = f'{tip}<origin xyz="{text(CRX_STEPS[6])}"/></joint>'
    opened = '<robot name="CRX-10iA/L without meshes">'
    return "\n".join([opened, *links, *joints, flange, "</robot>"])
