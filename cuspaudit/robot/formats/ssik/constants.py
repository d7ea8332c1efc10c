"""The constants of a module: literal lists and numbers, read and never evaluated."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator
from typing import Any

from cuspaudit.robot.place import Place, quoted

__all__ = ["Constants"]


class Constants:
    """The values that a module gives to names at its top level.

    Raises:
        InvalidRobotError: the text is not Python.
    """

    def __init__(self, text: str, place: Place) -> None:
        self._place = place
        try:
            module = ast.parse(text)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise place.error("not Python", "give a module of ssik") from None
        self._nodes = dict(_assigned(module))

    def array(self, name: str, *shape: int) -> list[Any]:
        """Nested lists of finite numbers; a -1 in ``shape`` stands for any length.

        Raises:
            InvalidRobotError: there are none of this shape.
        """
        values = self.entries(name)
        if not _has_shape(values, shape):
            size = " x ".join("n" if n < 0 else str(n) for n in shape)
            raise self._place.at(name).error("other entries", f"give {size} numbers")
        return values

    def entries(self, name: str) -> list[Any]:
        """Lists, tuples, numbers and texts; ``np.array`` of a list stands for it.

        Raises:
            InvalidRobotError: the name is missing, or has another value.
        """
        if name not in self._nodes:
            raise self._place.error(f"no {name}", "give a module of ssik")
        try:
            found = _literal(self._nodes[name])
        except (ValueError, RecursionError):
            raise self._place.at(name).error("no literal", "give numbers") from None
        if not isinstance(found, list):
            raise self._place.at(name).error(quoted(str(found)), "give a list")
        return found


def _assigned(module: ast.Module) -> Iterator[tuple[str, ast.expr]]:
    for node in module.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            yield node.targets[0].id, node.value


def _literal(node: ast.expr) -> Any:
    match node:
        case ast.Call(func=ast.Attribute(attr="array"), args=[inner, *_]):
            return _literal(inner)
        case ast.List(elts=entries) | ast.Tuple(elts=entries):
            return [_literal(entry) for entry in entries]
    return ast.literal_eval(node)


def _has_shape(values: Any, shape: tuple[int, ...]) -> bool:
    if not shape:
        is_number = isinstance(values, int | float) and not isinstance(values, bool)
        return is_number and math.isfinite(values)
    count, *rest = shape
    return (
        isinstance(values, list)
        and count in (-1, len(values))
        and all(_has_shape(value, tuple(rest)) for value in values)
    )
