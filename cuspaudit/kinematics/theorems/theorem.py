"""What a theorem on arms of four or six joints is, and what it says of one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.robot.chain import Chain

__all__ = ["Reduction", "Theorem"]


@dataclass(frozen=True)
class Reduction:
    """A theorem that applies to an arm of four or six joints.

    Attributes:
        kind: the name of the theorem.
        why: what it says of this arm, one sentence.
        regional: the three-joint arm that decides, or None when the theorem says
            noncuspidal by itself.
        is_equivalent: whether a cuspidal ``regional`` makes the arm cuspidal; a
            noncuspidal one always makes it noncuspidal.
        is_full: whether every regular posture of ``regional`` stands for two of the arm
            in every pose but singular ones.
        aspects: the number of aspects, where the theorem gives it.
        postures: the largest number of postures of a regular pose, likewise.
        is_reversed: whether ``regional`` belongs to the arm taken from tip to base.
        by_relations: whether its hypotheses are that axes are parallel, meet, are
            square or not, and nothing else: it then holds of every chain that has the
            relations of the model (`model_relations`), exact or not.
    """

    kind: str
    why: str
    regional: ExactModel | None = None
    is_equivalent: bool = True
    is_full: bool = True
    is_reversed: bool = False
    aspects: int | None = None
    postures: int | None = None
    by_relations: bool = False


@dataclass(frozen=True)
class Theorem:
    """A theorem whose hypotheses are a structure of the axes, tested exactly.

    Its proof is in the docstring of its file.

    Attributes:
        name: of the structure.
        task: of the arms that it speaks of.
        joints: how many they have, a virtual one included.
        turning: the numbers of the joints that have to turn, from 1.
        looked_for: the structure, as an arm that has none is told.
        apply: what it says of a model with such joints, None where it does not hold.
    """

    name: str
    task: str
    joints: int
    turning: tuple[int, ...]
    looked_for: str
    apply: Callable[[ExactModel], Reduction | None]

    def speaks_of(self, chain: Chain) -> bool:
        """Whether task and kinds of the joints are as its hypotheses have them."""
        return (
            chain.task == self.task
            and len(chain.joints) == self.joints
            and all(chain.kinds[k - 1] == "revolute" for k in self.turning)
        )
