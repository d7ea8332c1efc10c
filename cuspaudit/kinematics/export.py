"""A chain's polynomials as text: for reading, and for msolve."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.determinant import determinant_factors, jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.polynomial_map import place
from cuspaudit.robot.numbers import format_angle
from cuspaudit.robot.task import DIMENSIONS
from cuspaudit.robot.virtual_joint import without_virtual_joint

__all__ = [
    "InverseKinematics",
    "factor_texts",
    "inverse_kinematics",
    "msolve_system",
    "poly_text",
]

_FINEST = 12


@dataclass(frozen=True)
class InverseKinematics:
    """The polynomial system of all postures that reach what ``posture`` reaches.

    Attributes:
        ring: the ring of the model.
        equations: f, then R - R(posture).
        posture: variable -> rational value, a point of V.
    """

    ring: Ring
    equations: tuple[Polynomial, ...]
    posture: dict[str, Fraction]


def factor_texts(model: ExactModel) -> list[str]:
    """The factors of det J as a function on V, each with its power."""
    return [f"({p})^{n}" if n > 1 else str(p) for p, n in determinant_factors(model)]


def poly_text(model: ExactModel) -> str:
    """f, R and det J in factored form, as `cuspaudit import --to poly` prints them.

    Raises:
        UnableError: det J is asked of a chain whose task is not square.
    """
    return "\n".join(_lines(model)) + "\n"


def inverse_kinematics(model: ExactModel, seed: int = 0) -> InverseKinematics:
    """(f, R - R(q0)) at a random rational posture q0.

    Its real solutions are the postures that reach the place of q0, q0 among them;
    finitely many unless q0 is singular. A position task gives three equations beside
    the circles, an angle two more, a pose task twelve.

    Args:
        model: any chain.
        seed: of q0, a point with half-angle tangents of small denominator.
    """
    ring, components = model.ring, place(model)
    posture = _rational_posture(model, random.Random(seed))
    values = {name: ring.constant(value) for name, value in posture.items()}
    at = [values[name] for name in ring.variables]
    at += [ring.surd] if ring.radicand else []
    reached = (ring.reduce(r.compose(*at, ctx=ring.context)) for r in components)
    rest = (r - p for r, p in zip(components, reached, strict=True))
    return InverseKinematics(ring, (*model.equations, *rest), posture)


def msolve_system(model: ExactModel, seed: int = 0) -> str:
    """The system of `inverse_kinematics` as msolve reads it.

    Over Q(sqrt m) only solutions with a positive last variable are postures.

    Raises:
        UnableError: the task is not square, so the system is not zero-dimensional.
    """
    if len(model.joints) != DIMENSIONS[model.chain.task]:
        raise UnableError(
            "msolve file",
            f"{len(model.joints)} joints for a {model.chain.task} task have "
            "infinitely many postures",
        )
    system = inverse_kinematics(model, seed)
    from cuspaudit.algebra.msolve import msolve_text  # few ask for this form

    return msolve_text(system.ring, system.equations)


def _lines(model: ExactModel) -> Iterator[str]:
    task = without_virtual_joint(model.chain).task
    yield f"# {model.chain.name}: {task} of {model.chain.tip}"
    yield from (f"# {line}" for line in _variables(model))
    for approximation in model.approximations:
        yield f"# {approximation.where}: within {approximation.difference:g} rad"
    yield "f"
    yield from (f"  {p} = 0" for p in model.equations)
    yield "R"
    entries = [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
    turning = {"pose": entries, "position-and-angle": ["cos", "sin"]}
    names = [*"xyz", *turning.get(model.chain.task, [])]
    for name, p in zip(names, place(model), strict=True):
        yield f"  {name} = {p}"
    yield "det J"
    yield f"  {jacobian_determinant(model)}"
    yield "det J, factors up to a constant"
    for text in factor_texts(model):
        yield f"  {text}"


def _variables(model: ExactModel) -> Iterator[str]:
    for number, joint in enumerate(model.joints, 1):
        if model.chain.joints[number - 1].is_virtual:
            yield f"joint {number} is virtual: it turns about the tool axis"
        if joint.kind == "prismatic":
            yield f"{joint.variables[0]} = displacement of joint {number}, {joint.name}"
            continue
        c, s = joint.variables
        angle = f"theta{number}"
        if not joint.zero.is_zero:
            zero = format_angle(joint.zero)
            angle += f" - {zero[1:]}" if zero.startswith("-") else f" + {zero}"
        yield f"{c}, {s} = cos, sin({angle}) of joint {number}, {joint.name}"
    if model.ring.radicand:
        yield f"sqrt{model.ring.radicand} = the positive root"


def _rational_posture(model: ExactModel, source: random.Random) -> dict[str, Fraction]:
    """A point of V with small rational coordinates, away from the axes."""
    posture: dict[str, Fraction] = {}
    for joint in model.joints:
        t = _small(source)
        if joint.kind == "prismatic":
            posture[joint.variables[0]] = t
            continue
        below = 1 + t * t
        point: Sequence[Fraction] = ((1 - t * t) / below, 2 * t / below)
        posture.update(zip(joint.variables, point, strict=True))
    return posture


def _small(source: random.Random) -> Fraction:
    """A rational in (-2, 2), not 0, 1 or -1."""
    denominator = source.randrange(5, _FINEST)
    numerator = source.choice([k for k in range(1, 2 * denominator) if k % denominator])
    return Fraction(source.choice((-1, 1)) * numerator, denominator)
