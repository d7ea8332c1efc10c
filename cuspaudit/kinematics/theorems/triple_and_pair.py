"""Arms with three axes that meet, or are parallel, and two more that do.

Theorem. Six revolute joints, det J not identically 0, three axes in a row parallel or
concurrent, two others in a row parallel or concurrent: the arm is noncuspidal.

Words. The three joints move in a group G: the motions of a plane along itself, or those
that fix a point. They keep an object I, that (oriented) plane or point. The two joints
keep an object K: the point where they meet, or a plane across them. Two objects have
one relation rho: the distance of two points, the distance of point and plane with its
sign, the angle of two planes. A posture is singular when a fourth axis keeps I, since
four screws in the three dimensions of the algebra of G are dependent; in particular

(a) when a point I is the point K, or the planes I and K are parallel;
(b) when the axis e of the pair that is away from the other (below) keeps I: e through
    the point I, or across the plane I.

Proof. Take the arm from tip to base if the triple begins at axis 3 or 4. The triple is
1-3 or 2-4. A sole joint s is left, and e is the outer axis of the pair:

    triple 2-4, pair 5-6, s = 1, e = 6: K is known from the pose, I turns with joint 1;
    triple 1-3, pair 5-6, s = 4, e = 6: I and K are known, rho depends on joint 4;
    triple 1-3, pair 4-5, s = 6, e = 4: I is known, in the tip's frame K turns.

1. rho fixes the joint s. Every time rho, as a function of theta_s for a given pose, is
A cos + B sin + C and has a value that is known (the constant relation of I and K within
one link, or what the pose says). Let its derivative vanish at a nonsingular posture.
All poses near by are reached, so rho would be stationary for every small motion of K
against I; that is so only in case (a). So the derivative is not 0, and two values of
theta_s with one rho have derivatives of different signs.

2. sigma fixes the other joint of the pair. Let p be that joint of the pair which is not
e. Once s is known, so is I seen from the link between p and e's far side, and e turns
about p. Let sigma be the first that K does not keep: for a point K, the product of e
with I - K, or with the normal of the plane I; for a plane K, the squared distance of
e to the point I, or the distance of the point e K to the plane I. It is A cos + B sin +
C in theta_p and its value is known. If its derivative vanishes at a nonsingular
posture, then for small motions of the pair's far side against I, sigma is stationary
where rho is, as every motion is reached and theta_s follows rho by 1. But turning about
a point K keeps rho and moves sigma, unless e and I are as in (b); sliding along a
plane K keeps its distance to a point I and moves sigma, unless as in (b); and sliding
across the plane I keeps the angle with a plane K and moves sigma. So the derivative is
not 0 and its sign fixes theta_p.

3. Joint e is fixed: its turn must carry I to where it is known to be, and e does not
keep I, by (b).

4. The triple: its motion in G is now known. The relation of its outer axes (distance of
parallels, angle of concurrent ones) is A cos + B sin + C in the middle joint, its
derivative 0 only when the three axes lie in one plane and their screws are dependent.
So its sign fixes the middle joint. The outer axes are then no one line, so the first
joint is fixed as the one that carries the last axis to its place, and the last joint
by what is left.

A nonsingular posture is therefore known from its pose and three signs. They are
constant along a nonsingular path: two postures of one pose in one aspect are equal.
"""

from __future__ import annotations

from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.neighbors import concurrent, coplanar, parallel
from cuspaudit.kinematics.regular import is_regular_somewhere
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem

__all__ = ["PLACES", "TRIPLE_AND_PAIR", "triple_and_pair"]

PLACES = ((1, 4), (1, 5), (2, 5), (3, 1), (4, 1), (4, 2))
"""Where a triple and a pair can stand: the number of the first axis of each."""


def triple_and_pair(model: ExactModel) -> str | None:
    """Which axes meet the hypotheses of the theorem, or None; tested exactly.

    Args:
        model: six revolute joints.
    """
    for first, other in PLACES:
        triple = _triple(model, first)
        if triple is None or not coplanar(model, other):
            continue
        if not is_regular_somewhere(model):
            return None
        pair = "are parallel" if parallel(model, other) else "meet"
        return f"{triple} and axes {other}, {other + 1} {pair}"
    return None


def _triple(model: ExactModel, first: int) -> str | None:
    axes = f"axes {first}, {first + 1}, {first + 2}"
    if parallel(model, first) and parallel(model, first + 1):
        return f"{axes} are parallel"
    return f"{axes} meet in one point" if concurrent(model, first) else None


def _apply(model: ExactModel) -> Reduction | None:
    axes = triple_and_pair(model)
    if axes is None:
        return None
    return Reduction(
        "triple and pair",
        f"{axes}: three signs along a nonsingular path tell all postures of a pose "
        "apart",
        by_relations=True,
    )


TRIPLE_AND_PAIR = Theorem(
    "triple and pair",
    "pose",
    6,
    (1, 2, 3, 4, 5, 6),
    "three axes in a row parallel or concurrent, and two others in a row as well",
    _apply,
)
