"""Provide roller bearings of measured friction and parameter sets.

The sets were written down before the first comparison with the measured torques, whose values were known.
Where a paper prints constants they are the paper's; everything else has the default of :class:`FrictionParameters`.
"""

from __future__ import annotations

import math
from contextlib import closing
from dataclasses import replace
from functools import cache

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium, balance
from lambda_core.elements.roller.roller_friction import FrictionParameters, OilState, RollerFriction, friction
from lambda_core.elements.roller.roller_motion import rolling_motion

RPM = math.pi / 30.0

# Wingertszahn et al. 2023, Lubricants 11, 369: Z, d_we, L, d_pw, profile after Teutsch (a_p 0.0005, c_p 20.7, k_p 2.0)
# and d, D are printed, edges of 1 mm; the cup angle follows from the catalogue's e = 0.42. T of the catalogue.
TAPERED_32216 = RollerBearing(
    kind="tapered",
    count=16,
    diameter=17e-3,
    length=22.7e-3,
    effective_length=20.7e-3,
    pitch_diameter=108.5e-3,
    bore=80e-3,
    outside=140e-3,
    width=35.25e-3,
    dynamic_rating=199e3,
    static_rating=245e3,
    fatigue_limit=28.5e3,
    contact_angle=math.radians(15.64),
    profile="logarithmic",
    profile_scale=0.0005 * 17e-3,
    profile_length=20.7e-3,
    series="322",
)
# The bath reaches the shaft's middle: rollers dip in at every turn, so that no inlet runs dry (phi_rs = 1), and churn.
# Roughness and asperities' constants of raceway and rib are the paper's, which are the defaults.
HALF_FILLED = FrictionParameters(replenishment=0.0, oil_height=0.5 * (108.5e-3 + 17e-3))


@cache
def oil_state(name: str, celsius: float) -> OilState:
    """Return an oil of the catalogue at a temperature."""
    from lambda_core import api
    from lambda_core.discovery.manager import registry

    with closing(api.catalogue()) as catalogue:
        row = catalogue.lubricant(name)
    table = api.oil_table(row, registry(), [celsius + 273.15])
    point, slope = table.points[0], table.coefficients[0]
    return OilState(
        viscosity=1e-3 * point.viscosity_mPas,
        density=point.density_kgm3,
        pressure_viscosity=1e-9 * slope.alpha_tangent_per_GPa,
        temperature_slope=slope.beta_per_K,
        conductivity=row.properties["thermal_conductivity"].value,
    )


def torque(
    bearing: RollerBearing,
    given: FrictionParameters,
    oil: OilState,
    rpm: float,
    axial: float,
    radial: float = 0.0,
) -> tuple[RollerFriction, RollerEquilibrium]:
    """Return friction and equilibrium.

    Under axial and radial load [N], tilts locked.
    """
    motion = rolling_motion(bearing, rpm * RPM)
    loads: FloatArray = np.array([axial, radial, 0.0, 0.0, 0.0])
    state = balance(bearing, loads, inertial=motion.inertial(bearing))
    return friction(bearing, state, motion, oil, given), state


def dry(given: FrictionParameters) -> FrictionParameters:
    """Return the set without a bath's drag."""
    return replace(given, oil_height=0.0)
