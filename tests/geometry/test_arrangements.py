"""Components of the complement of hypersurfaces, against published numbers.

HypersurfaceRegions.jl, and Kuramoto's oscillators [Breiding, Sturmfels, Wang 2024].
"""

from __future__ import annotations

import pytest

from cuspaudit.algebra.polynomial_text import parse_polynomial
from cuspaudit.algebra.ring import Ring
from cuspaudit.algebra.system import PolynomialSystem
from cuspaudit.geometry.routing import Routing, morse_graph

ELLIPTOPE = "2*x*y*z - x^2 - y^2 - z^2 + 1"
KURAMOTO = (
    "314928*x^8*y^4 + 1259712*x^7*y^5 + 1889568*x^6*y^6 + 1259712*x^5*y^7"
    " + 314928*x^4*y^8 + 139968*x^10 + 699840*x^9*y + 1277208*x^8*y^2"
    " + 909792*x^7*y^3 - 279936*x^6*y^4 - 1084752*x^5*y^5 - 279936*x^4*y^6"
    " + 909792*x^3*y^7 + 1277208*x^2*y^8 + 699840*x*y^9 + 139968*y^10 - 96957*x^8"
    " - 387828*x^7*y - 226962*x^6*y^2 + 676512*x^5*y^3 + 1128249*x^4*y^4"
    " + 676512*x^3*y^5 - 226962*x^2*y^6 - 387828*x*y^7 - 96957*y^8 + 22680*x^6"
    " + 68040*x^5*y - 20844*x^4*y^2 - 155088*x^3*y^3 - 20844*x^2*y^4 + 68040*x*y^5"
    " + 22680*y^6 - 2298*x^4 - 4596*x^3*y - 6894*x^2*y^2 - 4596*x*y^3 - 2298*y^4"
    " + 96*x^2 + 96*x*y + 96*y^2 - 1"
)
CASES = {
    "two circles": (("x^2+y^2-1", "x^2+y^2-4"), 3),
    "a circle and a parabola": (("x^2+y^2-1", "y-x^2"), 4),
    "the elliptope": ((ELLIPTOPE,), 6),
    "ellipsoids": (("x^2+y^2+z^2-1", "x^2+y^2+z^2-4", "100*x^2+100*y^2+z^2-9"), 8),
    "a discriminant": (("x^2-4*y",), 2),
    "a discriminant and lines": (("x^2-4*y", "x", "y"), 6),
    "a cubic discriminant": (("4*x^3-x^2*y^2-18*x*y+4*y^3+27",), 3),
}
LONG = {
    "the elliptope and planes": (
        (ELLIPTOPE, "1-x", "1+x", "1-y", "1+y", "1-z", "1+z"),
        43,
    ),
    "Kuramoto": ((KURAMOTO,), 9),
}


def regions(texts: tuple[str, ...]) -> Routing:
    """The components of the complement in the plane or in space."""
    names = ["x", "y", "z"] if any("z" in text for text in texts) else ["x", "y"]
    ring = Ring(names)
    product = ring.constant(1)
    for text in texts:
        product *= parse_polynomial(ring, text)
    return morse_graph(PolynomialSystem(ring), len(names), [product])


@pytest.mark.parametrize("name", CASES)
def test_regions(name: str) -> None:
    """As many as published."""
    texts, expected = CASES[name]
    assert regions(texts).number_of_components == expected


@pytest.mark.slow
@pytest.mark.parametrize("name", LONG)
def test_regions_of_higher_degree(name: str) -> None:
    """As many as published, each listed completely within a minute."""
    texts, expected = LONG[name]
    assert regions(texts).number_of_components == expected
