"""Define drag of balls in an oil-air mixture.

Oil jet, lubrication through the inner ring ("under-race") and oil-air leave a few percent of oil among the balls. The
mixture is taken as one fluid, and each ball as a single sphere in it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, law, parameter
from lambda_plugins.immersion import kinematic_speeds
from lambda_plugins.shapes import at_most
from lambda_plugins.sphere_drag import SphereDrag, churning_of_sphere, drag_of_sphere

_RPM = math.pi / 30.0
_SLOWEST = 1e-6  # [1/min] below which the share of oil is that of this speed (numerical: the share is held at 1)
_AIR_VISCOSITY = 1.8e-5  # [Pa s] of air at 20 degC, 2.1e-5 at 80 degC


class CavityMixture(SphereDrag):
    """Parameters of the oil-air mixture in the cavity."""

    oil_share: float | None = parameter(
        None,
        "share of oil in the volume of the cavity; absent: from thermal.oil_flow, speed and pitch diameter",
        source="Parker 1984, NASA TP-2300: 10^5 W^0.37/(n d_m^1.7) with W in cm3/min, n in 1/min, d_m in mm; not "
        "confirmed from its original",
        status="unconfirmed",
        published_range=(0.005, 0.05),
        gt=0.0,
        le=1.0,
    )
    air_density: float = parameter(
        1.2, "kg/m3, density of the air in the cavity", source="dry air at 20 degC and 101 kPa", ge=0.0, le=100.0
    )


class Mixture(NamedTuple):
    """The mixture that a ball meets."""

    ball_radius: float  # [m]
    moving: float  # speed of the ball through the mixture over its orbital speed
    share: float  # of oil, as given; 0 where it follows from the speed
    flow: float  # share of oil times speed [1/min]
    orbit: float  # kinematic speed per 1/min of the bearing [m/s]
    air: float  # density [kg/m3]


def cavity_share(flow: float, speed: float, pitch_diameter: float) -> float:
    """Return the oil share of the cavity by Parker.

    The correlation is not limited to 1.

    10^5 W^0.37/(n d_m^1.7), W in cm3/min, n in 1/min, d_m in mm: Parker 1984, NASA TP-2300, unconfirmed. From angular
    contact ball bearings of 35 to 167 mm bore with jets and through the inner ring, 1 to 3 10^6 n d, in which it gave
    1 to 5 %; used beyond, it is an extrapolation.

    Parameters
    ----------
    flow : float
        Oil that flows through the bearing [m3/s].
    speed : float
        Of the inner ring against the outer one [1/min].
    pitch_diameter : float
        [m].
    """
    share: float = 1e5 * (6e7 * flow) ** 0.37 / (speed * (1e3 * pitch_diameter) ** 1.7)
    return share


def prepare(parameters: CavityMixture, context: Context) -> Mixture:
    """Return the mixture of a bearing."""
    share, flow = parameters.oil_share or 0.0, 0.0
    if parameters.oil_share is None:
        if not context.oil_flow > 0.0:
            raise ValueError(
                "the share of oil in the cavity is unknown: give thermal.oil_flow, or parameters.fluid_drag.oil_share"
            )
        flow = cavity_share(context.oil_flow, 1.0, context.pitch_diameter)
    orbit, _ = kinematic_speeds(context, _RPM)
    return Mixture(
        0.5 * context.ball_diameter, 1.0 - parameters.entrainment, share, flow, orbit, parameters.air_density
    )


@law(
    "fluid_drag",
    "cavity-mixture",
    CavityMixture,
    role_api=3,
    reference="Parker 1984, NASA TP-2300 (share of oil); Clift, Grace and Weber 1978, eq. 5-8; Sawatzki 1970",
    validity="oil jet, under-race and oil-air; share of oil unconfirmed, tested at 1 to 3 million mm/min; neighbours, "
    "cage and rings left out",
    prepare=prepare,
)
def cavity_mixture(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: Mixture, out: FloatArray
) -> int:
    """Drag and churning of spheres in an oil-air mixture.

    The mixture fills the cavity; each sphere counts as single.

    Density and viscosity of the mixture are means by volume, rho = x rho_oil + (1 - x) rho_air (as programs after
    Rumbarger et al. 1973, J. Lubr. Technol. 95, 401, take it; unconfirmed), with the share x of oil of Parker 1984,
    NASA TP-2300 (:func:`cavity_share`), at most 1. Force and moment are those of :func:`.sphere_drag.sphere_drag`.
    """
    n = abs(v_orbit) / par.orbit + _SLOWEST
    x = par.share if par.share > 0.0 else at_most(par.flow / n, 1.0)
    density = x * rho + (1.0 - x) * par.air
    viscosity = (x * rho * nu + (1.0 - x) * _AIR_VISCOSITY) / density
    out[0] = drag_of_sphere(1.0, par.moving * v_orbit, par.ball_radius, viscosity, density)
    out[1] = churning_of_sphere(1.0, omega_spin, par.ball_radius, viscosity, density)
    return OK
