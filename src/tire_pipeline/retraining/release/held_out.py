"""Which physical tires are held out: decided tire by tire, so that it never changes when others arrive."""

from __future__ import annotations

import hashlib

import numpy as np
import pandas as pd

_NAMELESS = "unknown "


def held_out_rows(table: pd.DataFrame, *, share: float, seed: int) -> np.ndarray:
    """Mark the rows of the held-out tires.

    A tire's side follows from a hash of its ``tire_id`` alone, so that a tire that an earlier model was
    judged on is never trained on later. Rows without any size or mass are taken file by file.

    Parameters
    ----------
    table : DataFrame
        Has ``file`` and ``tire_id``.
    share : float
        Of the tires, 0 to 1.
    seed : int

    Returns
    -------
    ndarray of bool, shape (rows,)

    Examples
    --------
    >>> table = pd.DataFrame({"file": ["A/1.tir", "B/1.tir"], "tire_id": ["x", "x"]})
    >>> held_out_rows(table, share=1.0, seed=0)
    array([ True,  True])
    """
    nameless = table["tire_id"].str.startswith(_NAMELESS)
    names = table["tire_id"].where(~nameless, table["file"])
    side = {name: _fraction(f"{seed}\0{name}") < share for name in names.unique()}
    return names.map(side).to_numpy(dtype=bool)


def _fraction(text: str) -> float:
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big") / 2**64
