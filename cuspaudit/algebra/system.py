"""Varieties and maps: the input (f, R) of the paper."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring

__all__ = ["PolynomialMap", "PolynomialSystem"]


@dataclass(frozen=True, eq=False)
class PolynomialSystem:
    """The variety V = {f_1 = ... = f_s = 0} in R^n.

    Attributes:
        ring: K[x_1..x_n].
        equations: f_1..f_s; empty for V = R^n.
    """

    ring: Ring
    equations: tuple[Polynomial, ...] = ()

    @property
    def dimension(self) -> int:
        """The dimension n - s of V when f is a complete intersection (not checked)."""
        return len(self.ring.variables) - len(self.equations)


@dataclass(frozen=True, eq=False)
class PolynomialMap:
    """The map R = (r_1, ..., r_k, angles) on R^n, into R^k times circles.

    Attributes:
        ring: K[x_1..x_n].
        components: r_1..r_k.
        angles: pairs (c, s) with c^2 + s^2 = 1 on V, each a map into the circle.
    """

    ring: Ring
    components: tuple[Polynomial, ...]
    angles: tuple[tuple[Polynomial, Polynomial], ...] = ()

    @property
    def dimension(self) -> int:
        """The dimension d of the values; an angle counts as one."""
        return len(self.components) + len(self.angles)

    @property
    def functions(self) -> tuple[Polynomial, ...]:
        """The components, then c and s of every angle: they tell values apart."""
        return (*self.components, *(p for pair in self.angles for p in pair))

    def over(self, value: Sequence[fmpq]) -> tuple[Polynomial, ...]:
        """The equations R(x) = q, given the values of ``functions``."""
        pairs = zip(self.functions, value, strict=True)
        return tuple(p - q for p, q in pairs)
