"""Places in the arrays that the compiled march works on, by name."""

from __future__ import annotations

from typing import Any, NamedTuple

# Nodes: 0 the rotor (inner ring), 1 the outer ring where it is insulated, then the balls. Ground is the frame.
ROTOR, RING = 0, 1


class Machine(NamedTuple):
    """Constants of what surrounds the films; capacitances [F], conductances [S]."""

    winding: float  # against the rotor
    rotor: float  # against the frame
    rings: float  # against each other
    brush: float  # from the rotor to the frame
    coating: float  # of the outer ring against the frame
    bridge: float  # conductance across it
    twins: float  # further bearings of the machine that are like this one
    pocket: float  # of a conducting cage against each ball, 0: there is none
    cage_inner: float  # against the inner ring
    cage_outer: float


class Held(NamedTuple):
    """State of the contacts over one part of an interval, arrays of shape (Z, 2)."""

    capacitance: Any  # [F]
    conductance: Any  # [S]
    film: Any  # central, 0 where nothing breaks down [m]
    thinnest: Any  # minimum film [m]
    area: Any  # of Hertz [m2]
    rolled: Any  # patches since the start, at the beginning of the part
    rate: Any  # patches per second


class Channels(NamedTuple):
    """The two channels of a ball in a discharge, arrays of shape (2,)."""

    burns: Any  # 1 while it conducts
    sign: Any  # of its current
    resistance: Any  # [Ohm]
    fall: Any  # [V]
    least: Any  # current below which it dies [A]


# What is added up over a march, `total[...]`.
T_SOURCE, T_OHMIC, T_ARC, T_MOTION = range(4)  # work of the source, heat, heat of arcs, work of moving surfaces [J]
T_LEAK, T_ARC_CHARGE = 4, 5  # charge from all nodes to ground: through conductances, through arcs [C]
T_STORED_0, T_STORED, T_CHARGE_0, T_CHARGE = range(6, 10)  # energy [J] and charge of all nodes [C], start and end
T_EVENTS, T_DISCHARGES, T_TRACE, T_SEGMENTS, T_TIME = range(10, 15)
T_STATUS = 15  # that a law refused with
T_SETTLING, T_BEGAN = 16, 17  # 1 until films stand the voltages of the start; time from which sums count [s]
N_TOTAL = 18
# One row per contact that broke down in a discharge, `events[...]`.
(
    E_TIME,  # of the breakdown [s]
    E_BALL,
    E_RACEWAY,  # 0 inner, 1 outer
    E_DISCHARGE,  # number of the discharge: both contacts of a ball may belong to one
    E_CONTACT_VOLTAGE,  # at the breakdown [V]
    E_BEARING_VOLTAGE,  # inner against outer ring at the breakdown [V]
    E_ENERGY,  # turned into heat in this arc [J]
    E_CHARGE,  # through this arc [C]
    E_PEAK,  # largest current [A]
    E_DURATION,  # from the breakdown to the end of this arc [s]
    E_SAMPLE,  # number of the interval of samples that it began in
) = range(11)
N_EVENT = 11
# One row per moment of the record, `trace[...]`.
N_TRACE = 4  # time [s], source [V], inner against outer ring [V], current of arcs [A]

# Status of the march; from NO_VOLTAGE on a law is to blame.
OK, EVENTS_FULL, NOT_POSITIVE, ENDLESS, NO_VOLTAGE, NO_ARC, ARC_STARVED = range(1, 8)
