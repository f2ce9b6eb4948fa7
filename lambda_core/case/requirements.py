"""Declare requirements on a bearing and data of modified lives."""

from __future__ import annotations

from typing import Any

from pydantic import field_validator

from lambda_core.case.option import Section, option
from lambda_core.domain.errors import unknown_name
from lambda_core.domain.units import Temperature, Time
from lambda_core.formulas.life import CONTAMINATION_LEVELS


class Life(Section):
    """Inputs of modified rating lives."""

    contamination: float | str | None = option(
        None,
        'contamination factor e_C, 0 to 1, or a level of ISO 281 such as "normal cleanliness", of which the lower '
        "e_C counts; absent: normal cleanliness is shown, and the verdict goes by lives without a_ISO",
        reference="ISO 281:2007, table 13",
    )

    @field_validator("contamination", mode="before")
    @classmethod
    def _is_read(cls, value: Any) -> Any:
        """Read a number that comes as text.

        It may come from the command line.
        """
        try:
            return value if isinstance(value, bool) else float(value)
        except (TypeError, ValueError):
            return value

    @field_validator("contamination")
    @classmethod
    def _is_known(cls, value: float | str | None) -> float | str | None:
        if isinstance(value, str) and value not in CONTAMINATION_LEVELS:
            raise ValueError(unknown_name("contamination level", value, CONTAMINATION_LEVELS))
        if isinstance(value, int | float) and not 0.0 <= value <= 1.0:
            raise ValueError("e_C must lie between 0 and 1")
        return value


class Requirements(Section):
    """Requirements for every bearing.

    They hold for the case of one bearing or of a machine; absent values are not required.
    """

    life: Time | None = option(None, 'rating life that 90 % have to reach, such as "20000 h"', gt=0.0)
    static_safety: float | None = option(None, "least static safety C_0/P_0", gt=0.0, reference="ISO 76")
    viscosity_ratio: float | None = option(None, "least viscosity ratio kappa", gt=0.0, reference="ISO 281")
    film_parameter: float | None = option(None, "least Lambda, central film over composite roughness", gt=0.0)
    temperature: Temperature | None = option(None, "highest temperature of the oil in the bearing")
