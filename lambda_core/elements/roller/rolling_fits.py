"""Compute rolling resistance of line contacts by published power laws.

Scalars or arrays; fits to solved elastic-piezoviscous contacts or to tests, fully flooded and isothermal.

U = eta u/(E' R) with the mean u of the surface speeds, G = alpha E', W = w/(E' R). Every force is the one on each
surface, per length [N/m].
"""

from __future__ import annotations

from lambda_core.domain.arrays import FloatArray


def matsuyama_rolling_force(
    line_load: FloatArray | float,
    radius: FloatArray | float,
    speed: FloatArray | float,
    viscosity: float,
    pressure_viscosity: float,
    e_eff: float,
) -> FloatArray:
    """Return Matsuyama's rolling resistance per length [N/m].

    F/l = 7.1 E' R U^0.75 G^-0.04 W^0.08, half of the moment 14.2 E' l R^2 U^0.75 G^-0.04 W^0.08 over R: Manjunath,
    Fauconnier, Ost and De Baets 2023, Machines 11, 801, table 1 (the original not seen): a fit to solved EHL contacts,
    which they find nearest to the measured torque of tapered roller bearings in FVA3A.

    Parameters
    ----------
    line_load : array or float
        Load per length w [N/m].
    radius : array or float
        Reduced radius R [m].
    speed : array or float
        Mean u of the surface speeds [m/s], above zero.
    viscosity, pressure_viscosity : float
        eta [Pa s] and alpha [1/Pa] at the inlet.
    e_eff : float
        E' [Pa].
    """
    stiffness = e_eff * radius
    U, W = viscosity * speed / stiffness, line_load / stiffness
    force: FloatArray = 7.1 * stiffness * U**0.75 * (pressure_viscosity * e_eff) ** -0.04 * W**0.08
    return force


def zhou_hoeprich_rolling_force(
    line_load: FloatArray | float,
    radius: FloatArray | float,
    speed: FloatArray | float,
    viscosity: float,
    pressure_viscosity: float,
    e_eff: float,
) -> FloatArray:
    """Return Zhou and Hoeprich's rolling resistance [N/m].

    F/l = 29.2 (R/alpha) (G U)^0.648 W^0.246: Zhou and Hoeprich 1991, J. Tribol. 113, 590, eq. 17, a fit to their
    solutions of isothermal line contacts (table 1; W 1e-4 to 3e-4, U 1e-11 to 1e-9), in the form of Goksem and
    Hargreaves.

    Parameters
    ----------
    line_load : array or float
        Load per length w [N/m].
    radius : array or float
        Reduced radius R [m].
    speed : array or float
        Mean u of the surface speeds [m/s], above zero.
    viscosity, pressure_viscosity : float
        eta [Pa s] and alpha [1/Pa] at the inlet.
    e_eff : float
        E' [Pa].
    """
    stiffness = e_eff * radius
    flow, W = pressure_viscosity * viscosity * speed / radius, line_load / stiffness
    force: FloatArray = 29.2 * radius / pressure_viscosity * flow**0.648 * W**0.246
    return force


def aihara_rolling_force(
    line_load: FloatArray | float,
    radius: FloatArray | float,
    speed: FloatArray | float,
    viscosity: float,
    pressure_viscosity: float,
    e_eff: float,
) -> FloatArray:
    """Return Aihara's rolling resistance per length [N/m].

    F/l = 88 (R/alpha) (G U)^0.658 W^0.31, half of his moment 176 R^2 l/alpha (...) over R: Aihara 1987, J. Tribol. 109,
    471, section 2.4 as transcribed by others (the original not seen), for tapered roller bearings. His W takes the
    radius of the roller where R stands here. The load's exponent is from tests on two discs.

    Parameters
    ----------
    line_load : array or float
        Load per length w [N/m].
    radius : array or float
        Reduced radius R [m].
    speed : array or float
        Mean u of the surface speeds [m/s], above zero.
    viscosity, pressure_viscosity : float
        eta [Pa s] and alpha [1/Pa] at the inlet.
    e_eff : float
        E' [Pa].
    """
    stiffness = e_eff * radius
    flow, W = pressure_viscosity * viscosity * speed / radius, line_load / stiffness
    force: FloatArray = 88.0 * radius / pressure_viscosity * flow**0.658 * W**0.31
    return force
