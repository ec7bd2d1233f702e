"""Some files translated together, as the bytes of one stored part."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.suppliers import BY_FOLDER, UNKNOWN_SUPPLIER, KnownSuppliers
from tire_pipeline.errors import cause_in_entry, may_pass
from tire_pipeline.file_names import printable
from tire_pipeline.files.objects import UnreachableError
from tire_pipeline.files.packed import as_parquet, from_parquet, member, names_in, pack, unpack
from tire_pipeline.files.state_files import pack_state, unpack_state
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.progress import track
from tire_pipeline.tir import tir_bytes
from tire_pipeline.tir.format.values import COMPUTED_DIGITS
from tire_pipeline.tir.reading.read import NEXT_WARNING, file_warnings
from tire_pipeline.tire_table import from_models
from tire_pipeline.tire_table.from_models import KNOWN_COEFFICIENTS, as_in_whole
from tire_pipeline.tire_table.read_blocks import TireFiles
from tire_pipeline.translation.base import JudgingTranslator
from tire_pipeline.translation.curves.of_files import file_curves
from tire_pipeline.translation.files.of_models import at_one_load, at_own_load
from tire_pipeline.translation.result import REFUSED, UNKNOWN, TranslationResult

TABLES = ("sources", "report", "coefficients", "bands")
BAND_COLUMNS = ("file", "output", "normal_load", "slip", "middle", "low", "high")
_TEXT = "texts/"


class TranslatedPart(bytes):
    """What became of some files, packed; ``failures`` are told as they come."""

    @property
    def failures(self) -> dict[str, str]:
        """File -> why it cannot be read."""
        return {row["file"]: row["reason"] for row in unreadable_in(self)}


class PassingTranslatedPart(TranslatedPart):
    """A part with a file that could not be opened: the next run reads it again."""

    passing = True


def table_in(part: bytes, name: str) -> pd.DataFrame:
    """One of ``TABLES`` of a part."""
    return from_parquet(member(part, f"{name}.parquet"))


def curves_in(part: bytes) -> dict[str, Any]:
    """Curves of a part's files (:func:`.curves.of_files.file_curves`)."""
    return unpack_state(member(part, "curves"))


def unreadable_in(part: bytes) -> list[dict[str, str]]:
    """Rows of the report of a part's files that cannot be read."""
    rows: list[dict[str, str]] = json.loads(member(part, "unreadable.json"))
    return rows


def translated_in(part: bytes) -> list[str]:
    """Names of the translated files of a part."""
    return [name.removeprefix(_TEXT) for name in names_in(part) if name.startswith(_TEXT)]


def texts_in(part: bytes) -> dict[str, bytes]:
    """The translated files of a part."""
    return {name.removeprefix(_TEXT): text for name, text in unpack(part).items() if name.startswith(_TEXT)}


@dataclass(frozen=True)
class Given:
    """What all blocks have in common.

    Attributes
    ----------
    translator : JudgingTranslator
        Fitted; it has learned from the batch already, if it learns from one.
    suppliers : KnownSuppliers
    nominal_load : float
        Of the table that the translator was fitted to, N.
    farthest : float
        Files farther from the training data are refused.
    """

    translator: JudgingTranslator
    suppliers: KnownSuppliers
    nominal_load: float
    farthest: float


@dataclass(frozen=True)
class Sources:
    """Files as they were read.

    Attributes
    ----------
    models : dict of str to TireModel
    own : DataFrame
        Their tire table, with all columns there are: a file's row does not depend on what stands beside it.
    table : DataFrame
        The same at one nominal load, with suppliers.
    unreadable : list of dict
    passing : bool
        A file could not be opened.
    """

    models: dict[str, TireModel]
    own: pd.DataFrame
    table: pd.DataFrame
    unreadable: list[dict[str, str]]
    passing: bool

    @classmethod
    def read(cls, files: TireFiles, given: Given) -> Self:
        """Read files; one that cannot be read has its reason among the unreadable ones."""
        models, unreadable, passing = dict[str, TireModel](), list[dict[str, str]](), False
        for file, load in files.items():
            try:
                models[file] = load()
            except Exception as error:
                cause = cause_in_entry(error)
                if isinstance(cause, UnreachableError):
                    raise
                passing |= may_pass(error)
                unreadable.append(unreadable_row(file, given.suppliers, f"cannot be read: {cause}"))
        rows = ((file, given.suppliers.by_folder(file), model) for file, model in models.items())
        own = as_in_whole(from_models(rows), KNOWN_COEFFICIENTS)
        table = given.suppliers.of(at_one_load(own, given.nominal_load))
        return cls(models, own, table, unreadable, passing)


def unreadable_row(file: str, suppliers: KnownSuppliers, reason: str) -> dict[str, str]:
    """A row of the report of a file that cannot be read."""
    source = suppliers.by_folder(file)
    return {
        "file": file,
        "source": source or UNKNOWN_SUPPLIER,
        "supplier_known": BY_FOLDER if source else UNKNOWN_SUPPLIER,
        "verdict": REFUSED,
        "reason": printable(reason),
    }


@dataclass(frozen=True)
class TranslateBlock:
    """Reads some files and translates them.

    Attributes
    ----------
    files : mapping
        ``category/.../name.tir`` to the function that reads it.
    given : Given
    """

    files: TireFiles
    given: Given
    label = ""

    def __call__(self) -> TranslatedPart:
        """Translate them; one that cannot be read has its reason in the report."""
        sources = Sources.read(self.files, self.given)
        kept = PassingTranslatedPart if sources.passing else TranslatedPart
        if not sources.models:
            return packed_part({}, {}, sources.unreadable, {}, kept)
        result = self.given.translator.translation(sources.table, farthest=self.given.farthest)
        result = _with_notes(_named_suppliers(result, sources.table), sources)
        files = list(sources.own["file"])
        translated, comments = at_own_load(result, sources.models, sources.own)
        texts = {
            file: tir_bytes(model, comments=comments[file], digits=COMPUTED_DIGITS)
            for file, model in track(translated.items(), "writing translated files")
        }
        tables = {
            "sources": sources.table,
            "report": result.report,
            "coefficients": result.coefficients,
            "bands": _bands(result, files),
        }
        return packed_part(
            tables, file_curves(files, sources.models, result), sources.unreadable, texts, kept
        )

    def split(self) -> dict[str, TranslateBlock]:
        """One file each: to find the one that ends its process."""
        return {file: replace(self, files={file: load}) for file, load in self.files.items()}

    def join(self, parts: list[bytes]) -> TranslatedPart:
        """What the blocks of :meth:`split` gave, as if this one had been done."""
        kept = PassingTranslatedPart if any(getattr(p, "passing", False) for p in parts) else TranslatedPart
        read = [part for part in parts if has_tables(part)]
        return packed_part(
            {
                name: pd.concat([table_in(p, name) for p in read], ignore_index=True)
                for name in TABLES
                if read
            },
            _joined_curves([curves_in(part) for part in read]),
            [row for part in parts for row in unreadable_in(part)],
            {name: text for part in parts for name, text in texts_in(part).items()},
            kept,
        )

    def lost(self, reason: str) -> TranslatedPart:
        """What a block of one file gives that ends its process; the next run may have more memory."""
        rows = [unreadable_row(file, self.given.suppliers, reason) for file in self.files]
        return packed_part({}, {}, rows, {}, PassingTranslatedPart)


@dataclass(frozen=True)
class LookForTeachers:
    """Reads some files, and gives what the translator has to know of them to learn from the whole batch."""

    files: TireFiles
    given: Given
    label = ""

    def __call__(self) -> tuple[np.ndarray, pd.DataFrame]:
        """Tires, and rows of the files that may teach (:meth:`.JudgingTranslator.teaching`)."""
        return self.given.translator.teaching(Sources.read(self.files, self.given).table)


def has_tables(part: bytes) -> bool:
    """Whether any file of a part could be read."""
    return bool(json.loads(member(part, "read.json")))


def packed_part(
    tables: Mapping[str, pd.DataFrame],
    curves: dict[str, Any],
    unreadable: list[dict[str, str]],
    texts: Mapping[str, bytes],
    kept: type[TranslatedPart],
) -> TranslatedPart:
    """The bytes of a part: ``TABLES``, curves, rows of files that cannot be read, and translated files."""
    content = {
        "unreadable.json": json.dumps(unreadable).encode(),
        "read.json": json.dumps(bool(tables)).encode(),
    }
    content |= {f"{name}.parquet": as_parquet(table) for name, table in tables.items()}
    if curves:
        content["curves"] = pack_state(curves)
    return kept(pack({**content, **{f"{_TEXT}{name}": text for name, text in texts.items()}}))


def _joined_curves(every: list[dict[str, Any]]) -> dict[str, Any]:
    if not every:
        return {}
    joined = {name: every[0][name] for name in ("normal_load", "slip")}
    joined["files"] = [file for one in every for file in one["files"]]
    for name in every[0].keys() - joined.keys():
        joined[name] = np.concatenate([one[name] for one in every])
    return joined


def _named_suppliers(result: TranslationResult, source: pd.DataFrame) -> TranslationResult:
    """The result with how each supplier is known, and what to do where it is not."""
    report = result.report.copy()
    report.insert(1, "supplier_known", source["supplier_known"].to_numpy())
    unknown = (report["verdict"] == UNKNOWN).to_numpy()
    report.loc[unknown, "source"] = UNKNOWN_SUPPLIER
    report.loc[unknown, "reason"] = source["supplier_note"].to_numpy()[unknown]
    targets = (report["supplier_known"] != BY_FOLDER) & (report["source"] == report["target"])
    report.loc[targets, "reason"] = "classified as the target's own"
    return replace(result, report=report)


def _with_notes(result: TranslationResult, sources: Sources) -> TranslationResult:
    """The result with what is unusual in each file, such as two values of a key."""
    notes = [NEXT_WARNING.join(file_warnings(sources.models[file])) for file in sources.own["file"]]
    return replace(result, report=result.report.assign(notes=notes))


def _bands(result: TranslationResult, names: list[str]) -> pd.DataFrame:
    """Bands of the translated files as one long table."""
    parts = []
    for output, every in result.bands.items():
        known = np.isfinite(every.low).any(axis=(1, 2))
        band = replace(every, middle=every.middle[known], low=every.low[known], high=every.high[known])
        n, loads, slips = band.middle.shape
        parts.append(
            pd.DataFrame(
                {
                    "file": np.repeat(np.array(names)[known], loads * slips),
                    "output": output,
                    "normal_load": np.tile(np.repeat(band.normal_load, slips), n),
                    "slip": np.tile(band.slip, n * loads),
                    **{name: getattr(band, name).ravel() for name in ("middle", "low", "high")},
                }
            )
        )
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame(columns=list(BAND_COLUMNS))
