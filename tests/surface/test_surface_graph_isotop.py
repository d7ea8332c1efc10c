from __future__ import annotations

import sys

import pytest
from flint import arb
from surfaces import arm_map, decided, plane

from cuspaudit.errors import PrecisionError
from cuspaudit.surface.graph_isotop import graph_isotop


def test_every_query_point_is_placed_with_its_sign() -> None:
    """A posture's vertex has the sign of Delta there, and a strip that it lies in."""
    decision = decided(arm_map((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))
    numerator, _ = decision.surface.chart(decision.delta)
    for fiber in decision.samples:
        for posture, (strip, sign) in zip(
            fiber.postures, decision.graph.vert(fiber), strict=True
        ):
            assert sign == posture.sign(numerator)
            assert sign in decision.roadmap.strips[strip].signs


def test_aspects_have_one_sign_each() -> None:
    """No component of the graph holds vertices of both signs."""
    graph = decided(arm_map((1, 3, 4), (0, 3, 0), (-90, 90, 0))).graph
    signs: dict[int, set[int]] = {}
    for (_, sign), number in graph.aspects.items():
        signs.setdefault(number, set()).add(sign)
    assert all(len(found) == 1 for found in signs.values())
    assert len(signs) == graph.number_of_aspects == 5


def test_turns_are_odd() -> None:
    """The way back crosses the point without chart the other way."""
    decision = decided(arm_map((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0)))
    for couple in decision.couples:
        first, second = couple.postures
        assert decision.graph.turns(first, second) == -decision.graph.turns(
            second, first
        )
        assert decision.graph.aspect(first) == decision.graph.aspect(second)


def test_a_posture_over_a_zero_is_not_placed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A posture exactly over a zero of D is told from no strip."""
    module = sys.modules[graph_isotop.__module__]
    monkeypatch.setattr(module, "PRECISIONS", (64, 128))
    # det J = 2 x (y - 1): D vanishes at y = 1, over which (2, 1) has two postures
    decision = decided(plane(lambda x, y: (x**2 + y, (y - 1) ** 2)))
    fibers = decision.fibers
    assert fibers.surface.base.names in (("x",), ("y",))
    zero = decision.roadmap.critical[0]
    at = arb(float(zero))
    assert decision.roadmap.strip_of(at, 64) is None
    posture = next(p for f in decision.samples for p in f.postures)
    monkeypatch.setattr(posture, "chart", lambda bits: (arb(1), at))
    with pytest.raises(PrecisionError, match="strip"):
        graph_isotop(decision.roadmap, decision.delta, [posture])


def test_a_wide_posture_is_asked_for_more_bits() -> None:
    """When a chart is not enclosed with few bits, more are tried."""
    decision = decided(plane(lambda x, y: (x**2, y)))
    posture = decision.samples[-1].postures[0]
    chart = posture.chart
    asked = []

    def shy(bits: int) -> tuple[arb, arb]:
        asked.append(bits)
        if bits < 256:
            raise PrecisionError("test", bits)
        return chart(bits)

    posture.chart = shy  # type: ignore[method-assign]
    graph = graph_isotop(decision.roadmap, decision.delta, [posture])
    assert graph.placed[posture] == decision.graph.placed[posture]
    assert max(asked) == 256
