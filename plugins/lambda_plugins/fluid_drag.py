"""Drag and churning of the oil on the balls after catalogues of bearing makers, shared among the immersed balls.

A catalogue gives one torque M(n) for the whole bearing. Each ball takes a part in proportion to its submerged volume,
as a drag force against its orbit and a churning moment against its spin, such that at kinematic speeds the power of all
balls, averaged over the azimuth, equals M times the speed of rotation. The `drag_share` splits it between force and
moment. Reactions go to the housing.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from lambda_core.plugins import Context, NoParameters, model
from lambda_plugins.fields import FloatArray, Parameters, parameter
from lambda_plugins.immersion import immersion, kinematic_speeds, mean_immersion, oil_geometry
from lambda_plugins.shapes import at_least

_RPM = math.pi / 30.0
_SLOW = 1.0  # [1/min] below which a power law with an exponent under 1 becomes linear (numerical)


class SharedLoss(Parameters):
    """How a bearing's loss is split on each ball."""

    drag_share: float = parameter(
        0.8,
        "share of the loss that acts as a drag force on the orbit; the rest churns against the spin",
        source="powers of a free sphere in oil (Clift et al. 1978, Sawatzki 1970): 0.74 to 0.88 of them are drag in a "
        "6319 at 500 to 3000 1/min",
        status="assumed",
        published_range=(0.7, 0.9),
        ge=0.0,
        le=1.0,
    )


class Skf(SharedLoss):
    """Parameters of SKF's drag losses in an oil bath."""

    v_m: float = parameter(
        2.25e-5,
        "drag loss factor V_M, to be read from SKF's chart over oil level and pitch diameter",
        source="middle of 0..4.5e-5, all consistent with the SKF row of Syla et al. 2026, Table 4 (6319, oil to the "
        "centre of the lowest ball); the chart is not available as numbers",
        status="assumed",
        published_range=(0.0, 4.5e-5),
        ge=0.0,
        le=2e-3,
    )
    edition: Literal["2008", "2018"] = parameter(
        "2008",
        "edition of the catalogue: 2008 has the square law alone, 2018 adds a viscous term and weights V_M by 0.4",
        source="SKF; the second form is not confirmed from its original",
    )
    k_z: float = parameter(3.1, "geometry constant K_Z", source="SKF: deep groove ball bearings 3.1", gt=0.0)


def mean_diameter(context: Context) -> float:
    """Return d_m = (d + D)/2 of the catalogues [mm]."""
    return 500.0 * (context.bore_diameter + context.outside_diameter)


def skf_torque(parameters: Skf, context: Context) -> tuple[float, float]:
    """Return (M / n^2, M / (n^0.621 nu^1.379)) of SKF's drag torque [N mm], n in 1/min, nu in mm2/s.

    2008: M = V_M K_ball d_m^5 n^2, K_ball = K_Z (d + D)/(D - d) 1e-12 for one row (mm). 2018: 0.4 of that, plus
    1.093e-7 n^2 d_m^3 (n d_m^2 f_t/nu)^-1.379 R_s, R_s = 0.36 d_m^2 (t - sin t) f_A, f_A = 0.05 K_Z (D + d)/(D - d),
    t = 2 acos((0.6 d_m - H)/(0.6 d_m)), f_t = sin(t/2) below t = pi and 1 above; H is the oil level above the lowest
    point of the outer raceway.
    """
    d, D, d_m = 1e3 * context.bore_diameter, 1e3 * context.outside_diameter, mean_diameter(context)
    ratio = parameters.k_z * (D + d) / (D - d)
    square = parameters.v_m * ratio * 1e-12 * d_m**5
    if parameters.edition == "2008":
        return square, 0.0
    level = 1e3 * (oil_geometry(context)[0] + 0.5 * context.ball_diameter)
    level = min(max(level, 0.0), 1.2 * d_m)
    t = 2.0 * math.acos((0.6 * d_m - level) / (0.6 * d_m))
    f_t = math.sin(0.5 * t) if t < math.pi else 1.0
    if f_t <= 0.0:
        return 0.4 * square, 0.0
    R_s = 0.36 * d_m**2 * (t - math.sin(t)) * 0.05 * ratio
    return 0.4 * square, 1.093e-7 * d_m**3 * (d_m**2 * f_t) ** -1.379 * R_s


def prepare_skf(parameters: Skf, context: Context) -> FloatArray:
    """Return [oil geometry (3), orbit and spin speed per 1/min (2), square factors (2), viscous factors (2)]."""
    square, viscous = skf_torque(parameters, context)
    drag, churn = power_factors(parameters, context)
    oil, speeds = oil_geometry(context), kinematic_speeds(context, _RPM)
    return np.array([*oil, *speeds, drag * square, churn * square, drag * viscous, churn * viscous])


def power_factors(parameters: SharedLoss, context: Context) -> tuple[float, float]:
    """Return force [N] and moment [N m] on a wholly immersed ball per N mm of the bearing's drag torque.

    From Z mean(immersion) (F v_orbit + M omega_spin) = torque times speed of rotation, at kinematic speeds. A bearing
    whose balls never touch the oil has no loss.
    """
    mean = mean_immersion(oil_geometry(context))
    if mean <= 0.0:
        return 0.0, 0.0
    orbit, spin = kinematic_speeds(context, _RPM)
    power = 1e-3 * _RPM / (context.ball_count * mean)
    return parameters.drag_share * power / orbit, (1.0 - parameters.drag_share) * power / spin


def skf_catalogue(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: FloatArray, out: FloatArray
) -> int:
    """SKF's drag torque in an oil bath, on each ball by its immersion.

    M_drag = V_M K_ball d_m^5 n^2: SKF, Das Waelzlagerhandbuch fuer Studenten (2008); Syla et al. 2026, eq. 40. The
    viscous term of the 2018 edition is optional (not confirmed from its original).
    """
    wet = immersion(azimuth, par[0], par[1], par[2])
    orbit = v_orbit / par[3]
    spin = omega_spin / par[4]
    out[0] = wet * orbit * par[5] * abs(orbit)
    out[1] = wet * spin * par[6] * abs(spin)
    if par[7] > 0.0 or par[8] > 0.0:
        viscosity = (1e6 * nu) ** 1.379
        out[0] += wet * orbit * par[7] * viscosity * (orbit * orbit + _SLOW * _SLOW) ** -0.1895
        out[1] += wet * spin * par[8] * viscosity * (spin * spin + _SLOW * _SLOW) ** -0.1895
    return 1


# Factors f0 for oil bath; series not listed need the parameter.
_F0_BATH = {"60": 1.7, "62": 2.0, "63": 2.3, "64": 2.3, "618": 1.7, "619": 1.7}


class Schaeffler(SharedLoss):
    """Parameters of Schaeffler's speed-dependent torque M0."""

    f0: float | None = parameter(
        None,
        "bearing factor f0; by the series if not given: 1.7 for 60, 618, 619, 2 for 62, 2.3 for 63 and 64",
        source="Schaeffler catalogue, oil bath (common values, original not seen)",
        status="unconfirmed",
        published_range=(1.7, 2.3),
        gt=0.0,
    )
    fluid_share: float = parameter(
        0.35,
        "share of M0 that is drag and churning; the rest is rolling resistance, which the contacts carry",
        source="1 - f0(oil mist)/f0(oil bath) = 1 - 1.1/1.7, 1 - 1.3/2, 1 - 1.5/2.3 = 0.35 for all series: without a "
        "bath M0 has no churning left, and rolling resistance does not know the bath",
        status="assumed",
        published_range=(0.0, 1.0),
        ge=0.0,
        le=1.0,
    )


def prepare_schaeffler(parameters: Schaeffler, context: Context) -> FloatArray:
    """Return [oil geometry (3), orbit and spin speed per 1/min (2), force and moment per (160 or (nu n)^(2/3)) (2)]."""
    f0 = parameters.f0 if parameters.f0 is not None else _F0_BATH.get(context.series)
    if f0 is None:
        known = ", ".join(_F0_BATH)
        raise ValueError(
            f'bearing series "{context.series}" has no built-in f0 (known: {known}): give the parameter f0'
        )
    torque = parameters.fluid_share * f0 * 1e-7 * mean_diameter(context) ** 3
    drag, churn = power_factors(parameters, context)
    return np.array([*oil_geometry(context), *kinematic_speeds(context, _RPM), drag * torque, churn * torque])


def viscous_number(nu: float, n: float) -> float:
    """Return (nu n)^(2/3) held at 160 and above (the catalogue steps by 0.8 % there); nu in m2/s, n in 1/min."""
    power: float = (1e6 * nu * abs(n)) ** (2.0 / 3.0)
    return at_least(power, 160.0)


def schaeffler_catalogue(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: FloatArray, out: FloatArray
) -> int:
    """Fluid share of Schaeffler's torque M0, on each ball by its immersion.

    M0 = f0 1e-7 d_m^3 (nu n)^(2/3) from nu n = 2000 on, 160e-7 f0 d_m^3 below (mm, mm2/s, 1/min, N mm): Syla et al.
    2026, eq. 38-39. M0 holds rolling resistance too; only `fluid_share` of it is applied, so that nothing counts twice.
    Below 1 1/min the torque goes to zero with the speed.
    """
    wet = immersion(azimuth, par[0], par[1], par[2])
    n = v_orbit / par[3]
    out[0] = wet * par[5] * viscous_number(nu, n) * n / math.sqrt(n * n + _SLOW * _SLOW)
    n = omega_spin / par[4]
    out[1] = wet * par[6] * viscous_number(nu, n) * n / math.sqrt(n * n + _SLOW * _SLOW)
    return 1


def none(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: FloatArray, out: FloatArray
) -> int:
    """No fluid losses on the balls."""
    out[0] = 0.0
    out[1] = 0.0
    return 1


SKF_CATALOGUE = model(
    "fluid_drag",
    "skf-catalogue",
    skf_catalogue,
    Skf,
    reference="SKF, Das Waelzlagerhandbuch fuer Studenten (2008); Syla et al. 2026, Lubricants 14, 154, eq. 40",
    validity="oil bath, horizontal shaft; V_M must be read from SKF's chart for the oil level",
    prepare=prepare_skf,
)

SCHAEFFLER_CATALOGUE = model(
    "fluid_drag",
    "schaeffler-catalogue",
    schaeffler_catalogue,
    Schaeffler,
    reference="Schaeffler, Rolling bearings (catalogue); Syla et al. 2026, Lubricants 14, 154, eq. 38-39",
    validity="oil bath to the centre of the lowest ball; the share of drag in M0 is an assumption",
    prepare=prepare_schaeffler,
)

NONE = model("fluid_drag", "none", none, NoParameters, reference="-")
