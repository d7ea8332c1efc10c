"""The exceptions of cuspaudit: one family, each branch telling whose turn it is.

::

    CuspauditError
      InvalidInputError        a file or a value that cannot be read as it stands
        InvalidRobotError      not a serial chain we can read (file, joint or row)
          UnsupportedJointError
        InvalidSystemError     a polynomial system or map that cannot be read
        InvalidCertificateError
      AssumptionError          a hypothesis fails here: no answer exists by this route
        NotSquareError
        DegenerateMapError
        NoAngleError
        NotOnVarietyError
        NotZeroDimensionalError
        NotRadicalError
        NotEquidimensionalError
        RealPartSingularError
      RetryableError           an unlucky choice: another chart, or more bits, may do
        PrecisionError
      SetUpError               a program that is needed is not installed
      UnableError              our limit, not mathematics: too large, too long
        TimeLimitError         the time that was given has passed
      CrossCheckError          exact and numeric answers disagree: one has a bug

A search may catch ``RetryableError``; only a decision turns ``UnableError`` into
UNDECIDED; nobody catches ``CrossCheckError`` except to print it.
"""

from __future__ import annotations

import traceback
from pathlib import Path
from typing import Any

__all__ = [
    "AssumptionError",
    "CrossCheckError",
    "CuspauditError",
    "DegenerateMapError",
    "InvalidCertificateError",
    "InvalidInputError",
    "InvalidRobotError",
    "InvalidSystemError",
    "NoAngleError",
    "NotEquidimensionalError",
    "NotOnVarietyError",
    "NotRadicalError",
    "NotSquareError",
    "NotZeroDimensionalError",
    "PrecisionError",
    "RealPartSingularError",
    "RetryableError",
    "SetUpError",
    "TimeLimitError",
    "UnableError",
    "UnsupportedJointError",
    "unforeseen",
]

#: characters of a foreign message that are kept
_LONGEST = 400


class CuspauditError(Exception):
    """Base of every error this package raises on purpose.

    It travels between processes with its facts.
    """

    def __reduce__(self) -> tuple[Any, ...]:
        """How to copy it: message and attributes, without building them again."""
        return _restored, (type(self), self.args, self.__dict__)


def _restored(
    kind: type[CuspauditError], args: tuple[Any, ...], facts: dict[str, Any]
) -> CuspauditError:
    error = kind.__new__(kind, *args)
    error.__dict__.update(facts)
    return error


class InvalidInputError(CuspauditError):
    """An input cannot be read: where, what was found, what to do instead.

    Attributes:
        file: the file (or name) as the user gave it.
        where: joint, row, element or line inside it, or "".
        found: what stands there.
        expected: what would be accepted, or what to do.
    """

    def __init__(
        self, *, file: str, found: str, expected: str, where: str = ""
    ) -> None:
        """Build the one-line message from its facts."""
        self.file, self.where, self.found, self.expected = file, where, found, expected
        place = f"{file}: {where}" if where else file
        super().__init__(f"{place}: {found}; {expected}")


class InvalidRobotError(InvalidInputError):
    """The input is not a serial chain we can read."""


class UnsupportedJointError(InvalidRobotError):
    """A joint on the chain is of a kind that has no exact model here."""


class InvalidSystemError(InvalidInputError):
    """The input is not a polynomial system and map we can read."""


class InvalidCertificateError(InvalidInputError):
    """The input is not a certificate file (a refuted one is not an error)."""


class AssumptionError(CuspauditError):
    """A hypothesis of the theorem in use fails for this input."""


class NotSquareError(AssumptionError):
    """The Jacobian matrix of (f, R) is not square.

    Attributes:
        rows: number of equations and map components together.
        variables: number of variables.
    """

    def __init__(self, *, rows: int, variables: int) -> None:
        """Name both sizes."""
        self.rows, self.variables = rows, variables
        super().__init__(
            f"{rows} equations and components for {variables} variables; a decision "
            "needs as many components as the variety has dimensions"
        )


class NotOnVarietyError(AssumptionError):
    """A query point does not lie on V - {Delta = 0}.

    Attributes:
        point: the point as the caller gave it, in text.
    """

    def __init__(self, point: str, found: str) -> None:
        """Name the point and what fails there."""
        self.point = point
        super().__init__(f"the point {point} is not a query point: {found}")


class DegenerateMapError(AssumptionError):
    """The map is singular everywhere: det J vanishes identically."""


class NoAngleError(AssumptionError):
    """The axes share no direction about which the tip would have an angle.

    Attributes:
        joints: their names.
    """

    def __init__(
        self, joints: tuple[str, ...], file: str = "", advice: str = ""
    ) -> None:
        """Say which axes would have to be parallel, and what to do instead."""
        self.joints = joints
        super().__init__(
            (f"{file}: " if file else "")
            + "the tip has no angle, because neither all axes that turn are parallel "
            "(a SCARA), nor the last three, at right angles to the first (yaw and "
            f"pitch){advice and '; '}{advice}"
        )


class NotZeroDimensionalError(AssumptionError):
    """A system that should have finitely many complex solutions has not.

    Attributes:
        dimension: of its zero set, positive.
    """

    def __init__(self, dimension: int) -> None:
        """Name the dimension."""
        self.dimension = dimension
        super().__init__(
            f"the zero set has dimension {dimension} where finitely many points are "
            "needed"
        )


class NotRadicalError(AssumptionError):
    """The ideal of the equations is not radical: they hold with multiplicity.

    Attributes:
        where: the part of the zero set where the equations are not reduced.
    """

    def __init__(self, where: str) -> None:
        """Name the part."""
        self.where = where
        super().__init__(
            f"the equations are not reduced {where}; give generators of the radical"
        )


class NotEquidimensionalError(AssumptionError):
    """The zero set does not have the dimension it should everywhere.

    Attributes:
        expected: the dimension it should have.
        found: another dimension that one of its components has, -1 when it is empty,
            None for a smaller one that is not known.
    """

    def __init__(self, *, expected: int, found: int | None) -> None:
        """Name both dimensions."""
        self.expected, self.found = expected, found
        other = f"smaller than {expected}" if found is None else f"{found}"
        super().__init__(
            "V is empty"
            if found == -1
            else f"a component of V has dimension {other}, and {expected} is needed"
        )


class RealPartSingularError(AssumptionError):
    """No real point of V is regular: all are singular, or there is none.

    Attributes:
        dimension: the dimension of V in C^n.
    """

    def __init__(self, dimension: int) -> None:
        """Name the dimension that the real part does not have."""
        self.dimension = dimension
        super().__init__(
            f"V, of dimension {dimension} in C^n, has no regular real point"
        )


class SetUpError(CuspauditError):
    """A program that this run needs is not installed, or does not work.

    It says nothing of the input, so no search takes it for a limit of its own.
    """

    def __init__(self, found: str, remedy: str) -> None:
        """Say what is missing, and what to type."""
        super().__init__(f"{found}; {remedy}")


class RetryableError(CuspauditError):
    """An unlucky choice was made; another one may succeed."""


class PrecisionError(RetryableError):
    """The working precision did not separate two numbers.

    Attributes:
        bits: the precision that was not enough.
    """

    def __init__(self, what: str, bits: int) -> None:
        """Name the question and the precision reached."""
        self.bits = bits
        super().__init__(f"{what}: not decided with {bits} bits")


class UnableError(CuspauditError):
    """A limit of this implementation, not of the mathematics.

    Attributes:
        step: the routine that stopped.
    """

    def __init__(self, step: str, why: str) -> None:
        """Name the routine and the limit."""
        self.step = step
        super().__init__(f"{step}: {why}")


class TimeLimitError(UnableError):
    """The time that was given has passed.

    Attributes:
        seconds: the limit.
    """

    def __init__(self, step: str, seconds: float) -> None:
        """Name the step that was not begun or not ended, and the limit."""
        self.seconds = seconds
        super().__init__(step, f"the time limit of {seconds:g} s has passed")


class CrossCheckError(CuspauditError):
    """Two routes to one number disagree: one of them has a bug."""


def unforeseen(error: BaseException) -> str:
    """One line about an error that is none of ours: what, where, and what to report.

    Such an error is a fault of this package whatever the input was: it says nothing
    of the input, and it ends without a verdict.

    >>> try:
    ...     [][0]
    ... except IndexError as error:
    ...     print(unforeseen(error).partition(";")[0])
    an error nobody foresaw: IndexError: list index out of range
    """
    root = Path(__file__).parent
    frames = [
        f"{Path(frame.filename).relative_to(root).as_posix()}:{frame.lineno}"
        for frame in traceback.extract_tb(error.__traceback__)
        if Path(frame.filename).is_relative_to(root)
    ]
    what = " ".join(f"{type(error).__name__}: {error}".split())
    place = f" ({frames[-1]})" if frames else ""
    return (
        f"an error nobody foresaw: {what[:_LONGEST]}{place}; no verdict was reached: "
        "please report this line with the input"
    )
