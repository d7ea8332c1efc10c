"""Which expressions of a xacro file are evaluated: arithmetic, and nothing else.

xacro evaluates what stands in ``${...}`` as Python. Here it is parsed first, and
refused unless it is made of numbers, texts, names, arithmetic, comparisons, choices,
lists, items of them, and calls of a few functions by name.
"""

from __future__ import annotations

import ast

__all__ = ["refusal"]

_NODES = (
    *(ast.Expression, ast.BinOp, ast.UnaryOp, ast.BoolOp, ast.Compare, ast.IfExp),
    *(ast.Constant, ast.Name, ast.Load, ast.List, ast.Tuple, ast.Dict, ast.Subscript),
    *(ast.Slice, ast.Attribute, ast.Call, ast.operator, ast.unaryop, ast.boolop),
    ast.cmpop,
)
_ROOMS = {"math", "python", "xacro"}
_FUNCTIONS = {
    *("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "radians"),
    *("degrees", "hypot", "floor", "ceil", "fabs", "pow", "exp", "log"),
    *("int", "float", "str", "bool", "len", "min", "max", "round", "abs", "sum"),
    *("list", "dict", "range", "load_yaml"),
}
_LONGEST = 2000
_LARGEST_POWER = 16


def refusal(text: str) -> str | None:
    """Why an expression is not evaluated, None when it is.

    >>> refusal("radians(90) / 2 + length"), refusal("().__class__")
    (None, 'the name __class__')
    """
    if len(text) > _LONGEST:
        return f"more than {_LONGEST} characters"
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return "it is no expression"
    for node in ast.walk(tree):
        if not isinstance(node, _NODES):
            return f"a {type(node).__name__}"
        if isinstance(node, ast.Attribute | ast.Name):
            name = node.attr if isinstance(node, ast.Attribute) else node.id
            if name.startswith("_"):
                return f"the name {name}"
        if isinstance(node, ast.Call):
            name = _function(node.func)
            if name not in _FUNCTIONS or node.keywords:
                return f"a call of {name or 'something else'}"
        if isinstance(node, ast.BinOp) and not _is_small(node):
            return "a power or a repetition"
    return None


def _function(node: ast.expr) -> str:
    """The name of a function, alone or in one of the rooms of xacro."""
    if isinstance(node, ast.Name):
        return node.id
    in_room = (
        isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id in _ROOMS
    )
    return node.attr if in_room and isinstance(node, ast.Attribute) else ""


def _is_small(node: ast.BinOp) -> bool:
    """Whether an operation makes no huge number or text."""
    if isinstance(node.op, ast.Pow):
        power = node.right
        return (
            isinstance(power, ast.Constant)
            and isinstance(power.value, int | float)
            and abs(power.value) <= _LARGEST_POWER
        )
    if isinstance(node.op, ast.LShift):
        return False
    if not isinstance(node.op, ast.Mult):
        return True
    return not any(
        isinstance(side, ast.List | ast.Tuple)
        or (isinstance(side, ast.Constant) and isinstance(side.value, str))
        for side in (node.left, node.right)
    )
