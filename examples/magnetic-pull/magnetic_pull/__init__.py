"""Define the magnetic pull on an eccentric rotor.

It grows with the eccentricity.
"""

import math
from typing import Annotated, NamedTuple

from lambda_core.plugins import OK, Context, Parameters, Quantity, law, parameter

VACUUM = 4e-7 * math.pi  # permeability [V s/(A m)]
Length = Annotated[float, Quantity("length")]


class Machine(Parameters):
    rotor_radius: Length = parameter("60 mm", "radius of the rotor", status="assumed", gt=0.0)
    core_length: Length = parameter("100 mm", "length of the rotor's core", status="assumed", gt=0.0)
    air_gap: Length = parameter("0.6 mm", "air gap", status="assumed", gt=0.0)
    flux_density: float = parameter(0.8, "amplitude of the flux density in the air gap [T]", status="assumed", gt=0.0)


class Pull(NamedTuple):
    slope: float  # force over eccentricity [N/m]


def prepare(parameters: Machine, context: Context) -> Pull:
    area = math.pi * parameters.rotor_radius * parameters.core_length
    return Pull(area * parameters.flux_density**2 / (2.0 * VACUUM * parameters.air_gap))


@law(
    "force_element",
    "magnetic-pull",
    Machine,
    role_api=3,
    reference="Maxwell stress B^2/(2 mu_0) of a field B cos(p phi), p > 1, over a gap g - e cos(phi), to first order",
    validity="eccentricity far below the air gap; no saturation, no damping by currents in the rotor",
    prepare=prepare,
)
def magnetic_pull(t, place, tilt, v_rel, omega_rel, par, out):
    """Radial magnetic force along the eccentricity.

    F = pi R L B^2 e/(2 mu_0 g).
    """
    for i in range(6):
        out[i] = 0.0
    out[1] = par.slope * place[1]
    out[2] = par.slope * place[2]
    return OK
