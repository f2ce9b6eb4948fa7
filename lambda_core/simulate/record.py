"""What the machine interface is made of."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

INTERFACE = 1
Ring = Literal["inner", "outer"]  # in the order of channels.RINGS
# A contact below this share of the largest load does not count as carrying it.
CARRYING = 0.01


class Record(BaseModel):
    """Base of what the machine interface is made of."""

    model_config = ConfigDict(frozen=True, extra="forbid")
