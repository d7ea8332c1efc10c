"""The same routines for maps from a product of two circles or lines to the plane.

An arm of three joints is decided here, in milliseconds: fibers and roadmap come from
resultants in one variable. ``geometry`` has them for any variety and map.
"""

from cuspaudit.surface.atypical_values import atypical_values
from cuspaudit.surface.cusps import cusps
from cuspaudit.surface.graph_isotop import graph_isotop
from cuspaudit.surface.nodes import nodes
from cuspaudit.surface.roadmap import roadmap
from cuspaudit.surface.sample_points import sample_points

__all__ = [
    "atypical_values",
    "cusps",
    "graph_isotop",
    "nodes",
    "roadmap",
    "sample_points",
]
