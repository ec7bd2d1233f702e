"""The gallery: scripts in docs/gallery are run, and shown with what they print and draw; notebooks beside them.

A script ends with a ``figure``, and the last paragraph of its docstring says what to see in it: ``Picture: ...``.
What it gave is kept in ``.cache/gallery`` for as long as neither the script, nor
the examples, nor the package changes.
"""

from __future__ import annotations

import ast
import contextlib
import hashlib
import html
import io
import json
import os
import runpy
import warnings
from functools import cache
from pathlib import Path

import nbformat

INTRODUCTION = """# Gallery

Short scripts, run when these pages were built. Run them from the project's root with the environment active, for example
`python docs/gallery/read_and_plot.py`. They need no data but `examples/`.
"""


def scripts(root: Path) -> list[Path]:
    """Return the scripts in the order of the gallery."""
    order = (root / "docs/gallery/order.txt").read_text("utf-8").split()
    found = {path.stem: path for path in (root / "docs/gallery").glob("*.py")}
    if set(order) != set(found):
        raise ValueError(f"docs/gallery/order.txt and the scripts differ: {sorted(set(order) ^ set(found))}")
    return [found[name] for name in order]


def notebooks(root: Path) -> list[Path]:
    """Return the notebooks, in order."""
    return sorted((root / "notebooks").glob("*.ipynb"))


def navigation(root: Path) -> list[dict[str, str]]:
    """Return the entries of the navigation."""
    entries = [{parts_of(path)[0]: f"gallery/{path.stem}.md"} for path in scripts(root)]
    return entries + [{_title(path): f"gallery/notebook_{path.stem}.md"} for path in notebooks(root)]


def pages(root: Path) -> dict[str, str | bytes]:
    """Run every script and return the pages and pictures."""
    made: dict[str, str | bytes] = {}
    cards = []
    for path in scripts(root):
        title, text, caption, code = parts_of(path)
        printed, picture = run(path, root)
        made[f"gallery/{path.stem}.png"] = picture
        parts = [f"# {title}", text, f"```python\n{code}\n```"]
        if printed.strip():
            parts.append(f"It prints:\n\n```text\n{printed.rstrip()}\n```")
        parts += [f"![{title}]({path.stem}.png)", f"*{caption}*"]
        made[f"gallery/{path.stem}.md"] = "\n\n".join(parts) + "\n"
        cards.append(f'<a href="{path.stem}.html"><img alt="" src="{path.stem}.png">{html.escape(title)}</a>')
    listed = []
    for path in notebooks(root):
        made[f"gallery/notebook_{path.stem}.md"] = notebook_page(path)
        listed.append(f"- [{_title(path)}](notebook_{path.stem}.md)")
    made["gallery/README.md"] = (
        f'{INTRODUCTION}\n<div class="gallery-cards">\n{"".join(cards)}\n</div>\n\n## Notebooks\n\n'
        "The tests run them from the first cell to the last.\n\n" + "\n".join(listed) + "\n"
    )
    return made


def parts_of(path: Path) -> tuple[str, str, str, str]:
    """Title, text, caption of the picture and code of a script."""
    source = path.read_text("utf-8")
    tree = ast.parse(source)
    said, found, caption = (ast.get_docstring(tree) or "").partition("\n\nPicture: ")
    if not found:
        raise ValueError(f"{path}: the docstring has to end with a paragraph 'Picture: what to see in it'")
    title, _, text = said.partition("\n")
    code = "\n".join(source.splitlines()[tree.body[0].end_lineno or 0 :]).strip()
    return title.rstrip("."), text.strip(), " ".join(caption.split()), code


@cache
def _state_of(root: Path) -> str:
    """A hash of all that scripts rest on beside themselves."""
    digest = hashlib.sha256()
    for folder, pattern in (("src/tire_pipeline", "**/*.py"), ("src/tire_pipeline", "**/*.json"), ("examples", "*")):
        for path in sorted((root / folder).glob(pattern)):
            if path.is_file():
                digest.update(path.read_bytes())
    return digest.hexdigest()


def run(path: Path, root: Path) -> tuple[str, bytes]:
    """Return what a script prints and the picture it draws (PNG)."""
    key = hashlib.sha256((_state_of(root) + path.read_text("utf-8")).encode()).hexdigest()[:20]
    kept = root / ".cache" / "gallery" / f"{path.stem}_{key}.json"
    picture = kept.with_suffix(".png")
    if kept.exists() and picture.exists():
        return json.loads(kept.read_text("utf-8")), picture.read_bytes()
    printed, before = io.StringIO(), Path.cwd()
    try:
        os.chdir(root)
        with contextlib.redirect_stdout(printed), warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            figure = runpy.run_path(str(path), run_name="__main__")["figure"]
    finally:
        os.chdir(before)
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=90, metadata={"Software": None})
    for old in kept.parent.glob(f"{path.stem}_*"):
        old.unlink()
    kept.parent.mkdir(parents=True, exist_ok=True)
    picture.write_bytes(drawn.getvalue())
    kept.write_text(json.dumps(printed.getvalue()), encoding="utf-8")
    return printed.getvalue(), drawn.getvalue()


def _title(path: Path) -> str:
    first = nbformat.read(path, as_version=4).cells[0].source.splitlines()[0]
    return f"Notebook: {first.lstrip('# ').replace('`', '')}"


def notebook_page(path: Path) -> str:
    """Return a notebook with its stored outputs as a page."""
    parts = []
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "markdown":
            parts.append(cell.source)
            continue
        parts.append(f"```python\n{cell.source}\n```")
        parts += [shown for output in cell.get("outputs", []) if (shown := _output(output))]
    return "\n\n".join(parts) + "\n"


def _output(output: nbformat.NotebookNode) -> str:
    data = output.get("data", {})
    if output.output_type == "stream":
        return f"```text\n{output.text.rstrip()}\n```"
    if "text/html" in data:
        # One line: Markdown ends a block of HTML at a blank line.
        return f'<div class="notebook-output">{" ".join(data["text/html"].split())}</div>'
    if "image/png" in data:
        return f'<img alt="" src="data:image/png;base64,{"".join(data["image/png"].split())}">'
    if "text/plain" in data:
        return f"```text\n{data['text/plain'].rstrip()}\n```"
    return ""
