"""Provide averages, spectra and frequencies shared by views."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.channels import RINGS
from lambda_core.formulas.kinematics import FrequencyOrders, cage_speed, frequency_orders
from lambda_core.model.bearing_model import Solver
from lambda_core.plugins import FloatArray, NotApplicable, RunData, Series
from lambda_core.results.convergence import window
from lambda_core.results.rolling import is_full_complement

BINS = 72  # over azimuth: 5 degrees each
BODY = {"inner": 0, "outer": 1, "cage": 2}
_MOST_POINTS = 4000  # of a drawn line
SHORTEST_SPECTRUM = 32  # samples


@dataclass(frozen=True)
class Span:
    """The part of a run that a view looks at."""

    start: float  # [s]
    words: str

    def rows(self, time: FloatArray) -> slice:
        """Return the rows of the channels in the span."""
        return slice(int(np.searchsorted(time, self.start)), None)


def averaging(run: RunData) -> Span:
    """Return the averaging window of a run.

    It consists of whole cage revolutions after the discarded ones.
    """
    settings = Solver(**{name: float(value) for name, value in run.model["solver"].items()})
    chosen = window(settings, run.revolutions(), run.integrals()[-1])
    start, end = float(chosen.interval.first[0]), float(chosen.interval.last[0])
    turn = "roller orbit" if is_full_complement(run.model) else "cage revolution"
    if chosen.revolutions:
        words = f"{chosen.revolutions} {turn}s from {1e3 * start:.4g} to {1e3 * end:.4g} ms"
        return Span(start, words)
    return Span(start, f"the whole run, {1e3 * end:.4g} ms: no {turn} to average over yet")


def source(run: RunData) -> str:
    """Return the line that identifies a run.

    Case, bearing, loads and speed, oil and clearance.
    """
    bearing, conditions, *_ = run.headline.splitlines()
    parts = re.split(r" {2,}", bearing)
    loads = [part for part in re.split(r" {3,}", conditions) if part != "cage on" and not part.startswith("strips ")]
    clearance = next((part.split(" (")[0] for part in parts if part.startswith("clearance ")), "")
    return "   ".join(filter(None, (f"{run.case}: {run.title}", *loads, parts[-1], clearance)))


def has_rollers(run: RunData) -> bool:
    """Tell whether the elements of a run are rollers."""
    return any(channel.name == "roller_lean" for channel in run.channels)


def require_cage(run: RunData) -> None:
    """Refuse runs without a cage."""
    if not run.model["depth"]["cage"]:
        raise NotApplicable("the cage is switched off in this run")


def number(value: object) -> float:
    """Return a number of the resolved model.

    The model writes NaN and infinity as text.
    """
    return float(str(value))


@dataclass(frozen=True)
class Profile:
    """A channel over azimuth.

    Mean and spread in bins of equal width.
    """

    azimuth: FloatArray  # centres of the bins [deg], shape (bins,)
    mean: FloatArray  # NaN where nothing was
    low: FloatArray
    high: FloatArray


def profile(azimuth: FloatArray, values: FloatArray, keep: NDArray[np.bool_], bins: int = BINS) -> Profile:
    """Return average values over azimuth.

    Parameters
    ----------
    azimuth : float64[...]
        [rad], any winding.
    values, keep : arrays of the same shape
        `keep` says which samples count.
    """
    used = keep & np.isfinite(values)
    index = np.floor(np.mod(azimuth[used], 2.0 * math.pi) / (2.0 * math.pi) * bins).astype(int) % bins
    data = values[used]
    count = np.bincount(index, minlength=bins)
    with np.errstate(invalid="ignore"):
        mean = np.bincount(index, data, bins) / count
    low, high = np.full(bins, np.inf), np.full(bins, -np.inf)
    np.minimum.at(low, index, data)
    np.maximum.at(high, index, data)
    empty = count == 0
    low[empty], high[empty] = np.nan, np.nan
    return Profile((np.arange(bins) + 0.5) * 360.0 / bins, mean, low, high)


def over_azimuth(
    run: RunData,
    span: Span,
    values: FloatArray,
    keep: NDArray[np.bool_],
    name: str,
    role: str,
    *,
    end: bool = True,
) -> list[Series]:
    """Return a channel over azimuth.

    Mean and range, and every ball at the end state as a point.

    Parameters
    ----------
    values, keep : arrays, shape (time, ball)
        In the unit of the axis, over the whole run.
    """
    rows = span.rows(run["time"])
    azimuth = run["ball_azimuth"]
    found = profile(azimuth[rows], values[rows], keep[rows])
    series = []
    if azimuth.shape[0] > 1:
        series.append(
            Series(name, found.azimuth, found.mean, "line", role, found.low, found.high, "smallest to largest")
        )
    if end:
        at = np.degrees(azimuth[-1]) % 360.0
        last = np.where(keep[-1], values[-1], np.nan)
        order = np.argsort(at)
        label = f"{name}, end state" if series else name
        series.append(Series(label, at[order], last[order], "points", role, unlisted=bool(series)))
    return series


def of_ring(run: RunData, channel: str, ring: str) -> FloatArray:
    """Return a contact channel of one ring.

    It has the shape (time, ball), in SI.
    """
    return run[channel][:, :, RINGS.index(ring)]


@dataclass(frozen=True)
class Speeds:
    """Mean and kinematic speeds of a span.

    They are in rad/s, except `orders`.
    """

    inner: float
    outer: float
    cage: float  # of balls that roll without sliding
    contact_angle: float  # mean over the loaded contacts [rad]
    orders: FrequencyOrders

    @property
    def relative(self) -> float:
        """Speed of the inner ring against the outer [rad/s]."""
        return self.inner - self.outer

    def frequencies(self) -> dict[str, float]:
        """Return the characteristic frequencies by their usual names [Hz]."""
        turns = abs(self.relative) / (2.0 * math.pi)
        orders = self.orders
        return {
            "FTF": orders.cage * turns,
            "shaft": turns,
            "BSF": orders.ball_spin * turns,
            "2 BSF": 2.0 * orders.ball_spin * turns,
            "BPFO": orders.outer_pass * turns,
            "BPFI": orders.inner_pass * turns,
        }


def speeds(run: RunData, span: Span) -> Speeds:
    """Return mean and kinematic speeds of a span.

    The kinematic ones belong to the mean speeds of the rings.
    """
    rows = span.rows(run["time"])
    spin = run["body_spin"][rows].mean(axis=0)
    load, angle = run["load"][rows], run["contact_angle"][rows]
    total = load.sum()
    cosine = float((load * np.cos(angle)).sum() / total) if total > 0.0 else 1.0
    mean_angle = math.acos(min(max(cosine, -1.0), 1.0))
    geometry: Mapping[str, float] = run.model["geometry"]
    ball, pitch, count = geometry["ball_diameter"], geometry["pitch_diameter"], int(geometry["ball_count"])
    gamma = ball * cosine / pitch
    inner, outer = float(spin[BODY["inner"]]), float(spin[BODY["outer"]])
    orders = frequency_orders(count, ball, pitch, mean_angle)
    return Speeds(inner, outer, cage_speed(inner, outer, gamma), mean_angle, orders)


def spectrum(time: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the single-sided amplitude spectrum of evenly sampled values.

    Hann window, amplitude of a sine wave read at its peak (Harris 1978, Proc. IEEE 66, 51: coherent gain 1/2);
    the mean is taken off first.

    Returns
    -------
    frequency : float64[:]
        [Hz], without zero.
    amplitude : float64[:]
        In the unit of `values`.
    """
    n = values.size
    if n < SHORTEST_SPECTRUM:
        raise NotApplicable(
            f"{n} samples to average over are too few for a spectrum: at least {SHORTEST_SPECTRUM}; simulate longer"
        )
    taper = np.hanning(n + 1)[:n]
    amplitude: FloatArray = np.asarray(2.0 * np.abs(np.fft.rfft((values - values.mean()) * taper)) / taper.sum(), float)
    step = float(time[-1] - time[0]) / (n - 1)
    return np.asarray(np.fft.rfftfreq(n, step)[1:], dtype=np.float64), amplitude[1:]


def integration(run: RunData, frequency: float) -> tuple[str, ...]:
    """Return what the integration does to vibrations.

    It concerns a spectrum that ends at a frequency [Hz].
    """
    found = run.summary().vibrations
    return (found.note(frequency),) if found is not None and frequency > 0.0 else ()


def trace(name: str, x: FloatArray, y: FloatArray, role: str = "") -> Series:
    """Return a line of at most some thousand points.

    It has every k-th point of a long record.
    """
    step = max(1, -(-x.size // _MOST_POINTS))
    return Series(name, x[::step], y[::step], "line", role)
