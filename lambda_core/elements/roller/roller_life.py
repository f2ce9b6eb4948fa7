"""Compute roller lives by ISO 281 and ISO 16281.

Lives are in million revolutions. The system exponent is 9/8 (Weibull slope of line contact), the load-life exponent of
a lamina 9/2, of a bearing 10/3 in ISO 281 and 4 between loads of the same distribution.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_ratings import REDUCTION_FACTOR, LaminaRatings
from lambda_core.formulas.life import RADIAL_ROLLER, life_modification_factor

LIFE_EXPONENT = 10.0 / 3.0
_LAMINA_EXPONENT = 4.5
_MOVING, _RESTING = 4.0, 4.5  # exponents of the mean on the ring that turns relative to the load, and on the other
_SYSTEM = 8.0 / 9.0


@dataclass(frozen=True)
class RollerLife:
    """Basic reference rating life of ISO 16281.

    It has its inputs, too.
    """

    life: float  # L_10r [1e6 revolutions]
    equivalent_load: float  # P_ref,r = C_r/L_10r^(3/10) [N]
    inner: FloatArray  # q_ei of every lamina [N], with the stress riser, (n,)
    outer: FloatArray  # q_ee of every lamina [N], (n,)
    damage: FloatArray  # (q_ei/q_ci)^(9/2) + (q_ee/q_ce)^(9/2) of every lamina, (n,)


def stress_riser(slices: int) -> FloatArray:
    """Return the stress riser of every lamina, (n,) (ISO 16281:2025).

    f_k = 1 - 0.01/ln(1.985 |(2k - n_s - 1)/(2 n_s - 2)|): 1.00 in the middle, 2.33 at the ends. The middle lamina of an
    odd number has the argument zero and f = 1.
    """
    k = np.arange(1, slices + 1)
    argument = 1.985 * np.abs((2.0 * k - slices - 1.0) / (2.0 * slices - 2.0))
    with np.errstate(divide="ignore"):
        found: FloatArray = 1.0 - 0.01 / np.log(argument)
    return found


def roller_basic_life(dynamic_rating: float, equivalent_load: float) -> float:
    """Return L_10 = (C/P)^(10/3) [1e6 revolutions] (ISO 281:2007, roller bearings)."""
    return float((dynamic_rating / equivalent_load) ** LIFE_EXPONENT) if equivalent_load > 0.0 else math.inf


def lamina_life(
    loads: FloatArray,
    ratings: LaminaRatings,
    dynamic_rating: float,
    *,
    inner_rotates: bool = True,
    riser: FloatArray | float | None = None,
) -> RollerLife:
    """Return the basic reference rating life.

    It follows from the loads of all laminae (ISO 16281:2025).

    L_10r = {sum_k [(q_ci/q_ei)^(-9/2) + (q_ce/q_ee)^(-9/2)]}^(-8/9), q_e the mean of f_k q_jk over the rollers, of the
    exponent 4 on the ring that turns relative to the load and 9/2 on the other.

    Parameters
    ----------
    loads : array
        Load of each lamina of each roller [N], (rollers, n).
    ratings : LaminaRatings
        q_ci and q_ce for n laminae.
    dynamic_rating : float
        C_r [N].
    inner_rotates : bool
        Whether the inner ring turns relative to the load.
    riser : array or float
        Stress riser f_k of each lamina; :func:`stress_riser` by default.
    """
    factor = stress_riser(loads.shape[-1]) if riser is None else np.broadcast_to(riser, loads.shape[-1:])
    raised = factor * loads
    on_inner, on_outer = (_MOVING, _RESTING) if inner_rotates else (_RESTING, _MOVING)
    inner, outer = _mean(raised, on_inner), _mean(raised, on_outer)
    damage = (inner / ratings.inner) ** _LAMINA_EXPONENT + (outer / ratings.outer) ** _LAMINA_EXPONENT
    total = float(damage.sum())
    life = total**-_SYSTEM if total > 0.0 else math.inf
    equivalent = dynamic_rating * total ** (_SYSTEM / LIFE_EXPONENT)
    return RollerLife(life, equivalent, inner, outer, damage)


def lamina_equivalent_loads(life: RollerLife, dynamic_rating: float) -> FloatArray:
    """Return the equivalent bearing load of every lamina [N], (n,).

    The radial load of a bearing, half of its raceway loaded, whose laminae would all fail as this one does:
    P_k = (C_r/lambda) (n_s X_k)^(2/9), X_k the damage of the lamina. It follows from the ratings of ISO 16281, whose
    own constant for it was not seen.
    """
    found: FloatArray = dynamic_rating / REDUCTION_FACTOR * (len(life.damage) * life.damage) ** (2.0 / 9.0)
    return found


def modified_lamina_life(
    life: RollerLife, dynamic_rating: float, viscosity_ratio: float, contamination: float, fatigue_limit: float
) -> float:
    """Return L_10mr [1e6 revolutions].

    It is the modified reference rating life (ISO 16281:2025).

    {sum_k a_ISO,k^(-9/8) X_k}^(-8/9): each lamina has the factor a_ISO of its own equivalent load
    (:func:`lamina_equivalent_loads`). Parameters as for
    :func:`lambda_core.formulas.life.life_modification_factor`.
    """
    loads = lamina_equivalent_loads(life, dynamic_rating)
    factors = np.array(
        [life_modification_factor(viscosity_ratio, contamination, fatigue_limit, load, RADIAL_ROLLER) for load in loads]
    )
    total = float((factors ** (-1.0 / _SYSTEM) * life.damage).sum())
    return float(total**-_SYSTEM) if total > 0.0 else math.inf


def _mean(loads: FloatArray, exponent: float) -> FloatArray:
    """Return the power mean over the rollers.

    It is computed relative to the largest value, so that zero stays zero without overflow.
    """
    top = loads.max(axis=0)
    scale = np.where(top > 0.0, top, 1.0)
    found: FloatArray = top * np.mean((loads / scale) ** exponent, axis=0) ** (1.0 / exponent)
    return found
