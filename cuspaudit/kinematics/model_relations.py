"""Whether an exact model stands to the world as the chain that it models does.

A model whose turns are moved to rational ones is another arm, within 1e-12. What makes
that harmless is that the axes of both are parallel, meet and are square alike; a
verdict hangs on that and not on digits.
"""

from __future__ import annotations

from flint import ctx

from cuspaudit.algebra.ring import Ring
from cuspaudit.kinematics.exact_model import ExactModel
from cuspaudit.kinematics.transform import Column, Transform, identity, zero
from cuspaudit.robot.lines import BITS, Ball, Line
from cuspaudit.robot.relations import relations, relations_of_lines

__all__ = ["changed_relations"]


def changed_relations(model: ExactModel) -> frozenset[str]:
    """The relations of the axes that only one of the chain and its model has.

    None for an exact model. A number below 1e-300 counts as 0, in both. That two axes
    stand at 30, 45 or 60 degrees is no structure on which a verdict hangs, and a model
    over Q cannot have it.
    """
    if model.is_exact:
        return frozenset()
    with ctx.workprec(BITS):
        own = relations_of_lines(model.chain, *_lines(model))
    meant = relations(model.chain)
    return frozenset(word for word in own ^ meant if _decides(word))


def _decides(word: str) -> bool:
    return "the base" not in word and not word.endswith(" deg")


def _lines(model: ExactModel) -> tuple[list[Line], Ball]:
    """The axes and the tip at value 0 of the model's variables, in the base."""
    ring = model.ring
    placed, lines = Transform(ring, identity(ring), zero(ring)), []
    for joint in model.joints:
        placed = placed @ joint.before
        axis = _ball(ring, placed.turn(joint.axis))
        lines.append(Line(axis, _ball(ring, placed.translation)))
    return lines, _ball(ring, placed.apply(model.tool.translation))


def _ball(ring: Ring, column: Column) -> Ball:
    x, y, z = (ring.evaluate(entry, {}) for entry in column)
    return x, y, z
