from __future__ import annotations

from itertools import product

import networkx as nx
from surfaces import arm_map, decided

from cuspaudit.geometry.graph_connected import graph_connected
from cuspaudit.surface.graph_isotop import Vertex


def test_connection_is_being_in_one_aspect() -> None:
    """Two vertices are connected exactly when their aspects have one number."""
    graph = decided(arm_map((1, 3, 4), (0, 3, 0), (-90, 90, 0))).graph
    edges: nx.Graph[Vertex] = nx.Graph(
        {vertex: list(others) for vertex, others in graph.neighbors.items()}
    )
    assert len(edges) > 4
    for first, second in product(edges, repeat=2):
        together = graph.aspects[first] == graph.aspects[second]
        assert graph_connected(edges, first, second) == together
