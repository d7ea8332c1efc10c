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
from typing import TypeVar

from cuspaudit.certificate.arm import Arm, Screw
from cuspaudit.certificate.balls import Row, S, cross, dot, minus, plus, times

__all__ = ["determinant_with_column", "jacobian_determinant"]

T = TypeVar("T")

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


def determinant_with_column(
    arm: Arm[S], q: Sequence[S], joint: int, row: int
) -> S | None:
    """Return det J with the column of a joint replaced by a unit vector.

    J is written in the coordinates of link 1 (position) or link 3 (pose), as above. For
    a fixed row these are the entries of adj(J) e_row, J adj(J) e_row = det J e_row.

    Args:
        arm: three joints (position task) or six (pose).
        q: one value a joint.
        joint: which column, from 0.
        row: which unit vector; of a pose 0 to 2 for m, 3 to 5 for w.
    """
    one = arm.still.R[0][0]
    if len(arm.joints) == 3:
        return _triple(_replaced(_velocities(arm, q), joint, _unit(one, row)))
    none: Row[S] = (None, None, None)
    unit = Screw(none, _unit(one, row)) if row < 3 else Screw(_unit(one, row - 3), none)
    return _laplace(_replaced(_screws(arm, q), joint, unit))


def _unit(one: S | None, k: int) -> Row[S]:
    x, y, z = (one if i == k else None for i in range(3))
    return x, y, z


def _replaced(columns: list[T], k: int, column: T) -> list[T]:
    return [*columns[:k], column, *columns[k + 1 :]]


def _position(arm: Arm[S], q: Sequence[S]) -> S | None:
    return _triple(_velocities(arm, q))


def _velocities(arm: Arm[S], q: Sequence[S]) -> list[Row[S]]:
    """The velocities of the tip, in link 1."""
    outer, tip = arm.outward(1, q)
    return [screw.velocity(tip.p) for screw in arm.inward(1, q) + outer]


def _triple(columns: list[Row[S]]) -> S | None:
    first, second, third = columns
    return dot(first, cross(second, third))


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
    return _laplace(_screws(arm, q))


def _screws(arm: Arm[S], q: Sequence[S]) -> list[Screw[S]]:
    """The six screws, in link 3."""
    outer, _ = arm.outward(3, q)
    return arm.inward(3, q) + outer


def _laplace(screws: list[Screw[S]]) -> S | None:
    one, two, three, four, five, six = screws
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
