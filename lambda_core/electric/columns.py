"""Places in the arrays that the compiled march works on, by name."""

from __future__ import annotations

# Nodes: 0 the rotor (inner ring), 1 the outer ring where it is insulated, then the balls. Ground is the frame.
ROTOR, RING = 0, 1
# Constants of the machine, `machine[...]`.
M_WINDING, M_ROTOR, M_RINGS, M_BRUSH, M_COATING, M_BRIDGE = range(6)  # [F] [F] [F] [S] [F] [S]
# Field strength [V/m], roughness [m], particle size [m], least breakdown voltage [V], arc: [Ohm], fall [V], least [A].
F_STRENGTH, F_ROUGHNESS, F_PARTICLE, F_LEAST, F_RESISTANCE, F_FALL, F_QUENCH = range(7)
# What is added up over a march, `total[...]`.
T_SOURCE, T_OHMIC, T_ARC, T_MOTION = range(4)  # work of the source, heat, heat of arcs, work of moving surfaces [J]
T_LEAK, T_ARC_CHARGE = 4, 5  # charge from all nodes to ground: through conductances, through arcs [C]
T_STORED_0, T_STORED, T_CHARGE_0, T_CHARGE = range(6, 10)  # energy [J] and charge of all nodes [C], start and end
T_EVENTS, T_DISCHARGES, T_TRACE, T_SEGMENTS, T_TIME = range(10, 15)
N_TOTAL = 15
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
    E_SAMPLE,  # where the contact was then: samples since the first, with a fraction
) = range(11)
N_EVENT = 11
# One row per moment of the record, `trace[...]`.
N_TRACE = 4  # time [s], source [V], inner against outer ring [V], current of arcs [A]

OK, EVENTS_FULL, NOT_POSITIVE, ENDLESS = 1, 2, 3, 4  # status of the march
