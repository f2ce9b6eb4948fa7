"""Damping of the ball-raceway contact along its normal."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np

from lambda_core.plugins import Context, NoParameters, Quantity, model
from lambda_plugins.fields import FloatArray, Parameters, parameter
from lambda_plugins.normal_contact import stiffness
from lambda_plugins.shapes import at_least, at_most


class CubicDamping(Parameters):
    """Parameters of Teutsch's cubic damping."""

    time_constant: Annotated[float, Quantity("time")] = parameter(
        "10 us",
        "full damping over the contact stiffness dQ/d(delta) at the mean load",
        source="assumption; the paper prints no value",
        status="assumed",
        ge=0.0,
    )
    full_penetration: Annotated[float, Quantity("small_length")] = parameter(
        "2 um", "penetration delta_max from which damping is full", source="assumption", status="assumed", gt=0.0
    )
    coefficient: Annotated[float, Quantity("damping")] | None = parameter(
        None, "full damping d_max itself; replaces time_constant", source="measured values", status="assumed"
    )


def prepare_cubic(parameters: CubicDamping, context: Context) -> FloatArray:
    """Return [d_max, delta_max]; d_max from the contact stiffness at the mean load unless given."""
    full = parameters.coefficient
    if full is None:
        load = max(context.mean_load, 1.0)
        full = parameters.time_constant * stiffness(load, context.radius_x, context.radius_y, context.e_eff)
    if not math.isfinite(full) or full < 0.0:
        raise ValueError(f"damping coefficient {full:g} N s/m is not a finite number >= 0")
    return np.array([full, parameters.full_penetration])


def cubic(delta: float, delta_dot: float, load: float, par: FloatArray, out: FloatArray) -> int:
    """Damping that grows from zero at first touch, after Teutsch.

    F_D = d(delta) delta_dot with d = d_max s^2 (3 - 2 s), s = delta/delta_max, d = 0 below s = 0 and d_max above
    s = 1: Syla et al. 2026, eq. 12-13. Continuous at first touch; a contact never pulls, F_N + F_D >= 0.
    """
    s = at_most(at_least(delta / par[1], 0.0), 1.0)
    out[0] = at_least(par[0] * s * s * (3.0 - 2.0 * s) * delta_dot, -load)
    return 1


def none(delta: float, delta_dot: float, load: float, par: FloatArray, out: FloatArray) -> int:
    """No damping."""
    out[0] = 0.0
    return 1


CUBIC = model(
    "damping",
    "cubic",
    cubic,
    CubicDamping,
    reference="Teutsch 2005 (thesis, TU Kaiserslautern); Syla et al. 2026, Lubricants 14, 154, eq. 12-13",
    validity="parametric: both constants are to be identified; defaults are assumptions",
    prepare=prepare_cubic,
)

NONE = model("damping", "none", none, NoParameters, reference="-")
