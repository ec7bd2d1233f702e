"""Sentences on the aligning moment: whether it agrees, and what to look at where it does not."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.channels import ALIGNING_MOMENT, TANGENTIAL_FORCES
from tire_pipeline.mismatch.proof.measured import OutputFit
from tire_pipeline.mismatch.report.contents import Head
from tire_pipeline.mismatch.report.unnamed_part import MomentError
from tire_pipeline.mismatch.report.words import newtons
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport

_LOOK_AT = (
    "Next, check the unit and the sign of the recorded Mz, the point about which it is taken, and whether "
    "the file's Mz was fitted to measurements."
)


def head_of_moment(moment: MomentError, fit: Mapping[str, OutputFit], unnamed: UnnamedReport) -> Head:
    """Return the head of a report whose forces agree and whose aligning moment does not.

    Parameters
    ----------
    moment : MomentError
    fit : mapping of str to OutputFit
    unnamed : UnnamedReport
        With the moment's equation, if one was proved.
    """
    forces = [o.capitalize() for o in fit if o in TANGENTIAL_FORCES]
    agree = f"{' and '.join(forces)} agree{'' if len(forces) > 1 else 's'}"
    return Head(
        f"{agree} with the recording, Mz does not: no effect of the catalogue acts on Mz alone",
        size="; ".join(filter(None, [_how_far(moment), _equation(unnamed)])),
        todo=_of_sign(moment) or _LOOK_AT,
    )


def on_moment(moment: MomentError | None, fit: Mapping[str, OutputFit]) -> str:
    """Say that the aligning moment stays far off beside what was found in the forces.

    Parameters
    ----------
    moment : MomentError, optional
    fit : mapping of str to OutputFit
        Errors with what was found.
    """
    if moment is None or not moment.stays_far_off:
        return ""
    after = fit[ALIGNING_MOMENT].rms_after
    of_effects = "" if after >= moment.before else f", and {newtons(after)} N m with what was found"
    how = f"The aligning moment does not agree: {_how_far(moment)}{of_effects}."
    return " ".join(filter(None, [how, _of_sign(moment)]))


def _equation(unnamed: UnnamedReport) -> str:
    """Say how what is missing acts, and what its equation removes on unseen sweeps."""
    if unnamed.physics is None:
        return ""
    acts_on, drivers = unnamed.physics.acts_on, ", ".join(unnamed.physics.depends_on)
    as_one = len(unnamed.coefficients) == 1 or not drivers
    acts = f"acts as {acts_on}{f' that depends on {drivers}' if drivers else ''}"
    before, after, _ = unnamed.unseen[ALIGNING_MOMENT]
    return (
        f"what is missing {acts if as_one else f'depends on {drivers}'}: an equation of it takes the RMS "
        f"error from {newtons(before)} N m to {newtons(after)} N m on held-out sweeps"
    )


def _how_far(moment: MomentError) -> str:
    noise = "" if np.isnan(moment.noise) else f"; noise {newtons(moment.noise)} N m"
    share = moment.before / moment.largest
    return f"Mz is off by {newtons(moment.before)} N m RMS ({share:.0%} of the model's largest{noise})"


def _of_sign(moment: MomentError) -> str:
    if not moment.other_sign:
        return ""
    return (
        "Next, check the sign of the recorded Mz: with the other sign it is off by "
        f"{newtons(moment.mirrored)} N m RMS."
    )
