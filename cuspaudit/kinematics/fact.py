"""Facts of a model: computed when they are first asked for, and kept by the model."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

__all__ = ["fact"]

Owner = TypeVar("Owner")
Value = TypeVar("Value")


def fact(compute: Callable[[Owner], Value]) -> Callable[[Owner], Value]:
    """The function, which computes once for each object that it is asked of.

    Args:
        compute: a function of one object that never changes. What it raises is not
            kept.
    """
    name = f"{compute.__module__}.{compute.__qualname__}"

    @wraps(compute)
    def asked(owner: Owner) -> Value:
        kept: dict[str, Any] = owner.__dict__
        if name not in kept:
            kept[name] = compute(owner)
        value: Value = kept[name]
        return value

    return asked
