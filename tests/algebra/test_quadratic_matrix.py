from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq, fmpq_poly

from cuspaudit.algebra.quadratic_matrix import QuadraticField


def elements(radicand: int | None, seed: int) -> np.ndarray:
    """A (3, 3) array of elements a + b sqrt m, or of rationals."""
    rng, result = np.random.default_rng(seed), np.empty((3, 3), dtype=object)
    for i, j in np.ndindex(3, 3):
        a, b = (fmpq(int(x), 7) for x in rng.integers(-20, 20, 2))
        result[i, j] = a if radicand is None else fmpq_poly([a, b])
    return result


@pytest.mark.parametrize("radicand", [None, 2, 3])
def test_products_and_inverses_are_those_of_the_elements(radicand: int | None) -> None:
    """Through FLINT's matrices over Q and back: A B and A^-1 A."""
    field = QuadraticField(radicand)
    a, b = (elements(radicand, seed) for seed in (1, 2))
    product = field.array(field.matrix(a) * field.matrix(b))
    assert (field.reduced(a @ b) == product).all()
    inverse = field.array(field.matrix(a).inv())
    assert (field.reduced(inverse @ a) == np.eye(3, dtype=int)).all()


@pytest.mark.parametrize("radicand", [2, 3])
def test_the_determinant_is_the_norm(radicand: int) -> None:
    """Det of the larger matrix = N(det), N(x + y sqrt m) = x^2 - m y^2."""
    field, a = QuadraticField(radicand), elements(radicand, 3)
    cross = [a[1, i] * a[2, j] - a[1, j] * a[2, i] for i, j in ((1, 2), (2, 0), (0, 1))]
    (det,) = field.reduced(_objects([sum(a[0] * _objects(cross), fmpq_poly([0]))]))
    norm = det[0] * det[0] - radicand * det[1] * det[1]
    assert field.matrix(a).det() == norm
    surd = field.surd_matrix(3)
    assert surd * surd == field.matrix(np.eye(3, dtype=object)) * radicand


def _objects(entries: list[fmpq_poly]) -> np.ndarray:
    result = np.empty(len(entries), dtype=object)
    result[:] = entries
    return result
