"""Connectivity in the graph of a roadmap (``GraphConnected``)."""

from __future__ import annotations

import networkx as nx

from cuspaudit.geometry.graph_isotop import RoadmapGraph, Vertex

__all__ = ["graph_connected"]


def graph_connected(graph: RoadmapGraph, first: Vertex, second: Vertex) -> bool:
    """Whether two vertices are connected; a vertex is connected to itself.

    [Paper, routine GraphConnected].
    """
    return bool(nx.has_path(graph.graph, first, second))
