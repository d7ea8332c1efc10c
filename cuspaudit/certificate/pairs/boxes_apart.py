"""No two joint vectors of a box have one pose in one aspect: a proof for small boxes.

Six joints of a pose task, the first and the last turning. The pose of a joint vector,
up to what these two do, fixes five functions f of the joints between: with z the axis
of joint 1, n that of joint 6, and e from a fixed point of the one to a fixed point of
the other,

    f = (<z, n>, <z, e>, <n, e>, <z x n, e>, <e, e>);

a turn about z moves n and e alike, and joint 6 moves neither.

**Theorem.** Let the joints between lie in a product B of intervals, and let each pair
of points of B lie in A x A' or A' x A for one of finitely many pairs of boxes A, A'
within B, for each of which one of these is proved:

1. *injective*: C is a box that contains A and A', D an enclosure of the derivative of f
   on C, Y a matrix with ||1 - Y D|| < 1 for every matrix of D;
2. *apart*: f(A) and f(A') have no common value;
3. *signs*: det J, or a factor of it, has one sign on A and the other on A'.

Then the arm is noncuspidal within every box of limits whose middle part is B.

*Proof.* Let q, q' be joint vectors of one pose in one aspect, p, p' their middle parts.
Then f(p) = f(p'), so 2. does not hold of their pair of boxes, nor does 3., as a factor
of det J keeps its sign along a path on which det J is not 0. So 1. does, and p = p':
f(p') - f(p) = M (p' - p) with M the mean of the derivative on the segment from p to p',
which is in the convex enclosure D, and Y M is regular. Then q and q' differ by motions
of joints 1 and 6 that undo each other. If q and q' are different postures, these are
turns about one line, and no whole turns: so the screws of joints 1 and 6 are dependent
at q, and det J = 0. QED. [Neumaier 1990,
Section 5.1, has the interval form of the mean value theorem that 1. rests on.]

Ranges of joints 1 and 6 play no part. Balls round outward. A search over pairs of boxes
that are halved ends at a number of looks; then nothing is said.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from flint import arb, arb_mat, arb_series

from cuspaudit.certificate.arm import Arm, Screw, arm_from_certificate
from cuspaudit.certificate.balls import (
    Row,
    S,
    ball_from_fraction,
    cross,
    dot,
    minus,
    plus,
    working_precision,
)
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.model import Certificate

__all__ = ["Apart", "Ends", "Search", "functions_of_pose", "halved"]

BITS = 64
_NEAR = 3.0

Ends = tuple[tuple[Fraction, Fraction], ...]
Signs = Callable[[Sequence[arb]], tuple[int, ...]]


@dataclass(frozen=True)
class Apart:
    """A proof that no two joint vectors of a box have one pose in one aspect.

    Attributes:
        pairs: how many pairs of boxes were looked at.
        injective: how many of them by the first ground.
        apart: by the second.
        signs: by the third.
    """

    pairs: int
    injective: int
    apart: int
    signs: int

    def sentence(self) -> str:
        """What is proved, in one sentence."""
        count = self.injective + self.apart + self.signs
        return (
            "no two postures of one pose lie in one aspect inside the limits: proved "
            f"for {count} pair{'s' if count > 1 else ''} of boxes, in {self.injective} "
            "of which the pose tells joint values apart"
        )


@dataclass(frozen=True, eq=False)
class _Look:
    """What is known of a box: f, its derivative, and signs of factors of det J."""

    values: list[arb]
    slope: arb_mat
    signs: tuple[int, ...]


class Search:
    """The search over pairs of boxes."""

    def __init__(self, certificate: Certificate, signs: Signs, looks: int) -> None:
        """Take an arm, its numbers enclosed.

        Args:
            certificate: of six joints, for its robot alone.
            signs: of factors of det J over a box of all joints, 1 or -1 where proved.
            looks: at how many boxes at most.
        """
        with working_precision(BITS, 2):
            self.arm: Arm[arb] = arm_from_certificate(certificate, lambda ball: ball)
            self.series = arm_from_certificate(certificate, lambda b: arb_series([b]))
        self.signs = signs
        self.left = looks
        self.known: dict[Ends, _Look] = {}

    def run(self, whole: Ends, tick: Callable[[], None]) -> Apart | None:
        """Halve pairs until every one is settled, or the looks are used up.

        Args:
            whole: the box of the middle joints, limits rounded outward.
            tick: called once a pair; what it raises ends the search.
        """
        waiting = [(whole, whole)]
        counts = dict.fromkeys(("injective", "apart", "signs"), 0)
        pairs = 0
        while waiting:
            tick()
            first, second = waiting.pop()
            pairs += 1
            with working_precision(BITS, 2):
                ground = self.ground(first, second)
            if ground is not None:
                counts[ground] += 1
                continue
            if self.left <= 0:
                return None
            waiting += halved(first, second)
        return Apart(pairs, **counts)

    def ground(self, first: Ends, second: Ends) -> str | None:
        """On which ground two boxes are told apart; None for none."""
        if first != second:
            a, b = self.look(first), self.look(second)
            if any(x * y < 0 for x, y in zip(a.signs, b.signs, strict=True)):
                return "signs"
            if any(not x.overlaps(y) for x, y in zip(a.values, b.values, strict=True)):
                return "apart"
        hull = tuple(
            (min(x[0], y[0]), max(x[1], y[1]))
            for x, y in zip(first, second, strict=True)
        )
        return "injective" if self._is_injective(hull) else None

    def _is_injective(self, box: Ends) -> bool:
        """Whether ||1 - Y D|| < 1, in the norm in which the box is a cube."""
        slope = self.look(box).slope
        widths = [float(high - low) for low, high in box]
        Y = _inverse(slope.mid(), widths)
        if Y is None:
            return False
        norm = _norm(Y * slope, widths)
        if norm < 1 or not norm < _NEAR:
            return bool(norm < 1)
        parts = [self.look(part).slope for part in _parts(box)]
        hull = arb_mat(
            [
                [_union([part[i, j] for part in parts]) for j in range(4)]
                for i in range(slope.nrows())
            ]
        )
        return bool(_norm(Y * hull, widths) < 1)

    def look(self, box: Ends) -> _Look:
        """What is known of a box, computed once."""
        if box not in self.known:
            self.left -= 1
            balls = [_ball(*ends) for ends in box]
            signs = self._signs(balls)
            self.known[box] = _Look(*self._enclosed(box, balls), signs)
        return self.known[box]

    def _signs(self, middle: Sequence[arb]) -> tuple[int, ...]:
        """Of det J and of its factors over a box; joints 1 and 6 play no part."""
        q = [arb(0), *middle, arb(0)]
        value = jacobian_determinant(self.arm, q)
        own = 0 if value is None else int(bool(value > 0)) - int(bool(value < 0))
        return (own, *self.signs(q))

    def _enclosed(self, box: Ends, balls: Sequence[arb]) -> tuple[list[arb], arb_mat]:
        """F and its derivative over a box, each by the mean value from the middle."""
        middle = [ball_from_fraction((low + high) / 2) for low, high in box]
        reach = [ball - at for ball, at in zip(balls, middle, strict=True)]
        values, rows = functions_of_pose(self.arm, middle)
        slope = [[_number(entry) for entry in row] for row in rows]
        for k, side in enumerate(reach):
            moved = [arb_series([b, int(i == k)]) for i, b in enumerate(balls)]
            for row, bent in zip(
                slope, functions_of_pose(self.series, moved)[1], strict=True
            ):
                for j, entry in enumerate(bent):
                    row[j] += side * (arb(0) if entry is None else entry[1])
        found = [
            _number(value)
            + sum((a * b for a, b in zip(row, reach, strict=True)), arb(0))
            for value, row in zip(values, slope, strict=True)
        ]
        return found, arb_mat(slope)


def functions_of_pose(
    arm: Arm[S], middle: Sequence[S]
) -> tuple[list[S | None], list[list[S | None]]]:
    """F on a box of the middle joints, and its derivative.

    In the coordinates of link 3: joints 2 and 3 move axis 1 there, joints 4 and 5 axis
    6, so that each vector depends on two joints, and enclosures are tight.
    """
    first, second, third, fourth, fifth, last = arm.joints
    frame, back = arm.still, list[Screw[S]]()
    for joint, value in ((third, middle[1]), (second, middle[0])):
        back.append(joint.screw(frame))
        frame = frame.then(joint.motion(arm.still, value, backwards=True))
        frame = frame.then(joint.after)
    a, z = frame.p, first.screw(frame).w
    frame, ahead = arm.still, list[Screw[S]]()
    for joint, value in ((fourth, middle[2]), (fifth, middle[3])):
        frame = frame.then(joint.before)
        ahead.append(joint.screw(frame))
        frame = frame.then(joint.motion(arm.still, value))
    frame = frame.then(last.before)
    o, n = frame.p, last.screw(frame).w
    e, across = _less(o, a), cross(z, n)
    values = [dot(z, n), dot(z, e), dot(n, e), dot(across, e), dot(e, e)]
    columns = []
    for screw in back[::-1]:
        turned, moved = cross(z, screw.w), _less((None, None, None), screw.velocity(a))
        columns.append(
            [
                dot(turned, n),
                minus(dot(turned, e), dot(z, moved)),
                minus(None, dot(n, moved)),
                minus(dot(cross(turned, n), e), dot(across, moved)),
                _twice(minus(None, dot(e, moved))),
            ]
        )
    for screw in ahead:
        turned, moved = cross(screw.w, n), screw.velocity(o)
        columns.append(
            [
                dot(z, turned),
                dot(z, moved),
                plus(dot(turned, e), dot(n, moved)),
                plus(dot(cross(z, turned), e), dot(across, moved)),
                _twice(dot(e, moved)),
            ]
        )
    return values, [[column[i] for column in columns] for i in range(len(values))]


def _less(a: Row[S], b: Row[S]) -> Row[S]:
    return minus(a[0], b[0]), minus(a[1], b[1]), minus(a[2], b[2])


def _number(value: arb | None) -> arb:
    return arb(0) if value is None else value


def _twice(value: S | None) -> S | None:
    return None if value is None else 2 * value


def _inverse(slope: arb_mat, widths: Sequence[float]) -> arb_mat | None:
    """About the pseudoinverse of a derivative, joints in units of their widths."""
    unit = arb_mat(
        [[arb(w) * (i == j) for j in range(4)] for i, w in enumerate(widths)]
    )
    scaled = slope * unit
    turned = scaled.transpose()
    try:
        return (unit * (turned * scaled).inv() * turned).mid()
    except ZeroDivisionError:
        return None


def _norm(product_: arb_mat, widths: Sequence[float]) -> arb:
    """The largest row sum of 1 - Y D, each column weighed by the width of its joint."""
    sums = []
    for i in range(4):
        row = [abs(product_[i, j] - int(i == j)).upper() * widths[j] for j in range(4)]
        sums.append((sum(row, arb(0)) / widths[i]).upper())
    return max(sums, key=float)


def _union(balls: Sequence[arb]) -> arb:
    found = balls[0]
    for ball in balls[1:]:
        found = found.union(ball)
    return found


def _ball(low: Fraction, high: Fraction) -> arb:
    return ball_from_fraction(low).union(ball_from_fraction(high))


def _split(ends: tuple[Fraction, Fraction]) -> list[tuple[Fraction, Fraction]]:
    middle = (ends[0] + ends[1]) / 2
    return [(ends[0], middle), (middle, ends[1])]


def _parts(box: Ends) -> list[Ends]:
    """The sixteen parts of a box halved along each joint."""
    return [tuple(part) for part in product(*map(_split, box))]


def halved(first: Ends, second: Ends) -> list[tuple[Ends, Ends]]:
    """The pairs of two boxes after the wider is halved along its longest side."""
    if first == second:
        a, b = _bisected(first)
        return [(a, a), (b, b), (a, b)]
    widest = max((first, second), key=_width)
    other = second if widest is first else first
    return [(part, other) for part in _bisected(widest)]


def _width(box: Ends) -> Fraction:
    return max(high - low for low, high in box)


def _bisected(box: Ends) -> tuple[Ends, Ends]:
    k = max(range(len(box)), key=lambda i: box[i][1] - box[i][0])
    low, high = _split(box[k])
    return (*box[:k], low, *box[k + 1 :]), (*box[:k], high, *box[k + 1 :])
