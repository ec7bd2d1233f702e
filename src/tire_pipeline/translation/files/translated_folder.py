"""The user's files -> files as the target would have measured them, with a verdict for each."""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.suppliers import KnownSuppliers
from tire_pipeline.code_hash import code_hash
from tire_pipeline.errors import DomainError
from tire_pipeline.files.added_files import AddedFiles
from tire_pipeline.files.read_later import StoredFiles
from tire_pipeline.files.rows_on_disk import FramesOfRows, RowsOnDisk, plain_rows
from tire_pipeline.files.state_files import state_digest
from tire_pipeline.progress import track
from tire_pipeline.tasks import Map, all_done, in_turn
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.tire_table.read_blocks import TireFiles, digest_of, divided
from tire_pipeline.tire_table.read_files import NAMED_IN_LOG, name_unread
from tire_pipeline.translation.base import JudgingTranslator, judging, translator_from_state
from tire_pipeline.translation.files.translated_block import (
    Given,
    LookForTeachers,
    TranslateBlock,
    has_tables,
    table_in,
    texts_in,
    translated_in,
    unreadable_in,
)
from tire_pipeline.translation.parameters import TranslateParameters

_LOG = logging.getLogger(__name__)
TRANSLATED_TOGETHER = 500
"""So many files are translated together, two seconds' work."""
TRANSLATION_TYPES = {
    "file": "str",
    "supplier_known": "str",
    "source": "str",
    "source_probability": "float64",
    "target": "str",
    "verdict": "str",
    "reason": "str",
    "distance": "float64",
    "expected_rms_ratio": "float64",
    "harm_probability": "float64",
    "bias_band": "str",
    "taught": "Int64",
    "protocol": "str",
    "changes": "str",
    "notes": "str",
}
"""Columns of the report of all files, and their types: :class:`.result.TranslationResult`, and ``notes``:
what is unusual in each file."""
_IN_ORDER = "from rows order by unreadable, file"
_FROM_TRANSLATED = "from rows where part is not null"
_REPORT_QUERY = f"select {', '.join(TRANSLATION_TYPES)} {_IN_ORDER}"


def translate_each(
    translator: dict[str, Any],
    chosen_files: TireFiles,
    normalized_table: pd.DataFrame,
    parameters: TranslateParameters,
    normalize: NormalizeParameters,
    seed: int,
    *,
    work: Map = in_turn,
) -> dict[str, TranslateBlock]:
    """Translate the files, some hundred at a time; what is stored and unchanged is not translated again.

    A task's name says all that its result depends on: what is stored under that name is not done again.

    Parameters
    ----------
    translator : dict
        State of a fitted translator.
    chosen_files : mapping
        ``category/.../name.tir`` to the function that reads it: :func:`.chosen_files.choose_files`.
    normalized_table : DataFrame
        The training files. Their categories are the known ones.
    parameters : TranslateParameters
    normalize : NormalizeParameters
    seed : int
    work : Map
        Reads all files first where the translator learns from them; nothing else.

    Returns
    -------
    dict
        Name of a task -> the task; :class:`.AddedFiles` if not all files were asked for.

    Raises
    ------
    DomainError
        If the translator gives no verdicts.
    """
    fitted = judging(translator_from_state(translator))
    suppliers = KnownSuppliers.learn(normalized_table, chosen_files, classify=parameters.classify, seed=seed)
    given = Given(fitted, suppliers, normalize.nominal_load, parameters.farthest)
    common = [state_digest(translator).encode(), *_depends_on(given, normalized_table, seed)]
    blocks = divided(chosen_files, TRANSLATED_TOGETHER)
    digests = {number: digest_of(block) for number, block in blocks.items()}
    if fitted.learn_from_batch:
        given = replace(given, translator=_taught(given, blocks, work))
        common.append("".join(digests.values()).encode())
    salt = hashlib.sha256(b"\0".join(common)).hexdigest()[:16]
    tasks = {
        f"{code_hash('.')}/{salt}/{number:06d}-{digests[number]}.zip": TranslateBlock(block, given)
        for number, block in blocks.items()
    }
    return AddedFiles(tasks) if parameters.restricted else tasks


def _depends_on(given: Given, normalized_table: pd.DataFrame, seed: int) -> list[bytes]:
    """What every block depends on beside the translator and its own files."""
    suppliers = given.suppliers
    common = [repr((given.nominal_load, given.farthest, suppliers.names)).encode()]
    if suppliers.classifier is not None:
        hashes = pd.util.hash_pandas_object(normalized_table, index=False).to_numpy()
        common += [hashes.tobytes(), str(seed).encode()]
    return common


def _taught(given: Given, blocks: Mapping[int, TireFiles], work: Map) -> JudgingTranslator:
    """The translator after it has learned from all files: from the rows of those that may teach."""
    tasks = {next(iter(block)): LookForTeachers(block, given) for block in blocks.values()}
    found = [done.result() for done in all_done(work, tasks, "reading files to learn from").values()]
    teachers = pd.concat([rows for _, rows in found], ignore_index=True)
    teachers = teachers.sort_values("file", ignore_index=True)
    return given.translator.taught(np.unique(np.concatenate([tires for tires, _ in found])), teachers)


def join_translated(
    parts: StoredFiles, translator: dict[str, Any], parameters: TranslateParameters
) -> tuple[
    Mapping[str, Callable[[], bytes] | None],
    FramesOfRows,
    list[Callable[[], pd.DataFrame]],
    list[Callable[[], pd.DataFrame]],
    list[Callable[[], pd.DataFrame]],
    pd.DataFrame,
]:
    """Join what was translated: files, report and tables.

    Nothing of each file stays in memory, unless only some of them were asked for: then their names do.

    Parameters
    ----------
    parts : mapping
        What :func:`translate_each` gave, done.
    translator : dict
        State of the translator.
    parameters : TranslateParameters
        If they do not ask for all files, what earlier runs made of the others stays.

    Returns
    -------
    files : mapping
        The translated ``.tir`` files, no others, by the function that reads each. If not all files were asked
        for they are :class:`.AddedFiles`, with None for each of those asked for that was not translated.
    report : iterable of DataFrame
        One row a file: how its supplier is known, verdict, reason, distance, expected RMS error over that of
        the unchanged file, band of the bias, and that in words with what it usually comes from. Sorted, files
        that could not be read last; read from the disk some thousand rows at a time.
    sources, coefficients, bands : list of callable
        By parts, a function each: the files as a tire table at one nominal load, with suppliers; one row a
        coefficient that moved; ``file, output, normal_load, slip, middle, low, high``: curves of the
        translated files with their 90% band.
    protocols : DataFrame
        Categories that changed how they measure.

    Raises
    ------
    DomainError
        If not one file could be read.
    """
    rows, read = RowsOnDisk([*TRANSLATION_TYPES, "unreadable", "part"]), list[Callable[[], bytes]]()
    for load in track(parts.values(), "joining what was translated", total=len(parts)):
        part = load()
        rows.add((*map(row.get, TRANSLATION_TYPES), True, None) for row in unreadable_in(part))
        if has_tables(part):
            rows.add(_rows_of(part, len(read)))
            read.append(load)
    _tell_unreadable(rows, any_read=bool(read))
    files: Mapping[str, Callable[[], bytes] | None] = TranslatedTexts(rows, read)
    if parameters.restricted:
        names = (name for (name,) in rows.do(f"select file {_IN_ORDER}"))
        files = AddedFiles(dict.fromkeys(names) | dict(files))
    protocols = judging(translator_from_state(translator)).protocol_changes()
    sources, coefficients, bands = (
        [_table_of(load, name) for load in read] for name in ("sources", "coefficients", "bands")
    )
    report = FramesOfRows(rows, _REPORT_QUERY, TRANSLATION_TYPES)
    return files, report, sources, coefficients, bands, protocols


def _rows_of(part: bytes, number: int) -> Iterator[tuple[Any, ...]]:
    """Rows of a part's files that were read; of the translated ones with the number of the part."""
    translated = set(translated_in(part))
    for row in plain_rows(table_in(part, "report")[[*TRANSLATION_TYPES]]):
        yield *row, False, number if row[0] in translated else None


def _tell_unreadable(rows: RowsOnDisk, *, any_read: bool) -> None:
    """Name those that could not be read in the log; an error if there are no others."""
    aside = "from rows where unreadable"
    first = rows.do(f"select file, reason {aside} order by file limit {NAMED_IN_LOG}").fetchall()
    name_unread(first, "is refused")
    (count,) = rows.do(f"select count(*) {aside}").fetchone()
    if (more := count - len(first)) > 0:
        _LOG.warning("%d more files cannot be read: the table of the translated files has them all", more)
    if not any_read:
        raise DomainError(
            f"none of {count} files could be read; the first: {first[0][1]}",
            where="translate",
            todo="correct them, then run again",
        )


def _table_of(load: Callable[[], bytes], name: str) -> Callable[[], pd.DataFrame]:
    return lambda: table_in(load(), name)


class TranslatedTexts(Mapping[str, Callable[[], bytes]]):
    """The translated files by the function that reads each; their names are on the disk.

    They come part by part, and of their texts those of the part that was read last are in memory.

    Parameters
    ----------
    rows : RowsOnDisk
        Every ``file``, with the number of its ``part`` if it was translated.
    parts : sequence of callable
        Give what became of the files of each part.
    """

    def __init__(self, rows: RowsOnDisk, parts: Sequence[Callable[[], bytes]]) -> None:
        rows.do("create index by_part on rows (part, file) where part is not null")
        rows.do("create index by_file on rows (file)")
        self._rows, self._parts = rows, parts
        self._last: int | None = None
        self._texts: dict[str, bytes] = {}

    def __getitem__(self, file: str) -> Callable[[], bytes]:
        """The function that reads a file."""
        found = self._rows.do("select part from rows where file = ? and part is not null", (file,)).fetchone()
        if found is None:
            raise KeyError(file)
        return partial(self._text, found[0], file)

    def __iter__(self) -> Iterator[str]:
        """Names, part by part."""
        return (file for (file,) in self._rows.do(f"select file {_FROM_TRANSLATED} order by part, file"))

    def __len__(self) -> int:
        return int(self._rows.do(f"select count(*) {_FROM_TRANSLATED}").fetchone()[0])

    def _text(self, part: int, file: str) -> bytes:
        if self._last != part:
            self._last, self._texts = part, texts_in(self._parts[part]())
        return self._texts[file]
