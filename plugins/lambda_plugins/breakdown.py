"""Define the breakdown voltage of a lubricating film.

Statistics of roughness decide over the onset of discharges (Jackson, Saha and Janik 2025, J. Tribol. 147, 051103; not
read in the original): mean films of half a micrometre break down at a few volts, where oil stands 15 V/um and more.
"""

from __future__ import annotations

import math
from typing import Annotated

from lambda_core.plugins import OK, FloatArray, Parameters, Quantity, law, parameter
from lambda_plugins.normal_tail import upper_quantile
from lambda_plugins.shapes import at_least, at_most

_STRENGTH = (
    "Busse et al. 1997, IEEE Trans. Ind. Appl. 33, 567, second-hand: 15 V/um slow, 30 V/um and more at fast edges"
)
_ONSET = "Jackson, Saha and Janik 2025, J. Tribol. 147, 051103"


class Field(Parameters):
    """Field that breaks the oil down."""

    strength: Annotated[float, Quantity("field_strength")] = parameter(
        "30 V/um",
        "E_b, field that breaks the oil down",
        source=_STRENGTH,
        status="unconfirmed",
        published_range=("15 V/um", "30 V/um"),
        gt=0.0,
    )


@law(
    "breakdown",
    "field",
    Field,
    role_api=3,
    reference=_STRENGTH,
    validity="smooth surfaces; measured first breakdowns of rough ones are an order below it",
)
def field(
    h: float, h_min: float, sigma: float, area: float, u_1: float, u_2: float, par: Field, out: FloatArray
) -> int:
    """Smooth film that breaks down at its thinnest place.

    The field there is V/h_min, so V = E_b h_min.
    """
    out[0] = par.strength * h_min
    return OK


class Rough(Field):
    """Field of breakdown and the range of roughness."""

    correlation_length: Annotated[float, Quantity("small_length")] = parameter(
        "10 um", "l_c, distance at which heights are independent", source="order of size", status="assumed", gt=0.0
    )


def lowest_spot(sigma: float, area: float, length: float, u: float) -> float:
    """Return the depth of the lowest roughness spot [m].

    N = A/l_c^2 independent Gaussian spots; the depth counts from the mean gap.

    P(no spot lower than z sigma) = Phi(z)^N = u, so 1 - Phi(z) = 1 - u^(1/N) (weakest link).
    """
    spots = at_least(area / (length * length), 1.0)
    return sigma * upper_quantile(-math.expm1(math.log(u) / spots))


@law(
    "breakdown",
    "statistical",
    Rough,
    role_api=3,
    reference=_ONSET,
    validity="Gaussian heights that do not touch: film above roughness; one draw per patch of surface",
)
def statistical(
    h: float, h_min: float, sigma: float, area: float, u_1: float, u_2: float, par: Rough, out: FloatArray
) -> int:
    """Rough film that breaks down at its lowest spot.

    It follows P(no breakdown | V) = Phi((h - V/E_b)/sigma)^N, N = A/l_c^2.

    h is the mean film, sigma the composite rms roughness. The exact form of the cited statistics was not read.
    """
    out[0] = at_least(par.strength * (h - lowest_spot(sigma, area, par.correlation_length, u_1)), 0.0)
    return OK


class Particles(Rough):
    """Conducting particles in the oil."""

    particle_size: Annotated[float, Quantity("small_length")] = parameter(
        "0.3 um", "d, of conducting particles", source="to be measured", status="assumed", gt=0.0
    )
    particle_density: Annotated[float, Quantity("number_density")] = parameter(
        "1000 1/mm3", "n, conducting particles in the oil", source="to be measured", status="assumed", ge=0.0
    )


@law(
    "breakdown",
    "particles",
    Particles,
    role_api=3,
    reference=f"{_ONSET}; Poisson statistics of particles",
    validity="as statistical; particles of one size, independent of each other",
)
def particles(
    h: float, h_min: float, sigma: float, area: float, u_1: float, u_2: float, par: Particles, out: FloatArray
) -> int:
    """Rough film with conducting particles.

    With probability 1 - exp(-n A h) a particle of size d leaves E_b (h - d).
    """
    gap = h - lowest_spot(sigma, area, par.correlation_length, u_1)
    if u_2 < -math.expm1(-par.particle_density * area * h):
        gap = at_most(gap, h - par.particle_size)
    out[0] = at_least(par.strength * gap, 0.0)
    return OK
