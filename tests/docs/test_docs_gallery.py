"""Each script of the gallery says what it shows and what to see in its picture."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/_build"))


@pytest.fixture
def gallery():
    """Imported where it is needed: it takes seconds."""
    return pytest.importorskip("gallery", reason="pip install -e .[docs]")


def test_every_script_is_in_the_order_of_the_gallery(gallery):
    assert gallery.scripts(ROOT)


@pytest.mark.parametrize("path", sorted((ROOT / "docs/gallery").glob("*.py")), ids=lambda path: path.stem)
def test_a_script_has_title_text_and_caption(gallery, path):
    title, text, caption, code = gallery.parts_of(path)
    assert min(map(len, (title, text, caption))) > 10
    assert caption.endswith(".")
    assert "Picture: " not in text + code
    compile(code, str(path), "exec")


def test_a_script_without_a_caption_stops_the_build(gallery, tmp_path):
    script = tmp_path / "one.py"
    script.write_text('"""Title.\n\nWhat it shows.\n"""\nfigure = None\n')
    with pytest.raises(ValueError, match=r"has to end with a paragraph 'Picture: "):
        gallery.parts_of(script)
