from __future__ import annotations

from itertools import product

from surfaces import arm_map, decided

from cuspaudit.geometry.graph_connected import graph_connected


def test_connection_is_being_in_one_aspect() -> None:
    """Two vertices are connected exactly when their aspects have one number."""
    graph = decided(arm_map((1, 3, 4), (0, 3, 0), (-90, 90, 0))).graph
    for first, second in product(graph.graph, repeat=2):
        together = graph.aspects[first] == graph.aspects[second]
        assert graph_connected(graph.graph, first, second) == together
