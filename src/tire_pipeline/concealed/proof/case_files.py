"""One case, shown or explained, as the bytes of one file."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS
from tire_pipeline.concealed import Answer, Case, make_case
from tire_pipeline.concealed.baselines import BASELINES, with_all_inputs
from tire_pipeline.concealed.real import RealPlan, make_real_case
from tire_pipeline.errors import RecordingError
from tire_pipeline.files.packed import as_parquet, pack, unpack
from tire_pipeline.files.read_later import Read
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.tir import read_tir, tir_bytes


def made_case(seed: int, kind: str) -> bytes:
    """Make a case: ``model.tir``, ``recording``, ``held_out`` and ``answer.json``."""
    return _packed(*make_case(seed, kind))


def made_real_case(plan: RealPlan, folder: Path) -> bytes:
    """The same of a case from real recordings, sealed sweeps only."""
    return _packed(*make_real_case(plan, folder))


def _packed(case: Case, answer: Answer) -> bytes:
    return pack(
        {
            "model.tir": tir_bytes(case.tire),
            "recording.parquet": as_parquet(case.recording),
            "held_out.parquet": as_parquet(case.held_out),
            "answer.json": json.dumps(answer.to_dict()).encode(),
            "case_id": case.case_id.encode(),
        }
    )


def shown_part(read: Read) -> bytes:
    """What a user would have; of the held-out run only the inputs, to predict it."""
    made = unpack(read())
    held_out = pd.read_parquet(io.BytesIO(made["held_out.parquet"]))
    inputs = held_out.drop(columns=[name for name in FORCE_CHANNELS if name in held_out])
    shown = {name: made[name] for name in ("model.tir", "recording.parquet", "case_id")}
    return pack({**shown, "inputs.parquet": as_parquet(inputs)})


def held_out_part(read: Read) -> bytes:
    """The held-out run, forces and all, and the model."""
    made = unpack(read())
    return pack({name: made[name] for name in ("model.tir", "held_out.parquet", "case_id")})


def explained(read: Read, method: str) -> bytes:
    """Explain one case with the model locked, then predict its held-out inputs.

    Parameters
    ----------
    read : callable
        Gives the bytes of :func:`shown_part`.
    method : str
        ``explain_mismatch`` or a name of ``BASELINES``.
    """
    shown = unpack(read())
    tire = read_tir(shown["model.tir"])
    recording = pd.read_parquet(io.BytesIO(shown["recording.parquet"]))
    inputs = pd.read_parquet(io.BytesIO(shown["inputs.parquet"]))
    prediction = pd.DataFrame(index=inputs.index)
    report: Any
    try:
        if method == "explain_mismatch":
            report = explain_mismatch(tire, recording)
            prediction = report.corrected.predict(inputs)
        else:
            report = BASELINES[method](tire, with_all_inputs(tire, recording))
            prediction = report.predict(with_all_inputs(tire, inputs))
        answer = {"sets": getattr(report, "sets", None), **report.to_dict()}
    except (RecordingError, np.linalg.LinAlgError) as error:  # counts as a miss, with its text in the table
        answer = {"verdict": "refused", "effects": [], "fit": {}, "problem": str(error)}
    kept = {
        key: answer.get(key) for key in ("verdict", "effects", "sets", "fit", "problem", "next_experiment")
    }
    return pack(
        {
            "report.json": json.dumps(kept, default=_plain).encode(),
            "prediction.parquet": as_parquet(prediction),
            "case_id": shown["case_id"],
        }
    )


def _plain(value: object) -> object:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    return str(value)
