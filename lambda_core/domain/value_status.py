"""Define where a value comes from, in one word."""

from __future__ import annotations

from typing import Literal

RowStatus = Literal["published", "measured", "derived", "assumed"]  # of a value of the catalogue
ValueStatus = Literal["given", "published", "measured", "derived", "assumed", "default"]  # of a value of a case
ESTIMATED: tuple[RowStatus, ...] = ("derived", "assumed")  # what a ≈ marks
