"""Connectivity in the graph of a roadmap (``GraphConnected``)."""

from __future__ import annotations

from typing import TypeVar

import networkx as nx

__all__ = ["graph_connected"]

V = TypeVar("V")


def graph_connected(graph: nx.Graph[V], first: V, second: V) -> bool:
    """Whether two vertices are connected; a vertex is connected to itself.

    [Paper, routine GraphConnected].
    """
    return bool(nx.has_path(graph, first, second))
