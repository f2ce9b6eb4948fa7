"""Declaring a model's parameters: default, unit, published range and source in one line each."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

FloatArray = NDArray[np.float64]
Bound = float | str


class Parameters(BaseModel):
    """Base of every built-in model's parameters: no unknown fields."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def parameter(
    default: Any,
    description: str,
    *,
    source: str = "",
    status: Literal["published", "unconfirmed", "assumed", "numerical", "lubricant"] = "published",
    published_range: tuple[Bound, Bound] | None = None,
    **constraints: Any,
) -> Any:
    """Declare one parameter.

    Parameters
    ----------
    default : Any
        What would stand in a case file ("6 MPa", 0.12); ``...`` makes the parameter required.
    description : str
        What the number is, for files, help and forms.
    source : str
        Where default and range come from.
    status : str
        "published"; "unconfirmed" for a value in common use whose original was not seen; "assumed" for an
        assumption to be printed with results; "numerical" for a regularisation without physical meaning;
        "lubricant" for a property that the oil's catalogue row brings.
    published_range : tuple of float or str, optional
        Range found in the literature, written as in a case file; studies sample it.
    **constraints
        Bounds as pydantic knows them (``gt``, ``ge``, ``lt``, ``le``), in SI.
    """
    extra: dict[str, Any] = {"status": status}
    if source:
        extra["source"] = source
    if published_range is not None:
        extra["published_range"] = list(published_range)
    return Field(default, validate_default=True, description=description, json_schema_extra=extra, **constraints)
