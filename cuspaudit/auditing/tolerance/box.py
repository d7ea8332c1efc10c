"""The largest box of play for which a certificate is proved, between bounds.

Boxes are the multiples of one box. What the checker proves it proves for every smaller
box too, but a failure says only that this certificate does not go so far: the bound
above is one of the proof, not of the arm.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from decimal import ROUND_DOWN, Context, Decimal
from fractions import Fraction

from cuspaudit.certificate import Certificate, Tolerance, verify
from cuspaudit.robot.tolerance import AxisTolerance
from cuspaudit.runtime.clock import check_time

__all__ = ["LargestBox", "enlarged", "largest_box", "over"]

_LARGEST = 1e6
_SMALLEST = 1e-9
_DOWN = Context(prec=3, rounding=ROUND_DOWN)


@dataclass(frozen=True, slots=True)
class LargestBox:
    """Between which boxes the proof of one certificate ends.

    Attributes:
        certificate: with the largest box that it was proved for; None if with none.
        proved: this box, in multiples of the one asked for; 0.0 for none.
        fails: the smallest larger box for which it was tried and not proved.
    """

    certificate: Certificate | None
    proved: float
    fails: float


def enlarged(box: AxisTolerance, factor: float) -> AxisTolerance:
    """So many times the box, in three digits, rounded down."""
    exact = Fraction(factor)
    return AxisTolerance(_rounded(box.lengths * exact), _rounded(box.angles * exact))


def over(certificate: Certificate, box: AxisTolerance) -> Certificate:
    """The claim of ``certificate`` for every arm of the box."""
    return replace(certificate, tolerance=Tolerance(box.lengths, box.angles))


def largest_box(
    certificate: Certificate, box: AxisTolerance, start: float, ratio: float = 1.05
) -> LargestBox:
    """How many times the box the claim of ``certificate`` is proved for.

    Args:
        certificate: accepted without play.
        box: of which multiples are tried.
        start: the multiple tried first.
        ratio: of the two bounds in the end, or less.
    """
    proved, fails, factor = 0.0, float("inf"), start
    best = None
    while (proved and fails / proved > ratio) or not proved or fails > _LARGEST:
        check_time("tolerance")
        if factor < _SMALLEST or factor > _LARGEST:
            break
        claim = over(certificate, enlarged(box, factor))
        if verify(claim).accepted:
            proved, best = factor, claim
        else:
            fails = factor
        factor = _next(proved, fails, factor)
    return LargestBox(best, proved, fails)


def _next(proved: float, fails: float, last: float) -> float:
    """The multiple to try next: between the bounds, or beyond the only one."""
    if not proved:
        return last / 2
    if fails == float("inf"):
        return last * 2
    return float((proved * fails) ** 0.5)


def _rounded(number: Fraction) -> Fraction:
    text = _DOWN.divide(Decimal(number.numerator), Decimal(number.denominator))
    return Fraction(text)
