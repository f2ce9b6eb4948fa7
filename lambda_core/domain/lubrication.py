"""Define ways of lubrication as bearing catalogues name them."""

from __future__ import annotations

from typing import Literal

Lubrication = Literal["oil bath", "oil jet", "under-race", "oil-air", "grease"]
# Where no oil stands among the balls: they run in a mixture of oil and air.
MIXTURES: tuple[Lubrication, ...] = ("oil jet", "under-race", "oil-air")
