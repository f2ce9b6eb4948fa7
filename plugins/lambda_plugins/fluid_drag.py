"""Define drag of balls after bearing catalogues.

The immersed balls share it.

A catalogue gives one torque M(n) for the whole bearing. Each ball takes a part in proportion to its submerged volume,
as a drag force against its orbit and a churning moment against its spin, such that at kinematic speeds the power of all
balls, averaged over the azimuth, equals M times the speed of rotation. The `drag_share` splits it between force and
moment. Reactions go to the housing.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Annotated, Any, Literal, NamedTuple

from pydantic import BeforeValidator

from lambda_core.plugins import OK, Context, FloatArray, NoParameters, Parameters, law, parameter
from lambda_plugins.immersion import OilBath, immersion, kinematic_speeds, mean_immersion, oil_geometry
from lambda_plugins.methods.skf_chart import UNCERTAINTY, drag_loss_factor
from lambda_plugins.methods.skf_drag import K_Z_OF_KINDS
from lambda_plugins.shapes import at_least

_RPM = math.pi / 30.0
_SLOW = 1.0  # [1/min] below which a power law with an exponent under 1 becomes linear (numerical)


def _year(value: Any) -> Any:
    """Return a year that is a number as text."""
    return str(value) if isinstance(value, int) else value


class SharedLoss(Parameters):
    """Share of a bearing's loss on each ball."""

    drag_share: float = parameter(
        0.8,
        "share of the loss that acts as a drag force on the orbit; the rest churns against the spin",
        source="powers of a free sphere in oil (Clift et al. 1978, Sawatzki 1970): 0.82 to 0.92 of them are drag in a "
        "6319 at 500 to 3000 1/min",
        status="assumed",
        published_range=(0.7, 0.9),
        ge=0.0,
        le=1.0,
    )


class Skf(SharedLoss):
    """Parameters of SKF's drag losses in an oil bath."""

    v_m: float | None = parameter(
        None,
        "drag loss factor V_M; absent: SKF's chart at the oil level, 2.25e-5 in the edition of 2008",
        source=f"2018: chart for ball bearings as digitised in public, +-{UNCERTAINTY:.0%}; 2008: middle of 0 to "
        "4.5e-5, which agree with the SKF row of Syla et al. 2026, Table 4",
        status="assumed",
        ge=0.0,
        le=2e-3,
    )
    edition: Annotated[Literal["2008", "2018"], BeforeValidator(_year)] = parameter(
        "2018",
        "edition of the catalogue: 2008 has the square law alone, 2018 adds a viscous term and weights V_M by 0.4",
        source=f"SKF; 2018 with V_M from SKF's chart, +-{UNCERTAINTY:.0%}; not confirmed from its original",
        status="unconfirmed",
    )
    k_z: float = parameter(
        3.1,
        "geometry constant K_Z; of single row angular contact 4.4, of self-aligning bearings 4.8",
        source="SKF: ball bearings 3.1, single row angular contact 4.4, self-aligning 4.8",
        by_kind=K_Z_OF_KINDS,
        gt=0.0,
    )


def mean_diameter(context: Context) -> float:
    """Return d_m = (d + D)/2 of the catalogues [mm]."""
    return 500.0 * (context.bore_diameter + context.outside_diameter)


def oil_height(context: Context) -> float:
    """Return the oil level H [mm].

    Above the lowest point of the outer raceway, from none to drowned.
    """
    level = 1e3 * (oil_geometry(context).level + 0.5 * context.ball_diameter)
    return min(max(level, 0.0), 1.2 * mean_diameter(context))


def volume_factor(parameters: Skf, context: Context) -> float:
    """Return V_M: as given, or SKF's chart."""
    if parameters.v_m is not None:
        return parameters.v_m
    return drag_loss_factor(oil_height(context) / mean_diameter(context), parameters.edition)


def skf_torque(parameters: Skf, context: Context) -> tuple[float, float]:
    """Return both parts of SKF's drag torque.

    They are (M / n^2, M / (n^0.621 nu^1.379)) in N mm, with n in 1/min and nu in mm2/s.

    2008: M = V_M K_ball d_m^5 n^2, K_ball = K_Z (d + D)/(D - d) 1e-12 for one row (mm). 2018: 0.4 of that, plus
    1.093e-7 n^2 d_m^3 (n d_m^2 f_t/nu)^-1.379 R_s, R_s = 0.36 d_m^2 (t - sin t) f_A, f_A = 0.05 K_Z (D + d)/(D - d),
    t = 2 acos((0.6 d_m - H)/(0.6 d_m)), f_t = sin(t/2) below t = pi and 1 above; H is the oil level above the lowest
    point of the outer raceway.
    """
    d, D, d_m = 1e3 * context.bore_diameter, 1e3 * context.outside_diameter, mean_diameter(context)
    ratio = parameters.k_z * (D + d) / (D - d)
    square = volume_factor(parameters, context) * ratio * 1e-12 * d_m**5
    if parameters.edition == "2008":
        return square, 0.0
    level = 1e3 * (oil_geometry(context).level + 0.5 * context.ball_diameter)
    level = min(max(level, 0.0), 1.2 * d_m)
    t = 2.0 * math.acos((0.6 * d_m - level) / (0.6 * d_m))
    f_t = math.sin(0.5 * t) if t < math.pi else 1.0
    if f_t <= 0.0:
        return 0.4 * square, 0.0
    R_s = 0.36 * d_m**2 * (t - math.sin(t)) * 0.05 * ratio
    return 0.4 * square, 1.093e-7 * d_m**3 * (d_m**2 * f_t) ** -1.379 * R_s


class SkfShare(NamedTuple):
    """Share of one wholly immersed ball in SKF's torque."""

    bath: OilBath
    orbit: float  # kinematic speed per 1/min of the bearing [m/s]
    spin: float  # the same [rad/s]
    force: float  # of the square law [N per (1/min)^2]
    moment: float  # of the square law [N m per (1/min)^2]
    viscous_force: float  # of the viscous term [N per (1/min)^0.621 (mm2/s)^1.379]
    viscous_moment: float  # of the viscous term [N m per the same]


def prepare_skf(parameters: Skf, context: Context) -> SkfShare:
    """Return a ball's share.

    SKF takes twice the torque of a bath to the middle of the lowest ball for an oil jet; it is spread over all balls.
    """
    jets, standing = 1.0, context
    if context.lubrication == "oil jet":
        jets, standing = 2.0, dataclasses.replace(context, lubrication="oil bath", oil_level=0.0)
        context = dataclasses.replace(standing, oil_level=math.nan)
    square, viscous = (jets * part for part in skf_torque(parameters, standing))
    drag, churn = power_factors(parameters, context)
    orbit, spin = kinematic_speeds(context, _RPM)
    bath = oil_geometry(context)
    return SkfShare(bath, orbit, spin, drag * square, churn * square, drag * viscous, churn * viscous)


def power_factors(parameters: SharedLoss, context: Context) -> tuple[float, float]:
    """Return force and moment on a wholly immersed ball.

    They are in [N] and [N m] per N mm of the bearing's drag torque.

    From Z mean(immersion) (F v_orbit + M omega_spin) = torque times speed of rotation, at kinematic speeds. A bearing
    whose balls never touch the oil has no loss.
    """
    mean = mean_immersion(oil_geometry(context))
    if mean <= 0.0:
        return 0.0, 0.0
    orbit, spin = kinematic_speeds(context, _RPM)
    power = 1e-3 * _RPM / (context.ball_count * mean)
    return parameters.drag_share * power / orbit, (1.0 - parameters.drag_share) * power / spin


@law(
    "fluid_drag",
    "skf-catalogue",
    Skf,
    role_api=3,
    reference="SKF, Rolling bearings, catalogue 17000 EN (2018), chapter Friction; edition of 2008: Syla et al. 2026, "
    "Lubricants 14, 154, eq. 40",
    validity="oil bath, horizontal shaft; V_M from SKF's chart, read within 15 %; oil jet: twice that of a usual bath",
    prepare=prepare_skf,
)
def skf_catalogue(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: SkfShare, out: FloatArray
) -> int:
    """SKF's drag torque in an oil bath.

    It acts on each ball by its immersion.

    M_drag = 0.4 V_M K_ball d_m^5 n^2 and a viscous term: SKF, Rolling bearings, catalogue 17000 EN (2018), chapter
    Friction (the second form not confirmed from its original). Edition of 2008: V_M K_ball d_m^5 n^2 alone, Syla et
    al. 2026, eq. 40.
    """
    wet = immersion(azimuth, par.bath)
    orbit = v_orbit / par.orbit
    spin = omega_spin / par.spin
    out[0] = wet * orbit * par.force * abs(orbit)
    out[1] = wet * spin * par.moment * abs(spin)
    if wet > 0.0 and (par.viscous_force > 0.0 or par.viscous_moment > 0.0):
        viscosity = (1e6 * nu) ** 1.379
        out[0] += wet * orbit * par.viscous_force * viscosity * (orbit * orbit + _SLOW * _SLOW) ** -0.1895
        out[1] += wet * spin * par.viscous_moment * viscosity * (spin * spin + _SLOW * _SLOW) ** -0.1895
    return OK


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


class SchaefflerShare(NamedTuple):
    """Share of one wholly immersed ball in Schaeffler's torque M0."""

    bath: OilBath
    orbit: float  # kinematic speed per 1/min of the bearing [m/s]
    spin: float  # the same [rad/s]
    force: float  # per (nu n)^(2/3), or 160 [N]
    moment: float  # per the same [N m]


def prepare_schaeffler(parameters: Schaeffler, context: Context) -> SchaefflerShare:
    """Return a ball's share."""
    f0 = parameters.f0 if parameters.f0 is not None else _F0_BATH.get(context.series)
    if f0 is None:
        known = ", ".join(_F0_BATH)
        raise ValueError(
            f'bearing series "{context.series}" has no built-in f0 (known: {known}): give the parameter f0'
        )
    torque = parameters.fluid_share * f0 * 1e-7 * mean_diameter(context) ** 3
    drag, churn = power_factors(parameters, context)
    orbit, spin = kinematic_speeds(context, _RPM)
    return SchaefflerShare(oil_geometry(context), orbit, spin, drag * torque, churn * torque)


def viscous_number(nu: float, n: float) -> float:
    """Return (nu n)^(2/3), at least 160.

    The catalogue steps by 0.8 % there; nu in m2/s, n in 1/min.
    """
    power: float = (1e6 * nu * abs(n)) ** (2.0 / 3.0)
    return at_least(power, 160.0)


@law(
    "fluid_drag",
    "schaeffler-catalogue",
    Schaeffler,
    role_api=3,
    reference="Schaeffler, Rolling bearings (catalogue); Syla et al. 2026, Lubricants 14, 154, eq. 38-39",
    validity="oil bath to the centre of the lowest ball; the share of drag in M0 is an assumption",
    prepare=prepare_schaeffler,
)
def schaeffler_catalogue(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: SchaefflerShare, out: FloatArray
) -> int:
    """Fluid share of Schaeffler's torque M0.

    It acts on each ball by its immersion.

    M0 = f0 1e-7 d_m^3 (nu n)^(2/3) from nu n = 2000 on, 160e-7 f0 d_m^3 below (mm, mm2/s, 1/min, N mm): Syla et al.
    2026, eq. 38-39. M0 holds rolling resistance too; only `fluid_share` of it is applied, so that nothing counts twice.
    Below 1 1/min the torque goes to zero with the speed.
    """
    wet = immersion(azimuth, par.bath)
    n = v_orbit / par.orbit
    out[0] = wet * par.force * viscous_number(nu, n) * n / math.sqrt(n * n + _SLOW * _SLOW)
    n = omega_spin / par.spin
    out[1] = wet * par.moment * viscous_number(nu, n) * n / math.sqrt(n * n + _SLOW * _SLOW)
    return OK


@law("fluid_drag", "none", role_api=3, reference="-", contact="any")
def none(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: NoParameters, out: FloatArray
) -> int:
    """No fluid losses on the balls."""
    out[0] = 0.0
    out[1] = 0.0
    return OK
