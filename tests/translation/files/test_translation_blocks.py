"""Files are translated some at a time: to the last bit as if all were translated together."""

from __future__ import annotations

from functools import partial
from unittest.mock import ANY

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.datasets import ComputedFolderDataset, TextFolderDataset
from tire_pipeline.errors import DomainError, TirError
from tire_pipeline.files.rows_on_disk import joined
from tire_pipeline.numerics.row_products import by_row
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.translation.files import translated_folder
from tire_pipeline.translation.files.chosen_files import choose_files
from tire_pipeline.translation.files.translated_block import TABLES, table_in, texts_in
from tire_pipeline.translation.files.translated_folder import join_translated, translate_each
from tire_pipeline.translation.parameters import TranslateParameters
from tire_pipeline.translation.translator import MixedModel

pytestmark = pytest.mark.slow
NORMALIZE = NormalizeParameters(nominal_load=6000.0)


def _broken() -> None:
    raise TirError("no tire", path="A/broken.tir", todo="mend it")


@pytest.fixture(scope="module")
def files(fleet):
    """Files of five suppliers, one of an unknown one, and one that cannot be read."""
    some = sorted(name for name in fleet.evaluation if name.startswith("hidden"))[::5]  # several tires
    found = {
        name.removeprefix("hidden/"): partial(read_tir, fleet.evaluation[name].encode("latin-1"))
        for name in some
    }
    return {**found, "nobody/1.tir": next(iter(found.values())), "A/broken.tir": _broken}


@pytest.fixture(scope="module")
def learning(made, training):
    """A translator that also learns from the files to translate."""
    return MixedModel(pairs=False, learn_from_batch=True).fit(training, target="D", made=made)


def _blocks(monkeypatch, size, translator, files, training):
    monkeypatch.setattr(translated_folder, "TRANSLATED_TOGETHER", size)
    parameters = TranslateParameters(farthest=3.0)
    return translate_each(translator.to_state(), files, training, parameters, NORMALIZE, 0)


def _translated(blocks, translator):
    """What a run makes of the blocks, each done once and stored."""
    blocks = {name: partial(bytes, block()) for name, block in blocks.items()}
    files, report, *tables, _ = join_translated(blocks, translator.to_state(), TranslateParameters())
    frames = {"report": joined(report)}
    for name, loads in zip(("sources", "coefficients", "bands"), tables, strict=True):
        frame = pd.concat([part for part in (load() for load in loads) if len(part)], ignore_index=True)
        keys = [key for key in ("file", "coefficient", "output", "normal_load", "slip") if key in frame]
        frames[name] = frame.sort_values(keys, ignore_index=True)
    return {name: text() for name, text in sorted(files.items())}, frames


@pytest.mark.parametrize("which", ["mixed", pytest.param("learning", marks=pytest.mark.long)])
def test_blocks_of_any_size_give_the_same_to_the_last_bit(which, request, monkeypatch, files, training):
    translator = request.getfixturevalue(which)
    one, several = (_blocks(monkeypatch, size, translator, files, training) for size in (100, 4))
    assert len(one) == 1
    assert len(several) > 1
    texts, whole = _translated(one, translator)
    assert len(texts) > 3
    again, frames = _translated(several, translator)
    assert again == texts
    for name in TABLES:
        pd.testing.assert_frame_equal(frames[name], whole[name], check_exact=True)
    rows = whole["report"].set_index("file")
    assert rows.loc["nobody/1.tir", "verdict"] == "unknown supplier"
    assert "cannot be read" in rows.loc["A/broken.tir", "reason"]
    assert list(rows.index) == [*sorted(set(rows.index) - {"A/broken.tir"}), "A/broken.tir"]
    if which == "learning":
        assert rows["taught"].max() > 0


def test_a_divided_block_gives_what_the_whole_gives(mixed, monkeypatch, files, training):
    three = {file: files[file] for file in (*list(files)[:3], "A/broken.tir")}
    (block,) = _blocks(monkeypatch, 100, mixed, three, training).values()
    parts = {file: part() for file, part in block.split().items()}
    whole, joined = block(), block.join(list(parts.values()))
    assert texts_in(joined) == texts_in(whole)
    assert joined.failures == whole.failures
    assert list(whole.failures) == ["A/broken.tir"]
    both = (table_in(each, "report").sort_values("file", ignore_index=True) for each in (joined, whole))
    pd.testing.assert_frame_equal(*both, check_exact=True)
    lost = next(iter(block.split().values())).lost("its worker died")
    assert lost.passing
    assert list(lost.failures.values()) == ["its worker died"]


def test_a_block_is_done_again_when_what_it_depends_on_changes(mixed, monkeypatch, files, training):
    some = {name: Same(load) for name, load in files.items()}
    names = [set(_blocks(monkeypatch, 3, mixed, some, training)) for _ in range(2)]
    assert names[0] == names[1]
    other = mixed.with_verdict(gate=False)
    assert not names[0] & set(_blocks(monkeypatch, 3, other, some, training))
    changed = {**some, "nobody/1.tir": files["nobody/1.tir"]}
    assert len(names[0] - set(_blocks(monkeypatch, 3, mixed, changed, training))) == 1


class Same:
    """A reader that knows that its file has not changed."""

    def __init__(self, load):
        self.load = load

    def __call__(self):
        return self.load()

    def fingerprint(self):
        return "as it was"


def test_what_is_unusual_in_a_file_stands_in_its_row(mixed, monkeypatch, files, training):
    """A second stiffness was read in silence; only the table of the files that were learned from told."""
    model = next(load() for name, load in files.items() if name.startswith("A/"))
    line = next(x for x in model.source.text.splitlines() if x.startswith("PKY1"))
    text = model.source.text.replace(line, f"{line}\nPKY1 = -60\nPCY1 = 1.5")
    some = {"A/plain.tir": lambda: model, "A/twice.tir": partial(read_tir, text.encode("latin-1"))}
    _, found = _translated(_blocks(monkeypatch, 9, mixed, some, training), mixed)
    notes = found["report"].set_index("file")["notes"]
    twice = notes["A/twice.tir"].split(" | ")
    assert len(twice) == len(notes["A/plain.tir"].split(" | ")) + (2 if notes["A/plain.tir"] else 1)
    assert any(each.startswith("PKY1 has two values") for each in twice)


def test_a_run_for_some_files_keeps_what_was_translated_of_the_others(mixed, files, training, tmp_path):
    folder = TextFolderDataset(path=str(tmp_path / "translated"))
    blocks = ComputedFolderDataset(path=str(tmp_path / "blocks"), only_the_last=True)
    state = mixed.to_state()

    def run(files, **asked):
        parameters = TranslateParameters(farthest=3.0, **asked)
        chosen = choose_files(files, parameters)
        blocks.save(translate_each(state, chosen, training, parameters, NORMALIZE, 0))
        folder.save(join_translated(blocks.load(), state, parameters)[0])
        return {*folder.load()}, {path.name for path in (tmp_path / "blocks").rglob("*.zip")}

    everything, stored = run(files)
    first, *others = sorted(everything)
    broken = {**files, first: _broken}
    assert run(broken, only=[first, others[0]])[0] == {*others}
    assert run(files, only=[first]) == (everything, ANY)
    assert stored < run(files, trials=2)[1]
    assert run({name: files[name] for name in (*others, "nobody/1.tir")})[0] == {*others}


def test_no_file_can_be_read(mixed, monkeypatch, training):
    blocks = _blocks(monkeypatch, 3, mixed, {"A/broken.tir": _broken}, training)
    with pytest.raises(
        DomainError, match="none of 1 files could be read; the first: cannot be read: A/broken"
    ):
        join_translated(blocks, mixed.to_state(), TranslateParameters())


@pytest.mark.parametrize("count", [1, 2, 31, 32, 33, 250])
def test_a_product_of_many_rows_is_that_of_each(count):
    generator = np.random.default_rng(1)
    rows, matrix = generator.normal(size=(250, 37)), generator.normal(size=(37, 120))
    whole = by_row(rows, matrix)
    np.testing.assert_allclose(whole, rows @ matrix, rtol=1e-12, atol=1e-12)
    for start in range(0, 250, count):
        part = by_row(rows[start : start + count], matrix)
        assert part.tobytes() == whole[start : start + count].tobytes()
