"""Whether small boxes of six joints are noncuspidal (`certificate.pairs`)."""

from __future__ import annotations

from cuspaudit.auditing.limits.joint_limits import outer_limits
from cuspaudit.auditing.proofs.certified_robot import certified_robot, regular_posture
from cuspaudit.certificate import CuspCertificate
from cuspaudit.certificate.pairs.boxes_apart import Apart, Ends, Search
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.factor_signs import factor_signs
from cuspaudit.runtime.clock import check_time

__all__ = ["pairs_apart"]

_LOOKS = 400
_MIDDLE = slice(1, 5)


def pairs_apart(model: ExactModel, looks: int = _LOOKS) -> Apart | None:
    """The proof for the middle joints of a chain inside their limits, if it is found.

    Args:
        model: task "pose"; the proof is about the numbers of its chain.
        looks: at how many boxes at most.

    Returns:
        None where a middle joint has no limits or an end joint slides, and where the
        number of looks was not enough.
    """
    chain = model.chain
    limits = outer_limits(chain)[_MIDDLE]
    ends = {chain.joints[0].kind, chain.joints[-1].kind}
    if chain.task != "pose" or ends != {"revolute"}:
        return None
    if any(pair is None for pair in limits):
        return None
    whole: Ends = tuple(pair for pair in limits if pair is not None)
    robot = certified_robot(chain)
    certificate = CuspCertificate(**robot, limits=None, posture=regular_posture(chain))
    search = Search(certificate, factor_signs(model), looks)
    return search.run(whole, lambda: check_time("limits: boxes apart"))
