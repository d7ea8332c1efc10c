"""Variables that a system gives as polynomials in the others.

An equation a x + p = 0, a != 0 in Q and p without x, says x = -p / a. Put into the
others, it leaves a system in one variable less, whose zeros are those of the whole
one with x left out, each once. This is done where it makes nothing longer: x stands in
no other equation, or p has degree 1 at most.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from flint import fmpq

from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.algebra.ring import Polynomial, Ring

__all__ = ["Independent", "without_dependents"]


@dataclass(frozen=True, eq=False)
class Independent:
    """A system in fewer variables.

    Attributes:
        whole: the ring of the whole system.
        ring: that of the variables left.
        equations: the equations left, in ``ring``.
        values: the variables left out, the last first, each with its value: in the
            variables left and in those before it here.
    """

    whole: Ring
    ring: Ring
    equations: tuple[Polynomial, ...]
    values: tuple[tuple[str, Polynomial], ...]

    def lifted(
        self, points: ZeroDimensionalParametrization
    ) -> ZeroDimensionalParametrization:
        """The zeros of the whole system over those of this one."""
        rho = dict(zip(points.variables, points.rho, strict=True))
        form = dict(zip(points.variables, points.form, strict=True))
        for name, value in self.values:
            names = [x for x in self.whole.variables if x in rho]
            known = replace(
                points,
                variables=tuple(names),
                rho=tuple(rho[x] for x in names),
                form=tuple(form[x] for x in names),
            )
            own = Ring(names)
            ((above, degree),) = known.numerators(
                own, [own.from_other(value, self.whole)]
            )
            # the value is N / omega'^e; rho is omega' times it
            for _ in range(degree - 1):
                above = above * points.inverse_slope % points.omega
            if degree == 0:
                above = above * points.slope % points.omega
            rho[name], form[name] = above, fmpq(0)
        variables = self.whole.variables
        return replace(
            points,
            variables=variables,
            rho=tuple(rho[x] for x in variables),
            form=tuple(form[x] for x in variables),
        )


def without_dependents(
    ring: Ring, equations: Sequence[Polynomial]
) -> Independent | None:
    """The system without dependent variables; None where there are none.

    At least one variable is left.

    >>> ring = Ring(["x", "y"])
    >>> x, y = ring.gens
    >>> found = without_dependents(ring, [2 * x - y**2, y**3 - 1])
    >>> found.equations, found.values
    ((y^3 - 1,), (('x', 1/2*y^2),))
    """
    left, rest = list(ring.variables), [p for p in equations if p != 0]
    values: list[tuple[str, Polynomial]] = []
    while len(left) > 1:
        step = _dependent(ring, rest)
        if step is None:
            break
        name, value, source = step
        others = (p for p in rest if p is not source)
        images = [value if x == name else ring.gen(x) for x in ring.variables]
        rest = [q for p in others if (q := _put(p, name, images)) != 0]
        left.remove(name)
        values.insert(0, (name, value))
    if not values:
        return None
    smaller = Ring(left)
    own = tuple(smaller.from_other(p, ring) for p in rest)
    return Independent(ring, smaller, own, tuple(values))


def _put(p: Polynomial, name: str, images: list[Polynomial]) -> Polynomial:
    return p if p.derivative(name) == 0 else p.compose(*images)


def _dependent(
    ring: Ring, equations: Sequence[Polynomial]
) -> tuple[str, Polynomial, Polynomial] | None:
    """A variable, its value, and the equation that says so."""
    for p in equations:
        for name in ring.variables:
            slope = p.derivative(name)
            if slope == 0 or not slope.is_constant():
                continue
            rest = p - slope * ring.gen(name)
            elsewhere = any(q.derivative(name) != 0 for q in equations if q is not p)
            if elsewhere and rest.total_degree() > 1:
                continue
            return name, -rest / slope.leading_coefficient(), p
    return None
