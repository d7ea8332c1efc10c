"""Exact arithmetic over Q: rings, systems, elimination, real roots."""

from cuspaudit.algebra.one_dimensional import OneDimensionalParametrization
from cuspaudit.algebra.parametrization import (
    RealPoint,
    ZeroDimensionalParametrization,
)
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.algebra.union import union
from cuspaudit.algebra.univariate import RealRoot, Univariate, real_roots
from cuspaudit.algebra.zero_dimensional import solve_zero_dimensional

__all__ = [
    "OneDimensionalParametrization",
    "Polynomial",
    "PolynomialMap",
    "PolynomialSystem",
    "RealPoint",
    "RealRoot",
    "Ring",
    "Univariate",
    "ZeroDimensionalParametrization",
    "real_roots",
    "solve_zero_dimensional",
    "union",
]
