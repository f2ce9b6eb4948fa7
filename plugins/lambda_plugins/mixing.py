"""Combine shear stresses of film and asperities in mixed contacts."""

from __future__ import annotations

import math
from typing import Annotated

from lambda_core.plugins import OK, FloatArray, NoParameters, Parameters, Quantity, law, parameter
from lambda_plugins.shapes import at_most


@law(
    "mixing",
    "load-share",
    NoParameters,
    role_api=3,
    reference="Spikes and Olver 2003, Lubr. Sci. 16(1), 3: mu = mu_film + (mu_bl - mu_film) psi",
    validity="psi the share of friction or of load",
)
def load_share(
    psi: float, Lambda: float, load: float, p_max: float, semi_a: float, semi_b: float, par: NoParameters,
    out: FloatArray,
) -> int:  # fmt: skip
    """Film and asperities by their shares of the load.

    tau = (1 - psi) tau_film + psi mu p.
    """
    out[0] = 1.0 - psi
    out[1] = psi
    return OK


class Hardness(Parameters):
    """Hardness of the softer surface."""

    hardness: Annotated[float, Quantity("pressure")] = parameter(
        "7 GPa", "indentation hardness of the softer surface", source="ISO 18265, table A.1: 61 HRC is 720 HV", gt=0.0
    )


@law(
    "mixing",
    "contact-area",
    Hardness,
    role_api=3,
    reference="Gelinck and Schipper 2000, Tribol. Int. 33, 175; real area: Bowden and Tabor 1939, Proc. R. Soc. A 169, "
    "391",
    validity="psi the share of the load (zhou-hoeprich), not of friction (spikes-olver); asperities yield",
)
def contact_area(
    psi: float, Lambda: float, load: float, p_max: float, semi_a: float, semi_b: float, par: Hardness, out: FloatArray
) -> int:
    """Film and asperities by their shares of the area.

    tau = (1 - A_r/A) tau_film + psi mu p, A_r = psi F/H.

    Asperities that carry the load psi F under their yield pressure H touch on the real area psi F/H alone (Bowden and
    Tabor); the film is sheared everywhere else, so that friction is the sum of both integrals, each over its own area
    (Gelinck and Schipper).
    """
    nominal = math.pi * semi_a * semi_b
    out[0] = 1.0 - at_most(psi * load / (par.hardness * nominal), 1.0)
    out[1] = psi
    return OK
