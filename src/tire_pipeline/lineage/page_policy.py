"""What may run in kedro-viz's page: its own scripts, by their hashes; never what a table or a name says."""

from __future__ import annotations

import re

from tire_pipeline.pages.safe_page import source_hash

_SCRIPT = re.compile(r"<script(?P<attributes>[^>]*)>(?P<text>.*?)</script>", re.S | re.I)


def with_policy(html: str, *, served: bool) -> str:
    """Write a content security policy into kedro-viz's page.

    Parameters
    ----------
    html : str
        The page before any content of files stands in it: every script in it now may run.
    served : bool
        By kedro-viz's server, whose scripts and data it then may load. Otherwise nothing is loaded.

    Returns
    -------
    str
        Styles may stand anywhere: kedro-viz's libraries (emotion, d3) write them while the page runs.
    """
    scripts = [found for found in _SCRIPT.finditer(html) if "application/json" not in found["attributes"]]
    hashes = " ".join(source_hash(found["text"]) for found in scripts if " src=" not in found["attributes"])
    own = "'self' " if served else ""
    policy = "; ".join(
        [
            "default-src 'none'",
            f"script-src {own}{hashes}",
            f"style-src {own}'unsafe-inline'",
            f"img-src {own}data: blob:",
            f"font-src {own}data:",
            *(["connect-src 'self'", "manifest-src 'self'"] if served else []),
            f"worker-src {own}blob:",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )
    meta = f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
    return html.replace("<head>", f"<head>\n{meta}", 1)
