"""One stored result as the bytes of one file, and the key that says all that it depends on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.files.read_later import Read
from tire_pipeline.files.state_files import pack_state, unpack_state
from tire_pipeline.representations import make_representation, representation_from_state
from tire_pipeline.thesis.experiments.agents import judged_agent, thinned_learning_curve
from tire_pipeline.translation.thesis.grid import Cell, train_cell


def key_of(*parts: Any) -> str:
    """A short hash of tables, arrays, parameters and texts."""
    total = hashlib.sha256()
    for part in parts:
        total.update(_bytes(part) + b"\0")
    return total.hexdigest()[:16]


def _bytes(part: Any) -> bytes:
    if isinstance(part, pd.DataFrame):
        rows = pd.util.hash_pandas_object(part, index=False).to_numpy().tobytes()
        return "\t".join(map(str, part.columns)).encode() + hashlib.sha256(rows).digest()
    if isinstance(part, np.ndarray):
        return str(part.dtype).encode() + np.ascontiguousarray(part).tobytes()
    return json.dumps(part, sort_keys=True, default=_plain).encode()


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else str(value)


def pack_frames(frames: Mapping[str, pd.DataFrame]) -> bytes:
    """Tables as one file of arrays."""
    return pack_state({name: _state(frame) for name, frame in frames.items()})


def unpack_frames(content: bytes) -> dict[str, pd.DataFrame]:
    """The tables that :func:`pack_frames` packed."""
    return {name: _frame(state) for name, state in unpack_state(content).items()}


def _state(frame: pd.DataFrame) -> dict[str, Any]:
    arrays = {}
    for number, column in enumerate(frame.columns):
        values = frame[column].to_numpy()
        arrays[f"c{number}"] = values.astype(str) if values.dtype.kind == "O" else values
    return {"columns": [str(column) for column in frame.columns], "values": arrays}


def _frame(state: dict[str, Any]) -> pd.DataFrame:
    columns = {}
    for number, name in enumerate(state["columns"]):
        values = state["values"][f"c{number}"]
        columns[name] = values.astype(object) if values.dtype.kind == "U" else values
    return pd.DataFrame(columns)


def computed(function: Callable[..., dict[str, pd.DataFrame]], *arguments: Any, **options: Any) -> bytes:
    """Tables that a function of the domain gives, packed."""
    return pack_frames(function(*arguments, **options))


def represented(training: pd.DataFrame, name: str, seed: int, options: Mapping[str, Any]) -> bytes:
    """Fit one representation, once for all its cells; its state."""
    return pack_state(make_representation(name, **options).fit(training, seed=seed).to_state())


def trained(
    training: pd.DataFrame,
    cell: Cell,
    seed: int,
    read: Read,
    *,
    target: str,
    total_steps: int | None,
) -> bytes:
    """Train one agent; its state and learning curve."""
    done = train_cell(
        training,
        cell,
        target=target,
        seed=seed,
        total_steps=total_steps,
        representation=representation_from_state(unpack_state(read())),
    )
    return pack_state(
        {
            "agent": done["state"],
            "learning": _state(thinned_learning_curve(done["learning_curve"])),
            "seconds": float(done["seconds"]),
        }
    )


def judged(read: Read, cell: Cell, seed: int, sources: pd.DataFrame, references: pd.DataFrame) -> bytes:
    """Judge one trained agent; its learning curve goes along."""
    stored = unpack_state(read())
    frames = judged_agent(stored["agent"], cell, seed, sources, references)
    which = {"seed": seed, **asdict(cell)}
    learning = _frame(stored["learning"]).rename(columns={"reward": "episode_reward"})
    frames["learning"] = learning.assign(**which)
    frames["seconds"] = pd.DataFrame({"seconds": [stored["seconds"]]}).assign(**which)
    return pack_frames(frames)
