"""The Magic Formula version of a file, from its labels and keys, and contradictions between these."""

from __future__ import annotations

from collections.abc import Collection

from tire_pipeline.errors import TirVersionError
from tire_pipeline.tir.format.values import parse_number

FITTYP_VERSIONS = {
    "5": "5.0",
    "51": "5.1",
    "6": "5.2",
    "21": "5.2",
    "52": "5.2",
    "60": "6.1",
    "61": "6.1",
    "62": "6.2",
    "5.0": "5.0",
    "5.1": "5.1",
    "5.2": "5.2",
    "6.1": "6.1",
    "6.2": "6.2",
}
"""``FITTYP`` -> version. 5 is MF-Tyre 5.0 and 5.1 (one form); MFeval reads 6 and 21 as MF 5.2."""

VERSION_FITTYP = {"5.0": "5", "5.1": "51", "5.2": "6", "6.1": "61", "6.2": "62"}
"""Version -> the ``FITTYP`` that is written. PAC2002 has none: ``PROPERTY_FILE_FORMAT`` says it."""

_FORMAT_VERSIONS = {
    "PAC2002": "PAC2002",
    "PAC02": "PAC2002",
    "MF_05": "5.0",
    "MF05": "5.0",
    "MF_5.0": "5.0",
    "MF_5.1": "5.1",
    "MF_52": "5.2",
    "MF52": "5.2",
    "MF_5.2": "5.2",
    "MF_61": "6.1",
    "MF61": "6.1",
    "MF_6.1": "6.1",
    "MF_62": "6.2",
    "MF62": "6.2",
    "MF_6.2": "6.2",
}
_OTHER_MODELS = frozenset(
    [
        "FIALA",
        "UA",
        "5.2.1",
        "521",
        "521_TIRE",
        "PAC89",
        "PAC94",
        "PAC_MC",
        "PAC-TIME",
        "PAC_TIME",
        "PACTIME",
        "FTIRE",
        "CTIRE",
        "HTIRE",
        "CDTIRE",
        "RMOD-K",
        "SWIFT",
        "PAC_CT",
        "TMEASY",
        "DELFT-TYRE-89",
    ]
)
_ONLY_PAC2002 = frozenset(["PTX4", "PTY3", "QPX1", "QPZ1", "QPZ2", "LIP", "LKG"])
_ONLY_62 = frozenset(
    ["Q_CAM1", "Q_CAM2", "Q_CAM3", "Q_FYS1", "Q_FYS2", "Q_FYS3", "Q_FCY2", "ENV_C1", "ENV_C2"]
)
_TELLS_VERSION_6 = frozenset(
    [
        "PKY4",
        "PKY5",
        "PKY6",
        "PKY7",
        "PEY5",
        "QDZ10",
        "QDZ11",
        "RBX3",
        "RBY4",
        "PPMX1",
        "QSX12",
        "QSX13",
        "QSX14",
        "PPY5",
        "PPZ1",
        "PPZ2",
        "LKYC",
        "LKZC",
        "LMP",
    ]
)


def detect_version(
    *,
    fittyp: str | None,
    file_format: str | None,
    comment: str | None,
    keys: Collection[str],
    path: str | None = None,
    line: int | None = None,
) -> tuple[str, list[str]]:
    """Return the version and what contradicts it.

    ``PROPERTY_FILE_FORMAT = 'PAC2002'`` decides first (``FITTYP`` is no key of that model), then ``FITTYP``,
    then any other conclusive ``PROPERTY_FILE_FORMAT``, then a ``TIRE_VERSION`` comment, then the keys that
    only one version has.

    Parameters
    ----------
    fittyp, file_format : str, optional
        Values of ``FITTYP`` and ``PROPERTY_FILE_FORMAT``; empty counts as absent.
    comment : str, optional
        What follows ``TIRE_VERSION`` in a comment.
    keys : collection of str
        All coefficient names of the file.
    path, line
        For messages; the line is that of ``FITTYP``.

    Returns
    -------
    version : str
    warnings : list of str

    Raises
    ------
    TirVersionError
        ``FITTYP`` is not a known number, or the format names a tire model that is not a Magic Formula of 5.0
        or later.
    """
    warnings: list[str] = []
    by_fittyp = _from_fittyp(fittyp, path, line) if fittyp else None
    by_format = _from_format(file_format, path, warnings, by_fittyp is None)
    by_comment = _from_comment(comment)
    by_keys = _from_keys(keys)
    if by_format == "PAC2002":
        version = by_format
    else:
        version = by_fittyp or by_format or by_comment or by_keys or "5.2"
    if version == "5.0" and by_comment == "5.1":
        version = by_comment
    if by_fittyp is None and by_format is None:
        origin = "the TIRE_VERSION comment" if by_comment else "the keys that are there"
        warnings.append(f"no FITTYP and no telling PROPERTY_FILE_FORMAT: read as {version} from {origin}")
    if fittyp in ("60", "21"):
        warnings.append(f"FITTYP = {fittyp} has no equations of its own here: read as {version}")
    for name, other in (
        ("FITTYP", by_fittyp),
        ("PROPERTY_FILE_FORMAT", by_format),
        ("the comment", by_comment),
    ):
        if other is not None and not _alike(other, version):
            warnings.append(f"{name} says {other}, which contradicts {version}")
    if by_keys is not None and _family(by_keys) != _family(version):
        warnings.append(f"read as {version}, but the file has keys that only {by_keys} has")
    return version, warnings


def _from_fittyp(fittyp: str, path: str | None, line: int | None) -> str:
    number = parse_number(fittyp)
    text = fittyp if number is None else f"{number:g}"
    if text in FITTYP_VERSIONS:
        return FITTYP_VERSIONS[text]
    known = ", ".join(each for each in FITTYP_VERSIONS if "." not in each)
    raise TirVersionError(
        f"FITTYP = {fittyp[:40]!r} is not a known Magic Formula version",
        path=path,
        line=line,
        key="FITTYP",
        todo=f"use one of {known}",
    )


def _from_format(text: str | None, path: str | None, warnings: list[str], decisive: bool) -> str | None:
    name = (text or "").strip().upper()
    if name in _FORMAT_VERSIONS:
        return _FORMAT_VERSIONS[name]
    if name in _OTHER_MODELS:
        if decisive:
            raise TirVersionError(
                f"PROPERTY_FILE_FORMAT = {name!r} is not a Magic Formula of version 5.0 or later",
                path=path,
                key="PROPERTY_FILE_FORMAT",
                todo="export the tire as MF-Tyre 5.2 or later, or PAC2002",
            )
        warnings.append(f"PROPERTY_FILE_FORMAT = {name!r} contradicts FITTYP, which is followed")
    return None


def _from_comment(text: str | None) -> str | None:
    name = (text or "").upper().replace("MF-TYRE", "MF").replace(" ", "").replace("-", "")
    for telling, version in (
        ("PAC2002", "PAC2002"),
        ("MF5.0", "5.0"),
        ("MF5.1", "5.1"),
        ("MF5.2", "5.2"),
        ("MF52", "5.2"),
        ("MF6.1", "6.1"),
        ("MF61", "6.1"),
        ("MF6.2", "6.2"),
        ("MF62", "6.2"),
    ):
        if name.startswith(telling):
            return version
    return None


def _from_keys(keys: Collection[str]) -> str | None:
    if not _ONLY_PAC2002.isdisjoint(keys):
        return "PAC2002"
    if not _ONLY_62.isdisjoint(keys):
        return "6.2"
    return None if _TELLS_VERSION_6.isdisjoint(keys) else "6.1"


def _family(version: str) -> int:
    return 6 if version.startswith("6") else 5


def _alike(one: str, other: str) -> bool:
    return one == other or {one, other} == {"5.0", "5.1"}
