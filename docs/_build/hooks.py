"""What mkdocs asks while it builds the site: pages that are generated from the code, and the gallery."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
os.environ.setdefault("MPLBACKEND", "Agg")
os.environ.setdefault("OMP_NUM_THREADS", "1")

from mkdocs.config.defaults import MkDocsConfig  # noqa: E402
from mkdocs.exceptions import PluginError  # noqa: E402
from mkdocs.structure.files import File, Files  # noqa: E402
from mkdocs.structure.pages import Page  # noqa: E402

_ROLE = re.compile(r":(?:func|class|meth|mod|attr|data|exc):<code>[.~]*([\w.]+)</code>")


def _reach() -> None:
    """Let the modules beside this one be imported; mkdocs takes back what a hook adds while it loads."""
    for folder in (HERE, ROOT / "src"):
        if str(folder) not in sys.path:
            sys.path.insert(0, str(folder))


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the generated pages and pictures."""
    _reach()
    import api
    import effects_page
    import gallery
    import pipelines_page

    made: dict[str, str | bytes] = {
        "reference/effects.md": effects_page.page(),
        "reference/pipelines.md": pipelines_page.page(ROOT),
        "reference/api.md": api.page(ROOT / "src" / "tire_pipeline"),
        **gallery.pages(ROOT),
    }
    for path, content in made.items():
        old = files.get_file_from_path(path)
        if old is not None:
            files.remove(old)
        files.append(File.generated(config, path, content=content))
    return files


def on_config(config: MkDocsConfig, **_: Any) -> MkDocsConfig:
    """Put the gallery's examples into the navigation."""
    _reach()
    import gallery

    for part in config.nav or []:
        if "Gallery" in part:
            part["Gallery"] = ["gallery/README.md", *gallery.navigation(ROOT)]
    return config


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Make links of public names, and stop at a name that the code no longer has. History keeps its names."""
    if page.file.src_uri.startswith("history/") or page.file.src_uri == "reference/api.md":
        return markdown
    _reach()
    import api
    import code_names

    from tire_pipeline.mismatch.effects import GROUP

    named = code_names.stale(markdown, frozenset({GROUP}))
    if named:
        raise PluginError(f"{page.file.src_uri}: the code has no {', '.join(named)}")
    return code_names.linked(markdown, api.public_names(ROOT / "src" / "tire_pipeline"))


def on_page_content(html: str, page: Page, **_: Any) -> str:
    """Make links of the names to which docstrings refer, where the page has them."""
    if page.file.src_uri != "reference/api.md":
        return html
    anchors = re.findall(r'id="(tire_pipeline\.[\w.]+)"', html)

    def named(found: re.Match[str]) -> str:
        *above, last = found[1].split(".")
        name = f"{above[-1]}.{last}" if above and above[-1][0].isupper() else last
        at = next((each for each in anchors if each.endswith(f".{name}")), "")
        return f'<a href="#{at}"><code>{name}</code></a>' if at else f"<code>{found[1]}</code>"

    return _ROLE.sub(named, html)


def on_post_page(output: str, **_: Any) -> str:
    """Let nothing run in a page but the site's own scripts."""
    _reach()
    from site_policy import with_policy

    return with_policy(output)


def on_post_build(config: MkDocsConfig, **_: Any) -> None:
    """Take away the page for addresses that a server does not find: opened from a file it lacks its looks."""
    (Path(config.site_dir) / "404.html").unlink(missing_ok=True)
