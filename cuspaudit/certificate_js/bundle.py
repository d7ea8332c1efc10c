"""The modules of the second checker as one script, for a page that fetches nothing.

Each module becomes a function that returns what it exports; an import becomes a look
into what an earlier function returned. Nothing else of the text is changed.
"""

from __future__ import annotations

import re
from importlib.resources import files

__all__ = ["checker_script"]

MODULES = (
    *("rational", "json", "interval", "jet", "boxes", "arm", "play", "certificate"),
    *("path", "structure", "pairs", "cusp", "check"),
)
"""Each after those that it imports."""

_IMPORT = re.compile(r'import (\{[^}]*\})\s+from "\./(\w+)\.js";')
_EXPORT = re.compile(r"^export (?=(?:const|class|function) (\w+))", re.MULTILINE)


def checker_script() -> str:
    """A script that defines ``cuspauditCertificate.checkCertificate``."""
    parts = ['"use strict";', "const cuspauditCertificate = (() => {"]
    for name in MODULES:
        text = (files("cuspaudit.certificate_js") / f"{name}.js").read_text("utf-8")
        exported = ", ".join(_EXPORT.findall(text))
        body = _EXPORT.sub("", _IMPORT.sub(r"const \1 = module_\2;", text))
        parts += [f"const module_{name} = (() => {{", body, f"return {{ {exported} }};"]
        parts.append("})();")
    return "\n".join([*parts, "return module_check;", "})();", ""])
