"""Add ratings of standards and catalogues to a result."""

from __future__ import annotations

from pydantic import Field

from lambda_core.results.quantity import FLOATING, quantity
from lambda_core.results.record import Record
from lambda_core.results.verdict import Found, Limits, Verdict, verdict


class Rating(Record):
    """Life, safety and catalogue friction of a case.

    They hold at the start of the case; a value is null where a method does not answer.
    """

    basic_life_h: float | None = quantity(
        "L_10h of ISO 281, from the catalogue's C and the equivalent load", "h",
        label="basic rating life L_10h of ISO 281", column="L_10h", group="life", default=None,
    )  # fmt: skip
    reference_life_h: float | None = quantity(
        "L_10rh of ISO/TS 16281, from the load of every ball", "h",
        label="reference rating life L_10rh of ISO/TS 16281", column="L_10rh", group="life", default=None,
    )  # fmt: skip
    modified_life_h: float | None = quantity(
        "L_nmh = a_ISO L_10h of ISO 281", "h", label="modified rating life L_nmh of ISO 281", column="L_nmh",
        group="life",
        default=None,
    )  # fmt: skip
    modified_reference_life_h: float | None = quantity(
        "L_nmrh of ISO/TS 16281",
        "h",
        label="modified reference rating life L_nmrh",
        column="L_nmrh",
        group="life",
        default=None,
    )
    life_factor: float | None = Field(description="a_ISO of ISO 281", default=None)
    contamination: float | None = Field(description="e_C that a_ISO was computed with", default=None)
    contamination_given: bool = Field(
        description="whether the case gives e_C; otherwise it is the lower end of normal cleanliness", default=False
    )
    equivalent_load_N: float | None = quantity(
        "P of ISO 281", "N", label="equivalent load P of ISO 281", decimals=FLOATING, digits=4, group="load",
        default=None,
    )  # fmt: skip
    static_safety: float | None = quantity(
        "C_0/P_0 of ISO 76", label="static safety", column="static safety C0/P0", group="life", default=None
    )
    viscosity_ratio: float | None = quantity(
        "kappa = nu/nu_1 of ISO 281", label="viscosity ratio kappa", column="viscosity ratio kappa", group="life",
        default=None,
    )  # fmt: skip
    skf_torque_Nmm: float | None = quantity(
        "friction torque after SKF's catalogue", "N mm", label="friction torque, SKF's catalogue", column="  SKF",
        decimals=0, digits=4, group="catalogue", default=None,
    )  # fmt: skip
    schaeffler_torque_Nmm: float | None = quantity(
        "friction torque after Schaeffler's catalogue", "N mm", label="friction torque, Schaeffler's catalogue",
        column="  Schaeffler", decimals=0, digits=4, group="catalogue", default=None,
    )  # fmt: skip
    skf_torque_without_step_Nmm: float | None = Field(
        description="friction torque after SKF's catalogue without its step where an axial load begins; null without "
        "an axial load",
        default=None,
    )
    limits: Limits | None = Field(description="what the bearing has to keep to", default=None)
    notes: list[str] = Field(description="why a method does not answer, one sentence each", default=[])


def life_that_counts(rating: Rating) -> tuple[str, float | None]:
    """Return the decisive rating life.

    Return its name and its hours; a requirement is compared with them.

    The loads of every ball count where they are known (ISO/TS 16281), a_ISO where the case gives e_C.
    """
    lives = [("L_10rh", rating.reference_life_h), ("L_10h", rating.basic_life_h)]
    if rating.contamination_given:
        lives = [("L_nmrh", rating.modified_reference_life_h), ("L_nmh", rating.modified_life_h), *lives]
    return next(((name, life) for name, life in lives if life is not None), ("L_10rh", None))


def rated_verdict(rating: Rating | None, pressure: float | None, film: list[float], tilt: float) -> Verdict | None:
    """Judge a solution whose lives are known; None without them.

    Parameters
    ----------
    pressure : float or None
        Largest Hertzian pressure [GPa].
    film : list of float
        Smallest and largest Lambda; empty without a film.
    tilt : float
        Between the axes of the rings [mrad].
    """
    if rating is None or rating.limits is None:
        return None
    name, life = life_that_counts(rating)
    found = Found(
        pressure, film[0] if film else None, tilt, rating.equivalent_load_N, rating.static_safety,
        rating.viscosity_ratio, life, name,
    )  # fmt: skip
    return verdict(rating.limits, found)
