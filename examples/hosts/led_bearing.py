"""A bearing whose rings another program leads: from Python, or as an FMU of version 2 through FMPy.

Both have the same two methods, so that a host is written once. Poses are x, y, z [m], tilt_y, tilt_z [rad] of the inner
ring, the outer ring stands still.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core import api

POSE = ("x", "y", "z", "tilt_y", "tilt_z")
_REACTION = [f"inner_ring.reaction_{kind}_{axis}" for kind in ("force", "moment") for axis in "xyz"]


class FromPython:
    """The bearing of :func:`lambda_core.api.iterate`."""

    def __init__(self, case: str | Path, changes: Iterable[str] = ()) -> None:
        self._bearing = api.iterate(case, tuple(changes), exact=True, couple="motion")
        dofs = self._bearing.model.inner_ring.dofs
        self.pose = np.array([dofs[name].motion.terms[0].values[0] for name in POSE])

    def step(self, until: float, pose: Sequence[float], rate: Sequence[float], acceleration: Sequence[float]) -> Any:
        """Lead the ring from a pose on; returns force [N] and moment [N m] of the bearing on it at the end."""
        for i, name in enumerate(POSE):
            self._bearing.give(f"inner_ring.{name}", pose[i], rate[i], acceleration[i])
        return self._bearing.step_to(until).reactions["inner_ring"]


class FromUnit:
    """The bearing in an FMU that was exported with ``--couple motion``; needs FMPy."""

    def __init__(self, file: str | Path) -> None:
        from fmpy import extract, read_model_description
        from fmpy.fmi2 import FMU2Slave

        about, folder = read_model_description(str(file)), extract(str(file))
        named = {variable.name: variable.valueReference for variable in about.modelVariables}
        self._lead = [named[f"inner_ring.{name}{more}"] for more in ("", "_rate", "_acceleration") for name in POSE]
        self._answer = [named[name] for name in _REACTION]
        self.unit = FMU2Slave(
            guid=about.guid,
            unzipDirectory=folder,
            modelIdentifier=about.coSimulation.modelIdentifier,
            instanceName="bearing",
        )
        self.unit.instantiate()
        self.unit.setupExperiment(startTime=0.0)
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()
        self.pose, self._time = np.array(self.unit.getReal(self._lead[: len(POSE)])), 0.0

    def step(self, until: float, pose: Sequence[float], rate: Sequence[float], acceleration: Sequence[float]) -> Any:
        """Lead the ring from a pose on; returns force [N] and moment [N m] of the bearing on it at the end."""
        self.unit.setReal(self._lead, [float(value) for value in (*pose, *rate, *acceleration)])
        self.unit.doStep(self._time, until - self._time)
        self._time = until
        return np.array(self.unit.getReal(self._answer))

    def again(self, until: float, poses: Iterable[tuple[Any, Any, Any]]) -> Any:
        """Repeat one step with better motions, each time from the saved state; returns the last answer.

        What a host does that solves its interface implicitly: the step is taken back until motion and reaction agree.
        """
        begin, state, answer = self._time, self.unit.getFMUState(), None
        for pose, rate, acceleration in poses:
            self.unit.setFMUState(state)
            self._time = begin
            answer = self.step(until, pose, rate, acceleration)
        self.unit.freeFMUState(state)
        return answer
