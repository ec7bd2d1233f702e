"""``python -m tire_pipeline.lineage.one_page build lineage.html``: ``kedro viz build`` as one file.

What ``kedro viz build`` writes needs a server: browsers load neither modules nor data from ``file:``
addresses. Here script, style and data stand in the page itself.
"""

from __future__ import annotations

import argparse
import json
import re
from pathlib import Path
from typing import cast

from tire_pipeline.errors import DomainError
from tire_pipeline.files.atomic import write_bytes
from tire_pipeline.kedro_runs.run_errors import errors_in_one_line
from tire_pipeline.lineage.descriptions import described, descriptions
from tire_pipeline.lineage.first_screen import prepared
from tire_pipeline.lineage.page_policy import with_policy
from tire_pipeline.pages.visible_text import visible_texts
from tire_pipeline.reporting.embedded import data_element
from tire_pipeline.reporting.front import FRONT, front_page

_FETCH = """
(function () {
  var kept = JSON.parse(document.getElementById("api").textContent), original = window.fetch;
  window.fetch = function (address) {
    var found = /api\\/(.+?)(?:[?#].*)?$/.exec(String(address && address.url || address));
    if (!found) return original.apply(this, arguments);
    var body = kept[found[1].replace(/\\/$/, "")], known = body !== undefined;
    return Promise.resolve(new Response(known ? JSON.stringify(body) : "{}",
      {status: known ? 200 : 404, headers: {"Content-Type": "application/json"}}));
  };
})();
"""


def one_page(build: Path, project: Path | None = None) -> str:
    """One self-contained page from a ``kedro viz build``.

    Parameters
    ----------
    build : Path
        The folder that ``kedro viz build`` wrote.
    project : Path, optional
        Show the descriptions of its datasets and nodes.

    Raises
    ------
    DomainError
        It is not such a folder.
    """
    index = build / "index.html"
    if not (index.is_file() and (build / "api").is_dir()):
        raise DomainError(
            "there is no kedro-viz build here", where=str(build), todo="run `kedro viz build` first"
        )
    html = prepared(index.read_text(encoding="utf-8"))
    api = {
        path.relative_to(build / "api").as_posix(): json.loads(path.read_text(encoding="utf-8"))
        for path in sorted((build / "api").rglob("*"))
        if path.is_file()
    }
    html = re.sub(r'<link rel="shortcut icon"[^>]*>', "", html)
    html = re.sub(
        r'<link rel="stylesheet"[^>]*href="\./([^"]+)"[^>]*>',
        lambda found: f"<style>{(build / found[1]).read_text(encoding='utf-8')}</style>",
        html,
    )
    html = re.sub(
        r'<script type="module"[^>]*src="\./([^"]+)"[^>]*></script>',
        lambda found: f'<script type="module">{_inside(build / found[1])}</script>',
        html,
    )
    fetch = f"<script>{_FETCH}</script>"
    html = html.replace("<head>", f"<head>\n{fetch}", 1)
    if project is not None:
        html = described(html, project)
    html = with_policy(html, served=False)
    data = data_element("api", visible_texts(api))
    return html.replace(fetch, data + fetch, 1)  # last: no script of it may run


def _inside(script: Path) -> str:
    text = script.read_text(encoding="utf-8")
    return re.sub(r"</(script)", r"<\\/\1", text, flags=re.I).replace("<!--", "\\x3c!--")


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path)
    parser.add_argument("page", type=Path)
    parser.add_argument("--project", type=Path, default=Path.cwd())
    arguments = parser.parse_args()
    project = arguments.project.resolve()
    with errors_in_one_line():
        page = one_page(arguments.build, project)
        write_bytes(arguments.page, page.encode())
        print(f"lineage: {arguments.page}")
        _link(arguments.page, project)


def _link(page: Path, project: Path) -> None:
    """Write the front page beside the lineage again, so that it links it without another run."""
    front = page.with_name(FRONT)
    if front.is_file():
        told = cast("dict[str, str]", descriptions(project)["exact"])
        write_bytes(front, front_page(front.parent, told).encode())


if __name__ == "__main__":
    main()
