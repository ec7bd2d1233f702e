"""A file that cannot be read is named once in a run's log, whichever of its pipelines read it."""

from __future__ import annotations

import io
import logging

import pytest

from tire_pipeline.datasets import TirFolderDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.kedro_runs.node_progress import NodeProgressHooks
from tire_pipeline.tire_table.read_files import IngestParameters, join_files, read_files
from tire_pipeline.translation.files.translated_block import TranslatedPart, packed_part
from tire_pipeline.translation.files.translated_folder import join_translated
from tire_pipeline.translation.parameters import TranslateParameters


@pytest.fixture
def said():
    """What a run's log shows."""
    stream = io.StringIO()
    handler, root = logging.StreamHandler(stream), logging.getLogger()
    root.addHandler(handler)
    yield stream
    root.removeHandler(handler)


class _Nodes:
    nodes = ()


def _broken():
    raise DomainError("no coefficient in it")


def _ingest(*files):
    blocks = read_files(dict.fromkeys(files, _broken))
    join_files(
        {name: (lambda block=block: bytes(block())) for name, block in blocks.items()},
        IngestParameters(most_failed_share=1.0),
    )


def _translate(*files):
    rows = [{"file": file, "verdict": "refused", "reason": "cannot be read"} for file in files]
    part = packed_part({}, {}, rows, {}, TranslatedPart)
    with pytest.raises(DomainError, match="none of"):
        join_translated({"0.zip": lambda: part}, {}, TranslateParameters())


def test_a_run_of_ingest_and_translate_names_a_file_once_and_the_next_run_again(said):
    hooks = NodeProgressHooks()
    hooks.before_pipeline_run(_Nodes)
    _ingest("A/1.tir", "A/2.tir")
    _translate("A/2.tir", "B/3.tir")
    text = said.getvalue()
    assert [text.count(name) for name in ("A/1.tir", "A/2.tir", "B/3.tir")] == [1, 1, 1]
    assert "B/3.tir is refused" in text
    hooks.after_pipeline_run()
    _translate("A/2.tir")
    assert said.getvalue().count("A/2.tir") == 2


def test_a_link_to_what_is_taken_is_named_once_too(said, tmp_path, monkeypatch):
    """Each of 21 lines came twice where ingest_tir and translate were run together."""
    monkeypatch.setattr(logging.getLogger("tire_pipeline"), "level", logging.INFO)
    (tmp_path / "A").mkdir()
    (tmp_path / "A" / "1.tir").write_text("a tire")
    for number in range(25):
        (tmp_path / f"again{number}").symlink_to("A")
    hooks = NodeProgressHooks()
    hooks.before_pipeline_run(_Nodes)
    for _ in range(2):
        TirFolderDataset(path=str(tmp_path)).load()
    hooks.after_pipeline_run()
    assert said.getvalue().count("taken already.") == 21
