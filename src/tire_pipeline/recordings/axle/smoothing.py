"""Differentiation with a stated bandwidth, and the noise that it lets through.

Two Savitzky-Golay filters in a row: a short one takes the derivative of the pose in the fixed
frame, a long one smooths (and differentiates again) in the vehicle's own frame, where the
signals are slow even when the vehicle goes round in circles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError

Array = NDArray[np.float64]
_ORDER = 2
# Mean square of a fourth difference of white noise: 1 + 16 + 36 + 16 + 1.
_FOURTH_DIFFERENCE = 70.0
_MAD_TO_STD = 1.4826


@dataclass(frozen=True)
class Smoother:
    """The two filters for one sample interval and bandwidth.

    Parameters
    ----------
    dt : float
        Sample interval, s.
    short, long : int
        Odd window lengths in samples.
    bandwidth : float
        Frequency at which the long filter passes half of the power, Hz.
    """

    dt: float
    short: int
    long: int
    bandwidth: float

    @property
    def reach(self) -> int:
        """Samples on each side that one output depends on."""
        return (self.short - 1) // 2 + (self.long - 1) // 2

    @property
    def stop(self) -> float:
        """Frequency above which the long filter passes less than a tenth of the power, Hz."""
        frequency, response = scipy.signal.freqz(scipy.signal.savgol_coeffs(self.long, _ORDER), worN=8192)
        passed = np.flatnonzero(np.abs(response) ** 2 > 0.1)
        return float(frequency[passed[-1]] / (2 * np.pi * self.dt))

    def first(self, signal: Array) -> Array:
        """First derivative through the short filter."""
        return np.asarray(scipy.signal.savgol_filter(signal, self.short, _ORDER, deriv=1, delta=self.dt))

    def smooth(self, signal: Array, derivative: int = 0) -> Array:
        """The signal, or its derivative, through the long filter."""
        return np.asarray(
            scipy.signal.savgol_filter(signal, self.long, _ORDER, deriv=derivative, delta=self.dt)
        )

    def gain(self, short_derivative: int, long_derivative: int) -> float:
        """Standard deviation at the output for white noise of 1 at the input.

        ``short_derivative`` is 1 where the short filter comes first and 0 where it is not used.
        """
        last = scipy.signal.savgol_coeffs(self.long, _ORDER, deriv=long_derivative, delta=self.dt)
        if short_derivative:
            last = np.convolve(scipy.signal.savgol_coeffs(self.short, _ORDER, deriv=1, delta=self.dt), last)
        return float(np.linalg.norm(last))

    def rotation_gain(self) -> float:
        """Gain from noise of the yaw angle to ``(d v_y/dt + yaw rate v_x) / v_x``.

        The yaw's error turns the velocity one way and enters the yaw rate the other way. The two
        cancel but for the difference of the filters that they pass.
        """
        direct = scipy.signal.savgol_coeffs(self.long, _ORDER, deriv=1, delta=self.dt)
        rate = np.convolve(
            scipy.signal.savgol_coeffs(self.short, _ORDER, deriv=1, delta=self.dt),
            scipy.signal.savgol_coeffs(self.long, _ORDER, deriv=0, delta=self.dt),
        )
        return float(np.linalg.norm(rate - np.pad(direct, (self.short - 1) // 2)))

    def inflation(self, rate: Array, input_std: float, good: NDArray[np.bool_]) -> Array:
        """How much stronger the noise beside the band is than white noise of ``input_std`` would be.

        The power of ``rate`` (a derivative by the short filter) between 1 and 4 times the bandwidth,
        averaged over 16 periods of the bandwidth, is compared with that of differentiated white noise.
        It is computed at each sample, because it can change: a wobble once a wheel turn lies far
        outside of the band at speed and beside it when the vehicle is slow.

        Returns
        -------
        ndarray, shape (n,)
            At least 1.
        """
        values = np.where(good, rate, np.nan)
        finite = np.isfinite(values)
        length = min(values.size, round(16 / (self.bandwidth * self.dt)))
        if finite.sum() < 2 * length or input_std <= 0:
            return np.ones(rate.size)
        filled = np.interp(np.arange(values.size), np.flatnonzero(finite), values[finite])
        top = min(4.0 * self.bandwidth, 0.45 / self.dt)
        band = scipy.signal.butter(2, (self.bandwidth, top), "bandpass", fs=1.0 / self.dt, output="sos")
        # Twice, forth and back: the response is squared, and so is its power.
        passed = np.asarray(scipy.signal.sosfiltfilt(band, filled)) ** 2
        frequency, response = scipy.signal.sosfreqz(band, worN=8192)
        _, first = scipy.signal.freqz(
            scipy.signal.savgol_coeffs(self.short, _ORDER, deriv=1, delta=self.dt), worN=frequency
        )
        white = input_std**2 * float(np.mean(np.abs(response) ** 4 * np.abs(first) ** 2))
        weight = scipy.ndimage.uniform_filter1d(finite.astype(float), length, mode="nearest")
        local = scipy.ndimage.uniform_filter1d(np.where(finite, passed, 0.0), length, mode="nearest")
        return np.sqrt(np.maximum(local / np.maximum(weight, 1.0 / length) / white, 1.0))


def make_smoother(dt: float, bandwidth: float) -> Smoother:
    """Choose the windows for a bandwidth.

    Parameters
    ----------
    dt : float
        Sample interval, s.
    bandwidth : float
        Wanted half-power frequency, Hz.

    Raises
    ------
    RecordingError
        The bandwidth is not between zero and a tenth of the sampling rate.
    """
    # A millionth: the interval is fitted to stamps.
    if not 0 < bandwidth <= 0.1 / dt * (1 + 1e-6):
        raise RecordingError(
            f"a bandwidth of {bandwidth:g} Hz at {1 / dt:g} samples a second",
            todo=f"choose one above 0 and up to {0.1 / dt:g} Hz",
        )
    # Schafer (2011), "What is a Savitzky-Golay filter?", eq. 12, for half-length M and order N.
    half = ((_ORDER + 1) / (2 * bandwidth * dt) + 4.6) / 3.2
    long = 2 * max(2, round(half)) + 1
    short = max(5, 2 * (long // 8) + 1)
    return Smoother(dt, short, long, half_power(long, dt))


def half_power(window: int, dt: float) -> float:
    """Half-power frequency, Hz, of a Savitzky-Golay filter of second order."""
    frequency, response = scipy.signal.freqz(scipy.signal.savgol_coeffs(window, _ORDER), worN=8192)
    below = np.flatnonzero(np.abs(response) ** 2 < 0.5)
    return float(frequency[below[0]] / (2 * np.pi * dt))


def white_noise_std(signal: Array) -> float:
    """Standard deviation of a signal's white noise from its fourth differences (robust)."""
    if signal.size < 10:
        return 0.0
    fourth = np.diff(signal, 4)
    fourth = fourth[np.isfinite(fourth)]
    if fourth.size == 0:
        return 0.0
    moving = np.abs(fourth)[np.abs(fourth) > 0]
    if moving.size == 0:
        return 0.0
    return float(_MAD_TO_STD * np.median(moving) / np.sqrt(_FOURTH_DIFFERENCE))


def reached_by_gap(missing: NDArray[np.bool_], reach: int, longest: int) -> NDArray[np.bool_]:
    """Mark the outputs that depend on a run of more than ``longest`` missing samples."""
    padded = np.concatenate([[False], missing, [False]])
    edges = np.flatnonzero(np.diff(padded.astype(np.int8)))
    bad = np.zeros(missing.size, dtype=bool)
    for start, stop in zip(edges[::2], edges[1::2], strict=True):
        if stop - start > longest:
            bad[start:stop] = True
    return np.asarray(scipy.ndimage.binary_dilation(bad, iterations=reach)) if bad.any() else bad
