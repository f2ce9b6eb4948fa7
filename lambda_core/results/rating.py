"""Add ratings of standards and catalogues to a result."""

from __future__ import annotations

from pydantic import Field

from lambda_core.results.record import Record
from lambda_core.results.verdict import Limits


class Rating(Record):
    """Life, safety and catalogue friction of a case at its start; null where a method does not answer."""

    basic_life_h: float | None = Field(description="L_10h of ISO 281, from the catalogue's C and the equivalent load")
    reference_life_h: float | None = Field(description="L_10rh of ISO/TS 16281, from the load of every ball")
    modified_life_h: float | None = Field(description="L_nmh = a_ISO L_10h of ISO 281", default=None)
    modified_reference_life_h: float | None = Field(description="L_nmrh of ISO/TS 16281", default=None)
    life_factor: float | None = Field(description="a_ISO of ISO 281", default=None)
    contamination: float | None = Field(description="e_C that a_ISO was computed with", default=None)
    contamination_given: bool = Field(
        description="whether the case gives e_C; otherwise it is the lower end of normal cleanliness", default=False
    )
    equivalent_load_N: float | None = Field(description="P of ISO 281")
    static_safety: float | None = Field(description="C_0/P_0 of ISO 76")
    viscosity_ratio: float | None = Field(description="kappa = nu/nu_1 of ISO 281")
    skf_torque_Nmm: float | None = Field(description="friction torque after SKF's catalogue")
    schaeffler_torque_Nmm: float | None = Field(description="friction torque after Schaeffler's catalogue")
    limits: Limits | None = Field(description="what the bearing has to keep to", default=None)
    notes: list[str] = Field(description="why a method does not answer, one sentence each")
