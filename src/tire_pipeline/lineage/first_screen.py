"""What kedro-viz shows first: the groups of the story from left to right, and nothing from a network."""

from __future__ import annotations

import json
import re

FIRST_PIPELINE = "story"
PREFERENCES = {
    "orientation": "horizontal",
    "theme": "light",
    "showFeatureHints": False,
    "pipeline": {"active": FIRST_PIPELINE},
    "nodeType": {"disabled": {"parameters": True, "task": False, "data": True}},
    "visible": {"miniMap": False},
}

# The version stands over the time of the build in the same corner.
_HIDDEN_REMINDER = "<style>.update-reminder-version-tag{display:none}</style>"


def prepared(html: str) -> str:
    """kedro-viz's page with our preferences, until the reader chooses others; no web fonts, no telemetry.

    Parameters
    ----------
    html : str
        ``index.html`` of kedro-viz.

    Returns
    -------
    str
    """
    html = re.sub(r"<link\b[^>]*fonts\.g(?:oogleapis|static)\.com[^>]*>", "", html)
    html = re.sub(r"<script[^>]*>\s*window\.heap.*?</script>", "", html, flags=re.S)  # telemetry
    return html.replace("<head>", f"<head>\n<script>{_script()}</script>\n{_HIDDEN_REMINDER}", 1)


def _script() -> str:
    wanted = json.dumps(PREFERENCES)
    return (
        "(function () { try {"
        "var key = 'KedroViz', kept = JSON.parse(localStorage.getItem(key) || '{}');"
        f"if (!kept.orientation) localStorage.setItem(key, JSON.stringify(Object.assign(kept, {wanted})));"
        "if (!location.search && location.protocol !== 'file:')"
        f" history.replaceState(null, '', '?pid={FIRST_PIPELINE}&types=nodes');"
        "} catch (error) { console.warn(error); } })();"
    )
