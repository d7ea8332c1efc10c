"""The points msolve finds, proved to be solutions; whether all is not claimed here.

msolve is asked for a parametrization (``-P 2``) of the system with one more variable,
last and equal to a linear form, which then is its parameter. It may still add a
variable ``A`` of its own, minus the linear form of the others that it prints. Its
conventions are x_i = -p_i(t) / (c_i w'(t)), w not monic.
The variables are renamed for it. Nothing of that is trusted: what is read must satisfy
the definition of a parametrization, and every equation must vanish modulo omega.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from flint import fmpq, fmpq_poly, fmpz, fmpz_poly

from cuspaudit.algebra.msolve import msolve_text, run_msolve
from cuspaudit.algebra.points.finite_algebra import linear_forms
from cuspaudit.algebra.points.parametrization import (
    ZeroDimensionalParametrization,
    empty_set,
)
from cuspaudit.algebra.points.union import restricted
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import InvalidSystemError, UnableError
from cuspaudit.runtime.clock import check_time

__all__ = ["msolve_points", "parse_parametrization"]

#: msolve takes another parameter when the form given to it does not separate
_FORMS = 3

_TOKEN = re.compile(r"'(\w+)'|(-?\d+)")


def msolve_points(
    ring: Ring,
    polynomials: Sequence[Polynomial],
    variables: Sequence[str],
    timeout: float,
    seed: int,
) -> ZeroDimensionalParametrization:
    """Common zeros of ``polynomials``, in the coordinates ``variables``.

    Args:
        ring: over Q.
        polynomials: the system, with finitely many zeros.
        variables: those to keep; they must separate the zeros.
        timeout: in s.
        seed: of msolve and of the linear form.

    Returns:
        A set of zeros (proved), perhaps not all of them, perhaps none: no ground.

    Raises:
        UnableError: msolve failed, or what it found does not solve the system.
    """
    names = tuple(f"x{i}" for i, _ in enumerate(ring.variables))
    own = dict(zip(ring.variables, names, strict=True))
    kept = tuple(own[x] for x in variables)
    larger = Ring([*names, "t"])
    system = [larger.context.from_dict(_with_zero(p)) for p in polynomials]
    for tried, form in enumerate(linear_forms(len(variables), seed), 1):
        terms = (w * larger.gen(x) for x, w in zip(kept, form, strict=True))
        parameter = larger.gen("t") - larger.total(terms)
        text = msolve_text(larger, [*system, parameter])
        found = parse_parametrization(run_msolve(text, ("-P", "2"), timeout, seed))
        if found is None:
            break
        weights = _weights(found, larger)
        if tried < _FORMS and any(weights[x] for x in kept):
            continue
        check_solves(found, larger, system)
        own_weights = zip(kept, form, strict=True)
        read = tuple(weights[x] + weights["t"] * w for x, w in own_weights)
        points = restricted(found, kept, read, seed)
        return replace(points, variables=tuple(variables))
    return empty_set(variables)


def _weights(found: ZeroDimensionalParametrization, ring: Ring) -> dict[str, fmpq]:
    """The coefficients of the parameter, one for every variable."""
    if not set(ring.variables) <= set(found.variables):
        raise UnableError("msolve", "its parametrization lacks a variable")
    return dict(zip(found.variables, found.form, strict=True))


def _with_zero(polynomial: Polynomial) -> dict[tuple[int, ...], fmpq]:
    check_time("msolve")
    return {(*e, 0): c for e, c in polynomial.to_dict().items()}


def check_solves(
    found: ZeroDimensionalParametrization,
    ring: Ring,
    polynomials: Sequence[Polynomial],
) -> None:
    """Nothing, when every polynomial vanishes at every point of ``found``.

    Raises:
        UnableError: one does not: msolve's answer is wrong.
    """
    for numerator, _ in found.numerators(ring, polynomials):
        if numerator != 0:
            raise UnableError("msolve", "its parametrization does not solve the system")


def parse_parametrization(answer: str) -> ZeroDimensionalParametrization | None:
    """What msolve printed under ``-P 2``, the last variable being the parameter.

    Returns:
        A parametrization in all the variables printed, or None for ``[-1]``, which
        claims that there is no solution.

    >>> found = parse_parametrization(
    ...     "[0, [0, 2, 2, ['x', 'y'], [0, 1], "
    ...     "[1, [[2, [-9, 0, 1]], [1, [0, 2]], [[[1, [24, 0]], 1]]]]]]:"
    ... )
    >>> found.variables, found.omega, found.coordinates
    (('x', 'y'), x^2 + (-9), ((-4/3)*x, x))

    Raises:
        UnableError: it reports infinitely many solutions, or is unreadable, or is no
            parametrization.
    """
    unreadable = UnableError("msolve", f"unreadable answer {answer[:60]!r}")
    quoted = _TOKEN.sub(lambda match: f'"{match[1] or match[2]}"', answer)
    try:
        parsed = json.loads(quoted.strip().removesuffix(":"))
        if parsed == ["-1"]:
            return None
        if parsed[0] != "0":
            raise UnableError("msolve", "it finds infinitely many solutions")
        return _from_lists(parsed[1])
    except (ValueError, LookupError, TypeError, ZeroDivisionError) as error:
        raise unreadable from error
    except InvalidSystemError as error:
        raise UnableError("msolve", f"its answer is wrong: {error.found}") from error


def _from_lists(body: list[Any]) -> ZeroDimensionalParametrization:
    _, _, _, names, weights, (_, (omega, _, numerators)) = body
    polynomial = _polynomial(omega)
    lead = polynomial[polynomial.degree()]
    monic = polynomial / lead
    rho = [-_polynomial(p) / (fmpq(fmpz(c)) * lead) for p, c in numerators]
    last = fmpq_poly([0, 1]) * monic.derivative() % monic
    form = (fmpq(0),) * len(rho) + (fmpq(1),)
    if names[-1] == "A":
        form = (*(fmpq(-fmpz(w)) for w in weights[:-1]), fmpq(0))
    return ZeroDimensionalParametrization(tuple(names), monic, (*rho, last), form)


def _polynomial(lists: list[Any]) -> fmpq_poly:
    return fmpq_poly(fmpz_poly([fmpz(c) for c in lists[1]]))
