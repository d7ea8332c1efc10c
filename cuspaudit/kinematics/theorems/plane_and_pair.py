"""Arms with slides: three joints of one plane or one point, and two more of one object.

Theorem. Six joints, the pose of the tip, det J not identically 0. Three joints in a row
turn about axes that meet in one point, or move along one plane: they turn about
parallel axes, one at least, or slide across these. Two others in a row turn about axes
that meet or are parallel, or one turns and one slides across its axis, or both slide in
different directions. Then the arm is noncuspidal.

Without slides this is `triple_and_pair`, whose words and steps are used: G the group of
the three, I the point or oriented plane that it keeps; K the point or plane that the
pair keeps (of two slides: the plane they span); s the sole joint; e the outer joint of
the pair, p the other; rho the relation of I and K. A posture is singular when a fourth
screw keeps I: when e turns about an axis through the point I or across the plane I, or
slides along the plane I; and when I and K are one point or parallel planes.

Proof. 1. rho fixes s. Its derivative by s is not 0 at a nonsingular posture, as every
small motion of K against I is reached and rho depends on s alone. If s turns, rho is
A cos + B sin + C. If s slides, rho is affine for a point and a plane, for two points
its square is a quadratic, and for two planes it is constant, which det J excludes. In
each case values of s with one rho have derivatives of opposite signs, or are equal.

2. The pair, with s known. If both turn, as there. Else K is a plane; let n be across K
and m across a plane I.

p slides, e turns about n. For a point I let sigma be the squared distance of e from I,
a quadratic in p with leading coefficient 1; for a plane I the distance of the point e K
from I, affine in p. It is known. As there, some motion keeps rho and moves sigma unless
e keeps I, so its derivative by p is not 0 and its sign fixes p. Joint e follows, since
it does not keep I.

p turns about n, e slides along u. For a plane I: the turns in G add up to one angle
about m, and the orientation of the tip is this turn, then what is known, then p's turn
about n. n is known in the tip and not parallel to m, so the angle about m is known from
where n points, and then p. For a point I let P be the plane through the axis of p along
u: e keeps P, and the distance of I from P is r sin(p + constant), r the distance of I
from the axis, and it is known. Sliding along K across u keeps rho and moves it, so its
derivative by p is not 0 and its sign fixes p. Joint e is then known: by the distance of
the tip along m from the plane I, as u is not along I, or by the place of the point I.

Both slide. For a plane I the tip would turn about two directions alone, m and that of
s, which det J excludes. For a point I the distance of I from the lines along u in K is
affine in p and fixes it; then e.

3. The triple, its motion in G known. Concurrent axes: as there, the sign of the triple
product of their directions. Parallel: the sum of the turns is known. One turn: it is
known, and the place is affine in the slides. Three turns: a planar arm of two links
with known end. Two turns, one slide: theorem 1 of `common_direction`, where the place
along the plane says that g(q) = 0, g of degree 2 in the slide q, g'/2 up to sign the
determinant of the triple. So the sign of the determinant of the three screws in the
algebra of G, which is 0 at singular postures only, fixes the triple.

A nonsingular posture is therefore known from its pose and at most three signs, which a
nonsingular path keeps: two postures of one pose in one aspect are equal.
"""

from __future__ import annotations

from cuspaudit.kinematics.distant_axes import always_orthogonal, always_parallel
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.neighbors import concurrent, coplanar, parallel
from cuspaudit.kinematics.regular import is_regular_somewhere
from cuspaudit.kinematics.theorems.theorem import Reduction, Theorem
from cuspaudit.kinematics.theorems.triple_and_pair import PLACES

__all__ = ["PLANE_AND_PAIR"]


def _apply(model: ExactModel) -> Reduction | None:
    if "prismatic" not in model.chain.kinds:
        return None
    for first, other in PLACES:
        triple = _triple(model, first)
        pair = _pair(model, other)
        if triple and pair and is_regular_somewhere(model):
            return Reduction(
                "plane and pair",
                f"{triple} and {pair}: three signs along a nonsingular path tell all "
                "postures of a pose apart",
            )
    return None


def _triple(model: ExactModel, first: int) -> str | None:
    """How three joints move along one plane or about one point, None if they do not."""
    numbers = (first, first + 1, first + 2)
    turning = [n for n in numbers if _turns(model, n)]
    if len(turning) == 3 and concurrent(model, first):
        return f"axes {_listed(numbers)} meet in one point"
    if not turning:
        return None
    axis = turning[0]
    if all(always_parallel(model, axis, n) for n in turning[1:]) and all(
        always_orthogonal(model, axis, n) for n in numbers if n not in turning
    ):
        return f"joints {_listed(numbers)} move along one plane"
    return None


def _pair(model: ExactModel, first: int) -> str | None:
    """What two joints in a row keep, None where the theorem does not speak of them."""
    numbers = (first, first + 1)
    turning = sum(_turns(model, n) for n in numbers)
    if turning == 2:
        if not coplanar(model, first):
            return None
        verb = "are parallel" if parallel(model, first) else "meet"
        return f"axes {_listed(numbers)} {verb}"
    if turning == 1 and not always_orthogonal(model, *numbers):
        return None
    if turning == 0 and always_parallel(model, *numbers):
        return None
    return f"joints {_listed(numbers)} move along one plane"


def _turns(model: ExactModel, number: int) -> bool:
    return model.chain.kinds[number - 1] == "revolute"


def _listed(numbers: tuple[int, ...]) -> str:
    return ", ".join(map(str, numbers))


PLANE_AND_PAIR = Theorem(
    "plane and pair",
    "pose",
    6,
    (),
    "three joints in a row along one plane or about one point, and two others in a row",
    _apply,
)
