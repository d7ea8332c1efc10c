"""Elimination of variables from an ideal, by a Groebner basis that msolve computes.

The basis is a lift from many primes and nothing proves it: it is a proposal. Whoever
uses an element proves by exact division what is needed of it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from flint import fmpq

from cuspaudit.algebra.msolve import msolve_text, run_msolve
from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import UnableError

__all__ = ["parse_basis", "propose_elimination"]

_TERM = re.compile(r"([+-]?)([^+-]+)")
_COMMENT = re.compile(r"#[^\n]*")


def propose_elimination(
    ring: Ring,
    polynomials: Sequence[Polynomial],
    eliminated: int,
    timeout: float = 60.0,
    seed: int = 1,
) -> list[Polynomial]:
    """Generators, unproved, of <p_1..p_k> without the first ``eliminated`` variables.

    Args:
        ring: Q[x_1..x_n].
        polynomials: p_1..p_k.
        eliminated: how many of x_1..x_n to eliminate.
        timeout: in s.
        seed: of msolve's random choices.

    Raises:
        UnableError: msolve fails or takes too long.
    """
    options = ("-e", str(eliminated), "-g", "2")
    answer = run_msolve(msolve_text(ring, polynomials), options, timeout, seed)
    return parse_basis(ring, answer)


def parse_basis(ring: Ring, answer: str) -> list[Polynomial]:
    r"""The polynomials that msolve prints with the option -g 2.

    >>> ring = Ring(["t", "u"])
    >>> parse_basis(ring, "#a comment\n[2*t^2-u, \nt*u-3]:")
    [2*t^2 - u, t*u - 3]

    Raises:
        UnableError: the answer is something else.
    """
    body = _COMMENT.sub("", answer).strip().removesuffix(":")
    if not (body.startswith("[") and body.endswith("]")):
        raise UnableError("msolve", f"unreadable answer {answer[:60]!r}")
    try:
        return [_polynomial(ring, text) for text in body[1:-1].split(",")]
    except (ValueError, KeyError) as error:
        raise UnableError("msolve", f"unreadable answer {answer[:60]!r}") from error


def _polynomial(ring: Ring, text: str) -> Polynomial:
    place = {name: i for i, name in enumerate(ring.context.names())}
    terms: dict[tuple[int, ...], fmpq] = {}
    for sign, term in _TERM.findall("".join(text.split())):
        exponents, coefficient = [0] * len(place), fmpq(-1 if sign == "-" else 1)
        for factor in term.split("*"):
            base, mark, power = factor.partition("^")
            if base in place:
                exponents[place[base]] += int(power) if mark else 1
            else:
                above, _, below = base.partition("/")
                coefficient *= fmpq(int(above), int(below or 1))
        key = tuple(exponents)
        terms[key] = terms.get(key, fmpq(0)) + coefficient
    return ring.context.from_dict(terms)
