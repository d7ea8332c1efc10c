"""Bounds on the number of solutions that prove a list of solutions complete.

Two bounds on what a system f_1 = ... = f_s = 0 over Q can have in C^n. A list of that
many distinct solutions is complete.

**Multiples modulo a prime.** Let R be a finite set of multiples m f_i (m a monomial)
with integer coefficients, M a finite set of monomials that contains 1 and those of R,
and B a subset of M with x_j b in M for every b in B and every j. *If the columns
M - B of the matrix of R have full rank modulo a prime p, then
dim Q[x]/<f> <= |B|.* For a minor that is not 0 modulo p is not 0: the columns have
full rank over Q, so that the rows project onto Q^(M - B) and every monomial of M is
congruent modulo <f> to an element of span(B). So span(B) + <f> contains 1 and with
every b also x_j b: it is closed under multiplication by the variables, hence is
Q[x]. The bound counts multiplicities: when it is met by distinct points, <f> is
radical. Nothing is assumed about p; a bad one only fails to prove.

**Bezout on a product of circles and a projective space.** n equations apart from the
circles c_i^2 + s_i^2 = 1, each of positive degree d in every circle and in the other
variables together: sections of ample bundles on a product of conics and one P^m. Every
component of their common zeros contributes at least 1 to the intersection number
[Fulton, *Intersection Theory*, theorem 12.2], so a list of as many solutions, each
isolated because the Jacobian determinant is not 0 there, leaves room for no other.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence

from flint import fmpq, nmod_mat

from cuspaudit.algebra.points.ideal import Exponents, as_exponents, degree_reverse_key
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.algebra.trigonometric import primitive

__all__ = ["bezout_number", "monomials", "multiples_bound", "times"]

PRIME = (1 << 61) - 1
_MOST_ENTRIES = 2_000_000

Row = dict[Exponents, int]


def multiples_bound(
    ring: Ring, polynomials: Sequence[Polynomial], points: int, seconds: float
) -> bool:
    """Whether dim Q[x]/<f> <= ``points`` was proved by multiples modulo 2^61 - 1.

    Degree by degree: B is made of the ``points`` lowest monomials that the rows leave
    free; then the highest dependent columns are given up, and the rows that use them,
    until the rest is independent.

    Args:
        ring: Q[x_1..x_n].
        polynomials: elements of the ideal, nonzero.
        points: the number of solutions known.
        seconds: no larger degree is begun afterwards.

    Returns:
        False when it was not proved within the time and the size allowed.
    """
    rows = [_row(ring, p) for p in polynomials]
    n, until = len(ring.variables), time.monotonic() + seconds
    degree = max((_degree(row) for row in rows), default=0)
    while time.monotonic() < until:
        multiples = [m for row in rows for m in _multiples(row, n, degree)]
        columns = {e for row in multiples for e in row}
        if len(multiples) * len(columns) > _MOST_ENTRIES:
            return False
        if _proves(multiples, columns, set(monomials(n, degree)), points):
            return True
        degree += 1
    return False


def bezout_number(ring: Ring, polynomials: Sequence[Polynomial]) -> int | None:
    """How many components the solutions can have at most; isolated ones are points.

    Returns:
        None when the equations apart from circles are not as many as the dimension of
        the product, or one has degree 0 in a factor.
    """
    circles = _circles(ring, polynomials)
    inside = {name for circle in circles for name in circle}
    others = [name for name in ring.variables if name not in inside]
    rest = [p for p in polynomials if not any(_is_circle(ring, p, c) for c in circles)]
    blocks = [*circles, *([tuple(others)] if others else [])]
    dimension = len(circles) + len(others)
    degrees = [[_degree_in(ring, p, block) for block in blocks] for p in rest]
    if len(rest) != dimension or any(d < 1 for row in degrees for d in row):
        return None
    classes = Ring([f"h{j}" for j in range(len(blocks))])
    product = classes.constant(2 ** len(circles))
    for row in degrees:
        product *= classes.total(d * h for d, h in zip(row, classes.gens, strict=True))
    sizes = (1,) * len(circles) + (len(others),) * bool(others)
    return int(product.to_dict().get(sizes, fmpq(0)).p)


def _proves(
    rows: list[Row], columns: set[Exponents], lowest: set[Exponents], points: int
) -> bool:
    """Whether a subset of ``rows`` satisfies the lemma with |B| = ``points``.

    Args:
        rows: multiples.
        columns: the monomials of the rows.
        lowest: the monomials of which B may be made, besides these.
        points: |B|.
    """
    downwards = sorted(columns, key=degree_reverse_key, reverse=True)
    free = {*_dependent(rows, downwards), *(lowest - columns)}
    kept = set(sorted(free, key=degree_reverse_key)[:points])
    if len(kept) < points:
        return False
    one = min(lowest, key=sum)
    needed = {times(b, j) for b in kept for j, _ in enumerate(one)} | {one}
    while rows:
        used = {e for row in rows for e in row} | needed
        upwards = sorted(used - kept, key=degree_reverse_key)
        lost = set(_dependent(rows, upwards))
        if not lost:
            return True
        if lost & needed:
            return False
        rows = [row for row in rows if not lost & row.keys()]
    return False


def _dependent(rows: list[Row], columns: list[Exponents]) -> list[Exponents]:
    """The columns that are combinations modulo p of columns before them."""
    index = {column: i for i, column in enumerate(columns)}
    matrix = nmod_mat(len(rows), len(columns), PRIME)
    for i, row in enumerate(rows):
        for exponents, value in row.items():
            if exponents in index:
                matrix[i, index[exponents]] = value
    reduced, rank = matrix.rref()
    found, line = [], 0
    for i, column in enumerate(columns):
        if line < rank and int(reduced[line, i]) != 0:
            line += 1
        else:
            found.append(column)
    return found


def _row(ring: Ring, polynomial: Polynomial) -> Row:
    integral = primitive(ring, polynomial).to_dict()
    return {as_exponents(e): int(c.p) % PRIME for e, c in integral.items()}


def _multiples(row: Row, n: int, degree: int) -> Iterator[Row]:
    for shift in monomials(n, degree - _degree(row)):
        yield {
            tuple(a + b for a, b in zip(e, shift, strict=True)): c
            for e, c in row.items()
        }


def monomials(n: int, degree: int) -> Iterator[Exponents]:
    """The exponents of n variables of total degree at most ``degree``."""
    if degree < 0:
        return
    if n == 0:
        yield ()
        return
    for first in range(degree + 1):
        for rest in monomials(n - 1, degree - first):
            yield (first, *rest)


def _degree(row: Row) -> int:
    return max(sum(e) for e in row)


def times(m: Exponents, j: int) -> Exponents:
    """The exponents of the monomial times x_j."""
    return (*m[:j], m[j] + 1, *m[j + 1 :])


def _circles(ring: Ring, polynomials: Sequence[Polynomial]) -> list[tuple[str, ...]]:
    """The pairs of variables, disjoint, of the circles among the equations."""
    found: list[tuple[str, ...]] = []
    for p in polynomials:
        names = tuple(x for x in ring.variables if p.derivative(x) != 0)
        fresh = not any(set(names) & set(circle) for circle in found)
        if len(names) == 2 and fresh and _is_circle(ring, p, names):
            found.append(names)
    return found


def _is_circle(ring: Ring, p: Polynomial, names: tuple[str, ...]) -> bool:
    circle = ring.total(ring.gen(name) ** 2 for name in names) - 1
    return bool(primitive(ring, p) == circle)


def _degree_in(ring: Ring, p: Polynomial, names: Sequence[str]) -> int:
    where = [ring.variables.index(name) for name in names]
    return max((sum(int(e[i]) for i in where) for e in p.to_dict()), default=0)
