"""det J and its slopes: by the joint values, and by the play of every link.

A small motion inserted before joint k, at unit speed the twist (mu, omega) (velocity of
the point at the origin, angular velocity), moves the screws s_j of the joints j >= k,
and the tip, against the others. With c_j the gradient of det J by the j-th column,
d det J = sum over j >= k of c_j . d s_j. Written out this is mu . A_k + omega . B_k:

*Pose.* s = (m, w), ds = (omega x m + mu x w, omega x w), c = (c^m, c^w):

    A_k = sum w_j x c^m_j,    B_k = sum (m_j x c^m_j + w_j x c^w_j),    j >= k.

*Position.* The columns are v_j, the velocities of the tip x. Those beyond the play turn
with it, dv_j = omega x v_j; the others, j < k, change as the tip moves,
dv_j = w_j x (mu + omega x x). So

    A_k = sum over j < k of c_j x w_j,    B_k = sum over j >= k of v_j x c_j + x x A_k.

Joint j itself moves what is beyond it by its screw: the slope of det J by its value is
m_j . A_(j+1) + w_j . B_(j+1).

**Play.** A path of play Q(t) = (turn by t w, translation by t v) at the place o, where
it carries its origin, has the twist (v + o x w, w) up to the turn of its frame. So the
slope of det J along it is at most |A| l + |B + A x o| a; of play of one number with the
unit screw s it is |s . (A, B)| times the largest value.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from flint import arb

from cuspaudit.certificate.arm import Screw
from cuspaudit.certificate.balls import Row, cross, dot, plus, transposed, turned
from cuspaudit.certificate.loose.loose_arm import LooseArm, PlacedPlay, Walk

__all__ = ["Slopes", "length", "slopes_at", "slopes_of"]

Covector = tuple[Row[arb], Row[arb]]
Row6 = list[arb]
_ZERO: Row[arb] = (None, None, None)
_PAIRS = tuple(combinations(range(6), 2))
_TRIPLES = tuple(combinations(range(6), 3))


@dataclass(frozen=True, slots=True)
class Slopes:
    """The slopes of det J over balls of joint values and all play.

    Attributes:
        by_joint: the derivative by each joint value.
        places: of the play.
        covectors: A_k, B_k.
    """

    by_joint: list[arb]
    places: list[PlacedPlay]
    covectors: list[Covector]

    @property
    def by_play(self) -> arb:
        """A bound of how much det J changes by all play, from none to any."""
        return sum((self._reach(place) for place in self.places), arb(0)).upper()

    def _reach(self, place: PlacedPlay) -> arb:
        play = place.play
        A, turning = self._at(place)
        if play.axis is None:
            return length(A) * play.lengths + length(turning) * play.angles
        n = turned(place.R, play.axis)
        slide, turn = _value(dot(A, n)), _value(dot(turning, n))
        return abs(slide).upper() * play.lengths + abs(turn).upper() * play.angles

    def in_own_frame(self, place: PlacedPlay) -> tuple[Row[arb], Row[arb]]:
        """The slopes by v and by w of a play, in the frame in which it is described."""
        A, turning = self._at(place)
        back = transposed(place.R)
        return turned(back, A), turned(back, turning)

    def _at(self, place: PlacedPlay) -> Covector:
        """The slopes by v and by w in the coordinates of the walk: A and B + A x o."""
        A, B = self.covectors[place.before]
        return A, _plus(B, cross(A, place.o))


def slopes_at(arm: LooseArm, q: Sequence[arb]) -> Slopes:
    """The slopes for every choice of values in ``q`` and of play."""
    return slopes_of(arm.walk(3 if len(arm.joints) == 6 else 1, q))


def slopes_of(walk: Walk) -> Slopes:
    """The slopes from a walk, from link 3 (pose) or link 1 (position)."""
    size = len(walk.screws)
    covectors = _of_pose(walk) if size == 6 else _of_position(walk)
    by_joint = [
        _value(plus(dot(screw.m, A), dot(screw.w, B)))
        for screw, (A, B) in zip(
            (walk.screws[k] for k in range(size)), covectors[1:], strict=True
        )
    ]
    return Slopes(by_joint, walk.places, covectors)


def length(vector: Row[arb]) -> arb:
    """An upper bound of the Euclidean norm."""
    # a square of a ball round 0 may reach below 0, where there is no root
    squares = (abs(x).upper() ** 2 for x in vector if x is not None)
    return sum(squares, arb(0)).sqrt().upper()


def _of_pose(walk: Walk) -> list[Covector]:
    """A_k, B_k for k = 0, ..., 6."""
    screws = [walk.screws[k] for k in range(6)]
    found: list[Covector] = [(_ZERO, _ZERO)]
    columns = _cofactors(screws)
    for screw, column in zip(screws[::-1], columns[::-1], strict=True):
        (a, b, c), (x, y, z) = column[:3], column[3:]
        first, second = (a, b, c), (x, y, z)
        A, B = found[0]
        B = _plus(_plus(B, cross(screw.m, first)), cross(screw.w, second))
        found.insert(0, (_plus(A, cross(screw.w, first)), B))
    return found


def _of_position(walk: Walk) -> list[Covector]:
    """A_k, B_k for k = 0, ..., 3."""
    x = walk.tip.p
    screws = [walk.screws[k] for k in range(3)]
    v = [screw.velocity(x) for screw in screws]
    c = [cross(v[1], v[2]), cross(v[2], v[0]), cross(v[0], v[1])]
    found = []
    for k in range(4):
        A = B = _ZERO
        for j in range(k):
            A = _plus(A, cross(c[j], screws[j].w))
        for j in range(k, 3):
            B = _plus(B, cross(v[j], c[j]))
        found.append((A, _plus(B, cross(x, A))))
    return found


def _cofactors(screws: Sequence[Screw[arb]]) -> list[Row6]:
    """The gradient of det J by each column (m; w), by Laplace as in `determinant`."""
    one, two, three, four, five, six = (_dense(screw.column) for screw in screws)
    # (5, 6, 4) is an even permutation
    inner, outer = (one, two, three), (five, six, four)
    beside, within = _minors(outer), _minors(inner)
    first: dict[tuple[int, ...], arb] = {}
    second: dict[tuple[int, ...], arb] = {}
    for rows in _TRIPLES:
        rest = tuple(row for row in range(6) if row not in rows)
        sign = 1 if sum(rows) % 2 else -1
        first[rows], second[rest] = sign * beside[rest], sign * within[rows]
    fifth, sixth, fourth = _minor_slopes(outer, second)
    return [*_minor_slopes(inner, first), fourth, fifth, sixth]


def _minors(columns: Sequence[Row6]) -> dict[tuple[int, ...], arb]:
    """The twenty 3x3 minors of three columns, by rows."""
    a, b, c = columns
    two = _small_minors(a, b)
    return {
        (i, j, k): two[i, j] * c[k] - two[i, k] * c[j] + two[j, k] * c[i]
        for i, j, k in _TRIPLES
    }


def _minor_slopes(
    columns: Sequence[Row6], weights: Mapping[tuple[int, ...], arb]
) -> list[Row6]:
    """The gradients by each column of the sum of the minors with these weights."""
    found = []
    for t in range(3):
        two = _small_minors(columns[(t + 1) % 3], columns[(t + 2) % 3])
        slope = [arb(0)] * 6
        for i, j, k in _TRIPLES:
            weight = weights[i, j, k]
            slope[i] += weight * two[j, k]
            slope[j] -= weight * two[i, k]
            slope[k] += weight * two[i, j]
        found.append(slope)
    return found


def _small_minors(a: Row6, b: Row6) -> dict[tuple[int, int], arb]:
    return {(i, j): a[i] * b[j] - a[j] * b[i] for i, j in _PAIRS}


def _dense(column: Sequence[arb | None]) -> Row6:
    return [_value(entry) for entry in column]


def _plus(a: Row[arb], b: Row[arb]) -> Row[arb]:
    return plus(a[0], b[0]), plus(a[1], b[1]), plus(a[2], b[2])


def _value(a: arb | None) -> arb:
    return arb(0) if a is None else a
