"""The content security policy of the site: its own files, and what stands in a page when it is built."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tire_pipeline.pages.safe_page import source_hash

_ELEMENT = r"<{0}(?P<attributes>[^>]*)>(?P<text>.*?)</{0}>"
_SCRIPT, _STYLE = (re.compile(_ELEMENT.format(name), re.S) for name in ("script", "style"))
_HERE = "'self' file:"  # opened from a file, a page has no origin that 'self' could name


def with_policy(html: str) -> str:
    """Write the policy into a page, before anything that it is about.

    Parameters
    ----------
    html : str
        As the theme has made it. Each script and style that stands in it is named by its hash.

    Returns
    -------
    str
        Figures of Matplotlib have ``style`` attributes. The theme's search runs in a worker, or, opened from
        a file, in a frame that has this policy, too.
    """
    policy = "; ".join(
        [
            "default-src 'none'",
            f"script-src {_HERE} {' '.join(_hashes(_SCRIPT, html))}",
            f"style-src {_HERE} {' '.join(_hashes(_STYLE, html))}".rstrip(),
            "style-src-attr 'unsafe-inline'",
            f"img-src {_HERE} data:",
            f"font-src {_HERE}",
            f"connect-src {_HERE}",
            f"worker-src {_HERE}",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )
    meta = f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
    head, charset, rest = html.partition('<meta charset="utf-8">')
    if not charset:
        raise ValueError("the theme's pages begin otherwise than is known")
    return f"{head}{charset}\n      {meta}{rest}"


def _hashes(element: re.Pattern[str], html: str) -> Iterator[str]:
    found = (each for each in element.finditer(html) if " src=" not in each["attributes"])
    texts = [each["text"] for each in found if "application/json" not in each["attributes"]]
    yield from map(source_hash, dict.fromkeys(texts))
