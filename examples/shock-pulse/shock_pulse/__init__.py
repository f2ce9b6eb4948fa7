"""Define a half-sine shock as product tests prescribe it."""

from math import cos, pi, sin
from typing import Annotated

from lambda_core.plugins import OK, Parameters, Quantity, law, parameter

Time = Annotated[float, Quantity("time")]


class Pulse(Parameters):
    start: Time = parameter("1 ms", "when the shock begins", status="assumed", ge=0.0)
    duration: Time = parameter("11 ms", "how long it lasts", source="IEC 60068-2-27", gt=0.0)


@law("time_function", "half-sine", Pulse, role_api=3, reference="IEC 60068-2-27, half-sine pulse")
def half_sine(t, par, out):
    """Half sine of a shock.

    f = sin(pi (t - t_0)/D) while the shock lasts, with its two derivatives.
    """
    turning, since = pi / par.duration, t - par.start
    on = 1.0 if 0.0 < since < par.duration else 0.0
    out[0] = on * sin(turning * since)
    out[1] = on * turning * cos(turning * since)
    out[2] = -on * turning * turning * sin(turning * since)
    return OK
