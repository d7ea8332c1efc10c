"""The table of the atlas as one page: sorted, filtered and searched by the reader."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from markupsafe import Markup

from cuspaudit.atlas.entry import Entry
from cuspaudit.viz.offline import asset, environment, policy

__all__ = ["index_html"]


def index_html(title: str, entries: Sequence[Entry]) -> str:
    """The page; it needs no network, and its rows are there without JavaScript too."""
    audited = [entry for entry in entries if not entry.error]
    script = asset("atlas.js")
    return (
        environment()
        .get_template("atlas.html")
        .render(
            title=title,
            entries=audited,
            refused=[entry for entry in entries if entry.error],
            counts=Counter(entry.verdict for entry in audited),
            proved=sum(bool(entry.certificate) for entry in audited),
            makers=sorted({entry.maker for entry in audited if entry.maker}),
            tasks=sorted({entry.task for entry in audited}),
            structures=sorted({entry.structure for entry in audited}),
            pictures={entry.slug: Markup(entry.picture) for entry in audited},
            style=Markup(asset("atlas.css")),
            script=Markup(script),
            policy=policy([script]),
        )
    )
