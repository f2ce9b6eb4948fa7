"""Prescribe the motion of an inner ring.

From Python, or as an FMU of version 2 through FMPy.

Both have the same methods, so that a host is written once. Poses are x, y, z [m], tilt_y, tilt_z [rad] of the inner
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

    @property
    def time(self) -> float:
        """Present time of the bearing [s]."""
        return self._bearing.time_s

    def step(self, until: float, pose: Sequence[float], rate: Sequence[float], acceleration: Sequence[float]) -> Any:
        """Move the ring from a pose on.

        Return force [N] and moment [N m] of the bearing on it at the end.
        """
        for i, name in enumerate(POSE):
            self._bearing.give(f"inner_ring.{name}", pose[i], rate[i], acceleration[i])
        return self._bearing.step_to(until).reactions["inner_ring"]

    def save(self) -> Any:
        """Return the state, to come back to."""
        return self._bearing.state()

    def back_to(self, state: Any) -> None:
        """Take back what was done since."""
        self._bearing.restore(state)

    def forget(self, state: Any) -> None:
        """Give a state back that is not needed any more."""


class FromUnit:
    """Bearing in an FMU with prescribed motion.

    Exported with ``--couple motion``; needs FMPy.
    """

    def __init__(self, file: str | Path) -> None:
        from fmpy import extract, read_model_description
        from fmpy.fmi2 import FMU2Slave

        about, folder = read_model_description(str(file)), extract(str(file))
        named = {variable.name: variable.valueReference for variable in about.modelVariables}
        self._lead = [named[f"inner_ring.{name}{more}"] for more in ("", "_rate", "_acceleration") for name in POSE]
        self._answer = [named[name] for name in _REACTION]
        self._spin, self._energy = named["inner_ring.spin"], named["bearing.energy_in"]
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
        self.pose, self.time = np.array(self.unit.getReal(self._lead[: len(POSE)])), 0.0

    def step(self, until: float, pose: Sequence[float], rate: Sequence[float], acceleration: Sequence[float]) -> Any:
        """Move the ring from a pose on.

        Return force [N] and moment [N m] of the bearing on it at the end.
        """
        self.unit.setReal(self._lead, [float(value) for value in (*pose, *rate, *acceleration)])
        self.unit.doStep(self.time, until - self.time)
        self.time = until
        return np.array(self.unit.getReal(self._answer))

    def save(self) -> Any:
        """Return the state, to come back to."""
        return self.time, self.unit.getFMUState()

    def back_to(self, state: Any) -> None:
        """Take back what was done since."""
        self.time = state[0]
        self.unit.setFMUState(state[1])

    def forget(self, state: Any) -> None:
        """Give a state back that is not needed any more."""
        self.unit.freeFMUState(state[1])

    def energy(self) -> tuple[float, float]:
        """Return the received energy [J] and speed.

        The speed is that of the ring [rad/s].
        """
        found = self.unit.getReal([self._energy, self._spin])
        return float(found[0]), float(found[1])
