"""What an answer for a model says of the chain that the model stands for.

Where the model is exact, the two are one arm. Where turns or lengths were moved, within
1e-12, what was found is proved for another arm. Three things carry over all the same:

- a witness, since a certificate holds the numbers of the chain and none of the model;
- a theorem that needs relations of the axes only: chain and model have the same ones
  (`kinematics.model_relations`), and every number between them may be any; and with it
  what was found for three joints that are exact;
- a verdict as such, which then says that it is about a model; its counts are no longer
  called proved.
"""

from __future__ import annotations

from dataclasses import replace

from cuspaudit.auditing.answer import Answer, Reason, undecided
from cuspaudit.count import Count
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.model_relations import changed_relations

__all__ = ["carried", "is_carried", "refused"]


def refused(model: ExactModel) -> Answer | None:
    """UNDECIDED where chain and model differ in a relation of the axes, else None."""
    changed = changed_relations(model)
    if not changed:
        return None
    words = "; ".join(sorted(changed))
    why = f"the exact model is not the arm: only one of the two has this: {words}"
    settle = "angles in deg or as multiples of pi, or one turn in place of several"
    return undecided(model, Reason.NO_MODEL, "exact model", why, (), settle)


def carried(found: Answer) -> Answer:
    """The answer, with nothing called proved that only its model has."""
    if found.model.is_exact or _is_of_an_exact_part(found):
        return found
    theorem = found.reduction if _rests_on_relations(found) else None
    keeps_aspects = theorem is not None and theorem.aspects is not None
    return replace(
        found,
        aspects=found.aspects if keeps_aspects else _unproved(found.aspects),
        postures=found.postures if theorem else _unproved(found.postures),
        cusps=_unproved(found.cusps),
        nodes=_unproved(found.nodes),
    )


def is_carried(found: Answer) -> bool:
    """Whether the verdict is proved for the chain, not for a model near it alone."""
    return (
        found.model.is_exact
        or found.witness is not None
        or _is_of_an_exact_part(found)
        or _rests_on_relations(found)
    )


def _rests_on_relations(found: Answer) -> bool:
    return found.reduction is not None and found.reduction.by_relations


def _is_of_an_exact_part(found: Answer) -> bool:
    """Whether three joints decide, and they and their point have exact numbers.

    That they decide is a relation of the other axes, which chain and model share.
    """
    regional = found.reduction.regional if found.reduction else None
    return regional is not None and regional.is_exact


def _unproved(count: Count | None) -> Count | None:
    return replace(count, proved=False) if count else None
