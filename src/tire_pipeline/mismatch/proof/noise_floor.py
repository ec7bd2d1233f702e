"""The noise of a recording, as its own samples show it."""

from __future__ import annotations

from tire_pipeline.mismatch.discrepancy.noise import estimate_noise, refined
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.model.residual import residual, rms

_DEVIATION_SUFFIX = "_std"


def noise_floors(analysis: Analysis, *, settled: bool) -> dict[str, float]:
    """Return the RMS of the noise of each output, N: at most what a smooth misfit leaves of the residual.

    Noise may be slow, and so may physics without a name. Where the residual is not settled, noise is
    therefore no more than what differs between neighbouring samples.

    A recording may state how uncertain its channels are (``fy_std``, ``slip_angle_std``). Samples are weighed
    by it, but it is no noise: much of it is the same throughout a drive, such as an axle mass or the place of
    a marker, and what of it changes is in the samples already.

    Parameters
    ----------
    analysis : Analysis
        With the set that is named.
    settled : bool
        Whether the residual is explained, or of a size that fitted models usually leave.
    """
    data, fit = analysis.data, analysis.fit
    rest = residual(data, fit.changes)
    smooth = analysis.system.fitted(rest, fit.columns if fit.labels else None)
    calm = {o: r - analysis.columns[o] @ smooth[o] for o, r in rest.items()}
    noise = analysis.noise
    if any(n.endswith(_DEVIATION_SUFFIX) for n in data.channels):
        seen = estimate_noise(data, calm, stated=False)
        noise = {o: refined(data, n, calm[o]) for o, n in seen.items()}
    floors = {o: min(n.floor, rms(calm[o]), rms(rest[o])) for o, n in noise.items()}
    if settled:
        return floors
    return {o: min(floors[o], n.floor) for o, n in estimate_noise(data, rest).items()}
