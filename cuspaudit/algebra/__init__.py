"""Exact arithmetic over Q: rings, systems, elimination, real roots."""

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.algebra.univariate import RealRoot, Univariate, real_roots

__all__ = [
    "Polynomial",
    "PolynomialMap",
    "PolynomialSystem",
    "RealRoot",
    "Ring",
    "Univariate",
    "real_roots",
]
