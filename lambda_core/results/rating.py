"""Add ratings of standards and catalogues to a result."""

from __future__ import annotations

from pydantic import Field

from lambda_core.results.record import Record


class Rating(Record):
    """Life, safety and catalogue friction of a case at its start; null where a method does not answer."""

    basic_life_h: float | None = Field(description="L_10h of ISO 281, from the catalogue's C and the equivalent load")
    reference_life_h: float | None = Field(description="L_10rh of ISO/TS 16281, from the load of every ball")
    equivalent_load_N: float | None = Field(description="P of ISO 281")
    static_safety: float | None = Field(description="C_0/P_0 of ISO 76")
    viscosity_ratio: float | None = Field(description="kappa = nu/nu_1 of ISO 281")
    skf_torque_Nmm: float | None = Field(description="friction torque after SKF's catalogue")
    schaeffler_torque_Nmm: float | None = Field(description="friction torque after Schaeffler's catalogue")
    notes: list[str] = Field(description="why a method does not answer, one sentence each")
