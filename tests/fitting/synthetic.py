"""Make measurements from a closed friction law, with noise."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.fitting.data import Data
from lambda_core.fitting.least_squares import Fit, fit
from lambda_core.fitting.parameters import Parameter

TRUTH = np.array([0.04, 6.0, 1.2])
PARAMETERS = (
    Parameter("loss factor", 0.03, 0.005, 0.1),
    Parameter("Eyring stress", 8.0, 2.0, 12.0),
    Parameter("rolling", 1.0, 0.3, 3.0),
)


class Conditions(NamedTuple):
    """Operating conditions of a test plan.

    Speeds [1/min], loads [kN] and oil temperatures [degC].
    """

    speed: FloatArray
    load: FloatArray
    temperature: FloatArray


def plan() -> Conditions:
    """Return 24 operating points."""
    speed, load = np.meshgrid([300.0, 600.0, 1200.0, 2400.0, 3600.0, 4800.0], [4.0, 8.0, 16.0, 24.0])
    shape = speed.size
    return Conditions(speed.ravel(), load.ravel(), 50.0 + 20.0 * np.arange(shape) / shape)


def torque(parameters: FloatArray, at: Conditions) -> FloatArray:
    """Return hysteresis, sliding and rolling torque [N mm]."""
    loss, stress, rolling = parameters
    viscosity = np.exp(-0.035 * (at.temperature - 60.0))
    hysteresis = 180.0 * loss * at.load ** (4 / 3)
    sliding = 2.0 * stress * at.load ** (2 / 3) * np.arcsinh(2.0 * at.speed**0.5 / stress)
    found: FloatArray = hysteresis + sliding + 2.4 * rolling * (viscosity * at.speed) ** 0.66
    return found


Noise = Callable[[np.random.Generator, FloatArray, FloatArray], FloatArray]


def normal(random: np.random.Generator, values: FloatArray, errors: FloatArray) -> FloatArray:
    """Add normal errors."""
    return values + errors * random.standard_normal(values.size)


def heavy(random: np.random.Generator, values: FloatArray, errors: FloatArray) -> FloatArray:
    """Add errors of Student's distribution with three degrees of freedom."""
    return values + errors * random.standard_t(3, values.size)


def spoiled(random: np.random.Generator, values: FloatArray, errors: FloatArray) -> FloatArray:
    """Add normal errors and outliers.

    One point in twelve gets one ten times as large.
    """
    size = np.where(random.permutation(values.size) < values.size // 12, 10.0, 1.0)
    return values + size * errors * random.standard_normal(values.size)


NOISES: dict[str, Noise] = {"normal": normal, "heavy": heavy, "spoiled": spoiled}


def fitted(
    noise: Noise,
    seed: int,
    *,
    is_error_known: bool,
    temperature_error: float = 0.0,
    common_error: float = 0.0,
    offset: float = 0.0,
    scale: float = 0.0,
    is_told: bool = True,
) -> Fit:
    """Fit one set of synthetic measurements.

    The thermometer has a `common_error` at all points [K], the torque sensor an `offset` and an error of its `scale`;
    where it `is_told` to be none, each point has one.
    """
    at, random = plan(), np.random.default_rng(seed)
    actual = at._replace(temperature=at.temperature + temperature_error * random.standard_normal(at.speed.size))
    if common_error:
        actual = actual._replace(temperature=actual.temperature + common_error * random.standard_normal())
    own = 0.01 * torque(TRUTH, at)
    values = noise(random, torque(TRUTH, actual), own)
    values = values + offset * random.standard_normal() + scale * random.standard_normal() * torque(TRUTH, actual)
    errors = own if is_told else np.sqrt(own**2 + offset**2 + (scale * torque(TRUTH, at)) ** 2)
    alone = math.hypot(temperature_error, 0.0 if is_told else common_error)
    inputs = np.full((values.size, 1), alone) if alone or common_error else np.zeros((0, 0))
    common = np.full((values.size, 1), common_error) if common_error and is_told else np.zeros((0, 0))

    def slopes(parameters: FloatArray) -> FloatArray:
        warmer = at._replace(temperature=at.temperature + 0.5)
        return ((torque(parameters, warmer) - torque(parameters, at)) / 0.5)[:, None]

    known = errors if is_error_known else np.ones(values.size)
    columns = {"speed": at.speed, "load": at.load, "temperature": at.temperature}
    data = Data(values, known, columns, inputs, is_error_known, not is_error_known, common_errors=common)
    if is_told and (offset or scale):
        errors_of_sensor, shares = (np.tile(one, (values.size, 1)) for one in ([offset, 0.0], [0.0, scale]))
        data = replace(data, value_errors=errors_of_sensor, value_shares=shares)
    return fit(lambda p: torque(p, at), PARAMETERS, data, input_slopes=slopes if inputs.size else None)
