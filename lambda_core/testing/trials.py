"""Make trial inputs for comparison methods and views."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import CHANNELS, Channel
from lambda_core.laws.probe import trial_context
from lambda_core.views.method import MethodInputs, NotApplicable
from lambda_core.views.view import RunData


def method_inputs(**changes: Any) -> MethodInputs:
    """Return what a comparison method sees of a 6208.

    It runs at 40 degC, 2750 1/min and 2 kN radial load.

    Parameters
    ----------
    **changes
        Fields of :class:`lambda_core.plugins.MethodInputs` that differ, SI.

    Returns
    -------
    MethodInputs
        Plain numbers, SI.
    """
    inner = trial_context("ball_inner")
    groove = inner.groove_radius
    given: dict[str, Any] = {
        "title": "6208 (trial)",
        "series": inner.series,
        "bore_diameter": inner.bore_diameter,
        "outside_diameter": inner.outside_diameter,
        "width": inner.width,
        "ball_count": inner.ball_count,
        "ball_diameter": inner.ball_diameter,
        "pitch_diameter": inner.pitch_diameter,
        "groove_radius_inner": groove,
        "groove_radius_outer": groove,
        "ball": inner.ball,
        "inner_ring": inner.partner,
        "outer_ring": inner.partner,
        "oil": inner.oil,
        "radial_load": 2000.0,
        "axial_load": 0.0,
        "inner_speed": inner.speed,
        "outer_speed": 0.0,
    }
    return MethodInputs(**(given | changes))


class TrialRun:
    """Run of given channels for view tests.

    See :class:`lambda_core.plugins.RunData`.
    """

    def __init__(self, channels: Mapping[str, ArrayLike], model: Mapping[str, Any] | None = None) -> None:
        self._channels = {name: np.asarray(values, np.float64) for name, values in channels.items()}
        self.path = Path("trial.h5")
        self.title = self.headline = self.case = "trial"
        self.case_toml = ""
        self.model = dict(model or {})
        self.kernel_keys: dict[str, str] = {}

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Return the given channels.

        Those of the program have their meaning.
        """
        known = {channel.name: channel for channel in CHANNELS}
        return tuple(known.get(name, Channel(name, (), "", "")) for name in self._channels)

    def __getitem__(self, name: str) -> FloatArray:
        """Return one channel, first axis time."""
        return self._channels[name]

    def blocks(self, names: Sequence[str], start: float = 0.0) -> Iterator[dict[str, FloatArray]]:
        """Yield the channels in one block.

        They begin at time `start` [s].
        """
        keep = self._channels["time"] >= start
        yield {name: self._channels[name][keep] for name in names}

    def sample(self, row: int, names: Sequence[str]) -> dict[str, FloatArray]:
        """Return the channels at one instant."""
        return {name: self._channels[name][row] for name in names}

    def integrals(self) -> FloatArray:
        """Return no integrals."""
        raise NotApplicable("a trial run has no running integrals")

    def revolutions(self) -> FloatArray:
        """Return no revolutions."""
        raise NotApplicable("a trial run has no whole cage revolutions")

    def summary(self) -> Any:
        """Return no summary."""
        raise NotApplicable("a trial run has no summary")


def run_data(**channels: ArrayLike) -> RunData:
    """Return a run of given channels, to test views.

    Parameters
    ----------
    **channels : array_like
        Channels by name, each with time as its first axis, SI; ``time`` [s] is one of them.

    Returns
    -------
    RunData
        Without integrals and summary: asking for them raises NotApplicable.
    """
    return TrialRun(channels)
