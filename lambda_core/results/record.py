"""Define the base of the machine interface."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

INTERFACE = 1


class Record(BaseModel):
    """Base of what the machine interface is made of."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)
