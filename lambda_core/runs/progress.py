"""Report the progress of a run and request its stop."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from pydantic import BaseModel, ConfigDict

from lambda_core.domain.number_text import plus_minus
from lambda_core.domain.processes import heard_signals


class Progress(BaseModel):
    """Progress of a run.

    ``--progress=json`` prints it as one JSON line each.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    time_s: float
    percent: float
    cage_revolutions: float
    cage_revolutions_wanted: float  # as far as one can tell now
    averaged: int  # whole cage revolutions that the mean is taken over
    friction_torque_Nmm: float | None  # mean so far
    friction_torque_ci_Nmm: float | None
    friction_torque_now_Nmm: float | None  # over the last record
    cage_speed_ratio: float | None  # over the last record
    epicyclic_ratio: float | None = None  # the same without slip, at the contact angles of the last samples
    energy_residual: float | None
    inner_loads_N: tuple[float, ...]  # of each ball on the inner ring at the last sample
    wall_s: float
    left_s: float | None
    bearing_voltage_V: tuple[float, float] | None = None  # smallest and largest so far, of a case with a circuit
    films_broken_per_s: float | None = None  # so far

    def __str__(self) -> str:
        """Return the progress in one line.

        The fields have more.
        """
        turns = f"{self.cage_revolutions:.1f} of {self.cage_revolutions_wanted:.0f} cage revolutions"
        left = "" if self.left_s is None else f"{self.left_s:.0f} s left"
        torque = plus_minus(self.friction_torque_Nmm, self.friction_torque_ci_Nmm)
        return "   ".join(filter(None, (f"{self.percent:.0f} %", turns, f"friction torque {torque} N mm", left)))


Report = Callable[[Progress], None]


class StopRequest:
    """Request to stop the run."""

    signal_number: int | None = None

    def __bool__(self) -> bool:
        return self.signal_number is not None

    def words(self) -> str:
        """Return who asked."""
        return "Ctrl+C" if self.signal_number == signal.SIGINT else "a request to terminate"


@contextmanager
def stop_request() -> Iterator[StopRequest]:
    """Turn Ctrl+C and other stop signals into a request.

    It is answered between two steps.

    A second one interrupts wherever Python hears it; where it does not, the command line ends the process. Outside
    the main thread signals are not ours to take.
    """
    request = StopRequest()
    if threading.current_thread() is not threading.main_thread():
        yield request
        return

    def note(number: int, frame: FrameType | None) -> None:
        if request:
            raise KeyboardInterrupt
        request.signal_number = number

    before = {number: signal.signal(number, note) for number in heard_signals()}
    try:
        yield request
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
