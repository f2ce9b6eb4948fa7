"""Define roles whose law a section chooses.

Such laws act on a motion, or drive it, from outside.
"""

from __future__ import annotations

import math

from lambda_core.domain import elements
from lambda_core.domain.role import Role, arguments_of

LINKS, TIMES, FILMS = tuple(elements.LINKS), tuple(elements.TIMES), tuple(elements.FILMS)
_POSITIVE, _RESISTIVE = (0.0, math.inf), (1e-9, math.inf)

SECTION_ROLES: tuple[Role, ...] = (
    Role(
        "force_element",
        "force between two bodies, or a body and the ground, in addition to those of the bearing",
        arguments_of(
            "t f time [s]; place a of the second point seen from the first, inertial axes [m]; "
            "tilt a of the second body's axis against the first's, as a vector of rotation, inertial axes [rad]; "
            "v_rel a velocity of the second point against the first body [m/s]; "
            "omega_rel a angular velocity of the second body against the first [rad/s]; par a parameters; "
            "out A force on the second body at its point [N] (3), couple on it [N m] (3), inertial axes"
        ),
        ("force[3] [N]", "couple[3] [N m]"),
        LINKS,
        section="elements",
    ),
    Role(
        "time_function",
        "course over time of a load, a speed or a motion, times an amplitude that the case gives",
        arguments_of("t f time [s]; par a parameters; out A results"),
        ("f [-]", "df/dt [1/s]", "d2f/dt2 [1/s2]"),
        TIMES,
        slopes=((1, 0, "t"), (2, 1, "t")),
        section="time",
    ),
    Role(
        "breakdown",
        "voltage that a film holds while it is on one patch of surface",
        arguments_of(
            "h f central film [m]; h_min f minimum film [m]; sigma f composite rms roughness [m]; "
            "area f Hertzian area [m2]; u_1 f random number of the patch, 0..1; "
            "u_2 f another one; par a parameters; out A results"
        ),
        ("voltage at which the film breaks down [V]",),
        FILMS,
        bounds=(_POSITIVE,),
        section="electric",
    ),
    Role(
        "discharge",
        "arc in a film that broke down: i = (V - U)/R until it is too small",
        arguments_of(
            "V f voltage of the contact when its film breaks down, > 0 [V]; h f central film [m]; "
            "area f Hertzian area [m2]; par a parameters; out A results"
        ),
        (
            "resistance R of the channel, > 0 [Ohm]",
            "fall U against the current, whatever it is [V]",
            "least current, below which the arc dies [A]",
        ),
        FILMS,
        bounds=(_RESISTIVE, _POSITIVE, _RESISTIVE),
        section="electric",
    ),
)
