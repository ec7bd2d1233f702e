"""Find the channels in a MATLAB file: in its variables and structs, by name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.conventions.channel_names import find_channel
from tire_pipeline.recordings.conventions.units_in_names import split_unit

_DATA_FIELDS = ("data", "values", "value", "samples")
_NAME_FIELDS = ("name", "label", "names", "labels", "channel", "channels", "channelname", "channelnames")
_UNIT_FIELDS = ("unit", "units")
_MOST_NESTED = 4

Vector = NDArray[np.float64]


@dataclass
class MatTable:
    """The channels of one place of a file.

    Parameters
    ----------
    where : str
        Such as ``"run1"``; "" at the top of the file.
    vectors : dict of str to ndarray
        Channel -> values.
    units : dict of str to str
        Channel -> what the file says.
    texts : dict of str to str
        Text beside them.
    left_out : list of str
        What holds no channel.
    others : list of str
        Other places of as many known channels.
    """

    where: str
    vectors: dict[str, Vector] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)
    others: list[str] = field(default_factory=list)

    @property
    def known(self) -> int:
        """How many channels have a name that is known."""
        return sum(v.size > 1 and _is_known(name) for name, v in self.vectors.items())


def richest(content: Mapping[str, object]) -> MatTable:
    """Return the place of a file with most known channels; the first of several.

    Vectors may stand side by side, or be one field of a struct a channel (``FY.data``, ``FY.unit``); channels
    may be elements of a struct array (``signals(i).name``) or columns of a matrix beside their names. A
    struct array whose elements all hold the channels is one run after the other.

    Raises
    ------
    RecordingError
        The runs of a struct array cannot follow each other.
    """
    found = [table for table in _tables(content, "", _MOST_NESTED) if table.vectors]
    best = max(found, key=lambda table: table.known, default=MatTable(""))
    best.others = [t.where for t in found if t is not best and 0 < best.known == t.known]
    return best


def _tables(group: Mapping[str, object], where: str, deep: int) -> Iterator[MatTable]:
    yield _table(group, where)
    if deep == 0:
        return
    for key, value in group.items():
        below = f"{where}.{key}" if where else key
        if isinstance(value, Mapping):
            yield from _tables(value, below, deep - 1)
        runs = _structs(value)
        if runs and not _entry_names(runs):
            yield _one_after_the_other([_table(run, below) for run in runs])
            for place, run in enumerate(runs, 1):
                for name, inner in run.items():
                    if isinstance(inner, Mapping):
                        yield from _tables(inner, f"{below}({place}).{name}", deep - 1)


def _table(group: Mapping[str, object], where: str) -> MatTable:
    """The channels that stand directly in a struct."""
    table = MatTable(where)
    for key, value in group.items():
        vector = numbers(value)
        columns = _columns(value, group)
        if key.lower() in _UNIT_FIELDS or (key.lower() in _NAME_FIELDS and vector is None):
            table.units |= stated_units(value)
        elif vector is not None:
            table.vectors[key] = vector
        elif isinstance(value, str):
            table.texts[key] = value
        elif columns:
            table.vectors |= columns
            table.units |= _listed_units(list(columns), group)
        elif isinstance(value, Mapping) and _add(table, _field(value, _NAME_FIELDS[:2]) or key, value):
            pass
        elif _entry_names(_structs(value)):
            for entry in _structs(value):
                _add(table, str(_field(entry, _NAME_FIELDS)).strip(), entry)
        elif not isinstance(value, Mapping):
            table.left_out.append(key)
    return table


def _add(table: MatTable, name: object, entry: Mapping[str, object]) -> bool:
    """Add the channel that a struct of data, name and unit is; return whether it is one."""
    vector = numbers(_field(entry, _DATA_FIELDS))
    if vector is None or vector.size < 2:
        return False
    name = str(name).strip()
    table.vectors[name] = vector
    unit = _field(entry, _UNIT_FIELDS)
    if isinstance(unit, str):
        table.units[name] = unit.strip()
    return True


def _one_after_the_other(runs: list[MatTable]) -> MatTable:
    """Join the elements of a struct array, whose time has to go on from one to the next."""
    first = runs[0]
    if len(runs) < 2 or not all(run.known and run.vectors.keys() == first.vectors.keys() for run in runs):
        return MatTable(first.where)
    for name in first.vectors:
        hit = find_channel(split_unit(name)[0])
        if hit is not None and hit[0].name == "time":
            for number, (before, after) in enumerate(pairwise(runs), 2):
                if not float(np.nanmax(before.vectors[name])) < float(np.nanmin(after.vectors[name])):
                    raise RecordingError(
                        f"{first.where} holds {len(runs)} runs, and {name} starts again in "
                        f"{first.where}({number})",
                        todo="save each in a file of its own and pass all of them together",
                    )
    joined = {name: np.concatenate([run.vectors[name] for run in runs]) for name in first.vectors}
    return MatTable(f"{first.where}(1:{len(runs)})", joined, first.units, first.texts, first.left_out)


def _columns(value: object, group: Mapping[str, object]) -> dict[str, Vector]:
    """The columns of a matrix by the names that a list beside it gives them."""
    if not isinstance(value, np.ndarray) or value.dtype.kind not in "fiu" or value.ndim != 2:
        return {}
    for key, beside in group.items():
        names = _words(beside)
        if key.lower() not in _UNIT_FIELDS and len(names) in value.shape and any(map(_is_known, names)):
            across = value if value.shape[1] == len(names) else value.T
            return {name: across[:, i].astype(float) for i, name in enumerate(names)}
    return {}


def _listed_units(names: list[str], group: Mapping[str, object]) -> dict[str, str]:
    """Units that stand in a list as long as the names."""
    for key, beside in group.items():
        units = _words(beside)
        if key.lower() in _UNIT_FIELDS and len(units) == len(names):
            return dict(zip(names, units, strict=True))
    return {}


def stated_units(value: object) -> dict[str, str]:
    """Units by channel: of a struct with a field a channel, of lists, or of an array of structs."""
    if isinstance(value, Mapping):
        names, units = _words(_field(value, _NAME_FIELDS)), _words(_field(value, _UNIT_FIELDS))
        pairs = dict(zip(names, units, strict=False))
        return pairs or {k: u.strip() for k, u in value.items() if isinstance(u, str)}
    pairs = {}
    for entry in _structs(value):
        name, unit = _field(entry, _NAME_FIELDS), _field(entry, _UNIT_FIELDS)
        if isinstance(name, str) and isinstance(unit, str):
            pairs[name.strip()] = unit.strip()
    return pairs


def _entry_names(entries: list[Mapping[str, object]]) -> bool:
    """Whether the elements of a struct array are channels: each has a name and numbers."""
    return bool(entries) and all(
        isinstance(_field(e, _NAME_FIELDS), str) and numbers(_field(e, _DATA_FIELDS)) is not None
        for e in entries
    )


def _field(entry: Mapping[str, object], names: tuple[str, ...]) -> object:
    """The first of some fields that a struct has, whatever its case."""
    lower = {str(k).lower(): v for k, v in entry.items()}
    return next((lower[n] for n in names if n in lower), None)


def _structs(value: object) -> list[Mapping[str, object]]:
    """Return the elements of a struct array; an empty result for any other value."""
    if isinstance(value, np.ndarray) and value.dtype == object:
        value = value.reshape(-1).tolist()
    if isinstance(value, list) and value and all(isinstance(v, Mapping) for v in value):
        return value
    return []


def _words(value: object) -> list[str]:
    """Return the texts of a cell array or of rows of characters; an empty result for any other value."""
    if isinstance(value, (list, np.ndarray)):
        flat = np.ravel(np.asarray(value, dtype=object)).tolist()
        if flat and all(isinstance(v, str) or np.size(v) == 0 for v in flat):
            return [v.strip() if isinstance(v, str) else "" for v in flat]
    return []


def numbers(value: object) -> Vector | None:
    """A numeric vector as floats, None for anything else."""
    if not isinstance(value, (np.ndarray, int, float, np.number, np.bool_)):
        return None
    array = np.asarray(value)
    if array.dtype.kind not in "fiub" or sum(n != 1 for n in array.shape) > 1:
        return None
    return array.reshape(-1).astype(float)


def _is_known(name: str) -> bool:
    return find_channel(split_unit(name)[0]) is not None
