"""Define additional time functions."""

from __future__ import annotations

import math
from typing import Annotated

from lambda_core.plugins import OK, FloatArray, Parameters, Quantity, law, parameter

Frequency = Annotated[float, Quantity("frequency")]
Time = Annotated[float, Quantity("time")]


class Sweep(Parameters):
    """Frequencies at both ends and the sweep time."""

    start: Frequency = parameter("10 Hz", "frequency at t = 0", source="to be given", status="assumed", ge=0.0)
    end: Frequency = parameter("500 Hz", "frequency at the end", source="to be given", status="assumed", ge=0.0)
    duration: Time = parameter(
        "1 s",
        "time of the sweep; the frequency stays as it is after it",
        source="to be given",
        status="assumed",
        gt=0.0,
    )


@law(
    "time_function",
    "chirp",
    Sweep,
    role_api=3,
    reference="linear swept sine sin(2 pi integral of f dt), f rising evenly (ISO 7626-2, swept sinusoidal excitation)",
)
def chirp(t: float, par: Sweep, out: FloatArray) -> int:
    """Sine whose frequency changes evenly over time.

    It is sin phi with dphi/dt = 2 pi f(t).
    """
    rate = (par.end - par.start) / par.duration
    swept = min(max(t, 0.0), par.duration)
    frequency = par.start + rate * swept
    phase = 2.0 * math.pi * (par.start * swept + 0.5 * rate * swept * swept + frequency * (t - swept))
    turning = 2.0 * math.pi * frequency
    inside = 2.0 * math.pi * rate if 0.0 <= t < par.duration else 0.0
    out[0] = math.sin(phase)
    out[1] = turning * math.cos(phase)
    out[2] = inside * math.cos(phase) - turning * turning * math.sin(phase)
    return OK
