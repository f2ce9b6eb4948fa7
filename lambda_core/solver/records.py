"""Define records of compiled code.

Name, unit and frame of every number that is not in the state vector.

Frames: *inertial* x (shaft), y, z; *turning* x, r, t, which goes round with one ball's azimuth; *contact* t along
rolling, s across, n from ball to raceway. All fields take eight bytes, so that a record of floats is also a vector.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lambda_core.domain.roles import RACEWAYS, ROLES
from lambda_core.formulas.elastic.ring import MOST_ORDERS
from lambda_core.laws.jit.binding import STRIDE

f8, i8 = np.float64, np.int64


def record(*fields: tuple[Any, ...]) -> np.dtype[Any]:
    """Return the type of a record.

    Its fields are attributes, in compiled code and in Python.
    """
    return np.dtype((np.record, np.dtype(list(fields), align=True)))


def floats_of(kind: np.dtype[Any]) -> int:
    """Return how many numbers of eight bytes a record has."""
    return kind.itemsize // 8


# ---- States. They lie in the state vector one after another; see layout.
BALL = record(
    ("x", f8),  # axial position of the centre [m]
    ("radius", f8),  # distance of the centre from the x axis [m]
    ("azimuth", f8),  # from +y towards +z [rad]
    ("velocity", f8, (3,)),  # turning frame [m/s]
    ("spin", f8, (3,)),  # angular velocity, turning frame [rad/s]
)
# A roller's own axes in the turning frame: e0 along its nominal axis, e1 across it in the plane of the bearing's axis,
# e2 = t. Of cylindrical rollers they are x, r, t.
ROLLER = record(
    ("x", f8),  # as of a ball
    ("radius", f8),
    ("azimuth", f8),
    ("velocity", f8, (3,)),
    ("spin", f8, (3,)),  # absolute angular velocity, own axes [rad/s]
    ("tilt", f8, (2,)),  # components of its axis along e1, and along e2: skew [-]
)
BODY_STATE = record(
    ("position", f8, (3,)),  # of the centre, inertial [m]
    ("tilt", f8, (2,)),  # y and z component of the unit vector of the body's axis [-]
    ("angle", f8),  # about the axis, from the frame of least rotation [rad]
    ("velocity", f8, (3,)),  # inertial [m/s]
    ("tilt_velocity", f8, (2,)),  # y and z component of the angular velocity across the axis [rad/s]
    ("spin", f8),  # angular speed about the axis [rad/s]
)
# Force and couple. On a ball: turning frame, about its centre. On a body: inertial, about its centre. Of a raceway
# contact: contact frame, on the ball, about the contact's centre.
WRENCH = record(("force", f8, (3,)), ("moment", f8, (3,)))  # [N, N m]

# ---- Raceway contacts.
# What the laws depend on, in the order of the columns of the tangent.
DRIVERS = (
    "penetration",  # [m]
    "normal_velocity",  # of the ball into the raceway [m/s]
    "slip_t",  # velocity of the ball's surface over the raceway's at the contact's centre [m/s]
    "slip_s",
    "rotation_t",  # angular velocity of the ball relative to the ring [rad/s]
    "rotation_s",
    "rotation_n",
    "entrainment_t",  # mean velocity of both surfaces relative to the contact's centre [m/s]
    "entrainment_s",
)
KINEMATICS = record(
    *((name, f8) for name in DRIVERS),
    ("t", f8, (3,)),  # axes of the contact frame in the turning frame [-]
    ("s", f8, (3,)),
    ("n", f8, (3,)),
    ("reach", f8),  # from the ball's centre to the contact's [m]
    ("arm", f8, (3,)),  # from the ring's centre to the contact's, turning frame [m]
    ("axial", f8),  # ball's centre from the groove's, along the ring's axis [m]
    ("radial", f8),  # and away from it [m]
    ("cosine", f8),  # of the ball's azimuth
    ("sine", f8),
    ("lift", f8),  # height of the raceway's surface above the nominal groove [m]
    ("rise_t", f8),  # its slopes with the place of the ball's centre along t and s [-]
    ("rise_s", f8),
    ("widening", f8),  # how far the waves of an elastic ring carry the groove's circle outwards there [m]
    ("widening_slope", f8),  # and its slope with the azimuth [m]
    ("widening_rate", f8),  # and its rate, in the ring's material [m/s]
    ("wave_cosine", f8),  # of the contact's azimuth in the ring's material
    ("wave_sine", f8),
    ("outward", f8),  # component of n away from the ring's axis
    ("line_tilt", f8),  # of a line contact: between roller and raceway, in the plane of the bearing's axis [rad]
    ("line_tilt_rate", f8),  # [rad/s]
    ("line_skew", f8),  # of a roller's axis to the raceway's generatrix [rad]
    ("entrainment_slope", f8),  # of entrainment_t along the line [1/s]
)
LINE_DRIVERS = (*DRIVERS, "line_tilt", "line_tilt_rate", "entrainment_slope", "line_skew")  # of a line contact
TANGENT = record(*((name, WRENCH) for name in DRIVERS))  # derivative of the wrench with each driver
CONTACT = record(
    ("load", f8),  # elastic [N]
    ("semi_axis_a", f8),  # across rolling [m]
    ("semi_axis_b", f8),  # along rolling [m]
    ("max_pressure", f8),  # [Pa]
    ("damping_force", f8),  # against approach [N]
    ("film_central", f8),  # with heating and starvation [m]
    ("film_minimum", f8),  # [m]
    ("film_parameter", f8),  # Lambda [-]
    ("asperity_share", f8),  # psi, of the load [-]
    ("film_stress", f8),  # what is left of the film's shear stress [-]
    ("solid_stress", f8),  # what acts of the asperities' [-]
    ("rolling_force", f8),  # hydrodynamic rolling resistance on each surface [N]
    ("hysteresis_moment", f8),  # [N m]
    ("shear_around", f8),  # of the oil around the flat of a line contact, over the slip [N s/m]
    ("entrainment", f8),  # speed [m/s]
    ("film_temperature", f8),  # mean over the contact [K]
    ("shear_change", f8),  # relative change of the mean shear stress in the last sweep [-]
    ("film_isothermal", f8),  # central film without heating and starvation [m]
    ("wet", i8),  # 1 once film and shear have been computed
)
CONTACT_SAMPLE = record(
    *(
        (name, f8)
        for name in (
            "load",
            "contact_angle",
            "max_pressure",
            "semi_axis_a",
            "semi_axis_b",
            "film_central",
            "film_minimum",
            "film_parameter",
            "asperity_share",
            "film_temperature",
            "slip",
            "entrainment",
            "spin_velocity",
            "capacitance_hertz",
            "capacitance",
            "contact_loss",
        )
    )
)  # the channels of that name of lambda_core.domain.channels

# ---- Contacts of the cage, and of ball with ball: what a law sees of one, in the frame of pocket or land.
GUIDE = record(
    ("place", f8, (3,)),  # of what is guided, from the frame's origin [m]
    ("velocity", f8, (3,)),  # [m/s]
    ("rotation", f8, (3,)),  # relative angular velocity [rad/s]
    ("axial", f8, (3,)),  # axes of the frame, inertial [-]
    ("radial", f8, (3,)),
    ("tangential", f8, (3,)),
    ("origin", f8, (3,)),  # from the centre of the guiding body, inertial [m]
    ("wave_cosine", f8),  # of the contact's azimuth in the material of an elastic cage
    ("wave_sine", f8),
    ("facing_radial", f8),  # direction there away from the cage's axis, in the frame
    ("facing_tangential", f8),
)

# ---- Constants.
OIL = record(
    ("temperature", f8),  # bulk [K]
    ("viscosity", f8),  # [Pa s]
    ("alpha_p", f8),  # pressure-viscosity coefficient [1/Pa]
    ("beta", f8),  # temperature-viscosity coefficient [1/K]
    ("conductivity", f8),  # [W/(m K)]
    ("density", f8),  # [kg/m3]
)
SYSTEM = record(
    ("balls", i8),  # of all rows
    ("tail", i8),  # where the free entries of the shared state begin in the state vector
    ("gravity", f8, (3,)),  # inertial [m/s2]
    ("roll_floor", f8),  # width of the change of sign of rolling losses [m/s]
    ("slip_floor", f8),  # smallest slip that directions are computed with [m/s]
    ("surfaces", i8),  # 0: every raceway is nominal
    ("friction_on", i8),  # 0: normal forces only (static equilibrium)
    ("guides_on", i8),  # 0: no cage forces, nominal raceways (quasi-static equilibrium)
    ("drag_azimuths", i8),  # evenly spaced, over which drag is averaged (quasi-static equilibrium); 1: at the ball's
)
FREE, LOCKED, PRESCRIBED = range(3)
BODY = record(
    ("mass", f8),  # [kg]
    ("transverse_inertia", f8),  # [kg m2]
    ("polar_inertia", f8),  # [kg m2]
    ("unbalance", f8),  # [kg m]
    ("moves", i8),  # 0: the body is left out
    ("is_cage", i8),  # 1: it stands still in the quasi-static equilibrium
    ("is_wave", i8),  # 1: of an elastic part, whose material damps it
    ("bearing", i8),  # whose contacts it has; -1: none
    ("mode", i8, (6,)),  # FREE, LOCKED, PRESCRIBED of x, y, z, tilt_y, tilt_z, spin
    ("stiffness", f8, (6,)),  # of the support to ground [N/m, N m/rad]
    ("damping", f8, (6,)),  # [N s/m, N m s/rad]
)
BALLS, ROLLERS = range(2)
ROW = record(
    ("number", i8),  # its place in the table of rows
    ("kind", i8),  # of its elements: BALLS, ROLLERS
    ("bearing", i8),  # that it belongs to
    ("first_ball", i8),
    ("balls", i8),
    ("first_state", i8),  # of its first ball, in the state vector
    ("size", i8),  # states of each of its balls
    ("first_raceway", i8),  # the raceways that every ball of the row touches
    ("raceways", i8),
    ("cage", i8),  # body
    ("caged", i8),  # 0: the row has no cage, its balls touch each other
    ("ball_radius", f8),  # [m]
    ("ball_mass", f8),  # [kg]
    ("ball_inertia", f8),  # [kg m2]
    ("pocket_circle", f8),  # radius of the pockets' circle [m]
    ("pocket_offset", f8),  # of its plane from the cage's centre, along the axis [m]
    ("pocket_phase", f8),  # of the first ball's pocket on the cage [rad]
    ("drag_on", i8),
    ("oil", OIL),
    ("guide_law", i8),  # row of Laws.guides
    ("drag_law", i8),  # row of Laws.drag
    ("pocket", i8, (2,)),  # where the parameters of its laws begin and end
    ("drag", i8, (2,)),
    ("waves", i8, (2,)),  # of its cage, in the table of waves: begin, end
    # Of rollers alone; their ball_radius is the mean radius, their ball_inertia that about their axis.
    ("transverse_inertia", f8),  # [kg m2]
    ("axis_angle", f8),  # of the nominal axis to the bearing's, positive where the radius grows with x [rad]
    ("cone_angle", f8),  # half of the angle of the roller's cone, 0 of a cylinder [rad]
    ("length", f8),  # effective [m]
    ("total_length", f8),  # between the end faces, on the axis [m]
    ("end_radius", f8),  # of the end faces' sphere, inf where they are plane [m]
    ("bar_gap", f8),  # between roller and bars of its pocket, on each side [m]
    ("end_gap", f8),  # between its end faces and the pocket's, on each side [m]
    ("bar_length", f8),  # of what touches a bar [m]
)
POINT, LINE, RIB = range(3)
RACEWAY_ROLES = tuple(name for name, role in ROLES.items() if role.elements == RACEWAYS)  # of a raceway contact
RACEWAY = record(
    ("number", i8),  # its row in the table of raceways
    ("kind", i8),  # of its contacts: POINT, LINE, RIB
    ("body", i8),  # that carries it
    ("laws", i8),  # row of Laws.raceways
    ("side", f8),  # +1 where balls lie inside the raceway (outer ring), -1 where outside [-]
    ("groove_circle", f8),  # radius of the circle of groove centres [m]
    ("groove_radius", f8),  # [m]
    ("ball_radius", f8),  # [m]
    ("radius_x", f8),  # reduced, along rolling [m]
    ("radius_y", f8),  # reduced, across rolling [m]
    ("modulus", f8),  # E' of ball and ring [Pa]
    ("radius_deformed", f8),  # of the common surface, across rolling [m]
    ("roughness", f8),  # of both surfaces together [m]
    ("reach", f8),  # gap below which the film between ball and raceway pushes them apart already [m]
    ("axial_offset", f8),  # of the plane of the groove's circle from the body's centre [m]
    ("surface_on", i8),  # 0: nominal
    ("oil", OIL),
    ("parameters", record(*((role, i8, (2,)) for role in RACEWAY_ROLES))),  # of each law: begin, end
    ("states", i8),  # that every contact of it keeps
    ("first_state", i8),  # of ball 0, among the states of all contacts
    ("slots", i8, (2,)),  # where its laws read them: begin, end
    ("waves", i8, (2,)),  # of its ring, in the table of waves: begin, end
    # Of a LINE: its groove_circle is the radius of the raceway's cone at the nominal place of the roller's middle.
    ("cone", f8),  # angle of its generatrix to the bearing's axis, of the sign of ROW.axis_angle [rad]
    ("line", i8),  # row of Bundle.lines
    # Of a RIB: its side is the end of the roller that it touches, +1 the one that the roller's axis points to.
    ("rib_radius", f8),  # distance of the nominal contact from the bearing's axis [m]
    ("rib_angle", f8),  # of the rib's normal to the bearing's axis [rad]
)
WAVE = record(  # a pattern of waves round an elastic ring or cage, whose orders rise from 2
    ("ring", i8),  # body
    ("body", i8),  # whose y and z are its amplitudes: of the cosine, of the sine [m]
    ("order", i8),  # number of waves
    ("coupling", f8),  # Coriolis force on one amplitude over the other's rate and the ring's spin [kg]
)
SLOT = record(
    ("state", i8),  # which one of its contact
    ("place", i8),  # where it stands in Bundle.par
    ("lower", f8),  # its bounds, in its unit
    ("upper", f8),
)
LAND = record(
    ("cage", i8),  # body
    ("ring", i8),  # body that guides it
    ("row", i8),  # a row of balls that the cage holds
    ("number", i8),  # of the pair of stations: its row in results
    ("law", i8),  # row of Laws.guides
    ("offset", f8),  # of the station from both bodies' centres, along the axis [m]
    ("viscosity", f8),  # of the oil [Pa s]
    ("parameters", i8, (2,)),
    ("side", f8),  # +1 where the cage lies inside the land (outer ring), -1 where round it [-]
    ("waves", i8, (2,)),  # of the cage, in the table of waves: begin, end
)
LINK = record(
    ("number", i8),  # its row in the table of links
    ("first", i8),  # body, -1 for the ground
    ("second", i8),  # body
    ("law", i8),  # row of Laws.links
    ("first_place", f8, (3,)),  # of its points, in the frames of the bodies [m]
    ("second_place", f8, (3,)),
    ("apart", f8, (3,)),  # where the second body is drawn from the first one [m]
    ("parameters", i8, (2,)),
)

# ---- Loads and motions over time.
SIGNAL = record(("value", f8), ("rate", f8), ("acceleration", f8))
INPUTS = record(  # of one body
    ("motion", SIGNAL, (6,)),  # prescribed: x, y, z, tilt_y, tilt_z [m, rad], spin [rad/s]
    ("force", SIGNAL, (3,)),  # inertial [N]
    ("moment", SIGNAL, (3,)),  # about the centre, inertial [N m]
)
CONSTANT, RAMP, HARMONIC, TABLE, GIVEN, LAW = range(6)
TERM = record(  # what a signal is the sum of
    ("signal", i8),  # 12 per body, in the order of INPUTS
    ("kind", i8),
    ("value", f8),  # CONSTANT; GIVEN from outside at the time `begin`, with the derivatives
    ("rate", f8),  # GIVEN
    ("acceleration", f8),
    ("before", f8),  # RAMP: values and times
    ("after", f8),
    ("begin", f8),
    ("end", f8),
    ("amplitude", f8),  # HARMONIC
    ("frequency", f8),  # [Hz]
    ("phase", f8),  # [rad]
    ("start", i8),  # TABLE: place of its first row in the table of knots
    ("knots", i8),
    ("law", i8),  # LAW: row of Laws.times; times the amplitude
    ("parameters", i8, (2,)),
)

# ---- Powers, and the running integrals of them: losses of the raceways by mechanism (layout.Losses), then these.
RUNNING = record(
    ("pocket", f8),  # losses [W]
    ("land", f8),
    ("drag", f8),
    ("bending", f8),
    ("support", f8),  # dissipated by dampers to the ground, no friction of the bearing [W]
    ("input", f8),  # power of everything external [W]
    ("input_abs", f8),
    ("drive", f8),  # power of what prescribes spins [W]
    ("relative_speed", f8),  # of the first two bodies [rad/s]
    ("position", f8, (3,)),  # of the first body [m]
    ("iteration", f8),  # work of what Newton's iteration leaves of the equations, counted positive [W]
)
TOTALS = record(
    ("stored_energy", f8),  # [J]
    ("capacitance", f8),  # of all balls [F]
    ("torque", f8),  # that balances the contacts of the first body about its axis [N m]
)

# ---- What one evaluation leaves behind and the next one writes over.
FAULT = record(
    ("role", i8),  # of the law that refused, as in faults.ROLES; -1: none did
    ("status", i8),  # that it returned
    ("ball", i8),
    ("place", i8),  # raceway, or land; -1: neither
    ("inputs", f8, (4,)),
)
# Contacts of a raceway for which laws are called at once: those that carry load from place 0 on, films that nothing
# presses yet from place BATCH on.
BATCH = 16
PLACES = 2 * BATCH
SWEEPS = 4  # places that the derivative of a contact's wrench takes
LANES = record(  # what laws take of contacts, number by number
    *(
        (name, f8, (PLACES,))
        for name in (
            "delta", "velocity", "load", "semi_a", "semi_b", "p_max", "u_mean", "cos2", "u_slide", "h_cen", "h_min",
            "h", "film_parameter", "psi",
        )
    )
)  # fmt: skip
SCRATCH = record(
    ("kinematics", KINEMATICS, (PLACES,)),  # of contacts; where there is one in hand, the second is of a state near it
    ("contact", CONTACT, (PLACES,)),
    ("wrench", WRENCH, (PLACES,)),
    ("lanes", LANES),
    ("ball", i8, (PLACES,)),  # whose contacts they are
    ("order", i8, (BATCH,)),  # their places by the number of the ball
    ("on_ring", WRENCH),
    ("on_ground", WRENCH),
    ("guide", GUIDE),
    ("at_rest", GUIDE),
    ("out", f8, (STRIDE * BATCH,)),  # results of laws without cells
    ("surface", f8, (3,)),  # height of a raceway and its slopes
    ("pushes", f8, (2, 2 * MOST_ORDERS)),  # on the waves of a cage: of a roller's whole pocket, and of a part of it
    ("fault", FAULT),  # survives the call
)

# Contact channels, in this order along the last axis of `contacts`.
CONTACT_CHANNELS: tuple[str, ...] = CONTACT_SAMPLE.names or ()
# How far the continuation has come.
STATIC_REPORT = np.dtype(
    [
        ("iterations", np.float64),
        ("last_change", np.float64),  # norm of the last Newton step, over the states' scales [-]
        ("pseudo_step", np.float64),  # of pseudo-time [s]
        ("orbit", np.float64),  # mean orbital speed of the balls that grip the rings [rad/s]
        ("speed", np.float64),  # largest orbital velocity of a ball at the start [m/s]
        ("spin", np.float64),  # largest component of a ball's spin at the start [rad/s]
    ],
    align=True,
)
