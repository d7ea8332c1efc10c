"""The command line."""

from cuspaudit.cli.main import main

__all__ = ["main"]
