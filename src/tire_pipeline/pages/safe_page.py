"""Pages that show text from files but never run it: all is escaped, and a policy limits what may run."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterable
from typing import Any

import jinja2
from markupsafe import Markup

from tire_pipeline.pages.visible_text import visible


def page_environment(package: str) -> jinja2.Environment:
    """Templates of a package: what they show is escaped, and made visible first.

    Parameters
    ----------
    package : str
        Its folder ``templates`` holds them; they may extend ``base.html`` of
        ``tire_pipeline/pages/templates``.
        What is not text from outside must be ``Markup``.

    Returns
    -------
    jinja2.Environment
    """
    environment = jinja2.Environment(
        loader=jinja2.ChoiceLoader(
            [jinja2.PackageLoader(package), jinja2.PackageLoader("tire_pipeline.pages")]
        ),
        autoescape=True,
        finalize=_finalised,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters["coded"] = _coded
    return environment


def _finalised(value: Any) -> Any:
    return value if not isinstance(value, str) or hasattr(value, "__html__") else visible(value)


def _coded(text: str) -> Markup:
    """Escape a text and set what stands between backticks as code: commands and files."""
    parts = re.split(r"`([^`]+)`", text)
    return Markup("").join(
        Markup("<code>{}</code>" if i % 2 else "{}").format(visible(part)) for i, part in enumerate(parts)
    )


def source_hash(text: str) -> str:
    """Hash of a script or style as a content security policy names it."""
    digest = hashlib.sha256(text.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"


def policy(*, style: str, scripts: Iterable[str] = (), figures: bool = False, pictures: bool = False) -> str:
    """Allow a page its own style and scripts, and nothing else from anywhere.

    Parameters
    ----------
    style : str
        What stands in its ``<style>``.
    scripts : iterable of str
        What stands in each of its ``<script>`` elements that run.
    figures : bool
        It shows figures of Matplotlib, which writes ``style`` attributes.
    pictures : bool
        It shows pictures that lie beside it.

    Returns
    -------
    str
        For ``<meta http-equiv="Content-Security-Policy">``.
    """
    runs = " ".join(map(source_hash, scripts))
    return "; ".join(
        [
            "default-src 'none'",
            *([f"script-src {runs}"] if runs else []),
            f"style-src {source_hash(style)}",
            *(["style-src-attr 'unsafe-inline'"] if figures else []),
            "img-src 'self' file: data:" if pictures else "img-src data:",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )
