"""Signs of the factors of det J over boxes of joint values.

A factor keeps its sign along a path on which det J is not 0: postures at which some
factor has different signs lie in different aspects.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from flint import arb, fmpq

from cuspaudit.kinematics.determinant import determinant_factors
from cuspaudit.kinematics.exact_model import ExactModel

__all__ = ["factor_signs"]


def factor_signs(model: ExactModel) -> Callable[[Sequence[arb]], tuple[int, ...]]:
    """The signs over a box of values of all joints: 1 or -1 where proved, else 0.

    None are given where det J does not factor, or the model only comes near its chain.
    """
    factors = determinant_factors(model) if model.is_exact else []
    chosen = [g for g, _ in factors] if len(factors) > 1 else []

    def signs(q: Sequence[arb]) -> tuple[int, ...]:
        if not chosen:
            return ()
        values = _coordinates(model, q)
        found = [model.ring.evaluate(g, values) for g in chosen]
        return tuple(int(bool(v > 0)) - int(bool(v < 0)) for v in found)

    return signs


def _coordinates(model: ExactModel, q: Sequence[arb]) -> dict[str, arb]:
    """The variables of the model over a box of joint values."""
    found: dict[str, arb] = {}
    for joint, value in zip(model.joints, q, strict=True):
        moved = value + _ball(joint.zero.radians)
        if joint.kind == "revolute":
            angle = moved + arb.pi() * _ball(joint.zero.half_turns)
            values: tuple[arb, ...] = (angle.cos(), angle.sin())
        else:
            values = (moved,)
        found |= zip(joint.variables, values, strict=True)
    return found


def _ball(number: Fraction) -> arb:
    return arb(fmpq(number.numerator, number.denominator))
