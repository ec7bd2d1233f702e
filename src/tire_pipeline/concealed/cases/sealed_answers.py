"""What a case conceals. Kept apart from the cases, sealed by a hash, read by the scorer alone."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Self, TypeVar

from tire_pipeline.errors import DomainError


@dataclass(frozen=True)
class EffectTruth:
    """One concealed effect.

    Attributes
    ----------
    name, kind : str
        Name, and "physics", "artefact" or "unknown".
    strength : float
        In the simulator's own terms.
    rms : float
        RMS over the recording of what the effect adds to recorded less modelled force, N.
    over_misfit, over_noise : float
        ``rms`` over the model's misfit without effects, and over the noise.
    output : str
        Force in which it is largest.
    when : list of (start, end)
        Stretches in which its local RMS (1 s) is above the noise, s.
    where : mapping
        Channel -> interval that holds the central 90% of its energy, SI.
    details : mapping
        Channel, unit or moment, where it has one.
    """

    name: str
    kind: str
    strength: float
    rms: float
    over_misfit: float
    over_noise: float
    output: str
    when: tuple[tuple[float, float], ...]
    where: Mapping[str, tuple[float, float]]
    details: Mapping[str, object]


@dataclass(frozen=True)
class Answer:
    """Everything about a case that ``explain_mismatch`` must find out by itself.

    Attributes
    ----------
    case_id, kind : str
        Kind as in ``effect_names.KINDS``.
    effects : tuple of EffectTruth
    acceptable : tuple of str
        Ambiguous cases: the names that the recording cannot separate; else empty.
    missing_channels : tuple of str
        Channels taken out of the recording.
    blocks : tuple of str
        Optional blocks of the schedule.
    focus : tuple of str
        Effects, concealed or decoys, that the schedule was made for.
    largest_force, misfit, noise : float
        N; misfit and noise are RMS over the recording, both forces together.
    oracle : mapping
        Output -> ``rms_before`` and ``rms_oracle`` on the held-out run, N: of the ``.tir`` and of
        the simulator with the effect put in (base misfit and noise remain).
    """

    case_id: str
    kind: str
    effects: tuple[EffectTruth, ...]
    acceptable: tuple[str, ...]
    missing_channels: tuple[str, ...]
    blocks: tuple[str, ...]
    focus: tuple[str, ...]
    largest_force: float
    misfit: float
    noise: float
    oracle: Mapping[str, Mapping[str, float]]

    @property
    def right_names(self) -> set[str]:
        """Names that are right: of what is concealed, and of what the recording cannot tell from it."""
        return {effect.name for effect in self.effects} | set(self.acceptable)

    def to_dict(self) -> dict:
        """Return the answer as plain JSON types."""
        return json.loads(json.dumps(asdict(self)))

    @classmethod
    def from_dict(cls, data: Mapping) -> Self:
        """Return the answer that :meth:`to_dict` wrote."""
        effects = tuple(
            EffectTruth(
                **{
                    **e,
                    "when": tuple((float(a), float(b)) for a, b in e["when"]),
                    "where": {k: (float(a), float(b)) for k, (a, b) in e["where"].items()},
                }
            )
            for e in data["effects"]
        )
        lists = {k: tuple(v) for k, v in data.items() if isinstance(v, list)}
        return cls(**{**data, **lists, "effects": effects})


A = TypeVar("A", bound=Answer)


def seal(answers: Iterable[Answer]) -> tuple[bytes, str]:
    """Write answers as canonical JSON and give its SHA-256.

    Parameters
    ----------
    answers : iterable of Answer

    Returns
    -------
    data : bytes
        JSON, sorted by case and key: the same answers always give the same bytes.
    sha256 : str
        To be published before any case is explained.
    """
    rows = sorted((a.to_dict() for a in answers), key=lambda row: row["case_id"])
    data = json.dumps(rows, sort_keys=True, separators=(",", ":")).encode()
    return data, hashlib.sha256(data).hexdigest()


def unseal(data: bytes, sha256: str, form: type[A] = Answer) -> list[A]:  # type: ignore[assignment]
    """Read sealed answers back, as ``form``.

    Raises
    ------
    DomainError
        If the data does not match the published hash.
    """
    found = hashlib.sha256(data).hexdigest()
    if found != sha256:
        raise DomainError(
            f"the answers' SHA-256 is {found}, published was {sha256}",
            where="sealed answers",
            todo="take the answers that belong to these cases",
        )
    return [form.from_dict(row) for row in json.loads(data)]
