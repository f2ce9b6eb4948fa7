"""Draw the vibration of a ring and its spectra."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field

from lambda_core.analysis.band.quantities import Condition, Measured, Vocabulary
from lambda_core.domain.channels import DIMENSIONS
from lambda_core.domain.errors import UsageError
from lambda_core.fitting.measurements import Measurements, read_measurements
from lambda_core.plugins import (
    Axis,
    FloatArray,
    Mark,
    NotApplicable,
    Options,
    Panel,
    RunData,
    Series,
    View,
    ViewData,
)
from lambda_plugins.views.common import BODY, SHORTEST_SPECTRUM, averaging, integration, source, spectrum, speeds, trace

_STILL = 1e-12  # [m] below this a ring does not move
_WIDTH = 3.5  # times the highest characteristic frequency: end of the spectra
_ENVELOPE = 1.0  # times the highest characteristic frequency: low end of the band whose envelope is taken
_MOST = 200_000  # lines of a measured signal
# How often the position is differentiated; unit and its size in SI.
_MOTIONS = {"displacement": ("um", 1e-6), "velocity": ("mm/s", 1e-3), "acceleration": ("m/s2", 1.0)}
COLUMNS = Vocabulary(
    {"time": Condition("", "time", "time")},
    {
        "displacement": Measured("", "small_length", "um", is_signed=True),
        "velocity": Measured("", "velocity", "mm/s", is_signed=True),
        "acceleration": Measured("", "acceleration", "m/s2", is_signed=True),
    },
    '"time [s],acceleration [m/s2]"',
    _MOST,
)


class VibrationOptions(Options):
    """Measured quantity and place of a sensor."""

    motion: Literal["displacement", "velocity", "acceleration"] = Field(
        "acceleration", description="what is shown; by default the motion that was measured"
    )
    place: Literal["housing", "shaft"] = Field("shaft", description="outer ring with its housing, or inner ring")
    axis: Literal["x", "y", "z"] = Field("z", description="along the shaft, horizontal, vertical")
    above: float = Field(
        0.0, ge=0.0, description="low end of the band of the envelope [Hz]; 0: the highest defect frequency"
    )
    measured: str = Field("", description='CSV file of a measured signal: "time [s]" and the motion with its unit')


@dataclass(frozen=True)
class _Signal:
    name: str
    time: FloatArray  # [s], evenly spaced
    values: FloatArray  # in the unit of the motion
    role: str


def envelope(time: FloatArray, values: FloatArray, low: float) -> FloatArray:
    """Return the envelope of a signal above a frequency.

    It is the size of its analytic signal.

    Parameters
    ----------
    time, values : float64[:], shape (n,)
        Evenly spaced.
    low : float
        [Hz].

    References
    ----------
    Randall and Antoni 2011, Mech. Syst. Signal Process. 25, 485, section 5.
    """
    n = values.size
    parts = np.fft.fft(values - values.mean())
    frequency = np.fft.fftfreq(n, float(time[-1] - time[0]) / (n - 1))
    return np.abs(np.fft.ifft(np.where(frequency >= low, 2.0 * parts, 0.0)))


def vibration(run: RunData, options: VibrationOptions) -> ViewData:
    """Show a vibration signal and its spectra.

    It shows displacement, velocity or acceleration over time, its spectrum and that of its envelope.
    """
    span = averaging(run)
    data = read_measurements(Path(options.measured), COLUMNS) if options.measured else None
    options = _of_measured(options, data)
    unit, _ = _MOTIONS[options.motion]
    own = _computed(run, options, span.rows(run["time"]))
    signals = [own] if data is None else [own, _signal(data, options.motion)]
    signals.sort(key=lambda one: -float(np.ptp(one.values)))  # the smaller one is drawn last, upon the larger
    marks = speeds(run, span).frequencies()
    highest = max(marks.values())
    low = options.above or _ENVELOPE * highest
    if not low < 0.5 / (own.time[1] - own.time[0]):
        raise UsageError(
            f"view vibration: above={low:g} Hz is above the highest frequency of the samples: choose a lower one"
        )
    for one in signals:
        if not low < 0.5 / (one.time[1] - one.time[0]) and one is not own:
            raise UsageError(
                f"{one.name}: the envelope begins at {low:.4g} Hz, above all frequencies of the samples: measure more "
                "often, or choose a lower one with above"
            )
    lines = tuple(Mark(name, value, "x") for name, value in marks.items() if value > 0.0)
    end = max(_WIDTH * highest, 1.5 * low)
    panels = (
        _over_time(signals, options.motion, unit),
        _spectra("spectrum", [(s, s.values) for s in signals], unit, end, lines),
        _spectra(
            "spectrum of the envelope", [(s, envelope(s.time, s.values, low)) for s in signals], unit,
            _WIDTH * highest, (*lines, *_sidebands(marks)),
        ),
    )  # fmt: skip
    words = "BPFI ± shaft, 2 BSF ± FTF: sidebands of defects that turn through the loaded zone"
    notes = (
        f"{options.motion} of the {options.place} along {options.axis} over {span.words}; Hann window",
        f"envelope of all above {low:.4g} Hz; {words}",
        *integration(run, 0.5 / (own.time[1] - own.time[0])),
    )
    return ViewData("vibration", f"{options.motion.capitalize()} of the {options.place}", source(run), panels, 1, notes)


def _computed(run: RunData, options: VibrationOptions, rows: slice) -> _Signal:
    """Return the signal of a run.

    Acceleration is the difference of the velocity.
    """
    body, k = BODY["outer" if options.place == "housing" else "inner"], DIMENSIONS["axis"].index(options.axis)
    time, place = run["time"][rows], run["body_position"][rows, body, k]
    if place.size < 3 or np.ptp(place) <= _STILL:
        remedy = (
            f'let it move, for example with bodies.outer_ring.{options.axis} = {{ mode = "free", stiffness = '
            '"100 N/um", damping = "2000 N s/m" }'
            if options.place == "housing"
            else "choose another axis"
        )
        raise NotApplicable(f"the {options.place} does not move along {options.axis} in the averaging window: {remedy}")
    values = place - place.mean()
    if options.motion != "displacement":
        values = run["body_velocity"][rows, body, k]
    if options.motion == "acceleration":
        values = np.gradient(values, time)
    role = "outer" if options.place == "housing" else "inner"
    return _Signal("computed", time, values / _MOTIONS[options.motion][1], role)


def _of_measured(options: VibrationOptions, data: Measurements | None) -> VibrationOptions:
    """Return options that show what was measured.

    A chosen motion stays, and so does the default one where it was measured.
    """
    if data is None or "motion" in options.model_fields_set or options.motion in data.measured:
        return options
    return options.model_copy(update={"motion": next(iter(data.measured))})


def _signal(data: Measurements, motion: str) -> _Signal:
    """Return a measured signal, from time 0 on."""
    if motion not in data.measured or "time" not in data.conditions:
        unit = _MOTIONS[motion][0]
        raise UsageError(f'{data.name}: the columns "time [s]" and "{motion} [{unit}]" are needed')
    time, values = data.conditions["time"], data.measured[motion]
    steps = np.diff(time)
    if time.size < 2 or not np.all(steps > 0.0) or np.ptp(steps) > 0.01 * steps.mean():
        usual = np.median(steps) if steps.size else 0.0
        line = data.lines[int(np.argmax(np.abs(steps - usual))) + 1 if steps.size else 0]
        raise UsageError(f"{data.name} line {line}: the times of a signal must be evenly spaced and rise")
    if not np.all(np.isfinite(values)):
        line = data.lines[int(np.argmin(np.isfinite(values)))]
        raise UsageError(f"{data.name} line {line}: {motion} is empty: a signal has a value at every time")
    if values.size < SHORTEST_SPECTRUM:
        raise UsageError(f"{data.name}: {values.size} samples are too few for a spectrum: {SHORTEST_SPECTRUM} at least")
    return _Signal(data.name, time - time[0], values, "measured")


def _over_time(signals: list[_Signal], motion: str, unit: str) -> Panel:
    """Return signals of equal length.

    Each starts at its beginning and is as long as the shortest one.
    """
    length = min(float(s.time[-1] - s.time[0]) for s in signals)
    series = []
    for s in signals:
        since = s.time - s.time[0]
        shown = since <= length
        series.append(trace(s.name, 1e3 * since[shown], (s.values - s.values.mean())[shown], s.role))
    return Panel("over time", Axis("time", "ms"), Axis(motion, unit), tuple(series))


def _spectra(
    title: str, signals: list[tuple[_Signal, FloatArray]], unit: str, end: float, marks: tuple[Mark, ...]
) -> Panel:
    series = []
    for one, values in signals:
        frequency, amplitude = spectrum(one.time, values)
        shown = frequency <= end
        series.append(Series(one.name, frequency[shown], amplitude[shown], "line", one.role))
    return Panel(
        title, Axis("frequency", "Hz", low=0.0, high=end), Axis("amplitude", unit, low=0.0), tuple(series), marks
    )


def _sidebands(marks: dict[str, float]) -> tuple[Mark, ...]:
    """Return the sidebands of defects that turn through the load.

    Those of the inner ring turn with the shaft, those of balls or rollers with the cage (Randall and Antoni 2011).
    """
    pairs = (("BPFI", "shaft"), ("2 BSF", "FTF"))
    return tuple(
        Mark(f"{name} {sign} {turning}", marks[name] + (marks[turning] if sign == "+" else -marks[turning]), "x")
        for name, turning in pairs
        for sign in "-+"
    )


VIEWS = (
    View(
        "vibration",
        "displacement, velocity or acceleration of shaft or housing; spectrum, envelope; measured signal",
        "result",
        vibration,
        VibrationOptions,
        reference="Randall and Antoni 2011, Mech. Syst. Signal Process. 25, 485",
        offered=lambda run: False,
        view_api=1,
    ),
)
