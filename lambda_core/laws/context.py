"""Define the data that the set-up of a law receives.

These are frozen geometry, materials and oil of one force element, in SI.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Material:
    """Solid properties of one body, SI."""

    name: str
    youngs_modulus: float  # [Pa]
    poisson_ratio: float  # [-]
    density: float  # [kg/m3]
    thermal_conductivity: float  # [W/(m K)]
    specific_heat: float  # [J/(kg K)]


@dataclass(frozen=True)
class Oil:
    """Properties of the lubricant at the run's bulk temperature, SI.

    The first block comes from the catalogue; the second is derived by the host from the
    chosen rheology kernel and is NaN in the context handed to that kernel's own `prepare`.
    """

    name: str
    base_type: str  # "mineral", "PAO", ...
    temperature: float  # bulk and inlet temperature [K]
    thermal_conductivity: float  # [W/(m K)]
    specific_heat: float  # [J/(kg K)]
    viscosity: float = float("nan")  # at ambient pressure [Pa s]
    density: float = float("nan")  # at ambient pressure [kg/m3]
    alpha_p: float = float("nan")  # d ln(eta)/dp at p = 0 [1/Pa]
    beta: float = float("nan")  # -d ln(eta)/dT [1/K]


@dataclass(frozen=True)
class Context:
    """Set-up for a law's `prepare`.

    It holds frozen geometry, materials and oil, in SI.

    Lengths that a force element does not have are NaN (a cage contact has no groove).
    """

    # "ball_inner", "ball_outer", "ball_cage", "ball_ball", "cage_inner", "cage_outer", "fluid_drag"; of rollers also
    # "rib_inner", "rib_outer"; of an electric circuit "film_inner", "film_outer"
    element: str
    ball_count: int  # Z
    ball_diameter: float  # [m]
    pitch_diameter: float  # [m]
    bore_diameter: float  # [m]
    outside_diameter: float  # [m]
    width: float  # [m]
    series: str  # "60", "62", "63", "64", "618", "619", "70", "72", "73" or "" when unknown
    speed: float  # |Omega_i - Omega_o| at the start or its largest planned value [rad/s]
    mean_load: float  # mean normal load of the loaded contacts at equilibrium [N]
    ball: Material  # of the balls
    partner: Material  # ring or cage
    oil: Oil  # at the bulk temperature
    contact_angle: float = float("nan")  # at which R_x is frozen [rad]
    groove_radius: float = float("nan")  # [m]
    race_diameter: float = float("nan")  # at the groove's bottom [m]
    radius_x: float = float("nan")  # reduced radius along rolling [m]
    radius_y: float = float("nan")  # reduced radius across rolling [m]
    e_eff: float = float("nan")  # E' with 2/E' = sum (1-nu^2)/E [Pa]
    pocket_clearance: float = float("nan")  # diametral clearance of ball and pocket [m]
    land_clearance: float = float("nan")  # diametral clearance of cage and land [m]
    land_diameter: float = float("nan")  # diameter of the guiding land [m]
    cage_width: float = float("nan")  # [m]
    starvation: float = 1.0  # share of the flooded film that the case prescribes
    oil_level: float = float("nan")  # height of the oil above the lowest point of the pitch circle [m]
    lubrication: str = "oil bath"  # "oil bath", "oil jet", "under-race", "oil-air", "grease"
    oil_flow: float = float("nan")  # through the bearing [m3/s]
