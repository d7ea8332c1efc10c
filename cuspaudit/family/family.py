"""The members of a family: a robot file whose numbers are names with many values.

A member is found from its index alone, so a family of a million needs no list. An
index that a constraint excludes keeps its number and has no member.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod
from pathlib import Path

from cuspaudit.errors import InvalidRobotError
from cuspaudit.family.conditions import Condition
from cuspaudit.family.expressions import Expression, Value
from cuspaudit.family.parameters import Parameter
from cuspaudit.robot.chain import Angle
from cuspaudit.robot.formats.dh.read import robot_from_table
from cuspaudit.robot.numbers import format_angle, format_rational
from cuspaudit.robot.place import Place
from cuspaudit.robot.proposals import check_task
from cuspaudit.robot.robot import Robot
from cuspaudit.robot.tables import Table

__all__ = ["Adaptive", "Family", "exact_text"]


@dataclass(frozen=True)
class Adaptive:
    """Where members are added: in the cells whose corners differ.

    Attributes:
        parameters: the ranges that span the cells; their ``steps`` are the coarsest.
        levels: how often a cell can be halved.
        on: the columns whose values are compared.
    """

    parameters: tuple[str, ...]
    levels: int
    on: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Family:
    """A family as read from its file.

    Attributes:
        name: the family's name.
        file: the file as the user gave it.
        text: what the file says, as JSON.
        hash: of ``text``, so that comments and spaces do not count.
        parameters: in the order of the file; those of ``adaptive`` at full sharpness.
        derived: names computed from the parameters and from the names before them.
        constraints: all hold for a member.
        record: the columns wanted beside verdict and proof.
        seed: of the random parameters.
        adaptive: None for a plain grid.
        rows: the robot file, names and all.
        cells: its cells that hold names: row, column and, for limits, which end.
    """

    name: str
    file: str
    text: str
    hash: str
    parameters: tuple[Parameter, ...]
    derived: Mapping[str, Expression]
    constraints: tuple[Condition, ...]
    record: tuple[str, ...]
    seed: int
    adaptive: Adaptive | None
    rows: Table
    cells: Mapping[tuple[int, str, int], Expression]

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """The sizes of the axes: grid parameters, then the random ones as one."""
        sizes = tuple(p.size for p in self.parameters if p.seed is None)
        random = {p.size for p in self.parameters if p.seed is not None}
        return sizes + tuple(random)

    @property
    def size(self) -> int:
        """How many indices there are, excluded ones counted."""
        return prod(self.shape)

    def index_of(self, point: tuple[int, ...]) -> int:
        """The index of the point with these numbers on the axes."""
        index = 0
        for number, size in zip(point, self.shape, strict=True):
            index = index * size + number
        return index

    def values(self, index: int) -> dict[str, Value] | None:
        """The values of the parameters of a member; None when it is excluded.

        Where a constraint cannot be compared there is a member, without a robot.
        """
        values = self._at(index)
        try:
            held = self._holds(values)
        except InvalidRobotError:
            held = True
        return values if held else None

    def known(self, values: Mapping[str, Value]) -> dict[str, Value]:
        """``values`` of the parameters, and those of the derived names.

        Raises:
            InvalidRobotError: an expression has no value there.
        """
        known = dict(values)
        for name, expression in self.derived.items():
            known[name] = expression.value(known)
        return known

    def indices(self) -> Iterator[int]:
        """The indices of all members, in order, one at a time."""
        return (k for k in range(self.size) if self.values(k) is not None)

    def table(self, values: Mapping[str, Value]) -> Table:
        """The robot file at ``values`` of the parameters: every number as exact text.

        Raises:
            InvalidRobotError: an expression has no value there.
        """
        known = self.known(values)
        rows = [dict(row) for row in self.rows.rows]
        for (number, column, part), expression in self.cells.items():
            text = exact_text(expression.value(known))
            if column == "limits":
                limits = rows[number]["limits"]
                assert isinstance(limits, Sequence), "as the cells were found"
                pair = list(limits)
                pair[part] = text
                rows[number]["limits"] = pair
            else:
                rows[number][column] = text
        return Table(self.rows.head, rows)

    def robot(self, index: int) -> Robot:
        """The robot of a member, its numbers exactly as the family gives them.

        Raises:
            InvalidRobotError: it cannot be read, its joints do not fit its task, or a
                constraint cannot be compared.
        """
        values = self._at(index)
        if not self._holds(values):
            raise Place(self.file).error(f"{index} is excluded", "name a member")
        robot = robot_from_table(self.table(values), Path(self.file))
        check_task(robot.chain, self.file)
        return robot

    def _at(self, index: int) -> dict[str, Value]:
        point = []
        for size in reversed(self.shape):
            index, number = divmod(index, size)
            point.append(number)
        point.reverse()
        grid = iter(point)
        return {
            p.name: p.value(next(grid) if p.seed is None else point[-1])
            for p in self.parameters
        }

    def _holds(self, values: Mapping[str, Value]) -> bool:
        if not self.constraints:
            return True
        known = self.known(values)
        return all(condition.holds(known) for condition in self.constraints)


def exact_text(value: Value) -> str:
    """``value`` as text that reads back as the same number."""
    return format_angle(value) if isinstance(value, Angle) else format_rational(value)
