"""Measures of an explanation: errors on sweeps left out, the residual, what could be seen."""

from __future__ import annotations

from dataclasses import dataclass, field

from tire_pipeline.mismatch.discrepancy.gaussian_form import GaussianForm
from tire_pipeline.mismatch.model.residual import share_above_noise
from tire_pipeline.mismatch.proof.locate import Located


@dataclass(frozen=True)
class OutputFit:
    """Errors of one output on sweeps that were left out of the fit, N (moments: no fit has seen them, N m).

    Parameters
    ----------
    noise_floor : float
        RMS of the noise of the recording.
    rms_before, rms_after : float
        RMS that the model leaves as it was, and with what was found.
    rms_after_low, rms_after_high : float
        95% interval of ``rms_after`` by resampling sweeps.
    recovered : float
        Share of the squared error above the noise floor that is gone, within -1 and 1; NaN where next to
        nothing is above it.
    held_out_condition : str
        The condition, such as the highest load, whose sweeps the parameters were not fitted to; "" if there
        is none.
    rms_condition_before, rms_condition_after : float
        RMS in that condition; NaN without one.

    See Also
    --------
    MismatchReport : Holds one for each output, as ``fit``.
    HeldOutFit : The same of a whole recording that was held out.

    Notes
    -----
    Neither the choice nor the fit has seen the sweeps: both are repeated without them
    (docs/explanation/mismatch.md).

    Examples
    --------
    >>> fit = OutputFit(10.0, 50.0, 11.0, 10.5, 11.5)
    >>> round(fit.recovered, 3)
    0.991
    """

    noise_floor: float
    rms_before: float
    rms_after: float
    rms_after_low: float
    rms_after_high: float
    recovered: float = field(init=False)
    held_out_condition: str = ""
    rms_condition_before: float = float("nan")
    rms_condition_after: float = float("nan")

    def __post_init__(self) -> None:
        share = share_above_noise(self.rms_before**2, self.rms_after**2, self.noise_floor)
        object.__setattr__(self, "recovered", share)


@dataclass(frozen=True)
class Visible:
    """What this recording shows of one parameter of one effect, named or not.

    Parameters
    ----------
    name, parameter, unit : str
        The parameter is empty where the recording shows nothing, or where an effect shows without a size.
    seen : float
        Smallest size that would have been named, alone or with alternatives, in 95% of repetitions; NaN where
        no size that is possible would have been.
    ruled_out : float
        Sizes above this one are ruled out (95%); NaN if it is named, or if nothing is ruled out.
    text : str
        The same in words.
    form : dict
        What else was assumed: the reference of a temperature, the moment of a change.
    """

    name: str
    parameter: str
    unit: str
    seen: float
    ruled_out: float
    text: str
    form: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Remainder:
    """The unexplained residual: the residual above the noise.

    Parameters
    ----------
    size : dict
        Output -> RMS above noise, N.
    located : list of Located
    significant : bool
        Whether it counts.
    probability : float
        That something unnamed is there.
    gaussian : list of GaussianForm
        The output first in which most is left.
    unusual : dict
        Output -> size of the error over the largest force, where it is larger than fitted models usually
        leave.
    usual : (float, float)
        What they usually leave.
    """

    size: dict[str, float]
    located: list[Located]
    significant: bool
    probability: float = 0.0
    gaussian: list[GaussianForm] = field(default_factory=list)
    unusual: dict[str, float] = field(default_factory=dict)
    usual: tuple[float, float] = (0.0, 0.0)
