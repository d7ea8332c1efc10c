"""The largest box of play for which a certificate is proved, between bounds.

Boxes are the multiples of one box. What the checker proves it proves for every smaller
box too, but a failure says only that this certificate does not go so far: the bound
above is one of the proof, not of the arm.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from decimal import ROUND_DOWN, Context, Decimal
from fractions import Fraction

from cuspaudit.certificate import Certificate, Loose, Tolerance, verify
from cuspaudit.robot.chain import Chain
from cuspaudit.robot.tolerance import AxisTolerance, LooseNumber
from cuspaudit.runtime.clock import check_time

__all__ = [
    "LargestBox",
    "PlacedNumber",
    "ToleranceBox",
    "box_of",
    "largest_box",
    "over",
    "part",
]

_LARGEST = 1e6
_SMALLEST = 1e-9
_DOWN = Context(prec=3, rounding=ROUND_DOWN)


@dataclass(frozen=True, slots=True)
class PlacedNumber:
    """A loose number where it stands: behind a motion of a link.

    Attributes:
        link: of the chain: before the joint of this index, or the tool.
        after: the index of the motion.
        number: the loose number.
    """

    link: int
    after: int
    number: LooseNumber


@dataclass(frozen=True, slots=True)
class ToleranceBox:
    """What may be off: all axes, and single numbers.

    Attributes:
        axes: how far all axes may be off; None where nothing is said of them.
        numbers: of a table.
    """

    axes: AxisTolerance | None
    numbers: tuple[PlacedNumber, ...] = ()

    @property
    def lengths(self) -> Fraction:
        """By how much all axes may be moved."""
        return self.axes.lengths if self.axes else Fraction(0)

    @property
    def angles(self) -> Fraction:
        """By how much all axes may be tilted."""
        return self.axes.angles if self.axes else Fraction(0)

    def times(self, factor: float) -> ToleranceBox:
        """So many times the box, in three digits, rounded down."""
        axes = self.axes and AxisTolerance(
            part(self.lengths, factor), part(self.angles, factor)
        )
        numbers = tuple(
            replace(
                placed,
                number=replace(
                    placed.number, within=part(placed.number.within, factor)
                ),
            )
            for placed in self.numbers
        )
        return ToleranceBox(axes, numbers)


def box_of(
    chain: Chain, axes: AxisTolerance | None, loose: tuple[LooseNumber, ...]
) -> ToleranceBox:
    """The box of a chain whose motions name the numbers that they are made of."""
    links = [joint.before for joint in chain.joints] + [chain.tool]
    places = {
        motion.source: (link, after)
        for link, motions in enumerate(links)
        for after, motion in enumerate(motions)
    }
    numbers = (PlacedNumber(*places[number.where], number) for number in loose)
    return ToleranceBox(axes, tuple(numbers))


def part(number: Fraction, factor: float) -> Fraction:
    """So many times a number, in three digits, rounded down."""
    exact = number * Fraction(factor)
    text = _DOWN.divide(Decimal(exact.numerator), Decimal(exact.denominator))
    return Fraction(text)


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


def over(certificate: Certificate, box: ToleranceBox) -> Certificate:
    """The claim of ``certificate``, one without play, for every arm of the box."""
    links = [list(joint.before) for joint in certificate.joints]
    links.append(list(certificate.tool))
    for placed in sorted(box.numbers, key=lambda each: -each.after):
        number = placed.number
        loose = Loose(number.kind, number.axis, number.within)
        links[placed.link].insert(placed.after + 1, loose)
    *before, tool = map(tuple, links)
    joints = tuple(
        replace(joint, before=motions)
        for joint, motions in zip(certificate.joints, before, strict=True)
    )
    tolerance = None if box.axes is None else Tolerance(box.lengths, box.angles)
    return replace(certificate, joints=joints, tool=tool, tolerance=tolerance)


def largest_box(
    certificate: Certificate, box: ToleranceBox, start: float, ratio: float = 1.05
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
        claim = over(certificate, box.times(factor))
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
