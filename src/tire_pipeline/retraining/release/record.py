"""The record of what was released, refused and taken back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from tire_pipeline.errors import DomainError
from tire_pipeline.retraining.release.model import CategoryModel

KEPT_MODELS = 20
KEPT_EVENTS = 1000
TO_GO_BACK = "`kedro run --pipeline rollback` puts back the last one whose file is whole; or restore the file"
WITHOUT_ANY_MODEL = (
    "restore a model from a backup; or move the folder of released models away and run "
    "`kedro run --pipeline retrain`, which trains the first model again from the files"
)
UNCHANGED = "unchanged"
_RELEASED_EVENT, _REFUSED_EVENT, _ROLLED_BACK_EVENT = "released", "refused", "rolled back"


@dataclass(frozen=True)
class Judged:
    """What a candidate was trained on and judged by.

    Attributes
    ----------
    digest : str
        Of the contents of all files (:attr:`Manifest.digest`).
    settings : str
        Hash of the parameters.
    sequence : int
        The store's sequence number.
    split : str
        Names the held-out tires: share and seed.
    """

    digest: str
    settings: str
    sequence: int
    split: str


@dataclass(frozen=True)
class Release:
    """Which model is in use, which were before it, and what happened.

    Attributes
    ----------
    revision : int
        Grows by one with every event; two runs at once are told apart by it.
    models : tuple of str
        Released models, oldest first; the last is in use.
    splits : mapping
        Model -> which tires were held out from it.
    judged : Judged or None
        The last candidate.
    history : tuple of dict
        One an event: ``revision, time, event, model, reason`` and figures.
    """

    revision: int = 0
    models: tuple[str, ...] = ()
    splits: Mapping[str, str] = field(default_factory=dict)
    judged: Judged | None = None
    history: tuple[Mapping[str, Any], ...] = ()

    @property
    def current(self) -> str | None:
        """The model in use."""
        return self.models[-1] if self.models else None

    @property
    def last_event(self) -> Mapping[str, Any]:
        """What happened last."""
        return self.history[-1] if self.history else {}

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Release:
        """What :meth:`to_dict` gave."""
        judged = data["judged"]
        return cls(
            revision=int(data["revision"]),
            models=tuple(data["models"]),
            splits=dict(data["splits"]),
            judged=Judged(**judged) if judged else None,
            history=tuple(data["history"]),
        )

    def _with(self, event: Mapping[str, Any], **changes: Any) -> Release:
        number = self.revision + 1
        history = [*self.history, {"revision": number, **event}][-KEPT_EVENTS:]
        return replace(self, revision=number, history=tuple(history), **changes)


@dataclass(frozen=True)
class ModelRegistry:
    """The record and the model in use (or the one to be put into use).

    Attributes
    ----------
    release : Release
    model : CategoryModel or None
        None if there is none, or if it is stored already.
    unusable : mapping
        Models of the record whose files are gone or damaged -> what is wrong with them. Only told for going
        back.
    """

    release: Release = field(default_factory=Release)
    model: CategoryModel | None = None
    unusable: Mapping[str, str] = field(default_factory=dict)


def judge(
    release: Release,
    model: str,
    judged: Judged,
    *,
    better: bool,
    time: str,
    figures: Mapping[str, float | None],
) -> Release:
    """Release a candidate if it is not worse, refuse it otherwise; never judge the same thing twice.

    Parameters
    ----------
    release : Release
    model : str
        Name of the candidate.
    judged : Judged
        What it was trained on. If that is what was judged last, nothing happens: so a run that was killed
        after its release changes nothing when it is repeated, and a model that was rolled back does not
        return until files or parameters change.
    better : bool
        Whether the candidate is at least as good as the released model.
    time : str
    figures : mapping
        For the history.

    Returns
    -------
    Release
        The same object if nothing happened.
    """
    before = release.judged
    if before is not None and (before.digest, before.settings) == (judged.digest, judged.settings):
        return release
    event = {"time": time, "model": model, **figures}
    if not better:
        reason = "worse than the released model on the held-out tires"
        return release._with({**event, "event": _REFUSED_EVENT, "reason": reason}, judged=judged)
    reason = (
        "not worse than the released model on the held-out tires" if release.models else "it is the first one"
    )
    models = (*release.models, model)[-KEPT_MODELS:]
    splits = {name: ({**release.splits, model: judged.split})[name] for name in models}
    event = {**event, "event": _RELEASED_EVENT, "reason": reason}
    return release._with(event, judged=judged, models=models, splits=splits)


def roll_back(release: Release, *, time: str, unusable: Mapping[str, str] | None = None) -> Release:
    """Put the last model before the present one back whose file is there.

    Parameters
    ----------
    release : Release
    time : str
    unusable : mapping, optional
        Models whose files are gone or damaged -> what is wrong with them. They are skipped.

    Raises
    ------
    DomainError
        There is none. It says what is left to do.
    """
    broken = unusable or {}
    earlier = release.models[:-1]
    while earlier and earlier[-1] in broken:
        earlier = earlier[:-1]
    if not earlier:
        raise _nothing_left(release, broken)
    left = [name for name in release.models[len(earlier) :] if name in broken]
    reason = f"{release.models[-1]} was taken back by the pipeline rollback"
    if left:
        reason += f" (unusable: {', '.join(left)})"
    event = {"time": time, "event": _ROLLED_BACK_EVENT, "model": earlier[-1], "reason": reason}
    return release._with(event, models=earlier, splits={name: release.splits[name] for name in earlier})


def _nothing_left(release: Release, broken: Mapping[str, str]) -> DomainError:
    if release.current in broken:
        wrong = "; ".join(f"{name} is {broken[name]}" for name in reversed(release.models) if name in broken)
        return DomainError(f"there is no model left to go back to: {wrong}", todo=WITHOUT_ANY_MODEL)
    have = "no model was released yet"
    if len(release.models) == 1:
        have = f"{release.current} is the only one on record"
    elif release.models:
        have = "; ".join(f"{name} is {broken[name]}" for name in reversed(release.models[:-1]))
    todo = "run `kedro run --pipeline retrain`"
    if release.current is not None:
        todo = f"keep {release.current}, which is in use and whole, or run `kedro run --pipeline retrain`"
    return DomainError(f"there is no earlier model to go back to: {have}", todo=todo)


def check_split(release: Release, split: str) -> None:
    """Refuse to compare models that other tires were held out from.

    Raises
    ------
    DomainError
        The released model may have been trained on tires that are held out now.
    """
    current = release.current
    if current is not None and release.splits[current] != split:
        raise DomainError(
            f"the released model had other tires held out ({release.splits[current]}, now {split})",
            where="retrain",
            todo="set retrain.held_out_share and retrain.split_seed back, or move the folder of released "
            "models away to start again",
        )


def history_rows(release: Release, most: int = 20) -> Sequence[Mapping[str, Any]]:
    """The last events, newest first."""
    return list(reversed(release.history))[:most]
