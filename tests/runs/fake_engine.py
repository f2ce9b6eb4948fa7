"""Imitate an engine with known answers.

A ring at constant speed; a cage that turns at a known share of it with a known ripple; losses
that are a constant plus a wave of whole periods per cage turn plus, on request, noise from a
chaotic map, whose state shows every bit that a continuation loses. Energy closes exactly,
but for a leak that tests ask for. Steps are irregular, and samples fall between them.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import CHANNELS, DIMENSIONS, LOSSES, Channel
from lambda_core.domain.elements import ALONE
from lambda_core.results.provenance import Provenance
from lambda_core.results.samples import RunChannels, Samples
from lambda_core.runs.run_engine import without_time
from lambda_core.solver.drivers.engine import Advance

MakeProvenance = Callable[..., Provenance]
# The engine in a process of its own: what fake_run.py does.
_HERE = str(Path(__file__).parent)
FAKE_RUN = f"import sys; sys.path.insert(0, {_HERE!r}); from fake_run import main; raise SystemExit(main())"


@dataclass(frozen=True)
class Truth:
    """Behaviour of the fake engine."""

    balls: int = 9
    speed: float = 157.08  # of the inner ring [rad/s]
    cage_share: float = 0.4
    torque: float = 1.2  # mean [N m]
    wave: float = 0.1  # amplitude of the torque's wave, 9 periods per cage turn [N m]
    noise: float = 0.0  # amplitude of the torque's noise [N m]
    leak: float = 0.0  # share of the input that vanishes
    slowness: float = 0.0  # wall time per step [s]
    fails_at: float = math.inf  # [s]

    @property
    def shares(self) -> FloatArray:
        """Share of each mechanism in the losses."""
        weights = np.arange(1.0, len(LOSSES) + 1.0)
        return weights / weights.sum()


class FakeEngine:
    """See the module."""

    written: tuple[Channel, ...] = CHANNELS

    def __init__(self, truth: Truth | None = None) -> None:
        self.truth = truth or Truth()
        self.time = 0.0
        self.turn = 2.0 * math.pi / (self.truth.cage_share * self.truth.speed)
        self.sample_interval = self.turn / 200.0
        self._chaos = 0.3141
        self._loss = 0.0  # J
        self._input = 0.0
        self._samples = 0
        self._steps = 0
        self._buffer: list[tuple[float, float]] = []

    def advance(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        while self.time < until:
            if self.time >= self.truth.fails_at:
                return Advance(False, f"ball 3, inner ring: no step is small enough at t = {self.time:.6g} s")
            self._step()
            if self._steps % 20 == 0 and self.time < until and pause is not None and pause():
                break
        return Advance(True, "")

    def _step(self) -> None:
        truth = self.truth
        self._chaos = 3.9 * self._chaos * (1.0 - self._chaos)
        step = self.turn / 230.0 * (0.5 + self._chaos)
        begin, end = self.time, self.time + step
        rate = 2.0 * math.pi * 9.0 / self.turn
        wave = truth.wave * truth.speed * (math.cos(rate * begin) - math.cos(rate * end)) / rate
        noise = truth.noise * (self._chaos - 0.5) * truth.speed * step
        loss = truth.torque * truth.speed * step + wave + noise
        self._loss += loss
        self._input += loss * (1.0 + truth.leak)
        self._steps += 1
        self.time = end
        while self._samples * self.sample_interval <= end:
            self._buffer.append((self._samples * self.sample_interval, self._chaos))
            self._samples += 1
        if truth.slowness:
            time.sleep(truth.slowness)

    @property
    def channels(self) -> RunChannels:
        return RunChannels((), {ALONE: without_time(self.written)})

    def samples(self) -> Samples:
        times = np.array([at for at, _ in self._buffer])
        chaos = np.array([value for _, value in self._buffer])
        self._buffer = []
        sizes = {"ball": self.truth.balls, **{name: len(labels) for name, labels in DIMENSIONS.items()}}
        found = {}
        for number, channel in enumerate(self.written):
            shape = (len(times), *(sizes[dim] for dim in channel.dims))
            pattern = np.arange(1.0, math.prod(shape[1:]) + 1.0).reshape(1, *shape[1:])
            column = (chaos + number).reshape(-1, *[1] * (len(shape) - 1))
            found[channel.name] = np.broadcast_to(column * pattern, shape).copy()
        found["time"] = times
        found["load"][:, ::2] = 0.0  # every other ball is unloaded
        found["contact_angle"][:] = 0.0
        found["ball_radius"][:] = 73.75e-3  # pitch circle of the 6319
        found["ball_azimuth"] *= 10.0
        found["semi_axis_a"] *= 1e-9
        found["body_position"] *= 1e-9
        return Samples(times, {}, {ALONE: found})

    def integrals(self) -> dict[str, dict[str, float]]:
        truth, now = self.truth, self.time
        found = {f"loss.{name}": share * self._loss for name, share in zip(LOSSES, truth.shares, strict=True)}
        angle = truth.speed * now
        cage = truth.cage_share * angle
        found |= {
            "input": self._input,
            "input_abs": self._input,
            "support": 0.0,
            "drive": self._input,
            "stored": 0.0,
            "relative_angle": angle,
            "cage_angle": cage,
            "inner_angle": angle,
            "x": 1e-6 * now,
            "y": 2e-6 * now,
            "z": -3e-6 * now,
        }
        return {ALONE: found}

    def statistics(self) -> dict[str, float]:
        return {"steps": float(self._steps)}

    def modes(self) -> list[tuple[float, float]]:
        return []

    def state(self) -> dict[str, FloatArray]:
        numbers = [self.time, self._chaos, self._loss, self._input, self._samples, self._steps]
        return {"numbers": np.array(numbers), "history": np.arange(3.0 + self._steps % 5)}

    def restore(self, state: Mapping[str, FloatArray]) -> None:
        self.time, self._chaos, self._loss, self._input, samples, steps = state["numbers"].tolist()
        self._samples, self._steps, self._buffer = int(samples), int(steps), []
