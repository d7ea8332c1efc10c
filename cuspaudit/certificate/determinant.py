"""The determinant of the Jacobian matrix of an arm, from the screws of its joints.

Position task, three joints: the columns are the velocities of the tip's origin. Pose
task, six joints: the columns are the velocity of the tip's origin above the angular
velocity, in this order (linear, then angular), base to tip.

Position and angle, four joints: the columns are the velocity of the tip's origin above
the part of the angular velocity along the last axis that turns.

Position and pose are computed in the coordinates of a link in the middle of the arm:
link 1 for the position, link 3 for the pose. This changes no value. A rotation of the
coordinates multiplies det J by det R (3 rows) or det diag(R, R) (6 rows), which are 1;
moving the reference point of the velocities from the tip to the origin, v = m + w x p,
adds multiples of the angular rows to the linear ones. What is gained: joint 1 (for the
pose task joint 6) drops out, and each screw depends on two joint values at most, so
that the enclosures are tight.

The 6x6 determinant is expanded by Laplace over the two halves of three columns: twenty
products of 3x3 minors.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from cuspaudit.certificate.arm import Arm, Screw
from cuspaudit.certificate.balls import S, cross, dot, minus, plus, times

__all__ = ["jacobian_determinant"]

_PAIRS = tuple(combinations(range(6), 2))
_TRIPLES = tuple(combinations(range(6), 3))


def jacobian_determinant(arm: Arm[S], q: Sequence[S]) -> S | None:
    """Return det J at the joint values ``q``.

    Args:
        arm: three joints (position task), four (position and angle) or six (pose).
        q: one value a joint: balls, or power series.

    Returns:
        An enclosure of det J for every choice of values in ``q``; None if it is
        exactly zero for want of any term.
    """
    if len(arm.joints) == 3:
        return _position(arm, q)
    if len(arm.joints) == 4:
        return _position_and_angle(arm, q)
    return _pose(arm, q)


def _position(arm: Arm[S], q: Sequence[S]) -> S | None:
    [first] = arm.inward(1, q)
    [second, third], tip = arm.outward(1, q)
    others = cross(second.velocity(tip.p), third.velocity(tip.p))
    return dot(first.velocity(tip.p), others)


def _position_and_angle(arm: Arm[S], q: Sequence[S]) -> S | None:
    """Expanded along the row of angles; None where no joint turns."""
    screws, tip = arm.outward(0, q)
    turning = [k for k, joint in enumerate(arm.joints) if joint.turns]
    if not turning:
        return None
    along, total = screws[turning[-1]].w, None
    velocities = [screw.velocity(tip.p) for screw in screws]
    for k in turning:
        a, b, c = velocities[:k] + velocities[k + 1 :]
        term = times(dot(screws[k].w, along), dot(a, cross(b, c)))
        total = plus(total, term) if k % 2 else minus(total, term)
    return total


def _pose(arm: Arm[S], q: Sequence[S]) -> S | None:
    one, two, three = arm.inward(3, q)
    [four, five, six], _ = arm.outward(3, q)
    inner = _minors(one, two, three)
    # screws 3 and 4 are constant in link 3; (5, 6, 4) is an even permutation
    outer = _minors(five, six, four)
    total = None
    for rows in _TRIPLES:
        rest = tuple(row for row in range(6) if row not in rows)
        term = times(inner[rows], outer[rest])
        total = plus(total, term) if sum(rows) % 2 else minus(total, term)
    return total


def _minors(a: Screw[S], b: Screw[S], c: Screw[S]) -> dict[tuple[int, ...], S | None]:
    """The twenty 3x3 minors of the columns (m; w) of three screws, by rows."""
    u, v, t = a.column, b.column, c.column
    two: dict[tuple[int, int], S | None] = {}
    for i, j in _PAIRS:
        two[i, j] = minus(times(u[i], v[j]), times(u[j], v[i]))
    three: dict[tuple[int, ...], S | None] = {}
    for i, j, k in _TRIPLES:
        near = minus(times(t[k], two[i, j]), times(t[j], two[i, k]))
        three[i, j, k] = plus(near, times(t[i], two[j, k]))
    return three
