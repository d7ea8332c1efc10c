"""The audits of members of a sweep, kept in its folder as robot file and page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import typer

from cuspaudit.cli.running import run_audit
from cuspaudit.errors import CuspauditError, InvalidInputError

__all__ = ["audit_members", "kept_audits"]


def audit_members(
    folder: Path, files: Mapping[int, str], wanted: Sequence[str]
) -> None:
    """Audit members of the sweep in ``folder``; an audit that is there is kept.

    A member that cannot be audited is a line on standard error, and the next begins.

    Args:
        folder: of the sweep; ``audits/INDEX.yaml`` and ``.html`` are written there.
        files: member index to the text of its robot file.
        wanted: indices, or "all".

    Raises:
        InvalidInputError: an index is none of ``files``, or the disk is full.
    """
    for index in _indices(files, wanted):
        if _page(folder, index).exists():
            continue
        try:
            _audit(folder, index, files[index])
        except InvalidInputError:
            raise
        except CuspauditError as error:
            typer.echo(f"cuspaudit: member {index} has no audit: {error}", err=True)


def kept_audits(folder: Path, files: Mapping[int, str]) -> dict[int, Path]:
    """The pages of those of ``files`` that were audited."""
    return {k: _page(folder, k) for k in files if _page(folder, k).exists()}


def _indices(files: Mapping[int, str], wanted: Sequence[str]) -> list[int]:
    if "all" in wanted:
        return sorted(files)
    known = {str(index): index for index in files}
    for text in wanted:
        if text not in known:
            raise InvalidInputError(
                file="--audit",
                found=f"no member {text} in this plane",
                expected="write the index of one that is drawn, or all",
            )
    return [known[text] for text in wanted]


def _audit(folder: Path, index: int, text: str) -> None:
    from cuspaudit.pictures.page import page_text
    from cuspaudit.robot.library import open_robot
    from cuspaudit.runtime.writing import write_text

    file = _page(folder, index).with_suffix(".yaml")
    file.parent.mkdir(exist_ok=True)
    write_text(file, text)
    result = run_audit(open_robot(file), 0, None, "none")
    page = page_text(result.record(), result)
    write_text(_page(folder, index), page)


def _page(folder: Path, index: int) -> Path:
    return folder / "audits" / f"{index}.html"
