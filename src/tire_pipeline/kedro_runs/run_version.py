"""The version of a run's results: later than all that are there, whatever the clock says."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from datetime import datetime, timedelta
from typing import Any

from kedro.io.core import AbstractVersionedDataset, Version, VersionNotFoundError

from tire_pipeline.errors import DomainError

_LOG = logging.getLogger(__name__)
_VERSION_FORMAT = "%Y-%m-%dT%H.%M.%S.%fZ"


def versioned_datasets(catalog: Any, names: Iterable[str]) -> list[AbstractVersionedDataset[Any, Any]]:
    """Those datasets of a catalog that are kept in versions.

    Parameters
    ----------
    catalog : DataCatalog
    names : iterable of str
    """
    known = [name for name in sorted(names) if name in catalog]
    found = map(catalog.get, known)
    return [each for each in found if isinstance(each, AbstractVersionedDataset) and each._version]


def settle_version(catalog: Any, pipeline: Any, version: str) -> str:
    """Have a run save under a version that is later than all that are there.

    Kedro names versions by the clock and loads the last name. If the clock was ahead in an earlier run, that
    run's results would be loaded for ever, also by the nodes of this run.

    Parameters
    ----------
    catalog : DataCatalog
    pipeline : Pipeline
    version : str
        By this run's clock.

    Returns
    -------
    str
        The same, or a thousandth of a second after the latest that is there.

    Raises
    ------
    DomainError
        What is there bears a name that is no date and comes after all dates.
    """
    outputs = versioned_datasets(catalog, pipeline.all_outputs())
    latest, where = max(((_latest(each), str(each._filepath)) for each in outputs), default=("", ""))
    if latest < version:
        return version
    later = _after(latest, where)
    _LOG.warning("The clock of an earlier run was ahead (%s): this run's results bear %s.", latest, later)
    for each in versioned_datasets(catalog, pipeline.all_inputs() | pipeline.all_outputs()):
        each._version = Version(each._version.load if each._version else None, later)
    return later


def _latest(dataset: AbstractVersionedDataset[Any, Any]) -> str:
    try:
        return max(dataset.list_versions(full_path=False), default="")
    except VersionNotFoundError:
        return ""


def _after(version: str, where: str) -> str:
    """The next version.

    Examples
    --------
    >>> _after("2027-01-01T00.00.00.999Z", "")
    '2027-01-01T00.00.01.000Z'
    """
    try:
        date = datetime.strptime(version, _VERSION_FORMAT) + timedelta(milliseconds=1)
    except (ValueError, OverflowError) as error:
        raise DomainError(
            f"the folder {version!r} in it would be taken for the newest version for ever",
            where=where,
            todo="move it elsewhere, then run again",
        ) from error
    return f"{date.strftime(_VERSION_FORMAT)[:-4]}Z"
