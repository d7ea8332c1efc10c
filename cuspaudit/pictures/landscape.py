"""|det J| of a six-joint arm as a landscape: its merge tree, and slices of it.

The maxima of |det J| stand in the aspects; as the level falls they join at saddles, and
the level of a saddle is the clearance of the widest way over it. The slices are planes
through the narrowest place of the witness path, or through a maximum where there is no
path. All of it is floating point, for the eye; only the number of aspects is proved.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from cuspaudit.algebra.angles import shortest_turn
from cuspaudit.auditing.audit import Options, audit
from cuspaudit.auditing.deciders.decide import answer
from cuspaudit.auditing.record import FinishedAudit
from cuspaudit.auditing.search.aspect_routing import AspectRouting, route_aspects
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.pictures.figures import figures
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.snapping import snap
from cuspaudit.viz.plot.data import Array, Figures, Landscape, Leaf, Slice

__all__ = ["landscape", "picture_of"]

_SIDE = 241
_MARGIN = 1.35


def picture_of(
    robot: Robot, at: tuple[Fraction, Fraction] | None, options: Options
) -> Figures | Landscape:
    """The figures of an arm that three joints decide, else its landscape.

    Args:
        robot: an arm of three joints, or of six.
        at: the value whose postures are drawn; only for three joints.
        options: of the audit that finds the witness.

    Raises:
        UnableError: there is nothing to draw for this arm.
        AssumptionError: a hypothesis fails for this arm.
        InvalidInputError: ``at`` is critical, or out of reach.
    """
    found = answer(exact_model(snap(robot.chain, options.snap)[0]))
    kinds = found.model.chain.kinds
    if found.decision is None and at is None and kinds == ("revolute",) * 6:
        return landscape(audit(robot, options))
    return figures(found, at)


def landscape(audited: FinishedAudit) -> Landscape:
    """The landscape of an audited arm of six revolute joints.

    Raises:
        DegenerateMapError: det J vanishes identically.
        UnableError: a joint is prismatic.
    """
    routing = route_aspects(audited.answer.model, audited.seed)
    order, branches, joins = _tree(routing)
    groups = {i: n for n, group in enumerate(_groups(routing, order), 1) for i in group}
    heights = _heights(routing, routing.routing.maxima)
    witness = audited.witness
    return Landscape(
        f"{audited.robot.name}: {audited.verdict.value}",
        tuple(_notes(routing)),
        tuple(
            Leaf(abs(heights[i]), int(np.sign(heights[i])), groups[i]) for i in order
        ),
        tuple(branches),
        joins,
        None if witness is None else witness.clearance,
        {} if witness is None else _ends(routing, order, witness.path),
        tuple(_slices(routing, None if witness is None else witness.path)),
    )


def _ends(
    routing: AspectRouting, order: Sequence[int], path: Array
) -> dict[str, Array]:
    """Where the ends of a path stand in the tree."""
    points = routing.on_torus(path[[0, -1]])
    leaves = [order.index(i) for i in routing.routing.vert(points)]
    levels = np.abs(_heights(routing, points))
    return dict(zip("AB", np.column_stack([leaves, levels]), strict=True))


def _heights(routing: AspectRouting, points: Array) -> Array:
    """Det J at points of the torus, over the largest |det J| found."""
    return np.asarray(routing.routing.function(points) / routing.routing.largest)


def _tree(routing: AspectRouting) -> tuple[list[int], list[Array], Array]:
    """The order of the maxima, the branches over it, and where they join."""
    merges = routing.routing.merges()
    order = {i: [i] for i in routing.routing.graph}
    for merge in merges:
        joined = order[min(merge.first)] + order[min(merge.second)]
        order |= dict.fromkeys(merge.first | merge.second, joined)
    flat = list(dict.fromkeys(i for i in sorted(order) for i in order[i]))
    tops = np.abs(_heights(routing, routing.routing.maxima))
    foot = {i: (float(flat.index(i)), float(tops[i])) for i in order}
    branches, joins = [], []
    for merge in merges:
        level = routing.clearance(merge.level)
        (x, top), (y, other) = foot[min(merge.first)], foot[min(merge.second)]
        branches.append(np.array([[x, top], [x, level], [y, level], [y, other]]))
        joins.append(((x + y) / 2, level))
        foot |= dict.fromkeys(merge.first | merge.second, joins[-1])
    roots = [[(x, 0.0), (x, top)] for x, top in sorted(set(foot.values()))]
    return flat, branches + [np.array(r) for r in roots], np.array(joins).reshape(-1, 2)


def _groups(routing: AspectRouting, order: Sequence[int]) -> list[list[int]]:
    """The groups of maxima that join above 0, in the order of the tree."""
    groups: dict[frozenset[int], list[int]] = {}
    merged = {i: frozenset([i]) for i in order}
    for merge in routing.routing.merges():
        both = merge.first | merge.second
        merged |= dict.fromkeys(both, both)
    for i in order:
        groups.setdefault(merged[i], []).append(i)
    return list(groups.values())


def _slices(routing: AspectRouting, path: Array | None) -> list[Slice]:
    """Planes of two joints, and with a path that of its ends and narrowest place."""
    last = len(routing.joints) - 1
    if path is None:
        tops = np.abs(_heights(routing, routing.routing.maxima))
        top, name = routing.routing.maxima[int(tops.argmax())], "M, a maximum"
        return [_of_joints(routing, i, top, name) for i in range(last)][:3]
    points = _dense(routing.on_torus(path))
    narrow = points[int(np.abs(_heights(routing, points)).argmin())]
    name = "N, the narrowest place"
    pairs = dict.fromkeys((0, last - 1))
    return [
        _of_ends(routing, {"A": points[0], "N": narrow, "B": points[-1]}, points),
        *(_of_joints(routing, i, narrow, name) for i in pairs),
    ]


def _dense(points: Array) -> Array:
    """The path with a point at every hundredth of a segment."""
    place = np.linspace(0, len(points) - 1, 100 * (len(points) - 1) + 1)
    return np.stack(
        [np.interp(place, range(len(points)), column) for column in points.T], axis=1
    )


def _of_joints(routing: AspectRouting, at: int, centre: Array, name: str) -> Slice:
    """The plane of two joints in a row, the others standing as at ``centre``."""
    pair = [at, at + 1]
    angles = (np.arange(_SIDE) + 0.5) * 2 * np.pi / _SIDE - np.pi
    points = np.tile(centre, (_SIDE, _SIDE, 1))
    points[..., at], points[..., at + 1] = np.meshgrid(angles, angles)
    joints = (routing.joints[k] for k in pair)
    first, second = (f"{_theta(k)}: joint {k + 1} (rad)" for k in joints)
    place = shortest_turn(centre[pair])
    window = (-np.pi, np.pi, -np.pi, np.pi)
    heights = _heights(routing, points)
    title = f"through {name}{_standing(routing, centre, pair)}"
    return Slice(title, (first, second), window, heights, {name[0]: place}, ())


def _of_ends(routing: AspectRouting, marks: dict[str, Array], path: Array) -> Slice:
    """The plane through both ends of the path and its narrowest place."""
    centre = marks["N"]
    frame = np.linalg.qr(np.stack([marks["A"] - centre, marks["B"] - centre], 1))[0]
    placed = {name: (point - centre) @ frame for name, point in marks.items()}
    flat = (path - centre) @ frame
    middle = (flat.max(axis=0) + flat.min(axis=0)) / 2
    reach = _MARGIN * float(np.ptp(flat, axis=0).max()) / 2
    low, high = middle - reach, middle + reach
    share = (np.arange(_SIDE)[:, None] + 0.5) / _SIDE
    x, y = np.meshgrid(*(low + share * (high - low)).T)
    points = centre + x[..., None] * frame[:, 0] + y[..., None] * frame[:, 1]
    window = (float(low[0]), float(high[0]), float(low[1]), float(high[1]))
    labels = ("from N along the line of A (rad)", "across it (rad)")
    heights = _heights(routing, points)
    title = f"through A, N and B{_standing(routing, centre)}"
    return Slice(title, labels, window, heights, placed, (flat,))


def _standing(routing: AspectRouting, at: Array, free: Sequence[int] = ()) -> str:
    """A line that says where the joints stand that the plane does not turn."""
    held = [
        f"{_theta(joint)} = {angle:.2f}".replace("-", "−")
        for k, (joint, angle) in enumerate(
            zip(routing.joints, shortest_turn(at), strict=True)
        )
        if k not in free
    ]
    of_mark = "" if free else "N: "
    return f"\n{of_mark}{', '.join(held)} rad" if held else ""


def _theta(joint: int) -> str:
    """The name of a joint's angle, joints counted from 0."""
    return f"θ{'₁₂₃₄₅₆'[joint]}"


def _notes(routing: AspectRouting) -> list[str]:
    groups = routing.routing.number_of_components
    found = (
        f"The tree is found by a search in floating point: {groups} groups of maxima"
    )
    if routing.aspects is None:
        return [f"{found}; the number of aspects is not proved."]
    proved = routing.aspects.count
    agree = "as many as" if proved == groups else f"but {proved} are"
    return [f"{found}, {agree} the aspects that are proved."]
