"""Define the arc in a film that broke down.

The current is i = (V - U)/R until it is too small.
"""

from __future__ import annotations

from typing import Annotated

from lambda_core.plugins import OK, FloatArray, Parameters, Quantity, law, parameter


class Channel(Parameters):
    """A channel of constant resistance."""

    resistance: Annotated[float, Quantity("resistance")] = parameter(
        "10 Ohm", "R, of the channel", source="order of size", status="assumed", ge=1e-6
    )
    least_current: Annotated[float, Quantity("current")] = parameter(
        "10 mA", "below which the arc dies", source="order of size", status="assumed", ge=1e-9
    )


@law(
    "discharge",
    "resistance",
    Channel,
    role_api=3,
    reference="Ohm's law",
    validity="resistances of arcs are hardly known; charge and energy depend little on them, the largest current does",
)
def resistance(V: float, h: float, area: float, par: Channel, out: FloatArray) -> int:
    """Channel of constant resistance.

    The film's charge decays with R C.
    """
    out[0], out[1], out[2] = par.resistance, 0.0, par.least_current
    return OK


class Arc(Channel):
    """A channel with a voltage of its own."""

    voltage: Annotated[float, Quantity("voltage")] = parameter(
        ..., "U, that the arc keeps whatever its current", source="to be given", ge=0.0
    )


@law(
    "discharge",
    "arc-voltage",
    Arc,
    role_api=3,
    reference="constant arc voltage and Ohm's law",
    validity="arcs that burn longer than they take to form",
)
def arc_voltage(V: float, h: float, area: float, par: Arc, out: FloatArray) -> int:
    """Channel of constant voltage U.

    The charge below U stays on the film.
    """
    out[0], out[1], out[2] = par.resistance, par.voltage, par.least_current
    return OK
