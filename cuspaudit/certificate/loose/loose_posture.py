"""The second posture of every robot that the play allows, in one box of joint values.

Let p be play, t p with 0 <= t <= 1 the same in part, and q(0) the second posture of the
robot without play (`krawczyk`). We look for postures q(t) with the pose that the first
posture has for the robot with play t p. Differentiated by t that is, in twists seen
from one link in the middle of the arm in posture q(t),

    J q' = (the twist of the tip, or its velocity, by p in the first posture)
           - (that by p in the posture q(t)),                                        (*)

J the matrix of the screws (of a position: of the velocities of the tip).

**Theorem.** Let X be the box of all q with |q_i - q_i(0)| <= r_i. If for all play J is
regular on X, and (*) has |q'_i| < r_i there, then for each p a curve q(t) exists in X,
and q(1) is the second posture of the robot with play p.

*Proof.* (*) is a differential equation for q(t). Its solution moves by less than t r_i
in each joint, so it does not leave X for t <= 1. QED

X is cut into boxes. On one of them let Y be a matrix, D = 1 - Y J in balls, and b_i > 0
a bound of the i-th row of Y times the right hand side. Then q' = Y (...) + D q'. With
k the largest sum over j of |D_ij| b_j / b_i and s the largest |q'_i| / b_i this says
s <= 1 + k s, so for k < 1

    |q'_i|  <=  b_i + sum over j of |D_ij| b_j / (1 - k),

and J is regular, as in the same way J x = 0 gives s <= k s, s = 0.

**On the way** from q(0) to q(1) the robot with all of p stands at q(t): det J differs
from its value at q(0) without play by at most the larger of

- the most that it changes along (q(t), t p): by its slope by p, and by its slope by q
  times q' = J^-1 (...), and
- the most that it changes by play alone,

as the share t of the way is made by the one, and 1 - t by the other. So from the end
of the path each robot reaches its second posture without a change of sign.

**Twists.** Play in the frame R, o (`loose_arm`) with the twist (v, w) in it has the
twist (R v + o x R w, R w), and moves the point x by R v + R w x (x - o). The frames of
the first posture are seen from the link by way of the base, or of the last link, where
both postures agree; by the shorter way the enclosures are tighter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import arb, arb_mat

from cuspaudit.certificate.arm import Screw
from cuspaudit.certificate.balls import Frame, Matrix, Row
from cuspaudit.certificate.loose.loose_arm import LooseArm, PlacedPlay, Walk
from cuspaudit.certificate.loose.loose_slopes import length, slopes_of
from cuspaudit.certificate.loose.play import Play

__all__ = ["LooseBox", "second_postures"]

_TRIES = 6
_MOST_BOXES = 96
_WIDEST = 1
"""Boxes reach at most so far (rad, or the unit of length) to each side."""
_TIGHT = 0.35
"""Boxes in which k is larger are cut, while there may be more."""
_SPARE = arb(9) / 8
_SMALL = arb(2) ** -40


@dataclass(frozen=True, slots=True)
class LooseBox:
    """A box with the second posture of every robot.

    Attributes:
        values: one ball a joint.
        radius: the largest half side.
        change: a bound of how much det J changes on the way there, from its value at
            the second posture of the robot without play.
    """

    values: tuple[arb, ...]
    radius: float
    change: arb


def second_postures(
    arm: LooseArm, first: Sequence[arb], second: Sequence[arb]
) -> LooseBox | None:
    """A box round ``second`` with one posture of each robot; None without a proof.

    Args:
        arm: with its play.
        first: the first posture.
        second: a box with the second posture of the arm without play.
    """
    there = _First(arm, first)
    point = [arb(x.mid()) for x in second]
    at = _Piece.on(arm, there, point)
    if at is None:
        return None
    radii = [(x * _SPARE).upper() for x in at.rates]
    for _ in range(_TRIES):
        if not all(r < _WIDEST for r in radii):
            return None
        box = tuple(x + arb(0, r) for x, r in zip(second, radii, strict=True))
        found = _over(arm, there, box)
        if found is None:
            return None
        rates, pieces = found
        if all(a < b for a, b in zip(rates, radii, strict=True)):
            change = max(piece.change() for piece in pieces)
            return LooseBox(box, max(map(float, radii)), change)
        radii = [
            max((x * _SPARE).upper(), r) for x, r in zip(rates, radii, strict=True)
        ]
    return None


def _over(
    arm: LooseArm, there: _First, box: Sequence[arb]
) -> tuple[list[arb], list[_Piece]] | None:
    """The bounds over a whole box, and its pieces; None where J may be singular there.

    The piece with the largest k is cut, until all are tight or there are many.
    """
    first = _Piece.on(arm, there, box)
    pieces: list[tuple[_Piece | None, list[arb]]] = [(first, list(box))]
    while len(pieces) < _MOST_BOXES:
        worst = max(range(len(pieces)), key=lambda i: _looseness(pieces[i][0]))
        found, piece = pieces.pop(worst)
        if _looseness(found) < _TIGHT:
            pieces.append((found, piece))
            break
        middle = [arb(x.mid()) for x in piece]
        if found is None and _Piece.on(arm, there, middle) is None:
            return None
        pieces += [(_Piece.on(arm, there, half), half) for half in _halves(piece)]
    proved = [found for found, _ in pieces if found is not None]
    if len(proved) < len(pieces):
        return None
    rates = [max(column) for column in zip(*(p.rates for p in proved), strict=True)]
    return rates, proved


def _looseness(found: _Piece | None) -> float:
    return 1.0 if found is None else float(found.k)


def _halves(box: Sequence[arb]) -> list[list[arb]]:
    """Both halves of a box, cut across its longest side that J depends on."""
    inner = range(1, len(box) - 1) if len(box) == 6 else range(1, len(box))
    k = max(inner, key=lambda j: float(box[j].rad()))
    low, high = arb(box[k].lower()), arb(box[k].upper())
    middle = arb(box[k].mid())
    return [
        [*box[:k], low.union(middle), *box[k + 1 :]],
        [*box[:k], middle.union(high), *box[k + 1 :]],
    ]


@dataclass(frozen=True, slots=True)
class _Piece:
    """What is known on a box.

    Attributes:
        rates: bounds of the |q'_i|.
        k: of the box.
        walk: from the link, over the box.
        right: the right hand side of (*).
        Y: of the box.
        D: of the box.
        b: of the box.
    """

    rates: list[arb]
    k: arb
    walk: Walk
    right: _Rates
    Y: arb_mat
    D: arb_mat
    b: list[arb]

    def change(self) -> arb:
        """The larger of the two bounds of the change of det J on the way."""
        slopes = slopes_of(self.walk)
        by_rate = _solved(arb_mat([slopes.by_joint]), self.D, self.b, self.k) * self.Y
        total = arb(0)
        for place, V, W in self.right:
            v, w = slopes.in_own_frame(place)
            along = arb_mat([_entries(v)]) + by_rate * V
            turning = arb_mat([_entries(w)]) + by_rate * W
            total += _reach(place.play, along.entries(), turning.entries())
        return max(total.upper(), slopes.by_play)

    @classmethod
    def on(cls, arm: LooseArm, there: _First, box: Sequence[arb]) -> _Piece | None:
        """On a box of joint values; None where J is not proved regular."""
        walk = arm.walk(_link(arm), box)
        J, rates = _jacobian(walk), there.rates(walk)
        try:
            Y = J.mid().inv().mid()
        except ZeroDivisionError:
            return None
        D, size = _unit(len(box)) - Y * J, range(len(box))
        b = [(x + _SMALL).upper() for x in _row_bounds(Y, rates)]
        rest = [sum((abs(D[i, j]).upper() * b[j] for j in size), arb(0)) for i in size]
        k = max((x / y).upper() for x, y in zip(rest, b, strict=True))
        if not k < 1:
            return None
        found = [(x + y / (1 - k)).upper() for x, y in zip(b, rest, strict=True)]
        return cls(found, k, walk, rates, Y, D, b)


_Rates = list[tuple[PlacedPlay, arb_mat, arb_mat]]
"""Of each play the right hand side of (*), by v and by w."""


def _link(arm: LooseArm) -> int:
    """The link from which all is seen."""
    return 3 if len(arm.joints) == 6 else 1


class _First:
    """The first posture: where its play stands, from the base and the last link."""

    def __init__(self, arm: LooseArm, q: Sequence[arb]) -> None:
        self.size = len(q)
        outward = arm.walk(0, q)
        self.tip = outward.tip.p
        #: the frame of each play, and whether it is seen from the base
        self.places = {
            (place.before, place.step): (Frame(place.R, place.o), True)
            for place in outward.places
        }
        if self.size == 6:
            for place in arm.walk(6, q).places:
                if place.before >= 3:
                    frame = Frame(place.R, place.o)
                    self.places[place.before, place.step] = frame, False

    def rates(self, walk: Walk) -> _Rates:
        """The right hand side of (*) in a posture."""
        found = []
        for place in walk.places:
            frame, is_from_base = self.places[place.before, place.step]
            here = Frame(place.R, place.o)
            if self.size == 6:
                seen = (walk.base if is_from_base else walk.hand).then(frame)
                V, W = _twists(seen)
                v, w = _twists(here)
            else:
                base = _dense(walk.base.R)
                V, W = (base * each for each in _velocities(frame, self.tip))
                v, w = _velocities(here, walk.tip.p)
            found.append((place, V - v, W - w))
        return found


def _twists(frame: Frame[arb]) -> tuple[arb_mat, arb_mat]:
    """The twists (mu, omega) by v and by w of play in this frame."""
    R = _dense(frame.R)
    V = arb_mat(R.table() + [[arb(0)] * 3] * 3)
    return V, arb_mat((_beside(_entries(frame.p)) * R).table() + R.table())


def _velocities(frame: Frame[arb], tip: Row[arb]) -> tuple[arb_mat, arb_mat]:
    """The velocities of the tip by v and by w of play in this frame."""
    R = _dense(frame.R)
    way = [x - o for x, o in zip(_entries(tip), _entries(frame.p), strict=True)]
    return R, -(_beside(way) * R)


def _jacobian(walk: Walk) -> arb_mat:
    """J: the screws of six joints, the velocities of the tip of three."""
    screws = [walk.screws[k] for k in range(len(walk.screws))]
    columns = [_column(screw, walk) for screw in screws]
    return arb_mat([list(row) for row in zip(*columns, strict=True)])


def _column(screw: Screw[arb], walk: Walk) -> list[arb]:
    if len(walk.screws) == 6:
        return _entries(screw.m) + _entries(screw.w)
    return _entries(screw.velocity(walk.tip.p))


def _row_bounds(Y: arb_mat, rates: _Rates) -> list[arb]:
    """The b_i."""
    totals = [arb(0)] * Y.nrows()
    for place, V, W in rates:
        by_v, by_w = (Y * V).table(), (Y * W).table()
        for i in range(Y.nrows()):
            totals[i] += _reach(place.play, by_v[i], by_w[i])
    return totals


def _solved(f: arb_mat, D: arb_mat, b: Sequence[arb], k: arb) -> arb_mat:
    """Encloses z = f (1 - D)^-1 = f + z D.

    The sum of the |z_j| b_j is at most that of the |f_j| b_j over 1 - k, so |z D| is at
    most k times as much; from there z is improved by its equation.
    """
    size = range(len(b))
    weight = sum((abs(f[0, j]).upper() * b[j] for j in size), arb(0))
    far = weight * k / (1 - k)
    z = arb_mat([[f[0, j] + arb(0, (far / b[j]).upper()) for j in size]])
    for _ in range(3):
        z = f + z * D
    return z


def _reach(play: Play, v: Sequence[arb], w: Sequence[arb]) -> arb:
    """The most that a linear function of v and w takes on a play."""
    if play.axis is None:
        a, b = length((v[0], v[1], v[2])), length((w[0], w[1], w[2]))
    else:
        n = _entries(play.axis)
        a = abs(sum((x * y for x, y in zip(v, n, strict=True)), arb(0))).upper()
        b = abs(sum((x * y for x, y in zip(w, n, strict=True)), arb(0))).upper()
    return (a * play.lengths + b * play.angles).upper()


def _beside(v: Sequence[arb]) -> arb_mat:
    """The matrix of the vector product with v."""
    x, y, z = v
    return arb_mat([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def _unit(size: int) -> arb_mat:
    return arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])


def _entries(row: Row[arb]) -> list[arb]:
    return [arb(0) if entry is None else entry for entry in row]


def _dense(matrix: Matrix[arb]) -> arb_mat:
    return arb_mat([_entries(row) for row in matrix])
