"""Tiles of pairs, against the postures of sample values."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from flint import ctx
from surfaces import arm_map, decided

from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.surface_decision import oriented
from cuspaudit.errors import UnableError
from cuspaudit.surface.pair_tiles import PairTiles
from cuspaudit.surface.value_waves import value_waves

Map = tuple[PolynomialSystem, PolynomialMap]
ARMS = {
    "orthogonal": arm_map((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)),
    "general": arm_map((1, 2, "3/2"), (0, 1, "1/3"), (70, 40, 0)),
    "walls": arm_map((1, 3, 4), (0, 3, 0), (-90, 90, 0)),
}


def tiles_of(pair: Map) -> tuple[PairTiles, int]:
    """The tiles, and the sign of Delta / g."""
    surface, delta = oriented(*pair)
    waves = value_waves(surface, pair[1], delta)
    assert waves is not None
    return PairTiles.of(waves), waves.sign


@pytest.mark.parametrize("depth", [5, 8, 13])
@pytest.mark.parametrize("name", ARMS)
def test_no_pair_is_lost(name: str, depth: int) -> None:
    """The tile of two postures of one value has the sign that both have."""
    decision = decided(ARMS[name])
    tiles, turned = tiles_of(ARMS[name])
    unit, seen = 2 * np.pi / 2**depth, 0
    names = decision.surface.base.names
    for fiber in decision.samples:
        for pair in combinations(fiber.postures, 2):
            signs = {decision.graph.placed[p][1] * turned for p in pair}
            at = [p.coordinates(ctx.prec) for p in pair]
            t, w = (np.arctan2(*(float(p[n].mid()) for n in names[::-1])) for p in at)
            m, h = (t + w) / 2, (w - t) / 2 % np.pi
            if h > np.pi / 2:
                m, h = m + np.pi, np.pi - h
            tile = np.array([[m % (2 * np.pi) // unit, h // unit]]).astype(np.int64)
            common = tiles.common(depth, tile)
            seen += len(signs) == 1
            if 1 in signs and len(signs) == 1:
                assert common.plus[0]
            if -1 in signs and len(signs) == 1:
                assert common.minus[0]
    assert seen > 10


@pytest.mark.parametrize("name", ARMS)
def test_a_tile_has_what_its_quarters_have(name: str) -> None:
    """A sign that is common somewhere in a quarter is common in the tile."""
    tiles, _ = tiles_of(ARMS[name])
    grid = np.stack(np.meshgrid(np.arange(64), np.arange(16), indexing="ij"), -1)
    tile = grid.reshape(-1, 2)
    coarse = tiles.common(6, tile)
    for step in ((0, 0), (0, 1), (1, 0), (1, 1)):
        fine = tiles.common(7, 2 * tile + step)
        for own, quarter in zip(coarse, fine, strict=True):
            assert not (quarter & ~own).any()
            assert not own.all()


def test_an_arm_that_is_its_mirror_image_is_refused() -> None:
    """Without the offsets of axes 2 and 3 circles are equal two by two."""
    with pytest.raises(UnableError, match="equal two by two"):
        tiles_of(arm_map((1, 2, "3/2"), (0, 0, 0), (-90, 90, 0)))
