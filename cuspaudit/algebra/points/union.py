"""Unions of zero-dimensional parametrizations, and changes of their forms."""

from __future__ import annotations

from collections.abc import Iterator

from flint import fmpq, fmpq_mat, fmpq_poly

from cuspaudit.algebra.points.finite_algebra import (
    FiniteAlgebra,
    linear_forms,
    parametrize,
)
from cuspaudit.algebra.points.parametrization import ZeroDimensionalParametrization
from cuspaudit.errors import InvalidSystemError, UnableError

__all__ = ["restricted", "union", "with_form"]

Form = tuple[fmpq, ...]

_MOST_POINTS = 30


def union(
    first: ZeroDimensionalParametrization,
    second: ZeroDimensionalParametrization,
    seed: int = 1,
) -> ZeroDimensionalParametrization:
    """A parametrization of Z(first) ∪ Z(second), common points once.

    [Paper, routine Union; Safey El Din, Schost 2017, lemma J.3]. Both sets are written
    with one form that separates each; where their omegas have a common factor the
    coordinates must agree, or the form does not separate the union and another is
    tried: that of the first set, of the second, then random ones from ``seed``.

    Args:
        first: points in C^n.
        second: points in the same C^n.
        seed: of the forms.

    Returns:
        The union, on the grounds of both.

    Raises:
        InvalidSystemError: the variables differ.
    """
    if first.variables != second.variables:
        raise InvalidSystemError(
            file="union",
            found=f"variables {first.variables} and {second.variables}",
            expected="points of one space",
        )
    for form in _forms(first, second, seed):
        sides = with_form(first, form), with_form(second, form)
        if sides[0] is not None and sides[1] is not None:
            joined = _joined(sides[0], sides[1], form)
            if joined is not None:
                return joined
    raise AssertionError("there is no end of linear forms")


def with_form(
    parametrization: ZeroDimensionalParametrization, form: Form
) -> ZeroDimensionalParametrization | None:
    """The same points with parameter ``form``, None when it does not separate them."""
    if form == parametrization.form or parametrization.degree == 0:
        return parametrization
    return parametrize(_algebra(parametrization), form, parametrization.grounds)


def restricted(
    parametrization: ZeroDimensionalParametrization,
    variables: tuple[str, ...],
    form: Form,
    seed: int = 1,
) -> ZeroDimensionalParametrization:
    """The projection of the points to ``variables``, which must be one to one.

    Args:
        parametrization: points in more variables.
        variables: the coordinates to keep, in the order wanted.
        form: used when it is the parameter already; otherwise one from ``seed`` is.
        seed: of the forms.

    Raises:
        UnableError: another form is needed for too many points.
    """
    own = dict(zip(parametrization.variables, parametrization.rho, strict=True))
    rho = tuple(own[name] for name in variables)
    try:
        return ZeroDimensionalParametrization(
            variables, parametrization.omega, rho, form, parametrization.grounds
        )
    except InvalidSystemError:
        if parametrization.degree > _MOST_POINTS:
            raise UnableError(
                "restricted", f"{parametrization.degree} points need another form"
            ) from None
        algebra = _algebra(parametrization)
        chosen = dict(zip(algebra.variables, algebra.matrices, strict=True))
        matrices = tuple(chosen[name] for name in variables)
        smaller = FiniteAlgebra(variables, matrices, algebra.one)
        forms = linear_forms(len(variables), seed)
        found = (parametrize(smaller, f, parametrization.grounds) for f in forms)
        return next(each for each in found if each is not None)


def _forms(
    first: ZeroDimensionalParametrization,
    second: ZeroDimensionalParametrization,
    seed: int,
) -> Iterator[Form]:
    yield first.form
    yield second.form
    yield from linear_forms(len(first.variables), seed)


def _joined(
    first: ZeroDimensionalParametrization,
    second: ZeroDimensionalParametrization,
    form: Form,
) -> ZeroDimensionalParametrization | None:
    """The union for a form of both; None when it takes one value at two points."""
    common = first.omega.gcd(second.omega)
    pairs = list(zip(first.coordinates, second.coordinates, strict=True))
    if any((x - y) % common != 0 for x, y in pairs):
        return None
    added = second.omega // common
    omega = first.omega * added
    slope = omega.derivative()
    unit = first.omega.xgcd(added)[1] * first.omega
    rho = tuple((x + (y - x) * unit) % omega * slope % omega for x, y in pairs)
    grounds = tuple(dict.fromkeys((*first.grounds, *second.grounds)))
    return ZeroDimensionalParametrization(first.variables, omega, rho, form, grounds)


def _algebra(parametrization: ZeroDimensionalParametrization) -> FiniteAlgebra:
    """Q[t]/omega with the multiplications by the coordinates."""
    size, omega = parametrization.degree, parametrization.omega
    matrices = tuple(_multiplication(x, omega) for x in parametrization.coordinates)
    one = fmpq_mat(size, 1, [1] + [0] * (size - 1))
    return FiniteAlgebra(parametrization.variables, matrices, one)


def _multiplication(factor: fmpq_poly, omega: fmpq_poly) -> fmpq_mat:
    """The matrix of multiplication by ``factor`` in Q[t]/omega."""
    size = int(omega.degree())
    image, columns = factor % omega, []
    for _ in range(size):
        columns.append([image[i] for i in range(size)])
        image = image * fmpq_poly([0, 1]) % omega
    return fmpq_mat(columns).transpose()
