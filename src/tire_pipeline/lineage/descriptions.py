"""What kedro-viz lacks: it reads the catalog's ``metadata.description`` and shows it nowhere."""

from __future__ import annotations

import json
import re
from pathlib import Path

_SHOW = """
(function (known) {
  var exact = known.exact, patterns = known.patterns.map(function (pair) {
    return [new RegExp(pair[0]), pair[1]];
  });
  function textOf(name) {
    if (Object.prototype.hasOwnProperty.call(exact, name)) return exact[name];
    var found = patterns.find(function (pair) { return pair[0].test(name); });
    return found ? found[1] : "";
  }
  function show() {
    var list = document.querySelector(".pipeline-metadata__list");
    var title = document.querySelector(".pipeline-metadata__title");
    if (!list || !title) return;
    var text = textOf(title.textContent.trim()), place = document.getElementById("tire-description");
    if (!place || place.nextSibling !== list) {
      if (place) place.remove();
      place = document.createElement("p");
      place.id = "tire-description";
      place.style.cssText = "margin:0 36px 20px;font-size:15px;line-height:1.5";
      list.before(place);
    }
    if (place.textContent !== text) place.textContent = text;
  }
  function watch() {
    new MutationObserver(show).observe(document.body, {childList: true, subtree: true, characterData: true});
  }
  if (document.body) watch(); else document.addEventListener("DOMContentLoaded", watch);
})
"""


def described(html: str, project: Path, env: str | None = None) -> str:
    """Add the descriptions of datasets and nodes to kedro-viz's page, above what the panel says.

    Parameters
    ----------
    html : str
        ``index.html`` of kedro-viz.
    project : Path
        Its configuration and pipelines are read.
    env : str, optional
        Configuration environment.

    Returns
    -------
    str
    """
    known = json.dumps(descriptions(project, env)).replace("<", "\\u003c")
    return html.replace("<head>", f"<head>\n<script>{_SHOW}({known});</script>", 1)


def descriptions(project: Path, env: str | None = None) -> dict[str, object]:
    """Texts by name (``exact``), and by regular expression for factories of datasets (``patterns``)."""
    from kedro.framework.project import pipelines
    from kedro.framework.session import KedroSession
    from kedro.framework.startup import bootstrap_project

    bootstrap_project(project)
    session = KedroSession.create(project_path=project, env=env)
    with session:
        catalog = session.load_context().config_loader["catalog"]
    exact: dict[str, str] = {}
    for pipeline in pipelines.values():
        for node in pipeline.nodes:
            text = (node.func.__doc__ or "").strip().split("\n\n")[0]
            exact[node.name] = exact[node.name.split(".")[-1]] = " ".join(text.split())
    patterns = []
    for name, entry in catalog.items():
        text = (entry.get("metadata") or {}).get("description", "")
        if "{" in name:
            parts = re.split(r"\{\w+\}", name)
            patterns.append((f"^{'[^.]+'.join(map(re.escape, parts))}$", text))
        elif text:
            exact[name] = text
    return {"exact": exact, "patterns": patterns}
