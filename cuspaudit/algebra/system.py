"""Varieties and maps: the input (f, R) of the paper."""

from __future__ import annotations

from dataclasses import dataclass

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
    """The map R = (r_1, ..., r_d) on R^n.

    Attributes:
        ring: K[x_1..x_n].
        components: r_1..r_d.
    """

    ring: Ring
    components: tuple[Polynomial, ...]
