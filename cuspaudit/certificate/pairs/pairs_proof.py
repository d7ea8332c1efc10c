"""The proof of a certificate of pairs: a three-joint arm is noncuspidal.

All pairs of postures of one position are looked at, in boxes. In the words of
`value_circles`: two postures with the values t and w of joint 3, t != w modulo 2 pi,
have one position, up to turns of joint 1, where the circles over t and w meet in a
point p. Put t = m - h, w = m + h with 0 < h < pi, s = sin h. With

    a = c'(m), k = c''(m), L = |a|^2, d = det(c', c'') (the same for every t),
    N = N1 + N2 (its parts of degree 1 and 2), A = N1''(m) + cos h N2''(m),
    r = N1'(m) + cos h N2'(m), so that N(w) - N(t) = 2 s r, c(w) - c(t) = 2 s a,
    B = 2 (N(t) + N(w)) L - r^2 - 4 s^2 L^2

the circles meet where B >= 0, in two points (upper and lower sign), and 2 L h / s is

    at t:    E - O -+ d sqrt B,   E = 2 cos h L^2 + r a.k - L A,
    at w:  -(E + O -+ d sqrt B),  O = s L (2 a.k + N2'(m)).

*Proof.* p = c(t) + (x + y J) (c(w) - c(t)), J a right angle, with
x = (4 s^2 L + N(t) - N(w)) / (8 s^2 L) = (2 s L - r) / (4 s L) and, from
|p - c(t)|^2 = N(t), y = +- sqrt B / (4 s L). Insert c'(m -+ h) = cos h a -+ s k and
N'(m -+ h) = cos h r -+ s A - s^2 N2'(m) in h = q.c' + N'/2. QED (The third derivatives
of c and N1 are -c' and -N1', that of N2 is -4 N2'.)

**Theorem.** If for each (m, h) and each point p one of these holds, the arm is
noncuspidal: (i) B < 0; (ii) h has different signs at t and w; (iii) t and w lie in
different aspects of the sign that h has at both. For (iii): over a value u with
N |c'|^2 < (N'/2)^2 the sign of h is that of N', so no path on which h has the other
sign passes u; two such values, one on each arc from t to w, part the aspects.
*Proof.* Two postures with one position, one sign of h and t = w modulo 2 pi are equal:
over one t a point p is on the circle once (if N(t) = 0, h = N'/2 = 0), and joint 1 is
fixed, as it moves the tip. So t != w. L is not 0, or (m, h) is one of finitely many
pairs with c'(m) = 0 and r = 0. All pairs of regular postures with one position are a
surface, as the map is a local diffeomorphism; those over finitely many (m, h) are a
curve in it; and on a component the ends keep to their aspects: a pair near by is in
the same two. QED

**Square axes.** Where e.n = 0, c moves on a line, d = 0, and a and k are numbers:

    E / L = 2 cos h a^2 + (r / a) k - A,     O / L = s (2 k a + N2'(m)).

a is 0 for two values of m, but B >= 0 says |r / a| <= sqrt(2 (N(t) + N(w))), which
serves in boxes that hold such a value. That r is not 0 for all h there is tested: one
of its coefficients of 1 and cos h is not 0. Where the axes are not square, d != 0 is
asked for, and L > 0 follows.

With play (`play`) the circles are balls that hold those of every robot, and what is
proved with them holds for each; axes 1 and 2 are square for each where no play turns.

Boxes in which none of the three is proved are halved. (m, h) and (m + pi, pi - h) are
the same two postures, exchanged, so 0 <= m <= 2 pi, 0 <= h <= pi/2 has them all.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from flint import arb

from cuspaudit.certificate.arm import arm_from_certificate
from cuspaudit.certificate.balls import ball_from_fraction, working_precision
from cuspaudit.certificate.cover import Refusal
from cuspaudit.certificate.determinant import jacobian_determinant
from cuspaudit.certificate.loose.play import for_every_robot, without_play
from cuspaudit.certificate.model import Loose, PairsCertificate
from cuspaudit.certificate.pairs.value_circles import ValueCircles, value_circles
from cuspaudit.certificate.structure.axes import are_square

__all__ = ["PairsProof"]

MOST_BOXES = 100_000
_BITS = 64
_SMALL = Fraction(1, 8)
"""Of narrower boxes the middle is looked at: where it fails, halving does not help."""
_LONG, _WIDE = Fraction(629, 100), Fraction(158, 100)
"""More than 2 pi, more than pi/2."""


@dataclass(slots=True)
class PairsProof:
    """The steps of the proof; each raises `Refusal` when it fails.

    Attributes:
        certificate: well formed.
        bits: the working precision.
        boxes: number of boxes looked at so far.
    """

    certificate: PairsCertificate
    bits: int = _BITS
    boxes: int = 0
    radius: float | None = None
    _parting: dict[int, list[arb]] = field(default_factory=dict)

    def run(self) -> float:
        """Prove all; return a lower bound of |det J| at the regular posture."""
        if any(joint.kind != "revolute" for joint in self.certificate.joints):
            raise Refusal("a joint slides: the theorem is about three that turn")
        with working_precision(self.bits):
            is_square = self._is_square()
            pairs = _Pairs(value_circles(self.certificate, is_square), is_square)
            pairs.check()
            self._part(pairs)
            self._cover(pairs)
            return self._regular()

    def _is_square(self) -> bool:
        """Whether axes 1 and 2 are square for every robot: no play tilts them."""
        tolerance = self.certificate.tolerance
        link = self.certificate.joints[1].before
        is_tilted = any(isinstance(m, Loose) and m.kind == "turn" for m in link)
        if is_tilted or (tolerance is not None and tolerance.angles):
            return False
        return are_square(without_play(self.certificate), 1)

    def summary(self) -> str:
        """What `run` has proved, in one sentence."""
        return (
            "noncuspidal: no two postures of one position lie in one aspect, proved in "
            f"{self.boxes} boxes of pairs{for_every_robot(self.certificate)}"
        )

    def _part(self, pairs: _Pairs) -> None:
        """The values of joint 3 that no path of one sign passes, by that sign."""
        self._parting = {1: [], -1: []}
        for number in self.certificate.parting:
            value = ball_from_fraction(number)
            sign = pairs.circles.only_sign(value)
            if sign is None:
                raise Refusal(f"paths of both signs may pass {number} of joint 3")
            self._parting[-sign].append(value)

    def _cover(self, pairs: _Pairs) -> None:
        """Prove (i), (ii) or (iii) on every box; the stack holds ends of m and h."""
        zero = Fraction(0)
        stack = [(zero, _LONG, zero, _WIDE)]
        while stack:
            m0, m1, h0, h1 = stack.pop()
            self.boxes += 1
            if self.boxes > MOST_BOXES:
                raise Refusal(f"not proved with {MOST_BOXES} boxes")
            if self._is_proved(pairs, _hull(m0, m1), _hull(h0, h1)):
                continue
            m, h = (m0 + m1) / 2, (h0 + h1) / 2
            if m1 - m0 < _SMALL and not self._is_proved(
                pairs, ball_from_fraction(m), ball_from_fraction(h)
            ):
                raise Refusal(
                    f"postures of one position near {float(m - h):.6g} and "
                    f"{float(m + h):.6g} of joint 3 are not proved to lie apart"
                )
            if m1 - m0 > h1 - h0:
                stack += [(m0, m, h0, h1), (m, m1, h0, h1)]
            else:
                stack += [(m0, m1, h0, h), (m0, m1, h, h1)]

    def _is_proved(self, pairs: _Pairs, m: arb, h: arb) -> bool:
        signs = pairs.common_signs(m, h)
        return all(self._lie_apart(m, h, sign) for sign in signs)

    def _lie_apart(self, m: arb, h: arb, sign: int) -> bool:
        """Whether values part the aspects of ``sign`` at m - h and m + h, both ways."""
        t, w, turn = m - h, m + h, 2 * arb.pi()
        values = [v + k * turn for v in self._parting[sign] for k in range(-2, 3)]
        there = any(t < v and v < w for v in values)
        return there and any(w < v and v < t + turn for v in values)

    def _regular(self) -> float:
        arm = arm_from_certificate(self.certificate, arb)
        q = [ball_from_fraction(value) for value in self.certificate.regular]
        value = jacobian_determinant(arm, q)
        if value is None or value.contains(0):
            raise Refusal("det J is not proved to differ from 0 at the regular posture")
        return float(abs(value).lower())


def _hull(low: Fraction, high: Fraction) -> arb:
    middle, half = (low + high) / 2, (high - low) / 2
    return ball_from_fraction(middle) + arb(0, ball_from_fraction(half).upper())


@dataclass(frozen=True)
class _Pairs:
    """The functions of (m, h) above, over balls."""

    circles: ValueCircles
    is_square: bool

    def check(self) -> None:
        """Refuse circles of which the theorem does not speak."""
        (a, b), (x, y) = self.circles.first, self.circles.second
        if self.is_square:
            length = a * a + b * b
            if not length > 0:
                raise Refusal("the circles of values are not proved to move")
            # a zero of c' = -a sin + b cos: cos, sin = (a, b) / root; r = r0 + r1 cos h
            _, y1, z1, y2, z2 = self.circles.radius
            still = b * y1 - a * z1
            moving = 2 * a * b * y2 - (a * a - b * b) * z2
            if still.contains(0) and moving.contains(0):
                raise Refusal("the arm may be its own mirror image: not proved")
        elif (a * y - b * x).contains(0):
            raise Refusal("the centres of the circles are not proved to leave a line")

    def common_signs(self, m: arb, h: arb) -> tuple[int, ...]:
        """The signs that h may have at both ends of a pair in the box."""
        s, c = m.sin_cos()
        s2, c2 = (2 * m).sin_cos()
        sigma, cosine = h.sin_cos()
        x0, y1, z1, y2, z2 = self.circles.radius
        total = 2 * (x0 + (y1 * c + z1 * s) * cosine)
        total += 2 * (y2 * c2 + z2 * s2) * (2 * h).cos()
        slope2, bend2 = 2 * (z2 * c2 - y2 * s2), -4 * (y2 * c2 + z2 * s2)
        r = z1 * c - y1 * s + cosine * slope2
        bend = -y1 * c - z1 * s + cosine * bend2
        (a, b), (x, y) = self.circles.first, self.circles.second
        first, first2 = b * c - a * s, -a * c - b * s
        if self.is_square:
            return _on_a_line(first, first2, total, r, bend, slope2, sigma, cosine)
        second, second2 = y * c - x * s, -x * c - y * s
        length = first * first + second * second
        below = 2 * total * length - r * r - (2 * sigma * length) ** 2
        if below < 0:
            return ()
        along = first * first2 + second * second2
        even = 2 * cosine * length * length + r * along - length * bend
        odd = sigma * length * (2 * along + slope2)
        root = _root(below) * (a * y - b * x)
        return tuple({*_signs(even - root, odd), *_signs(even + root, odd)})


def _on_a_line(
    a: arb,
    k: arb,
    total: arb,
    r: arb,
    bend: arb,
    slope2: arb,
    sigma: arb,
    cosine: arb,
) -> tuple[int, ...]:
    """The common signs where c moves on a line, a = c' and k = c'' numbers."""
    square = a * a
    if 2 * total * square - r * r - (2 * sigma * square) ** 2 < 0:
        return ()
    most = arb(0, _root(2 * total).upper())
    quotient = most if a.contains(0) else r / a
    even = 2 * cosine * square + quotient * k - bend
    return _signs(even, sigma * (2 * k * a + slope2))


def _signs(even: arb, odd: arb) -> tuple[int, ...]:
    """The signs that even - odd and -(even + odd) may have in common."""
    at_t, at_w = even - odd, -(even + odd)
    return tuple(
        sign for sign in (1, -1) if not at_t * sign <= 0 and not at_w * sign <= 0
    )


def _root(square: arb) -> arb:
    """The root of what a nonnegative member of ``square`` may be."""
    high = square.upper()
    low = square.lower()
    if not high > 0:
        return arb(0)
    top = high.sqrt().upper()
    bottom = low.sqrt().lower() if low > 0 else arb(0)
    return (top + bottom) / 2 + arb(0, ((top - bottom) / 2).upper())
