"""The routines of the paper, one file each; nothing here knows a robot."""

from cuspaudit.geometry.assumption_a import check_assumption_a
from cuspaudit.geometry.atypical_values import atypical_values
from cuspaudit.geometry.cells.open_cells import open_cells
from cuspaudit.geometry.crit import crit
from cuspaudit.geometry.curves.parametrization import one_dimensional_parametrization
from cuspaudit.geometry.fibers.generic_fiber import generic_fiber
from cuspaudit.geometry.graph_connected import graph_connected
from cuspaudit.geometry.graph_isotop import graph_isotop
from cuspaudit.geometry.heights.proved_path import prove_path
from cuspaudit.geometry.lifts.continuation import continue_point
from cuspaudit.geometry.roadmap import roadmap
from cuspaudit.geometry.routing import routing
from cuspaudit.geometry.sample_points import sample_points
from cuspaudit.geometry.sample_points_rational import sample_points_rational

__all__ = [
    "atypical_values",
    "check_assumption_a",
    "continue_point",
    "crit",
    "generic_fiber",
    "graph_connected",
    "graph_isotop",
    "one_dimensional_parametrization",
    "open_cells",
    "prove_path",
    "roadmap",
    "routing",
    "sample_points",
    "sample_points_rational",
]
