"""A mechanism as (f, R): the equations of its loops and the map of its problem.

V is the set of configurations: the platform at (x, y), turned by (c, s), and one
variable or circle for each actuator that needs one. A rod or a fixed leg of length L
from P to Q gives |P - Q|^2 = L^2.

- *Direct problem*, from actuators to platform. R maps V to the values of the actuators:
  the angle (c_i, s_i) of a crank, the place q_i of a slider, the square of an actuated
  length. A fiber is the set of assembly modes; Delta = 0 is a singularity
  in parallel.
  The square is as good as the length, which is its positive root; where a length is 0
  the square adds a critical point that the length, not differentiable there, has not.
- *Inverse problem*, from platform to actuators. R maps V to (x, y, angle (c, s)); an
  actuated length is a variable q_i with q_i^2 = |P - Q|^2. A fiber is the set of
  working modes; Delta = 0 are the serial singularities.

R is cuspidal when two modes of one value are joined without a singularity: for the
direct problem, an assembly mode that changes and no drive notices.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.parallel.mechanism import Leg, Mechanism

__all__ = ["Loops", "loops"]

Coordinates = tuple[Polynomial, ...]


@dataclass(frozen=True, eq=False)
class Loops:
    """The equations of a mechanism.

    Attributes:
        mechanism: where they come from.
        variety: V.
        mapping: R of its problem.
        labels: of the values of R, components first, with units.
        ends: for every leg its three points on V as functions: base, end of crank or
            slide (of a ``length`` leg the base again), anchor.
    """

    mechanism: Mechanism
    variety: PolynomialSystem
    mapping: PolynomialMap
    labels: tuple[str, ...]
    ends: tuple[tuple[Coordinates, Coordinates, Coordinates], ...]


def loops(mechanism: Mechanism) -> Loops:
    """The equations and the map of a mechanism."""
    ring = Ring(_names(mechanism))
    place = [ring.gen(name) for name in ("x", "y", "z")[: mechanism.space]]
    equations, components = list[Polynomial](), list[Polynomial]()
    angles, ends = list[tuple[Polynomial, Polynomial]](), []
    direct = mechanism.problem == "direct"
    turn = (ring.gen("c"), ring.gen("s")) if mechanism.body else None
    if turn:
        equations.append(turn[0] ** 2 + turn[1] ** 2 - 1)
    for number, leg in enumerate(mechanism.legs, 1):
        base = tuple(ring.constant(_rational(a)) for a in leg.base)
        anchor = _anchor(place, turn, leg)
        end = base
        if leg.kind == "crank":
            c, s = ring.gen(f"c{number}"), ring.gen(f"s{number}")
            equations.append(c * c + s * s - 1)
            angles += [(c, s)] if direct else []
            arm = _rational(leg.arm or Fraction(0))
            end = (base[0] + arm * c, base[1] + arm * s)
        elif leg.kind == "slider":
            q = ring.gen(f"q{number}")
            components += [q] if direct else []
            pairs = zip(base, leg.along, strict=True)
            end = tuple(b + _rational(a) * q for b, a in pairs)
        square = ring.total((a - b) ** 2 for a, b in zip(anchor, end, strict=True))
        if leg.rod is not None:
            equations.append(square - _rational(leg.rod) ** 2)
        elif direct:
            components.append(square)
        else:
            equations.append(ring.gen(f"q{number}") ** 2 - square)
        ends.append((base, end, anchor))
    if not direct:
        components, angles = place, [turn] if turn else []
    return Loops(
        mechanism,
        PolynomialSystem(ring, tuple(equations)),
        PolynomialMap(ring, tuple(components), tuple(angles)),
        _labels(mechanism),
        tuple(ends),
    )


def _names(mechanism: Mechanism) -> list[str]:
    names = ["x", "y", "z"][: mechanism.space] + ["c", "s"] * mechanism.body
    for number, leg in enumerate(mechanism.legs, 1):
        if leg.kind == "crank":
            names += [f"c{number}", f"s{number}"]
        elif leg.kind == "slider" or (
            leg.is_actuated and mechanism.problem == "inverse"
        ):
            names.append(f"q{number}")
    return names


def _labels(mechanism: Mechanism) -> tuple[str, ...]:
    if mechanism.problem == "inverse":
        flat = tuple(f"{x} (the file's unit)" for x in "xyz"[: mechanism.space])
        return (*flat, "turn of the platform (deg)") if mechanism.body else flat
    numbered = list(enumerate(mechanism.legs, 1))
    words = {
        "length": "square of length {} (the file's unit squared)",
        "slider": "place of slide {} (the file's unit)",
    }
    flat = tuple(
        words[leg.kind].format(i)
        for i, leg in numbered
        if leg.is_actuated and leg.kind != "crank"
    )
    turns = (f"angle of crank {i} (deg)" for i, leg in numbered if leg.kind == "crank")
    return (*flat, *turns)


def _anchor(
    place: Sequence[Polynomial], turn: tuple[Polynomial, Polynomial] | None, leg: Leg
) -> Coordinates:
    """The anchor of a leg in the frame of the base."""
    if turn is None:
        return tuple(place)
    (c, s), (a, b) = turn, map(_rational, leg.anchor)
    return (place[0] + a * c - b * s, place[1] + a * s + b * c)


def _rational(number: Fraction) -> fmpq:
    return fmpq(number.numerator, number.denominator)
