"""Store the electric circuit of a run.

The tables hold voltages between samples and every film that breaks down.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import Channel

CIRCUIT_GROUP = "electric/circuit"
DISCHARGES_GROUP = "electric/discharges"

CIRCUIT: tuple[Channel, ...] = (
    Channel("time", (), "s", "time of the sample"),
    Channel("bearing_capacitance", (), "F", "balls in parallel, the films of a ball in series"),
    Channel("bearing_voltage_least", (), "V", "smallest since the sample before, inner less outer ring"),
    Channel("bearing_voltage_largest", (), "V", "largest since the sample before; NaN where one discharge spans it"),
)
DISCHARGES: tuple[Channel, ...] = (
    Channel("time", (), "s", "of the breakdown"),
    Channel("ball", (), "", "from 1"),
    Channel("ring", (), "", "0 inner, 1 outer"),
    Channel("discharge", (), "", "number of the discharge; both films of a ball may belong to one"),
    Channel("angle", (), "rad", "place on the raceway, turning with the ring, from +y towards +z"),
    Channel("contact_voltage", (), "V", "across the film at the breakdown, ring less ball"),
    Channel("bearing_voltage", (), "V", "inner less outer ring at the breakdown"),
    Channel("energy", (), "J", "heat in this film"),
    Channel("charge", (), "C", "through this film"),
    Channel("peak", (), "A", "largest current"),
    Channel("duration", (), "s", "until the arc died"),
    Channel("film", (), "m", "central film thickness"),
    Channel("film_parameter", (), "", "Lambda"),
    Channel("area", (), "m2", "Hertzian area"),
    Channel("joined", (), "", "1 where metal joins the ball's other contact to its ring"),
)


def circuit_channels(bearings: int) -> tuple[Channel, ...]:
    """Return the circuit's channels of a run.

    It writes them between samples; several bearings are along a dimension.
    """
    if bearings == 1:
        return CIRCUIT
    time, *each = CIRCUIT
    shaft = (
        Channel("shaft_voltage_least", (), "V", "smallest since the sample before, rotor less frame"),
        Channel("shaft_voltage_largest", (), "V", "largest since the sample before"),
    )
    return (time, *(replace(channel, dims=("bearing",)) for channel in each), *shaft)


def discharge_channels(bearings: int) -> tuple[Channel, ...]:
    """Return the channels of every breakdown.

    A channel tells in which bearing it was where there are several.
    """
    own = (Channel("bearing", (), "", "number of the bearing in the file, from 0"),) if bearings > 1 else ()
    return (*DISCHARGES, *own)


@dataclass(frozen=True)
class CircuitRows:
    """A stretch of both tables, column -> values."""

    circuit: Mapping[str, FloatArray]
    discharges: Mapping[str, FloatArray]
