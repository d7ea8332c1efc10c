"""What every page that opens offline is made with: templates, and its own policy.

Everything from outside is escaped by the template, and the policy lets a browser run no
script but ours and fetch nothing at all.
"""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Sequence
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined

from cuspaudit.viz.page_rows import number

__all__ = ["asset", "environment", "policy"]


def environment() -> Environment:
    """The templates of this room, escaping; a name they miss is an error."""
    found = Environment(
        loader=PackageLoader("cuspaudit.viz"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    found.filters["number"] = number
    return found


def asset(name: str) -> str:
    """The text of a file that stands beside the templates."""
    return (files("cuspaudit.viz") / "templates" / name).read_text("utf-8")


def policy(scripts: Sequence[str]) -> str:
    """A content security policy: these scripts, inline style, embedded images."""
    digests = [hashlib.sha256(script.encode()).digest() for script in scripts]
    hashes = [base64.b64encode(digest).decode() for digest in digests]
    allowed = " ".join(f"'sha256-{text}'" for text in hashes) or "'none'"
    return (
        f"default-src 'none'; script-src {allowed}; style-src 'unsafe-inline'; "
        "img-src data: blob:; base-uri 'none'; form-action 'none'"
    )
