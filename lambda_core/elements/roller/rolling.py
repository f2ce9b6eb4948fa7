"""Compute hydrodynamic rolling resistance of line contacts."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray

# Half angle at which the oil of a half-flooded rigid cylinder tears, tan(psi) = x/sqrt(2 R h) = 0.475 (Swift and
# Stieber's condition; Dowson and Higginson 1966), and the integral of the shear over the film and the streamers behind.
_TEARS = math.atan(0.475)
FLOW_SHEAR = math.sqrt(2.0) * (
    0.5 * math.pi + _TEARS + (0.25 * math.pi - 0.5 * _TEARS - 0.25 * math.sin(2.0 * _TEARS)) / math.cos(_TEARS) ** 2
)


def flow_shear(radius: FloatArray | float, viscosity: float, film: FloatArray | float) -> FloatArray:
    """Return the flow's shear coefficient [Pa s].

    It is the shear force per length and slip of the oil around a line contact.

    3.49 eta sqrt(R/h): Couette flow between a cylinder and a plane of the gap h + x^2/(2 R), full up to where the oil
    tears and in streamers of its flow behind (Dowson and Higginson, Elasto-hydrodynamic Lubrication, 1966, ch. 3, whose
    number is 3.48). It goes with 4.58 eta u sqrt(R/h) of :func:`rolling_force` for rigid surfaces: a cylinder that
    nothing else drives turns with a fifth of the other surface's speed. Under load the flat's shear is thousands of
    times larger.

    Parameters
    ----------
    radius : array or float
        Reduced radius R [m].
    viscosity : float
        Of the inlet [Pa s].
    film : array or float
        Thickness h in the middle [m].
    """
    found: FloatArray = FLOW_SHEAR * viscosity * np.sqrt(np.asarray(radius) / film)
    return found


def rolling_force(
    line_load: FloatArray | float,
    radius: FloatArray | float,
    speed: FloatArray | float,
    viscosity: float,
    e_eff: float,
) -> FloatArray:
    """Return the rolling resistance per length on each surface [N/m].

    F/l = E' R 1.42 sqrt(U W)/[1 + (0.966 sqrt(M))^10]^0.1, U = 2 eta u/(E' R), W = w/(E' R), M = W/sqrt(U):
    Biboulet and Houpert 2010, Proc. IMechE J 224, 777, part 1, eq. 40-42. U holds the **sum** of the surface speeds,
    u the mean: with the mean in U the force would be 2^(3/4) = 1.68 times smaller under load. From rigid-isoviscous
    (F grows with sqrt(w); its start agrees with 4.58 eta u sqrt(R/h) on each surface, Dowson and Higginson 1966) to
    elastic-isoviscous and piezoviscous-elastic (F hardly depends on w); fully flooded and isothermal.

    Parameters
    ----------
    line_load : array or float
        Load per length w [N/m]; zero gives zero.
    radius : array or float
        Reduced radius R [m].
    speed : array or float
        Mean u of the surface speeds in the contact's frame [m/s], above zero.
    viscosity : float
        Dynamic viscosity of the inlet [Pa s].
    e_eff : float
        E' [Pa].
    """
    flooded, regime = rolling_regime(line_load, radius, speed, viscosity, e_eff)
    return flooded * regime**-0.1


def rolling_regime(
    line_load: FloatArray | float,
    radius: FloatArray | float,
    speed: FloatArray | float,
    viscosity: float,
    e_eff: float,
) -> tuple[FloatArray, FloatArray]:
    """Return both factors of :func:`rolling_force`.

    They are the force of rigid surfaces per length [N/m] and 1 + (0.966 sqrt(M))^10, whose power -0.1 multiplies it:
    compiled laws take that power for several slices at once (Biboulet and Houpert 2010, eq. 40-42).

    Parameters
    ----------
    line_load, radius, speed, viscosity, e_eff
        As for :func:`rolling_force`.
    """
    stiffness = e_eff * radius
    load = line_load / stiffness
    flow = 2.0 * viscosity * speed / stiffness
    regime = load / np.sqrt(flow)
    return stiffness * 1.42 * np.sqrt(flow * load), 1.0 + (0.966 * np.sqrt(regime)) ** 10


def rolling_torque(force: FloatArray, speed: float, ring_speed: float) -> float:
    """Return a bearing's torque of rolling resistance [N m].

    Each contact takes the power 2 F u: F on both surfaces, which move with u in the contact's frame.

    Parameters
    ----------
    force : array
        Rolling resistance of every contact on each surface [N], any shape.
    speed : float
        Mean surface speed u [m/s].
    ring_speed : float
        Speed of one ring against the other [rad/s].
    """
    return float(2.0 * np.sum(force) * speed / abs(ring_speed))
