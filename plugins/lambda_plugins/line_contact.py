"""Define laws of line contacts: rollers on raceways.

To a law of a line contact R_y is the effective length L of the contact, `semi_a` its half, `semi_b` Hertz's half width;
loads, forces and moments are those of the whole length. Laws take them as spread evenly.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from lambda_core.plugins import (
    OK,
    VACUUM_PERMITTIVITY,
    Context,
    FloatArray,
    NoParameters,
    aihara_rolling_force,
    dowson_toyoda_film,
    inlet_heat_rolling,
    law,
    matsuyama_rolling_force,
    moes_line_film,
    power,
    rolling_regime,
    zhou_hoeprich_rolling_force,
)
from lambda_plugins.damping import Onset, SqueezeFilm, prepare_cubic
from lambda_plugins.elastic_hysteresis import LossFactor
from lambda_plugins.film_thickness import FilmFloors, Floors
from lambda_plugins.film_thickness import prepare as prepare_floors
from lambda_plugins.rolling_resistance import InletShear, regular_speed, thermal_factor
from lambda_plugins.shapes import at_least, at_most

_STEEL = 2.0 / (2.0 * (1.0 - 0.3**2) / 206e9)  # E' of the steel bodies behind the constant of ISO 16281 [Pa]
# c of one raceway, Q = c L^(8/9) delta^(10/9) (N, m), of c_L = 35948 (N, mm) of two in series, each with half of delta.
_ONE_RACEWAY = 35948.0 * 1e3 ** (8.0 / 9.0) * 2e3 ** (10.0 / 9.0)
_NEWTON = 6  # steps of the logarithm's solution: the error falls below rounding
_GAP_STEPS = 64  # of Simpson's rule over the gap around a flat


def hertz_line(line_load: float, R_x: float, E_eff: float) -> tuple[float, float]:
    """Return half width [m] and pressure [Pa] of a line.

    The pressure is the maximum; the load is per length (Johnson 1985, eq. 4.43 and 4.45).
    """
    return math.sqrt(8.0 * line_load * R_x / (math.pi * E_eff)), math.sqrt(line_load * E_eff / (2.0 * math.pi * R_x))


@law(
    "normal_contact",
    "iso-line",
    role_api=3,
    reference="ISO 16281:2025; Hertz: Johnson, Contact Mechanics (1985), eq. 4.43-4.45",
    validity="line contacts; a power law of steel rollers of usual proportions, other materials in proportion to E'",
    contact="line",
)
def iso_line(delta: float, R_x: float, R_y: float, E_eff: float, par: NoParameters, out: FloatArray) -> int:
    """Load of one raceway after ISO 16281.

    Power law Q = c L^(8/9) delta^(10/9).

    ISO 16281 gives c_L = 35948 N/mm^2 for both raceways in series; alike, each takes half of the approach. Half width
    and pressure are Hertz's.
    """
    out[0] = 0.0
    out[1] = 0.5 * R_y
    out[2] = 0.0
    out[3] = 0.0
    if not delta <= 0.0:  # NaN goes through
        load = _ONE_RACEWAY * E_eff / _STEEL * delta * power(R_y**8 * delta, 1.0 / 9.0)
        out[0] = load
        out[2], out[3] = hertz_line(load / R_y, R_x, E_eff)
    return OK


@law(
    "normal_contact",
    "hertz-line",
    role_api=3,
    reference="Lundberg 1939, Forsch. Ing.-Wes. 10, 201; Johnson, Contact Mechanics (1985), eq. 3.19 and 4.43",
    validity="line contacts of half spaces, length much larger than the half width",
    contact="line",
)
def hertz_line_contact(delta: float, R_x: float, R_y: float, E_eff: float, par: NoParameters, out: FloatArray) -> int:
    """Load of one raceway by the half space's logarithm.

    delta = 4 w/(pi E') [ln(2 L/b) + 1/2].

    The deflection below the middle of a strip of length L with Hertz's pressure across: Lundberg 1939. Solved for w by
    Newton's method in ln w.
    """
    out[0] = 0.0
    out[1] = 0.5 * R_y
    out[2] = 0.0
    out[3] = 0.0
    if not delta <= 0.0:  # NaN goes through
        spread = math.log(2.0 * R_y) + 0.5 - 0.5 * math.log(8.0 * R_x / (math.pi * E_eff))
        wanted = 0.25 * math.pi * E_eff * delta
        line_load = wanted / 8.0
        for _ in range(_NEWTON):
            room = at_least(spread - 0.5 * math.log(line_load), 0.6)
            line_load = at_least(line_load - (line_load * room - wanted) / (room - 0.5), 0.01 * line_load)
        out[0] = line_load * R_y
        out[2], out[3] = hertz_line(line_load, R_x, E_eff)
    return OK


@law(
    "film_thickness",
    "moes-line",
    Floors,
    role_api=3,
    reference="Moes 1992, Wear 159, 57; minimum: Dowson 1968, Proc. IMechE 182, 151",
    validity="line contacts from rigid-isoviscous to elastic-piezoviscous, fully flooded, isothermal",
    prepare=prepare_floors,
    contact="line",
)
def moes_line(
    u_mean: float,
    cos2: float,
    load: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    par: FilmFloors,
    out: FloatArray,
) -> int:
    """Film of a line contact after Moes.

    The fit covers all four regimes.

    The central film of :func:`moes_line_film` for the component of entrainment across the line. The minimum is 0.866
    U^0.01 G^-0.02 W^-0.03 of it, the ratio of Dowson's 2.65 U^0.70 G^0.54 W^-0.13 (Dowson 1968) to Dowson and Toyoda's
    3.06 U^0.69 G^0.56 W^-0.10, at most 1.
    """
    across = u_mean * math.sqrt(cos2)
    speed = math.sqrt(across * across + par.speed * par.speed)
    force = math.sqrt(load * load + par.load * par.load)
    G = at_least(alpha_p * E_eff, 1e-3)
    central = moes_line_film(force / R_y, R_x, speed, eta0, G / E_eff, E_eff)
    U = eta0 * speed / (E_eff * R_x)
    W = force / (E_eff * R_x * R_y)
    minimum = central * at_most(2.65 / 3.06 * U**0.01 * G**-0.02 * W**-0.03, 1.0)
    out[0] = math.sqrt(central * central + par.central * par.central)
    out[1] = math.sqrt(minimum * minimum + par.minimum * par.minimum)
    return OK


@law(
    "film_thickness",
    "dowson-toyoda",
    Floors,
    role_api=3,
    reference="Dowson and Toyoda 1979, 5th Leeds-Lyon Symposium, 60; minimum: Dowson 1968, Proc. IMechE 182, 151",
    validity="line contacts, elastic-piezoviscous, fully flooded, isothermal",
    prepare=prepare_floors,
    contact="line",
)
def dowson_toyoda(
    u_mean: float,
    cos2: float,
    load: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    par: FilmFloors,
    out: FloatArray,
) -> int:
    """Film of a line contact after Dowson and Toyoda.

    h = 3.06 R U^0.69 G^0.56 W^-0.10, minimum 2.65 R U^0.70 G^0.54 W^-0.13.

    Dowson and Toyoda 1979 for the centre, Dowson 1968 for the minimum; U with the mean velocity across the line.
    """
    across = u_mean * math.sqrt(cos2)
    speed = math.sqrt(across * across + par.speed * par.speed)
    force = math.sqrt(load * load + par.load * par.load)
    G = at_least(alpha_p * E_eff, 1e-3)
    U = eta0 * speed / (E_eff * R_x)
    W = force / (E_eff * R_x * R_y)
    central = float(dowson_toyoda_film(force / R_y, R_x, speed, eta0, G / E_eff, E_eff))
    minimum = at_most(2.65 * R_x * U**0.70 * G**0.54 * W**-0.13, central)
    out[0] = math.sqrt(central * central + par.central * par.central)
    out[1] = math.sqrt(minimum * minimum + par.minimum * par.minimum)
    return OK


@law(
    "rolling_resistance",
    "biboulet-houpert-line",
    InletShear,
    role_api=3,
    reference="Biboulet and Houpert 2010, Proc. IMechE J 224, Part 1; heat: Aihara 1987, J. Tribol. 109, 471",
    validity="line contacts, fully flooded inlet, rigid-isoviscous to piezoviscous-elastic",
    contact="line",
)
def biboulet_houpert_line(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    beta: float,
    k_oil: float,
    par: InletShear,
    out: FloatArray,
) -> int:
    """Rolling resistance of a line after Biboulet and Houpert.

    Aihara's thermal factor applies.

    :func:`rolling_force` times the length, on each surface, in proportion to the speed near rest.
    """
    speed = regular_speed(u_mean, par.speed_floor)
    heat = thermal_factor(par.thermal_coefficient, speed, eta0, beta, k_oil)
    flooded, regime = rolling_regime(at_least(load, 0.0) / R_y, R_x, speed, eta0, E_eff)
    # no branch and the library's power: slices take the same way through the kernel, several at once
    out[0] = flooded * power(float(regime), -0.1) * R_y * heat * abs(u_mean) / speed
    return OK


@law(
    "rolling_resistance",
    "matsuyama-line",
    InletShear,
    role_api=3,
    reference="Matsuyama, as in Manjunath et al. 2023, Machines 11, 801, table 1; heat: "
    "Aihara 1987, J. Tribol. 109, 471",
    validity="fully flooded piezoviscous-elastic line contacts; original not seen",
    contact="line",
)
def matsuyama_line(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    beta: float,
    k_oil: float,
    par: InletShear,
    out: FloatArray,
) -> int:
    """Rolling resistance of a line after Matsuyama.

    Aihara's thermal factor applies.

    :func:`matsuyama_rolling_force` times the length, on each surface, in proportion to the speed near rest.
    """
    out[0] = 0.0
    if not (load <= 0.0 or alpha_p <= 0.0):  # NaN goes through
        speed = regular_speed(u_mean, par.speed_floor)
        heat = inlet_heat_rolling(speed, eta0, beta, k_oil, par.thermal_coefficient)
        force = matsuyama_rolling_force(load / R_y, R_x, speed, eta0, alpha_p, E_eff)
        out[0] = force * R_y * heat * abs(u_mean) / speed
    return OK


@law(
    "rolling_resistance",
    "zhou-hoeprich-line",
    InletShear,
    role_api=3,
    reference="Zhou and Hoeprich 1991, J. Tribol. 113, 590, eq. 17; heat: Aihara 1987, J. Tribol. 109, 471",
    validity="fully flooded piezoviscous-elastic line contacts; fitted from W 1e-4 to 3e-4, U 1e-11 to 1e-9",
    contact="line",
)
def zhou_hoeprich_line(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    beta: float,
    k_oil: float,
    par: InletShear,
    out: FloatArray,
) -> int:
    """Rolling resistance of a line after Zhou and Hoeprich.

    Aihara's thermal factor applies.

    :func:`zhou_hoeprich_rolling_force` times the length, on each surface, in proportion to the speed near rest.
    """
    out[0] = 0.0
    if not (load <= 0.0 or alpha_p <= 0.0):  # NaN goes through
        speed = regular_speed(u_mean, par.speed_floor)
        heat = inlet_heat_rolling(speed, eta0, beta, k_oil, par.thermal_coefficient)
        force = zhou_hoeprich_rolling_force(load / R_y, R_x, speed, eta0, alpha_p, E_eff)
        out[0] = force * R_y * heat * abs(u_mean) / speed
    return OK


@law(
    "rolling_resistance",
    "aihara-line",
    InletShear,
    role_api=3,
    reference="Aihara 1987, J. Tribol. 109, 471, section 2.4; heat: Aihara 1987, J. Tribol. 109, 471",
    validity="tapered roller bearings; constants second-hand",
    contact="line",
)
def aihara_line(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    beta: float,
    k_oil: float,
    par: InletShear,
    out: FloatArray,
) -> int:
    """Rolling resistance of a line after Aihara.

    Aihara's thermal factor applies.

    :func:`aihara_rolling_force` times the length, on each surface, in proportion to the speed near rest.
    """
    out[0] = 0.0
    if not (load <= 0.0 or alpha_p <= 0.0):  # NaN goes through
        speed = regular_speed(u_mean, par.speed_floor)
        heat = inlet_heat_rolling(speed, eta0, beta, k_oil, par.thermal_coefficient)
        force = aihara_rolling_force(load / R_y, R_x, speed, eta0, alpha_p, E_eff)
        out[0] = force * R_y * heat * abs(u_mean) / speed
    return OK


@law(
    "elastic_hysteresis",
    "johnson-line",
    LossFactor,
    role_api=3,
    reference="Johnson, Contact Mechanics (1985), section 9.2",
    validity="line contacts, small losses; alpha_h of bearing steel is known within a factor of a few only",
    contact="line",
)
def johnson_line(
    load: float, semi_a: float, semi_b: float, R_x: float, R_y: float, R_ball: float, par: LossFactor, out: FloatArray
) -> int:
    """Hysteresis couple of a line contact.

    It is M = (2/(3 pi)) alpha_h Q b.

    The elastic work on the front half of the contact, of which the share alpha_h is lost: Johnson, Contact Mechanics
    (1985), section 9.2.
    """
    out[0] = 2.0 / (3.0 * math.pi) * par.loss_factor * at_least(load, 0.0) * semi_b
    return OK


class SqueezedLine(NamedTuple):
    """Onset of the cubic damping and film of a cylinder."""

    d_max: float  # [N s/m]
    delta_max: float  # [m]
    reach: float  # gap from which the film is squeezed [m]; the solver looks at the contact from there on
    touch: float  # film at first touch [m]


def prepare_line_film(parameters: SqueezeFilm, context: Context) -> SqueezedLine:
    """Return the damping's onset and the film's dimensions.

    The onset is that of the cubic damping; the film has a reach and a thickness.

    Film of smooth surfaces (Dowson and Toyoda) and roughness keep the bodies apart together, by the root of the sum of
    their squares. Without a coefficient the full damping is the time constant times the line's stiffness at the mean
    load, 10/9 Q/delta of ISO 16281.
    """
    oil, length, load = context.oil, context.radius_y, max(context.mean_load, 1.0)
    full = parameters.coefficient
    if full is None:
        approach = (load / (_ONE_RACEWAY * context.e_eff / _STEEL * length ** (8.0 / 9.0))) ** 0.9
        full = parameters.time_constant * 10.0 / 9.0 * load / approach
    onset: Onset = prepare_cubic(parameters.model_copy(update={"coefficient": full}), context)
    speed = max(0.25 * context.speed * context.pitch_diameter, 1e-3)
    film = dowson_toyoda_film(load / length, context.radius_x, speed, oil.viscosity, oil.alpha_p, context.e_eff)
    return SqueezedLine(*onset, parameters.layer, math.hypot(film, parameters.thinnest_film))


@law(
    "damping",
    "squeeze-line",
    SqueezeFilm,
    role_api=3,
    reference="Teutsch 2005 (thesis, TU Kaiserslautern); Reynolds' equation of a cylinder",
    validity="line contacts, lightly loaded: pressures that thicken the oil leave the cubic damping alone",
    prepare=prepare_line_film,
    contact="line",
)
def squeeze_line(
    delta: float,
    delta_dot: float,
    load: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    eta0: float,
    alpha_p: float,
    par: SqueezedLine,
    out: FloatArray,
) -> int:
    """Cubic damping with the squeeze film of a roller.

    Damping after Teutsch; the roller squeezes the film before it touches.

    Between a cylinder and a plane, gap = h + x^2/(2 R), Reynolds' equation for an approach at v has the solution
    p = 6 eta v R/gap^2, F/L = 3 sqrt(2) pi eta v (R/h)^(3/2), less that of the gap H at which the oil ends. At first
    touch film of the mean load and roughness are left; under load exp(-alpha p_max) is left. A film does not pull.
    """
    s = at_most(at_least(delta / par.delta_max, 0.0), 1.0)
    film = par.touch + at_least(-delta, 0.0)
    room = par.touch + par.reach
    squeezed = 3.0 * math.sqrt(2.0) * math.pi * eta0 * R_y * R_x**1.5 * at_least(film**-1.5 - room**-1.5, 0.0)
    if load > 0.0 and semi_b > 0.0:
        squeezed *= math.exp(-at_most(alpha_p * 2.0 * load / (math.pi * semi_b * R_y), 700.0))
    out[0] = at_least((par.d_max * s * s * (3.0 - 2.0 * s) + squeezed) * delta_dot, -load)
    return OK


def _around_a_flat(h: float, b: float, R: float) -> float:
    """Return the integral of :func:`line_gap` over one side [-]."""
    if b >= R:
        return 0.0
    end = math.acosh(R / b)
    rise = b * b / (2.0 * R)
    total = 0.0  # the integrand vanishes at the edge
    for i in range(1, _GAP_STEPS + 1):
        s = i / _GAP_STEPS
        w = end * s * s
        grown = math.exp(w)
        across = 0.5 * (grown - 1.0 / grown)
        along = 0.5 * (grown + 1.0 / grown)
        weight = 1.0 if i == _GAP_STEPS else 4.0 if i % 2 == 1 else 2.0
        total += weight * 2.0 * end * s * b * across / (h + rise * (across * along - w))
    return total / (3.0 * _GAP_STEPS)


@law(
    "capacitance",
    "line-gap",
    role_api=3,
    reference="gap: Johnson, Contact Mechanics (1985), section 4.2(c); plates: Derjaguin 1934, Kolloid-Z. 69, 155",
    validity="line contacts whose surroundings are filled with oil; without fringes and constriction of the film",
    contact="line",
)
def line_gap(
    C_hertz: float,
    h: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    U: float,
    G: float,
    W: float,
    eps_r0: float,
    par: NoParameters,
    out: FloatArray,
) -> int:
    """Capacitance of a line contact and its gaps.

    The gaps on both sides count to where x is a radius R.

    C = C_Hertz + 2 eps L int_b^R dx/g. Outside the half-width b Hertz's surfaces stand apart by
    g = h + b^2/(2 R) [xi sqrt(xi^2 - 1) - arcosh xi], xi = x/b (Johnson 1985, section 4.2(c)). Simpson's rule takes the
    integral over s, xi = cosh(W s^2), to 4e-5. Where b^2 is below 1e-6 R h the gap is h + x^2/(2 R), and the integral
    sqrt(2 R/h) [atan(R/c) - atan(b/c)], c = sqrt(2 R h).
    """
    gap = at_least(h, 1e-10)
    if semi_b * semi_b < 1e-6 * R_x * gap:
        root = math.sqrt(2.0 * R_x * gap)
        sides = 2.0 * R_x / root * (math.atan(R_x / root) - math.atan(semi_b / root))
    else:
        sides = _around_a_flat(gap, semi_b, R_x)
    out[0] = C_hertz + 2.0 * VACUUM_PERMITTIVITY * eps_r0 * R_y * sides
    return OK
