"""An arm with one joint locked at any value: cosine and sine of it indeterminate.

A chain with one joint more than its task has dimensions becomes an arm of that task
when the joint is locked. Here the lock keeps its two variables c, s of the exact model,
and the fixed transform in which it stands has entries polynomial in them. A polynomial
in c, s vanishes at every value of the lock exactly when c^2 + s^2 - 1 divides it: the
ring of the circle over a real field is an integral domain with infinitely many points.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from flint import arb

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.kinematics.exact_model import ExactJoint, ExactModel, exact_model
from cuspaudit.kinematics.locked.span import Span, ball_of_angle
from cuspaudit.kinematics.transform import Transform
from cuspaudit.robot.chain import Angle, Chain, reverse
from cuspaudit.robot.task import lock
from cuspaudit.robot.virtual_joint import with_virtual_joint

__all__ = ["LockedArm", "locked_arm"]


@dataclass(frozen=True, eq=False)
class LockedArm:
    """The arm that is left when a joint is locked at a value that is not told.

    Attributes:
        whole: the chain with all joints, a virtual one included.
        number: of the locked joint, from 1; it turns.
        arm: the joints left, in the ring of the whole model; the variables of the lock
            stand in one of its fixed transforms.
        variables: (c, s) of the lock.
        zero: what is added to its value to get the angle with that cosine and sine.
    """

    whole: Chain
    number: int
    arm: ExactModel
    variables: tuple[str, str]
    zero: Angle

    def vanishes(self, *entries: Polynomial) -> bool:
        """Whether polynomials in c, s are 0 at every value of the lock."""
        ring, (c, s) = self.arm.ring, self.variables
        circle = ring.gen(c) ** 2 + ring.gen(s) ** 2 - 1
        return all(
            ring.reduce(divmod(ring.reduce(entry), circle)[1]) == 0 for entry in entries
        )

    def values(self, span: Span) -> dict[str, arb]:
        """Balls with the cosine and the sine of the lock over ``span``."""
        sine, cosine = (span.ball() + ball_of_angle(self.zero)).sin_cos()
        return dict(zip(self.variables, (cosine, sine), strict=True))

    def differs(self, entries: tuple[Polynomial, ...], span: Span) -> bool:
        """Whether at each value in ``span`` one of the entries is not 0, for certain.

        One and the same entry for all values: a shorter span may do where this fails.
        """
        values = self.values(span)
        evaluate = self.arm.ring.evaluate
        return any(not evaluate(entry, values).contains(0) for entry in entries)

    def reversed(self) -> LockedArm:
        """The same arm taken from tip to base."""
        return locked_arm(reverse(self.whole), len(self.whole.joints) + 1 - self.number)


def locked_arm(chain: Chain, number: int) -> LockedArm:
    """The arm that is left of ``chain`` when joint ``number`` is locked.

    Args:
        chain: a joint more than its task has dimensions; snapped.
        number: of a joint that turns, from 1.
    """
    chain = with_virtual_joint(chain)
    model = exact_model(chain)
    held = model.joints[number - 1]
    c, s = held.variables
    through = held.before @ model.motion(held)
    rest = list(model.joints[: number - 1])
    tool = model.tool
    if number == len(model.joints):
        tool = through @ tool
    else:
        rest.append(_moved(model.joints[number], through))
        rest += model.joints[number + 1 :]
    left = lock(chain, {held.name: Angle()})
    arm = replace(model, chain=left, joints=tuple(rest), tool=tool)
    return LockedArm(chain, number, arm, (c, s), held.zero)


def _moved(joint: ExactJoint, through: Transform) -> ExactJoint:
    return replace(joint, before=through @ joint.before)
