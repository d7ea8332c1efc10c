"""Files that appear whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from cuspaudit.errors import InvalidInputError

__all__ = ["check_writable", "write_text"]


def write_text(path: Path, text: str) -> None:
    """Write ``text`` to ``path``; an interruption leaves the old file or none.

    Raises:
        InvalidInputError: the file cannot be written.
    """
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as stream:
                stream.write(text)
            Path(name).chmod(0o644)
            os.replace(name, path)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise InvalidInputError(
            file=str(path),
            found=f"cannot be written ({error.strerror})",
            expected="name a file in a folder that exists and is writable",
        ) from error


def check_writable(path: Path) -> None:
    """Refuse a file that could not be written, before long work begins.

    Raises:
        InvalidInputError: its folder does not exist or is not writable.
    """
    folder = path.parent
    if not folder.is_dir() or not os.access(folder, os.W_OK) or path.is_dir():
        raise InvalidInputError(
            file=str(path),
            found="cannot be written there",
            expected="name a file in a folder that exists and is writable",
        )
