"""Define names, dimensions and units of all channels.

Dimensions are named and labelled (:data:`DIMENSIONS`); ``ball`` counts the balls from 1.
Every sample carries every channel.
"""

from __future__ import annotations

from dataclasses import dataclass

RINGS = ("inner", "outer")
ARCS = ("inner +x", "inner -x", "outer +x", "outer -x")  # of four-point contact, by the shaft's thrust that they take
RIBS = ("inner +x", "inner -x", "outer +x", "outer -x")  # of rollers, by the end of the roller that they touch
# Below this film parameter metal touches metal and shorts the contact: asperities carry more than 1 % of the load there
# (Zhou and Hoeprich 1991 with the constants of the raceways of Wingertszahn et al. 2023), whatever law friction uses.
SHORTED = 2.03
# Dissipators; each is non-negative on its own. Per ring where the name says so.
LOSSES = (
    "sliding_inner",  # fluid shear along the mean slip of the contact
    "sliding_outer",
    "spin_inner",  # fluid shear by rotation about the contact normal
    "spin_outer",
    "boundary_inner",  # asperity friction
    "boundary_outer",
    "rolling_inner",  # hydrodynamic rolling resistance of the inlet
    "rolling_outer",
    "hysteresis_inner",
    "hysteresis_outer",
    "damping_inner",  # normal contact damping
    "damping_outer",
    "pocket",  # ball - cage, friction and damping
    "land",  # cage - ring (ball - ball when the cage is off)
    "drag",  # fluid drag and churning
    "bending",  # material damping of elastic rings and cage
)
# dimension -> labels of its entries, in order
DIMENSIONS: dict[str, tuple[str, ...]] = {
    "ring": RINGS,
    "arc": ARCS,
    "rib": RIBS,
    "lean": ("tilt", "skew"),
    "body": ("inner ring", "outer ring", "cage"),
    "axis": ("x", "y", "z"),
    "tilt": ("y", "z"),
    "cylindrical": ("axial", "radial", "tangential"),
    "mechanism": LOSSES,
    "wave": ("cosine", "sine"),
}


@dataclass(frozen=True)
class Channel:
    """One quantity over time.

    Attributes
    ----------
    name : str
        In lower case with underscores.
    dims : tuple of str
        Dimensions in addition to time: names of :data:`DIMENSIONS`, "ball", "marker".
    unit, meaning : str
        SI unit, "-" for plain numbers; one line for people.
    """

    name: str
    dims: tuple[str, ...]
    unit: str
    meaning: str


CHANNELS: tuple[Channel, ...] = (
    Channel("time", (), "s", "time"),
    Channel("body_position", ("body", "axis"), "m", "position of each body's centre, inertial frame"),
    Channel("body_velocity", ("body", "axis"), "m/s", "velocity of each body's centre, inertial frame"),
    Channel("body_tilt", ("body", "tilt"), "rad", "tilt of each body's axis about y and z"),
    Channel(
        "body_tilt_velocity", ("body", "tilt"), "rad/s", "angular velocity of each body across its axis, about y and z"
    ),
    Channel("body_spin_angle", ("body",), "rad", "angle of rotation about each body's own axis"),
    Channel("body_spin", ("body",), "rad/s", "angular speed about each body's own axis"),
    Channel("ball_axial", ("ball",), "m", "axial position of each ball's centre"),
    Channel("ball_radius", ("ball",), "m", "distance of each ball's centre from the x axis"),
    Channel("ball_azimuth", ("ball",), "rad", "azimuth of each ball, unwrapped, from +y towards +z"),
    Channel("ball_velocity", ("ball", "cylindrical"), "m/s", "axial, radial, tangential velocity"),
    Channel("ball_spin", ("ball", "cylindrical"), "rad/s", "angular velocity, axial, radial, tangential"),
    Channel("load", ("ball", "ring"), "N", "normal contact force, elastic and damping"),
    Channel(
        "contact_angle",
        ("ball", "ring"),
        "rad",
        "contact angle; positive when the ball pushes the ring towards +x at the outer ring",
    ),
    Channel("max_pressure", ("ball", "ring"), "Pa", "maximum Hertzian pressure"),
    Channel("semi_axis_a", ("ball", "ring"), "m", "semi-axis across rolling"),
    Channel("semi_axis_b", ("ball", "ring"), "m", "semi-axis along rolling"),
    Channel("film_central", ("ball", "ring"), "m", "central film thickness, thermally corrected"),
    Channel("film_minimum", ("ball", "ring"), "m", "minimum film thickness, thermally corrected"),
    Channel("film_parameter", ("ball", "ring"), "-", "Lambda, central film over composite roughness"),
    Channel("asperity_share", ("ball", "ring"), "-", "psi, share of the load on asperities"),
    Channel("film_temperature", ("ball", "ring"), "K", "mean film temperature over the contact"),
    Channel("slip", ("ball", "ring"), "m/s", "sliding velocity of ball over ring along rolling, contact centre"),
    Channel("entrainment", ("ball", "ring"), "m/s", "mean surface velocity along rolling"),
    Channel("spin_velocity", ("ball", "ring"), "rad/s", "relative angular velocity about the contact normal"),
    Channel("capacitance_hertz", ("ball", "ring"), "F", "capacitance of the Hertzian area"),
    Channel("capacitance", ("ball", "ring"), "F", "capacitance of the contact; inf where asperities short it"),
    Channel("contact_loss", ("ball", "ring"), "W", "power dissipated in each raceway contact"),
    Channel(
        "pocket_force",
        ("ball", "cylindrical"),
        "N",
        "force of the cage, or without one of the next roller, on each ball: axial, radial, tangential",
    ),
    Channel("land_force", ("ring", "axis"), "N", "force of each ring's land on the cage"),
    Channel("bearing_capacitance", (), "F", "balls in parallel, inner and outer contact in series"),
    Channel("input_torque", (), "N m", "torque of the drive about the inner ring's axis"),
    Channel("loss", ("mechanism",), "W", "dissipated power by mechanism"),
    Channel(
        "support_power",
        (),
        "W",
        "power that dampers to the ground take from rings and cage; of a machine they are outside its bearings",
    ),
    Channel("input_power", (), "W", "power of drives, loads, gravity and prescribed motions"),
    Channel("stored_energy", (), "J", "kinetic plus elastic energy"),
)

_BY_ARC = (
    "load", "contact_angle", "max_pressure", "semi_axis_a", "film_central", "film_parameter", "slip", "spin_velocity",
    "contact_loss",
)  # fmt: skip
# Of four-point contact; the channels by ring have the arc that carries more.
ARC_CHANNELS: tuple[Channel, ...] = tuple(
    Channel(f"arc_{channel.name}", ("ball", "arc"), channel.unit, f"{channel.meaning}; of each arc")
    for channel in CHANNELS
    if channel.name in _BY_ARC
)
# Where each of two rows has a cage: the body "cage" is that of the first row.
SECOND_CAGE_CHANNELS: tuple[Channel, ...] = (
    Channel("second_cage_position", ("axis",), "m", "position of the centre of the second row's cage, inertial frame"),
    Channel("second_cage_tilt", ("tilt",), "rad", "tilt of the axis of the second row's cage about y and z"),
    Channel("second_cage_spin_angle", (), "rad", "angle of rotation of the second row's cage about its axis"),
    Channel("second_cage_spin", (), "rad/s", "angular speed of the second row's cage about its axis"),
)
ROLLER_CHANNELS: tuple[Channel, ...] = (
    Channel(
        "roller_lean",
        ("ball", "lean"),
        "rad",
        "angles of each roller's axis: tilt in the bearing's axial plane, outwards at +x, and skew along the orbit",
    ),
    Channel("rib_load", ("ball", "rib"), "N", "normal force of each rib on each roller; 0 where there is no rib"),
)
