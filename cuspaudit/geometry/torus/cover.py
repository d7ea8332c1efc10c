"""Components of a superlevel set on a torus, counted by a cover with boxes.

Let h = P c + Q s + S on circle x B, B = T^k. Over y in B the largest value of h is
f = S + sqrt(P^2 + Q^2), and {h > 0} lies over it in one arc or the whole circle. As in
``geometry.torus.components``, {h > 0} has as many components as {f > 0} in B.

B is covered by closed boxes. A box is *inside* if f > 0 on it, *outside* if f < 0, and
*open* else.

Theorem. Let no open box contain a local maximum of f with f > 0. Then {f > 0} has at
most as many components as the inside boxes, joined at faces, have components that may
hold a local maximum; and at least as many as there are components, with an inside box
in them, of the inside and open boxes together.
Proof. A component of {f > 0} holds a maximum of f over its closure, which lies in an
inside box; boxes that share a face lie in one component. And a path in {f > 0} meets no
outside box; where it passes an edge or a corner, all boxes round that point are inside
or open, and are joined by faces.

Open boxes are halved until both numbers agree. With S - level for S the same counts
{h > level}. It fails where two components touch in a point.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from cuspaudit.errors import UnableError
from cuspaudit.geometry.torus.box_waves import BoxWaves
from cuspaudit.geometry.torus.boxes import Boxes
from cuspaudit.runtime.clock import check_time

__all__ = ["TorusCover", "cover_count"]

Whole = NDArray[np.int64]
Truths = NDArray[np.bool_]

_FIRST_DEPTH = 3
_LAST_DEPTH = 12
_CHUNK = 20_000


@dataclass(frozen=True)
class TorusCover:
    """A proved count.

    Attributes:
        components: of {f > 0}.
        boxes: how many inside and open boxes proved it.
        depth: the smallest boxes have edges of 2 pi / 2^depth.
    """

    components: int
    boxes: int
    depth: int


@dataclass(frozen=True, eq=False)
class _Layer:
    """Boxes of one size that are not outside.

    Attributes:
        depth: edges are 2 pi / 2^depth.
        corner: (m, k) numbers of the lowest corners.
        inside: (m,) whether inside, or open.
        smooth: (m,) whether open and without a local maximum.
    """

    depth: int
    corner: Whole
    inside: Truths
    smooth: Truths

    def only(self, chosen: Truths) -> _Layer:
        """The chosen boxes."""
        return _Layer(
            self.depth, self.corner[chosen], self.inside[chosen], self.smooth[chosen]
        )

    def plus(self, other: _Layer) -> _Layer:
        """These boxes and those of another layer of the same depth."""
        return _Layer(
            self.depth,
            np.concatenate([self.corner, other.corner]),
            np.concatenate([self.inside, other.inside]),
            np.concatenate([self.smooth, other.smooth]),
        )


def cover_count(waves: BoxWaves, timeout: float = 60.0) -> TorusCover:
    """The number of components of {S + sqrt(P^2 + Q^2) > 0} on T^k.

    Args:
        waves: P, Q and S on T^k.
        timeout: in seconds of processor time.

    Raises:
        UnableError: not settled in time, or by boxes of 2 pi / 2^12.
    """
    end = time.process_time() + timeout
    grid = _grid(waves.dimension, _FIRST_DEPTH)
    layers = [_classified(waves, _FIRST_DEPTH, grid)]
    while len(layers) <= _LAST_DEPTH - _FIRST_DEPTH:
        split = [~layer.inside & ~layer.smooth for layer in layers]
        if not any(part.any() for part in split):
            upper = _at_most(waves, layers)
            if upper <= 1 or upper == _at_least(layers):
                boxes = sum(len(layer.corner) for layer in layers)
                return TorusCover(upper, boxes, layers[-1].depth)
            split = _between(layers)
        check_time("cover_count")
        if time.process_time() > end:
            raise UnableError("cover_count", f"not settled in {timeout:g} s")
        layers = _refined(waves, layers, split)
    raise UnableError("cover_count", f"not settled by boxes of 2 pi / 2^{_LAST_DEPTH}")


def _grid(dimension: int, depth: int) -> Whole:
    axes = [np.arange(1 << depth)] * dimension
    return np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, dimension)


def _between(layers: list[_Layer]) -> list[Truths]:
    """The open boxes halfway between inside boxes that are not joined.

    Every open box belongs to the nearest component of inside boxes, by faces; those
    that touch a box of another one are chosen.
    """
    inside = np.concatenate([layer.inside for layer in layers])
    node = np.arange(len(inside))
    own = np.flatnonzero(inside)
    parts = _components([layer.only(layer.inside) for layer in layers])
    for part in parts:
        node[own[part]] = own[part[0]]
    graph: nx.Graph[int] = nx.Graph()
    for first, second in _faces(layers):
        edges = zip(node[first].tolist(), node[second].tolist(), strict=True)
        graph.add_edges_from(edges)
    cell = np.full(len(inside), -1)
    centers = {int(own[part[0]]) for part in parts}
    for center, members in nx.voronoi_cells(graph, centers).items():
        cell[list(members)] = center if center in centers else -1
    touching = np.zeros(len(inside), dtype=bool)
    for first, second in _faces(layers):
        apart = cell[node[first]] != cell[node[second]]
        touching[first[apart]] = touching[second[apart]] = True
    ends = np.cumsum([len(layer.corner) for layer in layers])
    return [part for part in np.split(touching & ~inside, ends[:-1])]


def _refined(
    waves: BoxWaves, layers: list[_Layer], split: list[Truths]
) -> list[_Layer]:
    """The layers with the boxes to be split halved along every axis."""
    result = [layer.only(~chosen) for layer, chosen in zip(layers, split, strict=True)]
    for i, (layer, chosen) in enumerate(zip(layers, split, strict=True)):
        if chosen.any():
            step = _grid(waves.dimension, 1)
            halves = (2 * layer.corner[chosen][:, None] + step).reshape(
                -1, step.shape[1]
            )
            more = _classified(waves, layer.depth + 1, halves)
            if i + 1 == len(result):
                result.append(more)
            else:
                result[i + 1] = result[i + 1].plus(more)
    return result


def _classified(waves: BoxWaves, depth: int, corner: Whole) -> _Layer:
    """The boxes that are not outside."""
    found = None
    for i in range(0, len(corner), _CHUNK):
        boxes = Boxes.at(waves, depth, corner[i : i + _CHUNK])
        inside, outside = boxes.inside(), boxes.outside()
        smooth = ~inside & ~outside
        smooth[smooth] = boxes.only(smooth).no_maximum()
        layer = _Layer(depth, corner[i : i + _CHUNK], inside, smooth).only(~outside)
        found = layer if found is None else found.plus(layer)
    assert found is not None, "there is a box"
    return found


def _at_least(layers: list[_Layer]) -> int:
    """Components of all boxes with an inside box in them."""
    inside = np.concatenate([layer.inside for layer in layers])
    return sum(bool(inside[part].any()) for part in _components(layers))


def _at_most(waves: BoxWaves, layers: list[_Layer]) -> int:
    """Components of the inside boxes; the small ones only if one may hold a maximum."""
    layers = [layer.only(layer.inside) for layer in layers]
    parts = sorted(_components(layers), key=len)
    start = np.cumsum([0, *(len(layer.corner) for layer in layers)])
    count = len(parts)
    for part in parts[:-1]:
        rows = [part[(part >= a) & (part < b)] - a for a, b in pairwise(start)]
        count -= all(
            Boxes.at(waves, layer.depth, layer.corner[own]).no_maximum().all()
            for layer, own in zip(layers, rows, strict=True)
        )
    return count


def _components(layers: list[_Layer]) -> list[Whole]:
    """The boxes, numbered through all layers, in groups joined at faces."""
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(range(sum(len(layer.corner) for layer in layers)))
    for first, second in _faces(layers):
        graph.add_edges_from(zip(first.tolist(), second.tolist(), strict=True))
    return [np.array(sorted(part)) for part in nx.connected_components(graph)]


def _faces(layers: list[_Layer]) -> Iterator[tuple[Whole, Whole]]:
    """Pairs of boxes that share a face, found from the smaller one."""
    start = np.cumsum([0, *(len(layer.corner) for layer in layers)])
    index = [_Index.of(layer) for layer in layers]
    for i, layer in enumerate(layers):
        for axis in range(layer.corner.shape[1]):
            for step in (-1, 1):
                beside = layer.corner.copy()
                beside[:, axis] = (beside[:, axis] + step) % (1 << layer.depth)
                # of two boxes of one size, one finds the other
                for j in range(i + (step > 0)):
                    coarse = beside >> (layer.depth - layers[j].depth)
                    own, other = index[j].find(coarse)
                    yield own + start[i], other + start[j]


@dataclass(frozen=True, eq=False)
class _Index:
    """The boxes of a layer by the number of their corner."""

    depth: int
    keys: Whole
    order: Whole

    @classmethod
    def of(cls, layer: _Layer) -> _Index:
        keys = cls._key(layer.corner, layer.depth)
        order = np.argsort(keys)
        return cls(layer.depth, keys[order], order)

    def find(self, corner: Whole) -> tuple[Whole, Whole]:
        """Which corners are those of boxes here, and of which."""
        if not len(self.keys):
            return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
        wanted = self._key(corner, self.depth)
        at = np.minimum(np.searchsorted(self.keys, wanted), len(self.keys) - 1)
        hit = np.flatnonzero(self.keys[at] == wanted)
        return hit, self.order[at[hit]]

    @staticmethod
    def _key(corner: Whole, depth: int) -> Whole:
        return np.asarray(corner @ (1 << (depth * np.arange(corner.shape[1]))))
