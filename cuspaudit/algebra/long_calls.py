"""Single calls of a kernel that may run longer than the time that is left.

A resultant, a discriminant or a factorisation of long polynomials is one call, and
nothing inside asks for the time. Where a limit is in force, one that promises to be
long is made in a process of its own, which is ended when the time is up.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import fmpq

from cuspaudit.algebra.ring import Polynomial, Ring
from cuspaudit.errors import TimeLimitError
from cuspaudit.runtime.clock import Progress, seconds_left
from cuspaudit.runtime.own_process import run_in_own_process

__all__ = ["in_time"]

Terms = list[tuple[tuple[int, ...], fmpq]]


def in_time(
    ring: Ring, work: Callable[[], Sequence[Polynomial]], is_long: bool, step: str
) -> list[Polynomial]:
    """The polynomials of ``ring`` that ``work`` returns.

    Args:
        ring: theirs.
        work: what may be long.
        is_long: whether it promises to be.
        step: its name.

    Raises:
        TimeLimitError: the limit in force has passed.
    """
    left = seconds_left()
    if left is None or not is_long:
        return list(work())

    def told(progress: Progress) -> list[Terms]:
        return [
            [(tuple(map(int, e)), c) for e, c in p.to_dict().items()] for p in work()
        ]

    try:
        rows: list[Terms] = run_in_own_process(told, timeout=left)
    except TimeLimitError as late:
        raise TimeLimitError(step, late.seconds) from None
    return [ring.context.from_dict(dict(row)) for row in rows]
