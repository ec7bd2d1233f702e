"""Sentences on an equation of unnamed physics."""

from __future__ import annotations

from collections.abc import Sequence

from tire_pipeline.channels import ALIGNING_MOMENT, unit_of
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.report.words import newtons
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport


def on_unnamed(found: UnnamedReport | None, verdict: str, rivals: Sequence[Sequence[str]] = ()) -> str:
    """Return one or two sentences on the unexplained residual; empty if nothing is known.

    Parameters
    ----------
    found : UnnamedReport, optional
    verdict : str
    rivals : sequence of sequence of str
        Sets of effects of which each would explain it.
    """
    if found is None or found.physics is None:
        return ""
    first = verdict in ("unexplained", "partly explained")
    what = "The unexplained residual" if first else "The remaining residual"
    if set(found.physics.equations) == {ALIGNING_MOMENT}:
        what = f"{what} of Mz"
    text = (
        f"{what} {_resembles(found, rivals)}. Of what was recorded, it depends most on "
        f"{_drivers(found)}. The corrected model contains an equation for it"
    )
    if verdict in ("unexplained", "undecided"):
        return f"{text}."
    shares = " and ".join(
        f"{100.0 * (1.0 - after / before):.0f}% of the remaining RMS error of {o.capitalize()}"
        for o, (before, after, _) in _unseen(found).items()
    )
    return (
        f"{text}. It removes {shares} on sweeps that took no part in choosing or fitting it. The errors "
        "above include the equation."
    )


def of_equation(found: UnnamedReport | None) -> str:
    """What an equation does on unseen sweeps where no name stands beside it."""
    if found is None or found.physics is None:
        return ""
    errors = ", that of ".join(
        f"{o.capitalize()} from {newtons(before)} {unit_of(o)} to {newtons(after)} {unit_of(o)}"
        for o, (before, after, _) in _unseen(found).items()
    )
    return f"an equation in {_drivers(found)} takes the RMS error of {errors} on held-out sweeps"


def _resembles(found: UnnamedReport, rivals: Sequence[Sequence[str]]) -> str:
    """Say which effects it could be taken for, if any."""
    named = [names for names in rivals if names]
    if not found.instead_of and named:
        explanations = "an explanation" if len(named) == 1 else "several explanations"
        return f"has {explanations} in the catalogue"
    if not found.instead_of:
        return "does not look like any effect of the catalogue"
    names = " and ".join(catalogue()[name].title.lower() for name in found.instead_of)
    return f"resembles {names}, but an equation alone predicts unseen sweeps better"


def _drivers(found: UnnamedReport) -> str:
    assert found.physics is not None
    return found.physics.drivers_in_words


def _unseen(found: UnnamedReport) -> dict[str, tuple[float, float, float]]:
    assert found.physics is not None
    return {o: found.unseen[o] for o in found.physics.equations}
