"""Compute the frequency shift and damping of the time integration."""

from __future__ import annotations

import cmath
import math

import numpy as np
from pydantic import Field

from lambda_core.domain.number_text import percent
from lambda_core.domain.units import show
from lambda_core.model.bearing_model import USUAL_RESOLVE, Solver
from lambda_core.results.record import Record
from lambda_core.results.run_status import Status
from lambda_core.solver.integrator.tableau import STAGES, WEIGHTS, A

FOURTH_POWERS = "steps_to_the_fourth"  # of the statistics of a run: sum of the fourth powers of its steps [s4]
ITERATION_WORK = "iteration_work"  # of the same: work of early ends of Newton's iteration, counted positive [J]
_FASTEST = math.pi  # w h from which on a step sees nothing of a swing's frequency


class RingMode(Record):
    """Mode of the rings with its numerical damping.

    Near the end of a run.
    """

    frequency_Hz: float
    damping_percent: float = Field(description="of critical, of the bearing or the shaft itself")
    added_percent: float = Field(description="of critical, by the integration")
    shift_percent: float = Field(description="of the frequency, by the integration")


class NumericalDamping(Record):
    """Accuracy of vibrations."""

    resolve_Hz: float = Field(description="highest resolved frequency; 0 for averages")
    step_s: float = Field(description="length of a step, the cubic mean over time")
    modes: list[RingMode] = Field(
        description="modes of the rings by frequency, those that are damped least; of a shaft all up to resolve_Hz"
    )

    def at(self, frequency: float) -> tuple[float, float]:
        """Return added damping and frequency shift [%]."""
        damping, shift = added(2.0 * math.pi * frequency * self.step_s, fine=self.resolve_Hz > 0.0)
        return 100.0 * damping, 100.0 * shift

    def sentence(self) -> str:
        """Return how far vibrations can be believed."""
        worst = max(self.modes, key=lambda mode: mode.added_percent / mode.damping_percent, default=None)
        lost = ""
        if worst is not None and worst.added_percent > worst.damping_percent:
            where, own = show(worst.frequency_Hz, "frequency", 3), f"{worst.damping_percent:.2g} % of its own"
            lost = f"{worst.added_percent:.2g} % at {where}, which has {own} ({self._advice(worst.frequency_Hz)})"
        if self.resolve_Hz:
            until = f"resolved to {show(self.resolve_Hz, 'frequency')}"
            added_there = f"{until}, {self.at(self.resolve_Hz)[0]:.1g} % damping added"
            return f"{until}; the integration adds damping: {lost}" if lost else added_there
        if lost:
            return f"damped by the integration: {lost}"
        if worst is None:
            return f"{self.at(1000.0)[0]:.2g} % damping added at 1 kHz"
        return f"{worst.added_percent:.2g} % damping added at {show(worst.frequency_Hz, 'frequency', 3)}"

    def _advice(self, frequency: float) -> str:
        if self.resolve_Hz:
            return f"solver.resolve above {show(max(frequency, self.resolve_Hz), 'frequency', 3)} resolves it"
        more = f" with solver.resolve above {show(frequency, 'frequency', 3)}" if frequency > USUAL_RESOLVE else ""
        return f'solver.accuracy = "vibration"{more} resolves it'

    def note(self, frequency: float) -> str:
        """Return the note of a spectrum.

        The spectrum ends at a frequency [Hz].
        """
        damping, shift = map(percent, self.at(frequency))
        half_damping, half_shift = map(percent, self.at(0.5 * frequency))
        where, middle = show(frequency, "frequency", 3), show(0.5 * frequency, "frequency", 3)
        return (
            f"the integration adds {damping} of critical damping at {where} and shifts it by {shift}, "
            f"at {middle} {half_damping} and {half_shift}; {self.sentence()}"
        )


def added(angle: float, *, fine: bool) -> tuple[float, float]:
    """Return added damping ratio and frequency shift.

    A formula adds them to a swing; the shift is relative.

    The swing u' = i w u becomes u_n = rho^n, with the principal root rho of the formula at z = i w h (Hairer and Wanner
    1996, Solving ODEs II, IV.3, V.1): arg(rho)/(w h) is the frequency over w, -ln|rho|/(w h) the damping ratio. For
    small w h that is (w h)^3/4 and -(w h)^2/3 of BDF2. Of a step that is half a period or longer the damping still
    holds; the frequency is lost, a shift of -1.

    Parameters
    ----------
    angle : float
        w h [rad].
    fine : bool
        ESDIRK4(3)6L[2]SA; otherwise BDF2, in equal steps.
    """
    angle = max(angle, 1e-9)
    z = 1j * angle
    if fine:
        ones = np.ones(STAGES)
        root = complex(1.0 + z * (WEIGHTS @ np.linalg.solve(np.eye(STAGES) - z * A, ones)))
    else:
        # (3/2 - z) rho^2 - 2 rho + 1/2 = 0
        root = (2.0 + cmath.sqrt(1.0 + 2.0 * z)) / (3.0 - 2.0 * z)
    return -math.log(abs(root)) / angle, (cmath.phase(root) / angle if angle < _FASTEST else 0.0) - 1.0


def numerical_damping(settings: Solver, status: Status, time: float) -> NumericalDamping | None:
    """Return the accuracy of a run's vibrations.

    It is None for a result of an older version.
    """
    powers = status.statistics.get(FOURTH_POWERS, 0.0)
    if not powers > 0.0 or not time > 0.0:
        return None
    found = NumericalDamping(resolve_Hz=settings.resolve, step_s=(powers / time) ** (1.0 / 3.0), modes=[])
    for frequency, damping in status.modes:
        more, shift = found.at(frequency)
        swing = RingMode(
            frequency_Hz=frequency, damping_percent=100.0 * damping, added_percent=more, shift_percent=shift
        )
        found.modes.append(swing)
    return found
