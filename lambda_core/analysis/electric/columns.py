"""Name the positions in arrays of the compiled integrator."""

from __future__ import annotations

from typing import Any, NamedTuple

# Nodes: the rotor with all inner rings, the outer rings that are insulated, the balls of all bearings. Ground is the
# frame.
ROTOR = 0
GROUND = -1  # in place of a node


class CircuitConstants(NamedTuple):
    """Constants of rotor and frame; capacitances [F], conductance [S]."""

    winding: float  # against the rotor
    rotor: float  # against the frame
    brush: float  # from the rotor to the frame
    twins: float  # for each bearing, further ones that are like it


class BearingConstants(NamedTuple):
    """Constants of every bearing, arrays of shape (bearings,)."""

    rings: Any  # capacitance against each other [F]
    coating: Any  # of the outer ring against the frame [F]
    bridge: Any  # conductance across it [S]
    pocket: Any  # of a conducting cage against each ball, 0: there is none [F]
    cage_inner: Any  # of it against the inner ring [F]
    cage_outer: Any  # and against the outer ring [F]
    roughness: Any  # composite, rms [m]
    least: Any  # voltage below which nothing breaks down [V]


class Wiring(NamedTuple):
    """Numbers of nodes, arrays of integers."""

    bearing: Any  # of each ball, shape (balls,)
    outer: Any  # node of the outer ring of each ball, or GROUND
    ring: Any  # of each bearing, and behind them GROUND: the shaft against the frame, shape (bearings + 1,)


class Net(NamedTuple):
    """The wiring with the number of nodes before the balls."""

    shared: Any
    bearing: Any
    outer: Any
    ring: Any


class Held(NamedTuple):
    """Contacts over one part of an interval.

    The arrays have shape (Z, 2).
    """

    capacitance: Any  # [F]
    conductance: Any  # [S]
    film: Any  # central, 0 where nothing breaks down [m]
    thinnest: Any  # minimum film [m]
    area: Any  # of Hertz [m2]
    rolled: Any  # patches since the start, at the beginning of the part
    rate: Any  # patches per second


class Tables(NamedTuple):
    """Contacts at the samples.

    The arrays have the shape (samples, Z, 2); their units are those of `Held`.
    """

    capacitance: Any
    conductance: Any
    film: Any
    thinnest: Any
    area: Any
    rolled: Any


class FullNetwork(NamedTuple):
    """Full network over one part of an interval.

    The arrays have shape (n, n).
    """

    capacitance: Any  # [F]
    conductance: Any  # [S]
    factor: Any  # of Cholesky, of the capacitances
    turned: Any  # workspace of the rotations
    shape: Any  # row a: of mode a
    share: Any  # row of a ring: minus the part of a ball's voltage change that follows it


class Nodes(NamedTuple):
    """Nodes and modes of the full network.

    The arrays have shape (n,).
    """

    charge: Any  # [C]
    potential: Any  # [V]
    ahead: Any  # potential at the end of a step [V]
    amplitude: Any
    after: Any  # amplitude at the end of a step
    area: Any  # its integral over a step
    drive: Any  # what the source does to it per second
    decay: Any  # [1/s]
    leak: Any  # current to ground per amplitude
    mean: Any  # workspace of the start


class Part(NamedTuple):
    """Nodes that take part in a discharge.

    The arrays have shape (m, m).
    """

    capacitance: Any  # [F]
    conductance: Any  # [S]
    opened: Any  # with the open channels
    factor: Any
    turned: Any
    shape: Any
    product: Any  # integrals of products of two amplitudes over a step
    channel: Any  # row of a ring: voltage of its channel per amplitude
    limit: Any  # row of a ring: voltage that the films of other balls stand, by ball; 0: not looked at


class PartNodes(NamedTuple):
    """Nodes and modes of a discharge, arrays of shape (m,)."""

    charge: Any
    potential: Any
    ahead: Any
    fall: Any  # currents of the channels' falls and of the source into the nodes [A]
    amplitude: Any
    after: Any
    area: Any
    drive: Any
    decay: Any
    lost: Any  # 1 - exp(-x), and this over x, of each mode at the end of a step
    mean: Any
    middle: Any  # amplitude halfway
    other: Any  # potential of each ball [V]


class Standing(NamedTuple):
    """Breakdown law with its last voltages."""

    law: Any
    par: Any  # per ring of each bearing
    out: Any
    bearing: Any  # of each ball
    roughness: Any  # of each bearing: composite, rms [m]
    least: Any  # voltage below which nothing breaks down [V]
    seed: Any
    known: Any  # patch of each contact that `drawn` was found for
    drawn: Any  # voltages [V]


class Arcs(NamedTuple):
    """Discharge law with the arcs of one discharge."""

    law: Any
    par: Any  # per ring of each bearing
    out: Any
    state: Any  # Channels
    rows: Any  # what they did, (2, N_EVENT)
    stand: Any  # voltages that the films of the ball stand [V]
    opened: Any  # voltages of the bearings when the discharge began [V]
    terminal: Any  # nodes of the rings of the ball, GROUND for the frame
    raised: Any  # of each bearing: 1 where its voltage is above that
    members: Any  # nodes of the full network that take part
    place: Any  # of each node among them, -1: it keeps its charge
    watched: Any  # 1 where what other films stand is known, (1,)


class Source(NamedTuple):
    """Corners of the common-mode voltage."""

    time: Any  # [s]
    volt: Any  # [V]
    place: Any  # number of the segment that the integration is on, (1,)
    winding: Any  # capacitance to the rotor [F]


class Accumulators(NamedTuple):
    """Sums and records of an integration."""

    total: Any  # T_*
    extremes: Any
    events: Any  # E_*
    trace: Any
    ring: Any  # node of the outer ring of each bearing, and GROUND
    window: Any  # times between which the trace is kept [s]


class Channels(NamedTuple):
    """Two channels of a ball in a discharge.

    The arrays have shape (2,).
    """

    burns: Any  # 1 while it conducts
    sign: Any  # of its current
    resistance: Any  # [Ohm]
    fall: Any  # [V]
    least: Any  # current below which it dies [A]


# What is added up over an integration, `total[...]`.
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
N_TRACE = 3  # time [s], source [V], current of arcs [A]; behind them inner against outer rings, shaft against frame [V]

# Status of the integration; from NO_VOLTAGE on a law is to blame.
OK, EVENTS_FULL, NOT_POSITIVE, ENDLESS, NO_VOLTAGE, NO_ARC, ARC_STARVED = range(1, 8)
