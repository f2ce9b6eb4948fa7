"""Check the largest shear stress of traction laws.

A law without a limit leaves a bearing without equilibrium.
"""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.laws.law import Law
from lambda_core.laws.par import flat_kernel

# Measured limits of oils are 0.03 to 0.12 of the pressure (Johnson and Tevaarwerk 1977, Proc. R. Soc. A 356, 215; Bair
# and Winer 1979, J. Lubr. Technol. 101, 251): what exceeds this is no oil.
SHEAR_LIMIT = 0.3
_PRESSURE, _TEMPERATURE, _FILM, _LN_VISCOSITY = 1.5e9, 333.15, 0.5e-6, 15.0  # Pa, K, m, ln(Pa s): mineral oil, loaded


def stress_ratio(law: Law, par: FloatArray) -> float:
    """Return the largest shear stress over pressure.

    The contact is loaded and slips at 1 mm/s to 10 m/s; the result is 0 where the law refuses.

    Pressure 1.5 GPa, ln(eta) 15 (3 kPa s), film 0.5 um: usual contacts of loaded ball bearings.
    """
    slip = np.logspace(-3.0, 1.0, 41)
    pressure, temperature = np.full(slip.size, _PRESSURE), np.full(slip.size, _TEMPERATURE)
    stress = np.zeros(slip.size)
    status = flat_kernel(law)(
        slip, pressure, temperature, np.full(slip.size, _LN_VISCOSITY), np.full(slip.size, _FILM), par, stress
    )
    return float(np.abs(stress).max()) / _PRESSURE if status == 1 and np.all(np.isfinite(stress)) else 0.0


def limitless_sentence(ratio: float) -> str:
    """Report a law without a stress limit.

    Its shear stress is so many times the pressure; the text has a remedy.
    """
    return (
        f"gives shear stresses of up to {ratio:.3g} times the pressure, oils 0.03 to 0.12: hold them at a limiting "
        "stress, as tau = newtonian limit/(newtonian + limit) does, limit = 0.07 p"
    )
