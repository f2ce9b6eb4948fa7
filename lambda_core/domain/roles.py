"""Define the roles of laws and their arguments.

A kernel is a plain Python function of float64 scalars (``f``) and contiguous float64
arrays (``a``), SI units, that writes its outputs and returns an int64 status: 1 is OK,
2 and up are its own declared errors, 0 means that it raised. ``par`` is a record: the law's
parameters, or what its `prepare` returns, by name; to the solver it is one flat array.
"""

from __future__ import annotations

import math

from lambda_core.domain import elements
from lambda_core.domain.role import Role, arguments_of
from lambda_core.domain.section_roles import SECTION_ROLES

ROLE_API = 3
OK = 1  # what a kernel returns for a valid result; the number of lambda_core.solver.status.Status.OK

_POSITIVE = (0.0, math.inf)
_ANY = (-math.inf, math.inf)
RACEWAYS = tuple(elements.RACEWAYS)
CAGE = (*elements.POCKETS, *elements.LANDS)
GUIDES = (*CAGE, *elements.NEIGHBOURS)

_MATERIAL = (
    "R_x f reduced radius along rolling [m]; R_y f reduced radius across rolling [m]; "
    "E_eff f E' with 2/E' = sum (1-nu^2)/E [Pa]"
)
_OIL = "eta0 f viscosity at ambient pressure [Pa s]; alpha_p f pressure-viscosity coefficient [1/Pa]"

ROLES: dict[str, Role] = {
    role.name: role
    for role in (
        Role(
            "normal_contact",
            "load and contact ellipse from penetration",
            arguments_of(f"delta e penetration, > 0 [m]; {_MATERIAL}; par a parameters; out A results"),
            ("load [N]", "semi-axis across rolling a [m]", "semi-axis along rolling b [m]", "maximum pressure [Pa]"),
            RACEWAYS,
            bounds=(_POSITIVE,) * 4,
        ),
        Role(
            "damping",
            "normal force opposing the penetration velocity",
            arguments_of(
                "delta e penetration, below zero a gap within the law's reach [m]; "
                "delta_dot e penetration velocity [m/s]; load e elastic load [N]; "
                "u_mean e? mean surface velocity, >= 0 [m/s]; semi_a e? semi-axis across rolling [m]; "
                "semi_b e? semi-axis along rolling [m]; R_x f? reduced radius along rolling [m]; "
                "R_y f? reduced radius across rolling [m]; E_eff f? E' [Pa]; "
                "eta0 f? viscosity at ambient pressure [Pa s]; alpha_p f? pressure-viscosity coefficient [1/Pa]; "
                "par a parameters; out A results"
            ),
            ("force along the elastic load, of the sign of delta_dot [N]",),
            RACEWAYS,
            sign_of="delta_dot",
            reads_states=True,
        ),
        Role(
            "rheology",
            "viscosity and density of the oil at pressure and temperature",
            arguments_of(
                "p a pressure [Pa]; T a temperature [K]; par a parameters; "
                "ln_eta A natural logarithm of the viscosity in Pa s; rho A density [kg/m3]"
            ),
            ("ln(viscosity / Pa s)", "density [kg/m3]"),
            RACEWAYS,
            elementwise=True,
            bounds=(_ANY, _POSITIVE),
        ),
        Role(
            "film_thickness",
            "isothermal, fully flooded film",
            arguments_of(
                "u_mean e mean surface velocity, >= 0 [m/s]; "
                "cos2 e square of the cosine between entrainment and the rolling direction [-]; "
                f"load e normal load [N]; {_MATERIAL}; {_OIL}; par a parameters; out A results"
            ),
            ("central film thickness [m]", "minimum film thickness [m]"),
            RACEWAYS,
            bounds=(_POSITIVE,) * 2,
            reads_states=True,
        ),
        Role(
            "thermal_correction",
            "factor on the film for heating in the inlet",
            arguments_of(
                "u_mean e mean surface velocity, >= 0 [m/s]; u_slide e sliding velocity at the contact's centre [m/s]; "
                "p_max e maximum pressure [Pa]; E_eff f E' [Pa]; eta0 f viscosity at ambient pressure [Pa s]; "
                "beta f -d ln(eta)/dT [1/K]; k_oil f thermal conductivity of the oil [W/(m K)]; "
                "par a parameters; out A results"
            ),
            ("factor on the film [-], 0..1",),
            RACEWAYS,
            bounds=((0.0, 1.0),),
            reads_states=True,
        ),
        Role(
            "supply",
            "factors on film and rolling resistance for oil that is missing in the inlet",
            arguments_of(
                "u_mean e mean surface velocity, >= 0 [m/s]; load e normal load [N]; "
                "semi_a e semi-axis across rolling [m]; semi_b e semi-axis along rolling [m]; "
                "R_x f reduced radius along rolling [m]; h_cen e central film of the flooded contact [m]; "
                "h_min e minimum film of the flooded contact [m]; par a parameters; out A results"
            ),
            ("factor on the film [-], 0..1", "factor on the rolling resistance [-], 0..1"),
            RACEWAYS,
            bounds=((0.0, 1.0), (0.0, 1.0)),
            reads_states=True,
        ),
        Role(
            "contact_temperature",
            "temperature of the film in each cell",
            arguments_of(
                "T_in f oil temperature at the inlet [K]; u_mean e mean surface velocity, >= 0 [m/s]; "
                "h e central film [m]; semi_b e semi-axis along rolling [m]; tau a shear stress [Pa]; "
                "slip a slip velocity [m/s]; "
                "par a parameters; T A film temperature [K]"
            ),
            ("film temperature [K]",),
            RACEWAYS,
            elementwise=True,
            bounds=(_POSITIVE,),
            reads_states=True,
        ),
        Role(
            "traction",
            "shear stress of the film from its rate of shear",
            arguments_of(
                "slip a slip velocity, >= 0 [m/s]; p a pressure [Pa]; T a temperature [K]; "
                "ln_eta a ln(viscosity / Pa s); h a central film [m]; par a parameters; tau A shear stress, >= 0 [Pa]"
            ),
            ("shear stress [Pa]",),
            RACEWAYS,
            elementwise=True,
            bounds=(_POSITIVE,),
            vanishes_with="slip",
            reads_states=True,
        ),
        Role(
            "rolling_resistance",
            "hydrodynamic force of the inlet on each surface",
            arguments_of(
                "u_mean e mean surface velocity, >= 0 [m/s]; load e normal load [N]; "
                "semi_a e semi-axis across rolling [m]; "
                f"semi_b e semi-axis along rolling [m]; {_MATERIAL}; {_OIL}; beta f -d ln(eta)/dT [1/K]; "
                "k_oil f thermal conductivity of the oil [W/(m K)]; par a parameters; out A results"
            ),
            ("one force, the same on both bodies, >= 0 [N]",),
            RACEWAYS,
            bounds=(_POSITIVE,),
            reads_states=True,
        ),
        Role(
            "elastic_hysteresis",
            "couple that resists rolling by losses in the solids",
            arguments_of(
                "load e normal load [N]; semi_a e semi-axis across rolling [m]; semi_b e semi-axis along rolling [m]; "
                "R_x f reduced radius along rolling [m]; R_y f reduced radius across rolling [m]; "
                "R_ball f ball radius [m]; par a parameters; out A results"
            ),
            ("moment against the relative rolling, >= 0 [N m]",),
            RACEWAYS,
            bounds=(_POSITIVE,),
            reads_states=True,
        ),
        Role(
            "asperity_load",
            "share of the load carried by touching asperities",
            arguments_of("Lambda e film over composite roughness [-]; par a parameters; out A results"),
            ("share of the load psi [-], 0..1",),
            RACEWAYS,
            bounds=((0.0, 1.0),),
            reads_states=True,
        ),
        Role(
            "boundary_friction",
            "coefficient of friction of touching asperities",
            arguments_of(
                "slip a slip velocity, >= 0 [m/s]; p a pressure [Pa]; u_mean e mean surface velocity, >= 0 [m/s]; "
                "par a parameters; mu A coefficient [-]"
            ),
            ("coefficient of friction [-], >= 0, 0 at rest",),
            RACEWAYS,
            elementwise=True,
            bounds=(_POSITIVE,),
            vanishes_with="slip",
            reads_states=True,
        ),
        Role(
            "mixing",
            "shares of film and asperities in the shear stress of a contact where both carry",
            arguments_of(
                "psi e share of the load on asperities [-]; Lambda e film over composite roughness [-]; "
                "load e normal load [N]; p_max e maximum pressure [Pa]; semi_a e semi-axis across rolling [m]; "
                "semi_b e semi-axis along rolling [m]; par a parameters; out A results"
            ),
            ("factor on the film's shear stress [-], 0..1", "factor on mu p, the asperities' stress [-], 0..1"),
            RACEWAYS,
            bounds=((0.0, 1.0), (0.0, 1.0)),
            reads_states=True,
        ),
        Role(
            "contact_state",
            "rates of change of the states of a contact, for the laws that read them",
            arguments_of(
                "t f time [s]; load f normal load, 0 while the contact is open, as all that follows to the power [N]; "
                "semi_a f semi-axis across rolling [m]; semi_b f semi-axis along rolling [m]; "
                "p_max f maximum pressure [Pa]; u_mean f mean surface velocity, >= 0 [m/s]; "
                "u_slide f sliding velocity at the contact's centre, >= 0 [m/s]; "
                "spin f relative angular velocity about the normal [rad/s]; h f central film [m]; "
                "Lambda f film over composite roughness [-]; psi f share of the load on asperities [-]; "
                "power f power dissipated in the contact [W]; "
                "T_film f mean film temperature, that of the oil while open [K]; "
                "T_in f oil temperature at the inlet [K]; par a parameters, and the states themselves by name; "
                "out A results"
            ),
            ("rates of the law's states, in their order [unit of the state over s]",),
            RACEWAYS,
            reads_states=True,
        ),
        Role(
            "cage_contact",
            "force between the cage and a ball (pocket) or a ring (land), or of two balls where there is no cage",
            arguments_of(
                "r a position of the guided body's centre from the pocket's (ball) or the cage's centre from the "
                "land's (cage), (axial, radial or y, tangential or z) [m]; v_rel a its velocity in that frame [m/s]; "
                "omega_rel a its angular velocity relative to the partner [rad/s]; "
                "eta0 f viscosity at ambient pressure [Pa s]; par a parameters; "
                "out A force on the moving body [N] (3), point of action from the frame's origin [m] (3)"
            ),
            ("force[3] [N]", "point[3] [m]"),
            GUIDES,
        ),
        Role(
            "fluid_drag",
            "drag force and churning moment of the oil on one ball",
            arguments_of(
                "v_orbit f orbital speed of the ball's centre, signed [m/s]; omega_spin f spin speed, >= 0 [rad/s]; "
                "azimuth f azimuth from +y to +z [rad]; nu f kinematic viscosity [m2/s]; rho f density [kg/m3]; "
                "par a parameters; out A results"
            ),
            ("force against the orbital motion, of the sign of v_orbit [N]", "moment against the spin, >= 0 [N m]"),
            tuple(elements.OIL),
            sign_of="v_orbit",
        ),
        Role(
            "permittivity",
            "relative permittivity of the oil",
            arguments_of(
                "p a pressure [Pa]; T a temperature [K]; rho a density [kg/m3]; par a parameters; "
                "eps_r A relative permittivity"
            ),
            ("relative permittivity [-]",),
            RACEWAYS,
            elementwise=True,
            bounds=((1.0, math.inf),),
        ),
        Role(
            "capacitance",
            "total capacitance of one contact from that of its Hertzian area",
            arguments_of(
                "C_hertz f capacitance of the Hertzian area [F]; h f central film [m]; "
                "semi_a f semi-axis across rolling [m]; semi_b f semi-axis along rolling [m]; "
                "R_x f reduced radius along rolling [m]; R_y f reduced radius across rolling [m]; "
                "U f Hamrock-Dowson speed parameter [-]; G f material parameter [-]; W f load parameter [-]; "
                "eps_r0 f relative permittivity at ambient pressure [-]; par a parameters; out A results"
            ),
            ("capacitance of the contact [F]",),
            RACEWAYS,
            bounds=(_POSITIVE,),
        ),
        Role(
            "surface",
            "deviation of a raceway from its nominal surface: waviness, defects",
            arguments_of(
                "azimuth f place on the raceway, turning with the ring, -pi..pi from +y towards +z [rad]; "
                "contact_angle f place across the groove, positive where thrust on the inner ring presses [rad]; "
                "par a parameters; out A results"
            ),
            (
                "height along the normal, towards the ball [m]",
                "its derivative by azimuth [m/rad]",
                "its derivative by contact angle [m/rad]",
            ),
            RACEWAYS,
            slopes=((1, 0, "azimuth"), (2, 0, "contact_angle")),
        ),
        *SECTION_ROLES,
    )
}
MOTION_ROLES = {name: role for name, role in ROLES.items() if not role.section}
ELECTRIC_ROLES = {name: role for name, role in ROLES.items() if role.section == "electric"}

# Built-in default per role; "auto" is resolved to the model for which the lubricant has data.
DEFAULT_MODELS: dict[str, str] = {
    "normal_contact": "hamrock-brewe",
    "damping": "squeeze-film",
    "rheology": "auto",
    "film_thickness": "chittenden",
    "thermal_correction": "murch-wilson",
    "supply": "skf-replenishment",
    "contact_temperature": "shear-heating",
    "traction": "ree-eyring",
    "rolling_resistance": "biboulet-houpert",
    "elastic_hysteresis": "loss-factor",
    "asperity_load": "spikes-olver",
    "boundary_friction": "micro-slip",
    "mixing": "load-share",
    "contact_state": "none",
    "cage_contact": "spherical-pocket",
    "fluid_drag": "skf-catalogue",
    "permittivity": "bode",
    "capacitance": "schneider",
    "surface": "none",
    "force_element": "bushing",
    "time_function": "chirp",
    "breakdown": "statistical",
    "discharge": "resistance",
}

# Roles whose laws differ between ellipses and lines -> built-in default of line contacts; the others serve both.
DEFAULT_LINE_MODELS: dict[str, str] = {
    "normal_contact": "iso-line",
    "damping": "squeeze-line",
    "film_thickness": "moes-line",
    "rolling_resistance": "biboulet-houpert-line",
    "elastic_hysteresis": "johnson-line",
    "capacitance": "line-gap",
}
# Roles whose laws know the shape of the elements -> built-in default of rollers.
DEFAULT_SHAPE_MODELS: dict[str, str] = {"cage_contact": "roller-pocket", "fluid_drag": "skf-rollers"}
# Roles whose laws serve points and lines alike, but whose default of rollers, on raceways and on ribs, is another one.
DEFAULT_ROLLER_MODELS: dict[str, str] = {"asperity_load": "zhou-hoeprich"}
# Roles in which ends of rollers on ribs have other laws than points: they slide, and have no law of rolling.
DEFAULT_RIB_MODELS: dict[str, str] = {
    "thermal_correction": "zhu-cheng",
    "rolling_resistance": "none",
    "elastic_hysteresis": "none",
}
# Laws of the quasi-static friction of rollers: role -> names, the default first, and name in FrictionParameters of each
# parameter.
ROLLER_FRICTION: dict[str, tuple[tuple[str, ...], dict[str, str]]] = {
    "elastic_hysteresis": (("johnson-line",), {"loss_factor": "loss_factor"}),
    "rolling_resistance": (
        ("biboulet-houpert-line", "matsuyama-line", "zhou-hoeprich-line", "aihara-line"),
        {"thermal_coefficient": "inlet_heat"},
    ),
    "film_thickness": (("moes-line", "dowson-toyoda"), {}),
    "thermal_correction": (("murch-wilson", "zhu-cheng"), {}),
    "traction": (("ree-eyring",), {"tau_eyring": "eyring_stress", "limit_ratio": "limit_ratio"}),
    "boundary_friction": (("micro-slip",), {"mu": "boundary_friction"}),
    "asperity_load": (("zhou-hoeprich",), {"B": "asperity_scale", "C": "asperity_exponent"}),
    "supply": (("skf-replenishment",), {"k_rs": "replenishment"}),
}
# Roles whose laws the quasi-static friction of rollers exchanges: role -> name in FrictionParameters.
ROLLER_CHOICES = {
    "rolling_resistance": "rolling_law",
    "film_thickness": "film_law",
    "thermal_correction": "thermal_law",
}
