"""The audit page: one HTML file, rendered from the audit's JSON, that needs no network.

The template says what is shown and in which order; this module puts the audit's
numbers into words for it. Nothing is decided here: what the audit does not claim as
proved is not called proved. Everything from the audit is escaped by the template, and
the page's own policy lets a browser run no script but ours and fetch nothing at all.
"""

from __future__ import annotations

import base64
import json
import math
import re
from collections.abc import Mapping
from typing import Any

from markupsafe import Markup

from cuspaudit.certificate_js import checker_script
from cuspaudit.viz.advice import advice, file_name, margin_words, undecided_words
from cuspaudit.viz.limit_rows import cut_rows, limit_rows, limit_words
from cuspaudit.viz.offline import asset, environment, policy
from cuspaudit.viz.page_rows import (
    counts,
    model_rows,
    no_path_reason,
    part,
    posture_rows,
    proof_rows,
    structure_rows,
    verdict_words,
)
from cuspaudit.viz.scene.meshcat_commands import viewer_license, viewer_script
from cuspaudit.viz.scene.scene import Scene
from cuspaudit.viz.scene.strip import build_strip

__all__ = ["render_page"]


def render_page(
    audit: Mapping[str, Any],
    scene: Scene | None = None,
    *,
    certificate: str | None = None,
) -> str:
    """Render the audit as one self-contained HTML page.

    Args:
        audit: the audit, schema ``cuspaudit/audit/2``; missing keys count as null.
        scene: from `build_scene`: the arm on its path, or in a few postures when
            there is no path. None leaves the animation out.
        certificate: text of the certificate file, to be offered as a download, and
            checked by the page itself when it is opened.

    Returns:
        HTML that opens from ``file://`` and asks for no other file.
    """
    scripts = [viewer_script(), asset("page.js")] if scene else []
    checking = [checker_script(), asset("checking.js")] if certificate else []
    return (
        environment()
        .get_template("page.html")
        .render(
            words=verdict_words(audit),
            audit=_Tree(audit),
            scene=scene,
            strip=build_strip(scene.chain, scene.shown) if scene else None,
            counts=counts(audit),
            models=model_rows(audit),
            proof=proof_rows(audit),
            structures=structure_rows(audit),
            limits=limit_words(audit),
            limit_rows=limit_rows(audit),
            cuts=cut_rows(audit),
            postures=posture_rows(audit, scene),
            no_path=no_path_reason(audit),
            advice=advice(audit),
            file=file_name(audit),
            margin=margin_words(audit),
            undecided=undecided_words(audit),
            certificate=_certificate(audit, certificate),
            audit_link=_data_link(json.dumps(audit, indent=1, default=str)),
            drawing=_finite(scene.drawing) if scene else None,
            commands=[base64.b64encode(c).decode() for c in scene.commands]
            if scene
            else [],
            style=Markup(asset("page.css")),
            scripts=[Markup(script) for script in scripts],
            checking=[Markup(script) for script in checking],
            notices=Markup(viewer_license().replace("--", "- -")) if scene else "",
            policy=policy([*scripts, *checking]),
        )
    )


class _Tree(dict[str, Any]):
    """The audit for the template: a key that is missing anywhere reads as null."""

    def __init__(self, values: Mapping[str, Any] | None) -> None:
        super().__init__(values or {})

    def __missing__(self, key: str) -> Any:
        return None

    def part(self, key: str) -> _Tree:
        """The mapping under ``key``, empty when it is null."""
        return _Tree(part(self, key))


def _certificate(audit: Mapping[str, Any], text: str | None) -> dict[str, str] | None:
    """Name, command and download link of the certificate, as far as there is one.

    It is that of the witness within the limits where there is one, as that is shown.
    """
    inside = part(audit, "limits").get("witness")
    over = part(audit, "tolerance").get("certificate")
    free = over or part(audit, "witness").get("certificate")
    given = inside.get("certificate") if inside else free
    if not given and text is None:
        return None
    robot = part(audit, "robot").get("name") or "robot"
    plain = re.sub(r"[^A-Za-z0-9._-]+", "-", str(robot)).strip("-.") or "robot"
    of_what = ".within-limits" if inside else ""
    own = f"{plain}{of_what}.certificate.json"
    name = re.split(r"[\\/]", str(given))[-1] if given else own
    shown = name if re.fullmatch(r"[A-Za-z0-9._-]+", name) else f"'{name}'"
    link = _data_link(text) if text is not None else ""
    return {"name": name, "command": f"cuspaudit verify {shown}", "link": link}


def _data_link(text: str) -> str:
    return "data:application/json;base64," + base64.b64encode(text.encode()).decode()


def _finite(value: Any) -> Any:
    """The value with null for numbers that JSON cannot write."""
    if isinstance(value, Mapping):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
