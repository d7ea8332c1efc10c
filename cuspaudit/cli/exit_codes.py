"""What an exit code says, the same for every command."""

from __future__ import annotations

__all__ = ["BAD_INPUT", "INTERRUPTED", "OF_VERDICT", "UNFORESEEN"]

#: 0 also says all good, and 1 what is rejected or contradicted
OF_VERDICT = {"noncuspidal": 0, "cuspidal": 1, "undecided": 3}
BAD_INPUT = 2
UNFORESEEN = 4
INTERRUPTED = 130
