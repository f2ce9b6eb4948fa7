"""Hold samples of a run between engine and file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from numpy import float64
from numpy.typing import NDArray

from lambda_core.domain.channels import Channel

TIME = "time"


@dataclass(frozen=True)
class RunChannels:
    """Channels of a run's samples.

    Attributes
    ----------
    machine : tuple of Channel
        Of the machine, except its time; empty for one bearing alone.
    bearings : mapping
        Name of the bearing -> its channels, except the time.
    """

    machine: tuple[Channel, ...]
    bearings: Mapping[str, tuple[Channel, ...]]


@dataclass(frozen=True)
class Samples:
    """Stretch of samples.

    Channel -> array whose first axis is time.

    Attributes
    ----------
    time : float64[:]
        [s]
    machine : mapping
        Channels of the machine.
    bearings : mapping
        Name of the bearing -> its channels, the time among them.
    """

    time: NDArray[float64]
    machine: Mapping[str, NDArray[float64]]
    bearings: Mapping[str, Mapping[str, NDArray[float64]]]
