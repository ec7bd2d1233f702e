"""Cases with concealed effects -> explanations -> scores against the sealed answers."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import PurePosixPath
from typing import Any, Literal

import pandas as pd
from pydantic import Field

from tire_pipeline.code_hash import code_hash
from tire_pipeline.concealed import Answer, Case, case_plan, held_out_errors, score, seal, unseal
from tire_pipeline.concealed.proof import case_files as files
from tire_pipeline.concealed.real.parameters import RealParameters
from tire_pipeline.files.read_later import FilesToMake, Read, StoredFiles
from tire_pipeline.parameters import Parameters
from tire_pipeline.progress import track
from tire_pipeline.tasks import Labelled
from tire_pipeline.tir import read_tir

METHOD = "explain_mismatch"


class ProveConcealedParameters(Parameters):
    """Parameters of ``prove_concealed``.

    Attributes
    ----------
    cases : int
    seed : int
        Of the published proof; used once, after all thresholds were fixed on other seeds.
    baselines : tuple of str
        What else is tried on the same cases.
    real : RealParameters
        Of the half from real recordings.
    """

    cases: int = Field(400, ge=1)
    seed: int = Field(ge=10_000)
    baselines: tuple[Literal["bic_stepwise", "pysindy", "gaussian_process"], ...] = (
        "bic_stepwise",
        "pysindy",
        "gaussian_process",
    )
    real: RealParameters = RealParameters()


def cases_to_make(parameters: ProveConcealedParameters) -> FilesToMake:
    """Make the cases; those that exist already are not made again."""
    code = code_hash("concealed", "magic_formula")
    return {
        f"{code}/{seed:010d}_{kind}.zip": Labelled(f"case {seed}", partial(files.made_case, seed, kind))
        for seed, kind in case_plan(parameters.cases, parameters.seed)
    }


def part_cases(
    made: StoredFiles, form: type[Answer] = Answer
) -> tuple[FilesToMake, FilesToMake, dict[str, Any]]:
    """Separate what is shown, what is held out, and the answers, which are sealed by a hash.

    The names of the shown files are numbers only: the kind of a case does not reach who explains it.
    """
    shown: FilesToMake = {}
    held_out: FilesToMake = {}
    answers: list[Answer] = []
    for name, read in track(made.items(), "sealing the answers", total=len(made)):
        code, rest = name.split("/")
        number = rest.split("_")[0]
        shown[f"{code}/{number}.zip"] = partial(files.shown_part, read)
        held_out[f"{code}/{number}.zip"] = partial(files.held_out_part, read)
        answers.append(form.from_dict(json.loads(files.unpack(read())["answer.json"])))
    data, sha256 = seal(answers)
    return shown, held_out, {"sha256": sha256, "answers": data.decode()}


def explain_cases(shown: StoredFiles) -> FilesToMake:
    """Explain every case; neither answers nor held-out forces are available here."""
    code = code_hash("mismatch", "magic_formula", "tir")
    return {
        f"{code}/{name}": Labelled(_case(name), partial(files.explained, read, METHOD))
        for name, read in shown.items()
    }


def _case(name: str) -> str:
    """What progress calls a case by the name of its file."""
    return f"case {PurePosixPath(name).stem.lstrip('0')}"


def explain_by_baselines(shown: StoredFiles, parameters: ProveConcealedParameters) -> FilesToMake:
    """The same cases by the baselines."""
    return explained_by(shown, parameters.baselines)


def explained_by(shown: StoredFiles, methods: Sequence[str]) -> FilesToMake:
    """Say how each case is explained by each of these baselines."""
    code = code_hash("concealed/baselines", "magic_formula", "tir")
    return {
        f"{code}/{method}/{name}": Labelled(
            f"{_case(name)} by {method}", partial(files.explained, read, method)
        )
        for method in methods
        for name, read in shown.items()
    }


def score_proof(
    explained: StoredFiles, by_baselines: StoredFiles, held_out: StoredFiles, sealed: dict[str, Any]
) -> tuple[pd.DataFrame, pd.DataFrame, dict[str, Any]]:
    """Score all methods against the sealed answers.

    Parameters
    ----------
    explained, by_baselines : mapping
        Files of :func:`files.explained`.
    held_out : mapping
        Files of :func:`files.held_out_part`.
    sealed : dict
        ``sha256`` and ``answers``.

    Returns
    -------
    scores : DataFrame
        ``method, name, value, low, high, n, target, met``.
    misses : DataFrame
        Every case that ``explain_mismatch`` did not answer correctly, and why.
    details : dict
        Scores by strength and by effect, and the hash of the answers.
    """
    answers: list[Answer] = unseal(sealed["answers"].encode(), sealed["sha256"])
    tables, misses = [], pd.DataFrame()
    details: dict[str, Any] = {"sha256": sealed["sha256"]}
    for method, (reports, errors) in answers_of(explained, by_baselines, held_out):
        result = score(reports, answers, held_out=errors)
        tables.append(pd.DataFrame(result["scores"]).assign(method=method))
        details[method] = {key: result[key] for key in ("n", "by_strength", "by_effect")}
        if method == METHOD:
            misses = pd.DataFrame(result["misses"]) if result["misses"] else pd.DataFrame(columns=["case_id"])
    scores = pd.concat(tables, ignore_index=True)
    return scores[["method", *[c for c in scores.columns if c != "method"]]], misses, details


def answers_of(
    explained: StoredFiles, by_baselines: StoredFiles, held_out: StoredFiles
) -> Iterator[tuple[str, tuple[dict[str, Any], dict[str, Any]]]]:
    """Yield each method with its reports and its held-out errors by case."""
    truth = {files.unpack(read())["case_id"].decode(): read for read in held_out.values()}
    methods: dict[str, FilesToMake] = {METHOD: dict(explained)}
    for name, read in by_baselines.items():
        methods.setdefault(name.split("/")[1], {})[name] = read
    for method, folder in methods.items():
        reports, errors = {}, {}
        for read in track(folder.values(), f"scoring {method}", total=len(folder)):
            content = files.unpack(read())
            case_id = content["case_id"].decode()
            reports[case_id] = json.loads(content["report.json"])
            errors[case_id] = _errors(content, truth[case_id])
        yield method, (reports, errors)


def _errors(content: dict[str, bytes], read: Read) -> dict[str, dict[str, float]]:
    """Held-out errors before and after, of a prediction that was made without seeing them."""
    sealed = files.unpack(read())
    held_out = pd.read_parquet(io.BytesIO(sealed["held_out.parquet"]))
    prediction = pd.read_parquet(io.BytesIO(content["prediction.parquet"]))
    case = Case(sealed["case_id"].decode(), read_tir(sealed["model.tir"]), held_out.head(0), held_out)
    return held_out_errors(case, lambda _: prediction)
