"""Define a traction law with a limiting shear stress.

Two oils have parameters for it.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

from lambda_core.plugins import OK, Parameters, Quantity, hookimpl, law, parameter


class LimitingShear(Parameters):
    """Limiting shear stress: tau_L = ambient + slope * p."""

    ambient: Annotated[float, Quantity("pressure")] = parameter(
        "2 MPa", "limiting shear stress at ambient pressure", gt=0.0
    )
    slope: float = parameter(0.065, "rise of the limiting shear stress with pressure", gt=0.0, le=0.3)


@law(
    "traction",
    "gecim-winer",
    LimitingShear,
    role_api=3,
    reference="Gecim and Winer 1980, J. Lubr. Technol. 102, 213: limiting shear stress effect on the film",
    validity="viscous shear of the film; limiting stress linear in pressure, the same at every temperature",
)
def gecim_winer(slip, p, T, ln_eta, h, par, tau):
    """Shear stress of a film with limit.

    tau = tau_L tanh(eta gamma_dot/tau_L), gamma_dot = v/h.
    """
    for i in range(tau.size):
        limit = par.ambient + par.slope * p[i]
        newtonian = math.exp(min(ln_eta[i], 60.0)) * slip[i] / max(h[i], 1e-10)
        tau[i] = limit * math.tanh(newtonian / limit)
    return OK


@hookimpl
def lambda_data(register):
    register(Path(__file__).parent / "rows")
