"""Define hysteresis losses of rolling in the solids.

An equal and opposite couple acts on both bodies.
"""

from __future__ import annotations

from lambda_core.plugins import OK, FloatArray, NoParameters, Parameters, law, parameter
from lambda_plugins.shapes import at_least


class LossFactor(Parameters):
    """Parameter of the classical loss factor."""

    loss_factor: float = parameter(
        0.03,
        "share of the elastic work that is lost, alpha_h",
        source="without bias against M_rr of SKF's catalogue model on ten bearings (0.024 to 0.033 by groove): about "
        "three times the 0.01 of a simple cycle in hard steel, as in rolling (Greenwood, Minshall and Tabor 1961, not "
        "seen); Houpert's law corresponds to 0.047 inner and 0.033 outer",
        status="assumed",
        published_range=(0.02, 0.047),
        ge=0.0,
        le=0.2,
    )


@law(
    "elastic_hysteresis",
    "loss-factor",
    LossFactor,
    role_api=3,
    reference="Johnson, Contact Mechanics (1985), section 9.2; Greenwood, Minshall and Tabor 1961",
    validity="small losses; alpha_h of bearing steel is known within a factor of a few only",
)
def loss_factor(
    load: float, semi_a: float, semi_b: float, R_x: float, R_y: float, R_ball: float, par: LossFactor, out: FloatArray
) -> int:
    """Hysteresis couple of an elliptical contact.

    It is M = (3/16) alpha_h Q b.

    Greenwood, Minshall and Tabor 1961, Proc. R. Soc. A 259, 480; Johnson, Contact Mechanics (1985), section 9.2: the
    elastic work on the front half of the contact, of which the share alpha_h is lost; b is the semi-axis along rolling.
    """
    out[0] = 3.0 / 16.0 * par.loss_factor * load * semi_b
    return OK


@law(
    "elastic_hysteresis",
    "houpert",
    role_api=3,
    reference="Houpert 2002, Tribol. Int. 35 (as commonly quoted)",
    validity="steel on steel; not confirmed from its original",
)
def houpert(
    load: float, semi_a: float, semi_b: float, R_x: float, R_y: float, R_ball: float, par: NoParameters, out: FloatArray
) -> int:
    """Elastic rolling couple of steel ball contacts, after Houpert.

    M = 7.4826e-7 R_ball^0.33 Q^1.33 [1 - 3.519e-3 (k - 1)^0.8063], k = R_y/R_x, SI: Houpert 2002, Tribol. Int. 35 (as
    commonly quoted; original not seen). A fit to steel; it may contain slip that the contacts already carry.
    """
    shape = 1.0 - 3.519e-3 * at_least(R_y / R_x - 1.0, 0.0) ** 0.8063
    out[0] = 7.4826e-7 * R_ball**0.33 * at_least(load, 0.0) ** 1.33 * at_least(shape, 0.0)
    return OK


class Scheuermann(Parameters):
    """Constants of Scheuermann's rolling moment.

    They are not published, so there is no default.
    """

    coefficient: float = parameter(
        ...,
        "c_r in M = c_r (Q / 1 N)^e_r [N m]",
        source="to be identified; Wingertszahn et al. 2023, Lubricants 11, 369, eq. 19 prints no value",
        status="assumed",
        ge=0.0,
    )
    exponent: float = parameter(
        ...,
        "e_r in M = c_r (Q / 1 N)^e_r [-]",
        source="to be identified; Wingertszahn et al. 2023, Lubricants 11, 369, eq. 19 prints no value",
        status="assumed",
        gt=0.0,
        le=3.0,
    )


@law(
    "elastic_hysteresis",
    "scheuermann",
    Scheuermann,
    role_api=3,
    reference="Wingertszahn et al. 2023, Lubricants 11, 369, eq. 19",
    validity="constants must be identified by the user",
)
def scheuermann(
    load: float, semi_a: float, semi_b: float, R_x: float, R_y: float, R_ball: float, par: Scheuermann, out: FloatArray
) -> int:
    """Rolling moment of the solids after Scheuermann.

    It is a power of the load: M = c_r Q^e_r.

    Wingertszahn et al. 2023, Lubricants 11, 369, eq. 19; c_r and e_r must be given.
    """
    out[0] = par.coefficient * at_least(load, 0.0) ** par.exponent
    return OK


@law("elastic_hysteresis", "none", role_api=3, reference="-", contact="any")
def none(
    load: float, semi_a: float, semi_b: float, R_x: float, R_y: float, R_ball: float, par: NoParameters, out: FloatArray
) -> int:
    """No losses in the solids."""
    out[0] = 0.0
    return OK
