from __future__ import annotations

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from cuspaudit.algebra.matrix import determinant, jacobian
from cuspaudit.algebra.ring import Ring


@given(
    st.lists(
        st.lists(st.integers(-4, 4), min_size=4, max_size=4), min_size=4, max_size=4
    )
)
def test_determinants_are_sympy_s(rows: list[list[int]]) -> None:
    """Laplace expansion gives the determinant."""
    ring = Ring(["x"])
    found = determinant(ring, [[ring.constant(v) for v in row] for row in rows])
    assert found == int(sympy.Matrix(rows).det())


@pytest.mark.parametrize("radicand", [None, 2])
def test_a_determinant_multiplies(radicand: int | None) -> None:
    """The determinant of a product is the product, reduced in the field."""
    ring = Ring(["x", "y"], radicand)
    x, y = ring.gens
    r = ring.surd if radicand else ring.constant(7)
    A, B = [[x, r], [y + 1, x * y]], [[r, y], [x - r, ring.constant(2)]]
    AB = [
        [ring.total(A[i][k] * B[k][j] for k in range(2)) for j in range(2)]
        for i in range(2)
    ]
    product = ring.reduce(determinant(ring, A) * determinant(ring, B))
    assert determinant(ring, AB) == product


def test_the_empty_determinant_is_one() -> None:
    """No rows, determinant 1."""
    assert determinant(Ring(["x"]), []) == 1


def test_the_jacobian_has_the_ring_s_order() -> None:
    """Rows are polynomials, columns the variables of the ring, without sqrt m."""
    ring = Ring(["x", "y"], 3)
    x, y = ring.gens
    assert jacobian(ring, [x**2 * y, ring.surd * y]) == [
        [2 * x * y, x**2],
        [0, ring.surd],
    ]
