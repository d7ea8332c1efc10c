"""Widest paths and the merge tree of an arm's aspects, for posture after posture.

``geometry.torus.routing`` on the torus of the joints that det J depends on; the other
joints turn evenly on the way. A search in floating point: a path is a proposal for a
certificate, the number of aspects is that of ``auditing.aspects``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from cuspaudit.auditing.aspects import count_aspects
from cuspaudit.count import Count
from cuspaudit.geometry.torus.function import TorusFunction
from cuspaudit.geometry.torus.routing import TorusRouting, WidestPath, torus_routing
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel, revolute_circles

__all__ = ["AspectRouting", "route_aspects"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class AspectRouting:
    """The maxima of |det J|, the saddles between them, and paths of postures.

    Attributes:
        joints: the numbers, from 0, of the joints that det J depends on.
        zeros: of all joints: the angle of the torus is the joint value plus its zero.
        routing: on the torus of these joints.
        aspects: the proved number; None where it is not proved.
    """

    joints: tuple[int, ...]
    zeros: Array
    routing: TorusRouting
    aspects: Count | None

    def on_torus(self, postures: Array) -> Array:
        """The points of the torus of (..., n) joint values: (..., k)."""
        turned = np.asarray(postures, dtype=np.float64) + self.zeros
        return np.asarray(turned[..., list(self.joints)])

    def clearance(self, level: float) -> float:
        """A value of |det J| over the largest found, in [0, 1]."""
        return level / self.routing.largest

    def widest_path(self, first: Array, second: Array) -> WidestPath | None:
        """The widest path of postures from ``first`` to ``second``, or None.

        Args:
            first: (n,) joint values.
            second: (n,) joint values.

        Returns:
            (m, n) joint values that begin at ``first`` and end at ``second`` but for
            whole turns of joints, with the smallest |det J| at them; None when the
            ascents from the two end in groups of maxima that no saddle joins.
        """
        ends = np.array([first, second], dtype=np.float64)
        found = self.routing.widest_path(*self.on_torus(ends))
        if found is None:
            return None
        share = np.linspace(0.0, 1.0, len(found.points))[:, None]
        postures = ends[0] + share * (ends[1] - ends[0])
        chosen = list(self.joints)
        postures[:, chosen] = found.points - self.zeros[chosen]
        return replace(found, points=postures)


def route_aspects(model: ExactModel, seed: int = 0) -> AspectRouting:
    """The routing graph of |det J| of an arm with revolute joints.

    Where the number of aspects is proved, the search goes on until the graph has as
    many groups of maxima, or gives up after eight rounds.

    Raises:
        DegenerateMapError: det J vanishes identically.
        UnableError: a joint is prismatic.
    """
    circles = revolute_circles(model)
    determinant = jacobian_determinant(model)
    aspects = count_aspects(model)
    used = tuple(
        k
        for k, circle in enumerate(circles)
        if any(determinant.derivative(name) != 0 for name in circle)
    )
    h = TorusFunction.from_polynomial(
        model.ring, [circles[k] for k in used], determinant
    )
    wanted = None if aspects is None else aspects.count
    routing = torus_routing(h, seed, wanted)
    zeros = model.zeros
    return AspectRouting(used, zeros, routing, aspects)
