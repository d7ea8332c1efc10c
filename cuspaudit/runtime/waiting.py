"""How long a user has waited for a command: loading and writing included."""

from __future__ import annotations

import time

__all__ = ["waited"]

_BEGUN = time.perf_counter()


def waited() -> float:
    """The seconds since this module was loaded, which a command does first of all."""
    return time.perf_counter() - _BEGUN
