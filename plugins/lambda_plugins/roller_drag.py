"""Share SKF's drag in an oil bath among the rollers."""

from __future__ import annotations

import math

from lambda_core.plugins import Context, FloatArray, bath_drag_terms, law, parameter
from lambda_plugins.fluid_drag import SharedLoss, SkfShare, oil_height, power_factors, skf_catalogue
from lambda_plugins.immersion import kinematic_speeds, oil_geometry

_RPM = math.pi / 30.0
_K_L, _K_Z = 0.65, 5.1


class SkfRollers(SharedLoss):
    """Parameters of SKF's drag of rollers in oil."""

    k_l: float = parameter(
        _K_L,
        "geometry constant K_L; full complement and tapered 0.7, needle 0.5",
        source="SKF, Rolling bearings (2018), Friction: cylindrical with cage; remembered",
        status="unconfirmed",
        published_range=(0.5, 0.7),
        gt=0.0,
    )
    k_z: float = parameter(
        _K_Z,
        "geometry constant K_Z; full complement 6.2, tapered 6, needle 5.5",
        source="SKF, Rolling bearings (2018), Friction: cylindrical with cage; remembered",
        status="unconfirmed",
        published_range=(5.1, 6.2),
        gt=0.0,
    )


def prepare(parameters: SkfRollers, context: Context) -> SkfShare:
    """Return a roller's share of the bearing's drag."""
    orbit, spin = kinematic_speeds(context, _RPM)
    bath, height = oil_geometry(context), oil_height(context)
    if height <= 0.0:
        return SkfShare(bath, orbit, spin, 0.0, 0.0, 0.0, 0.0)
    sizes = (1e3 * context.bore_diameter, 1e3 * context.outside_diameter, 1e3 * context.width)
    square, viscous = bath_drag_terms(*sizes, height, (parameters.k_l, parameters.k_z))
    drag, churn = power_factors(parameters, context)
    return SkfShare(bath, orbit, spin, drag * square, churn * square, drag * viscous, churn * viscous)


@law(
    "fluid_drag",
    "skf-rollers",
    SkfRollers,
    role_api=3,
    reference="SKF, Rolling bearings, catalogue 17000 EN (2018), chapter Friction",
    validity="oil bath, horizontal shaft; V_M from SKF's chart; the share of drag is that of spheres, an assumption",
    prepare=prepare,
    contact="line",
)
def skf_rollers(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: SkfShare, out: FloatArray
) -> int:
    """SKF's drag torque of rollers in an oil bath.

    It acts on each roller by its immersion.

    M_drag = 4 V_M K_roll C_w B d_m^4 n^2 and the viscous term of balls: SKF, Rolling bearings, catalogue 17000 EN
    (2018), chapter Friction. Immersion is that of a sphere of the roller's diameter.
    """
    return skf_catalogue(v_orbit, omega_spin, azimuth, nu, rho, par, out)
