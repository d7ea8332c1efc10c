"""All pairs of points of one value, looked at in tiles of the plane of their angles.

Let V be a product of two circles and the values over the angle t of the base circles
with the center c(t) and the squared radius N(t) (``surface.value_waves``). Points of
one value over t = m - h and w = m + h, 0 < h < pi, are the points p in which the two
circles meet. With s = sin h and

    a = c'(m), k = c''(m), L = |a|^2, d = det(c', c'') (the same for every t),
    N = N0 + N1 + N2 (its parts of degree 0, 1 and 2),
    A = N1''(m) + cos h N2''(m),     r = N1'(m) + cos h N2'(m),
    B = 2 (N(t) + N(w)) L - r^2 - 4 s^2 L^2

they meet where B >= 0, and at the two points (upper and lower sign) the functions
g = <p - c, c'> + N' / 2 at t and at w, times 2 L h / s > 0, are

    E - O -+ d sqrt B   and   -(E + O -+ d sqrt B),
    E = 2 cos h L^2 + r <a, k> - L A,     O = s L (2 <a, k> + N2'(m)).

The proof is in ``certificate.pairs.pairs_proof``, which uses nothing of an arm but
these circles. g is the Jacobian of the map up to one nonzero constant: it is half the
derivative by t of the equation of the circle at p (``surface.pair_sheets``).

Where c moves on a line, d = 0, a and k are numbers, and E and O may be divided by
L = a^2: E / L = 2 cos h a^2 + (r / a) k - A and O / L = s (2 k a + N2'(m)). B >= 0
says that |r / a| <= sqrt(2 (N(t) + N(w))), which serves where a may be 0.

(m, h) and (m + pi, pi - h) are the same two points, exchanged: 0 <= h <= pi / 2 has
all. In tiles of edge 2 pi / 2^k the angles m, h, t and w of the middles are whole
multiples of pi / 2^k, whose cosines are read from a table of correctly rounded doubles;
over a tile a cosine moves by at most |sin| r + r^2 / 2, r the half edge.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from flint import arb, ctx, fmpq
from numpy.typing import NDArray

from cuspaudit.errors import UnableError
from cuspaudit.surface.spreads import UNIT, Spread
from cuspaudit.surface.value_waves import ValueWaves

__all__ = ["PairTiles", "Signs"]

Array = NDArray[np.float64]
Truths = NDArray[np.bool_]
Whole = NDArray[np.int64]

_TABLE_BITS = 11
"""Finer angles are few, and looked up one by one."""


class Signs(NamedTuple):
    """Of tiles or points: on which a sign of g may be common to both ends.

    Attributes:
        plus: where both ends may have g > 0.
        minus: where both may have g < 0.
    """

    plus: Truths
    minus: Truths


class _Angle(NamedTuple):
    cosine: Spread
    sine: Spread


@dataclass(frozen=True, eq=False)
class PairTiles:
    """The functions above, in doubles with bounds.

    Attributes:
        first: cosine and sine coefficients of the first entry of c.
        second: of the second; exactly 0 where c moves on a line.
        radius: of N: the constant, then of cos t, sin t, cos 2t and sin 2t.
        is_line: whether c moves on a line.
    """

    first: tuple[Spread, Spread]
    second: tuple[Spread, Spread]
    radius: tuple[Spread, ...]
    is_line: bool

    @classmethod
    def of(cls, waves: ValueWaves) -> PairTiles:
        """The tiles of these circles, in a unit of length near their size.

        Raises:
            UnableError: the theorem of the tiles does not speak of these circles, or
                that is not proved (`obstacle`).
        """
        first, second = waves.aligned()
        size = max(float(abs(x).mid()) for x in (*first, *second))
        large = max(float(abs(x).mid()) for x in waves.radius)
        shift = -int(np.frexp(max(size, large**0.5))[1])
        unit = arb(fmpq(2) ** shift)
        a, b, x, y = (Spread.of(v * unit) for v in (*first, *second))
        radius = tuple(Spread.of(v * unit * unit) for v in waves.radius)
        tiles = cls((a, b), (x, y), radius, waves.is_line)
        if (why := tiles.obstacle()) is not None:
            raise UnableError("pair tiles", why)
        return tiles

    def obstacle(self) -> str | None:
        """Why the theorem of the tiles says nothing of these circles; None if it does.

        It asks that L is 0 for finitely many (m, h) with B >= 0 at most, where r = 0
        with it. If c leaves its line, d is not 0 and L > 0. On a line c' has two zeros
        m, and r, as a polynomial in cos h, must not be 0 at them.
        """
        (a, b), (x, y) = self.first, self.second
        if not self.is_line:
            bend = a * y - b * x
            return None if _apart(bend) else "the centers may not leave a line"
        if not (a.square() + b.square()).low > 0:
            return "the centers may stand still"
        # a zero of c' = -a sin + b cos: cos, sin = (a, b) / root
        _, y1, z1, y2, z2 = self.radius
        still = b * y1 - a * z1
        moving = (a * b * y2).doubled() - (a.square() - b.square()) * z2
        if _apart(still) or _apart(moving):
            return None
        return "the circles may be equal two by two"

    def common(self, depth: int, tile: Whole) -> Signs:
        """The signs that g may have at both ends of a pair in a tile.

        Args:
            depth: k; tiles have the edge 2 pi / 2^k.
            tile: (n, 2), the numbers of tiles along m and along h.
        """
        odd = 2 * tile + 1
        m, h = (_angle(odd[:, i], depth + 1, np.pi / 2**depth) for i in (0, 1))
        return self._signs(m, h)

    def at_middles(self, depth: int, tile: Whole) -> Array:
        """How far, in doubles, both ends of a pair in the middle have one sign of g.

        Returns:
            (n, 2, 2): for each of both points p and the signs + and -, the smaller of
            the two |g|; negative where the sign is not common, and -inf where the
            circles do not meet.
        """
        odd = 2 * tile + 1
        m, h = (_angle(odd[:, i], depth + 1, 0.0) for i in (0, 1))
        even, uneven, root, below = self._parts(m, h)
        found = np.empty((len(tile), 2, 2))
        for i, turn in enumerate((-root.mid, root.mid)):
            at_t, at_w = even.mid - uneven.mid + turn, -(even.mid + uneven.mid + turn)
            found[:, i, 0] = np.minimum(at_t, at_w)
            found[:, i, 1] = np.minimum(-at_t, -at_w)
        found[~(below.mid > 0)] = -np.inf
        return found

    def _signs(self, m: _Angle, h: _Angle) -> Signs:
        even, odd, root, below = self._parts(m, h)
        plus, minus = (np.zeros(np.shape(even.mid), dtype=bool) for _ in range(2))
        for turned in (even,) if self.is_line else (even - root, even + root):
            at_t, at_w = turned - odd, -(turned + odd)
            plus |= ~(at_t.high <= 0) & ~(at_w.high <= 0)
            minus |= ~(at_t.low >= 0) & ~(at_w.low >= 0)
        apart = below.high < 0
        return Signs(plus & ~apart, minus & ~apart)

    def _parts(self, m: _Angle, h: _Angle) -> tuple[Spread, Spread, Spread, Spread]:
        """E, O, d sqrt B and B; on a line E / L, O / L, 0 and B."""
        c, s = m
        c2, s2 = _double(m)
        cosine, sine = h
        x0, y1, z1, y2, z2 = self.radius
        (a, b), (x, y) = self.first, self.second
        own1, own2 = y1 * c + z1 * s, y2 * c2 + z2 * s2
        total = (x0 + own1 * cosine + own2 * _double(h).cosine).doubled()
        slope2 = (z2 * c2 - y2 * s2).doubled()
        r = z1 * c - y1 * s + cosine * slope2
        bend = -own1 - cosine * own2.doubled().doubled()
        first, first2 = b * c - a * s, -(a * c + b * s)
        if self.is_line:
            square = first.square()
            below = self._meeting(total, square, r, sine)
            even = (cosine * square).doubled() + _ratio(r, first, total) * first2 - bend
            odd = sine * ((first2 * first).doubled() + slope2)
            return even, odd, Spread(np.zeros(1), np.zeros(1)), below
        second, second2 = y * c - x * s, -(x * c + y * s)
        length = first.square() + second.square()
        below = self._meeting(total, length, r, sine)
        along = first * first2 + second * second2
        even = (cosine * length.square()).doubled() + r * along - length * bend
        odd = sine * length * (along.doubled() + slope2)
        return even, odd, below.root() * (a * y - b * x), below

    @staticmethod
    def _meeting(total: Spread, length: Spread, r: Spread, sine: Spread) -> Spread:
        long = sine * length
        return (total * length).doubled() - r.square() - long.doubled().square()


def _ratio(r: Spread, a: Spread, total: Spread) -> Spread:
    """R / a where the circles meet: by division, or by the bound of B >= 0."""
    most = Spread(total.mid, total.rad).doubled().root().high
    least = np.abs(a.mid) - a.rad
    sure = least > np.abs(a.mid) / 2
    under = np.where(sure, a.mid, 1.0)
    mid = r.mid / under
    # |r'/a' - r/a| <= (|r' - r| + |r / a| |a' - a|) / |a'|
    rad = (r.rad + np.abs(mid) * a.rad) / np.where(sure, least, 1.0)
    rad = (rad + 4 * UNIT * np.abs(mid)) * (1 + 2.0**-40)
    better = sure & (rad < most)
    return Spread(np.where(better, mid, 0.0), np.where(better, rad, most))


def _apart(number: Spread) -> bool:
    return bool(np.abs(number.mid) > number.rad * (1 + 2.0**-40))


def _double(angle: _Angle) -> _Angle:
    c, s = angle
    one = Spread(np.ones(1), np.zeros(1))
    return _Angle(one - s.square().doubled(), (s * c).doubled())


def _angle(number: Whole, bits: int, reach: float) -> _Angle:
    """Cosine and sine within ``reach`` of 2 pi ``number`` / 2^bits."""
    place = number % (1 << bits)
    if bits > _TABLE_BITS:
        own, place = np.unique(place, return_inverse=True)
        cosines, sines = _cosines_sines(own.tolist(), bits)
    else:
        cosines, sines = _table(bits)
    c, s = cosines[place], sines[place]
    bent = reach * reach / 2 + 2 * UNIT
    grown = 1 + 2.0**-40
    return _Angle(
        Spread(c, (np.abs(s) * reach + bent) * grown),
        Spread(s, (np.abs(c) * reach + bent) * grown),
    )


@lru_cache
def _table(bits: int) -> tuple[Array, Array]:
    return _cosines_sines(range(1 << bits), bits)


def _cosines_sines(numbers: Iterable[int], bits: int) -> tuple[Array, Array]:
    """Cosines and sines of 2 pi j / 2^bits, each right to a unit or so."""
    saved, ctx.prec = ctx.prec, 80
    try:
        turns = [arb(fmpq(2 * j, 1 << bits)) for j in numbers]
        pairs = [(turn.cos_pi(), turn.sin_pi()) for turn in turns]
    finally:
        ctx.prec = saved
    c, s = (np.array([float(pair[i].mid()) for pair in pairs]) for i in (0, 1))
    return c, s
