"""The report of a mismatch: verdict, effects, fit, and what to record next."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tire_pipeline.files.json_values import json_value
from tire_pipeline.mismatch.report.contents import ReportContents

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(repr=False)
class MismatchReport(ReportContents):
    """The result of :func:`tire_pipeline.mismatch.explain_mismatch`.

    Parameters
    ----------
    verdict : str
        "agrees", "undecided", "explained", "ambiguous", "partly explained", "unexplained", "unusable" or
        "another tire".
    effects : list of EffectReport
        What was found, the surest first.
    fit : dict of str to OutputFit
        Errors of each force (N) and moment (N m) before and after, on sweeps that no fit has seen.
    next_experiment : str
        What to record next, in words.
    corrected : CorrectedModel
        The model with what was found added.
    head : Head
        What is said first: ``head.text``, or ``summary``, is three sentences; ``head.remarks`` are beside it.
    located : list of Located
        Stretches of time and of channels (SI) in which recorded and simulated force differ.
    remainder : Remainder
        The residual above the noise.
    notes : list of str
        What was done to the recording, and what it lacks.
    candidates : list of dict
        Each effect of the catalogue, and why it was named or not.
    series : dict
        Arrays of one value a sample, for the figures.
    recordings : tuple of str
        Names of the recordings that were explained together.
    held_out : HeldOutFit, optional
        Errors in the recording that was held out.
    each : tuple of HeldOutFit
        Errors in each of several recordings that were explained together; no test, because they took part.
    assumed : list of str
        What was assumed because the recording does not state it.
    find_visible : callable
        Returns :attr:`visible`, which takes longest to compute: it is called when that is first used.
    unnamed : UnnamedReport
        An equation of the residual, or why there is none.
    withheld : tuple of str
        Named effects that are not in ``corrected``, because it is not certain that they improve unseen
        sweeps.
    probabilities : list of (tuple of str, float)
        The sets of effects that hold 95% of the posterior, the likeliest first.

    See Also
    --------
    explain_mismatch : Makes it.
    CorrectedModel : The corrected model, for further use.

    Notes
    -----
    How each figure is computed: ``docs/explanation/mismatch.md``.

    Examples
    --------
    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.mismatch import explain_mismatch
    >>> from tire_pipeline.tir import read_tir
    >>> tire = read_tir("tire.tir")
    >>> slip_angle = np.tile(np.linspace(-0.15, 0.15, 100), 2)
    >>> rig = pd.DataFrame({"slip_angle": slip_angle, "normal_load": np.repeat([3000.0, 5000.0], 100)})
    >>> rig["fy"] = tire.forces(slip_angle=rig["slip_angle"], normal_load=rig["normal_load"]).fy
    >>> rig["fy"] += np.random.default_rng(0).normal(0.0, 20.0, len(rig))
    >>> report = explain_mismatch(tire, rig)
    >>> report.verdict, report.effects, sorted(report.fit)
    ('agrees', [], ['fy'])
    """

    @property
    def sets(self) -> list[tuple[tuple[str, ...], float]]:
        """What was found: names of which one is the cause, likeliest first, and the confidence of the set."""
        return [(e.names, e.confidence) for e in self.effects]

    def __repr__(self) -> str:
        names = ", ".join(effect.name for effect in self.effects) or "no effect"
        return f"MismatchReport({self.stated_verdict!r}: {names}. {self.summary})"

    def _repr_html_(self) -> str:
        from tire_pipeline.pages.notebook import card
        from tire_pipeline.pages.numbers_in_words import in_digits

        rows = [
            (
                name,
                in_digits(fit.rms_before),
                in_digits(fit.rms_after),
                in_digits(fit.noise_floor),
            )
            for name, fit in self.fit.items()
        ]
        header = ("output", "RMS before", "RMS after, held-out sweeps", "noise")
        return card(f"Simulation and recording: {self.stated_verdict}", self.summary, header, rows)

    def plot(self) -> Figure:
        """Draw what differs over slip and load and over time, before and after, with captions.

        Returns
        -------
        matplotlib.figure.Figure
            Of the output that differs most, beside its noise.
        """
        from tire_pipeline.mismatch.report.figures import overview

        return overview(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the report as plain JSON types.

        Returns
        -------
        dict
            SI units; no arrays, and None for NaN.
        """
        raw = {
            "verdict": self.verdict,
            "summary": self.summary,
            "remarks": list(self.head.remarks),
            "effects": [asdict(e) for e in self.effects],
            "sets": [{"names": list(names), "confidence": p} for names, p in self.sets],
            "fit": {o: asdict(f) for o, f in self.fit.items()},
            "next_experiment": self.next_experiment,
            "located": [asdict(f) for f in self.located],
            "remainder": asdict(self.remainder),
            "notes": list(self.notes),
            "assumed": list(self.assumed),
            "question": None if self.corrected.question is None else asdict(self.corrected.question),
            "candidates": self.candidates,
            "visible": [asdict(v) for v in self.visible],
            "recordings": list(self.recordings),
            "held_out": None if self.held_out is None else asdict(self.held_out),
            "each": [asdict(each) for each in self.each],
            "unnamed": asdict(self.unnamed),
            "withheld": list(self.withheld),
            "probabilities": [{"names": list(names), "probability": p} for names, p in self.probabilities],
            "corrected": [{"name": n, "parameters": dict(p)} for n, p in self.corrected.changes],
        }
        return json.loads(json.dumps(json_value(raw)))

    def to_json(self, path: str | Path) -> Path:
        """Write :meth:`to_dict` as a JSON file.

        Parameters
        ----------
        path : str or Path
            Where; a file that is there is overwritten.

        Returns
        -------
        Path
            The same.
        """
        path = Path(path)
        path.write_text(json.dumps(self.to_dict(), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        return path

    def to_html(self, path: str | Path, *, pages: Sequence[tuple[str, str]] = ()) -> Path:
        """Write the report as one HTML page that needs no network.

        Parameters
        ----------
        path : str or Path
        pages : sequence of (str, str)
            Address and name of other pages, for links at the top.

        Returns
        -------
        Path
        """
        from tire_pipeline.mismatch.report.report_page import render

        path = Path(path)
        path.write_text(render(self, pages=pages), encoding="utf-8")
        return path
