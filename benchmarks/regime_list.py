"""List hard regimes and the events they must show."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core import api
from lambda_core.domain.channels import RINGS
from lambda_core.model.bearing_model import BearingModel

Samples = Mapping[str, NDArray[np.float64]]
RADIAL, AXIAL = "6319-cp10-1500", "6208-axial-1300"
_PITCH, _BALL = 110.0, 8.0  # of the bearing with 25 balls [mm]
THIN_SECTION: dict[str, Any] = {
    "name": "25-balls",
    "bearing": {
        "clearance": "20 um",
        "geometry": {
            "ball_count": 25,
            "ball_diameter": f"{_BALL} mm",
            "pitch_diameter": f"{_PITCH} mm",
            "conformity_inner": 0.52,
            "conformity_outer": 0.53,
            "bore_diameter": "95 mm",
            "outside_diameter": "125 mm",
            "width": "13 mm",
            "series": "618",
        },
    },
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "3 kN"},
    "operation": {"speed": "1500 rpm"},
}

LIGHT: dict[str, Any] = {
    "name": "light-and-slow",
    "bearing": {"designation": "61905", "maker": "NSK", "clearance": "C4"},
    "lubricant": {"name": "ester-vg320", "temperature": "64 degC"},
    "loads": {"radial": "27 N"},
    "operation": {"speed": "112 rpm"},
}


COLD: dict[str, Any] = {
    "name": "cold-oil",
    "bearing": {"designation": "6016", "maker": "SKF"},
    "lubricant": {"name": "FVA3", "temperature": "-10 degC"},
    "loads": {"radial": "5.8 kN"},
    "operation": {"speed": "500 rpm"},
}
SLOW: dict[str, Any] = {
    "name": "slow-without-a-cage",
    "bearing": {"designation": "61911", "maker": "SKF"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "500 N"},
    "operation": {"speed": "78 rpm"},
    "depth": {"cage": False},
}
THIN: dict[str, Any] = {
    "name": "thin-section",
    "bearing": {"designation": "61816", "maker": "SKF"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "1 kN"},
    "operation": {"speed": "1500 rpm"},
}


@dataclass(frozen=True)
class Regime:
    """One regime with its condition.

    A case, its changes, and what must be seen to have happened.
    """

    name: str
    changes: tuple[str, ...]
    duration: float  # simulated time [s]
    seen: Callable[[Samples], bool]
    case: str | dict[str, Any] = RADIAL

    def model(self, *options: str) -> BearingModel:
        """Return the resolved case, with more options set."""
        return api.check(self.case, ["output.interval=0.1 ms", *self.changes, *options])


def ramp(path: str, start: str, end: str, begin: str, finish: str) -> tuple[str, ...]:
    """Return the changes that make a quantity a ramp."""
    values = {"kind": "ramp", "start": start, "end": end, "start_time": begin, "end_time": finish}
    return tuple(f"{path}.{key}={value}" for key, value in values.items())


def harmonic(path: str, amplitude: str, frequency: str) -> tuple[str, ...]:
    """Return the changes that make a prescribed motion harmonic."""
    dof = path.removesuffix(".motion")
    values = {"kind": "harmonic", "amplitude": amplitude, "frequency": frequency}
    return (f"{dof}.mode=prescribed", *(f"{path}.{key}={value}" for key, value in values.items()))


def _speed(samples: Samples) -> NDArray[np.float64]:
    """Return the inner ring's spin [rad/s]."""
    return samples["body_spin"][:, 0]


def _pressed(samples: Samples) -> NDArray[np.int64]:
    """Return the number of loaded balls.

    The inner ring presses them, at each time.
    """
    count: NDArray[np.int64] = (samples["load"][:, :, RINGS.index("inner")] > 0.0).sum(axis=1)
    return count


def _total(samples: Samples) -> NDArray[np.float64]:
    total: NDArray[np.float64] = samples["load"][:, :, RINGS.index("inner")].sum(axis=1)
    return total


def _creep(samples: Samples) -> float:
    """Return the largest early ball speed [m/s].

    Of the most loaded ball in the first 9 ms.

    Later what rounding left of asymmetry grows, by a decade per millisecond: by chance to more or less than a bound.
    """
    before = samples["time"] <= 0.009
    return float(np.abs(samples["ball_velocity"][before, _lowest(samples), 2]).max())


def _lowest(samples: Samples) -> int:
    """Return the ball that carries most at the end."""
    return int(samples["load"][-1, :, RINGS.index("inner")].argmax())


def _film(samples: Samples) -> float:
    """Return the smallest film at the end [um].

    Central film under load.
    """
    load, film = samples["load"][-1], samples["film_central"][-1]
    return float(1e6 * film[load > 0.01 * load.max()].min())


def _balls(count: int) -> Callable[[Samples], bool]:
    return lambda s: s["load"].shape[1] == count and _pressed(s)[-1] > 1


_AXES = ("x", "y", "z")
REGIMES = (
    Regime(
        "start from rest", ramp("operation.speed", "0 rpm", "1500 rpm", "2 ms", "12 ms"), 0.015,
        lambda s: bool(abs(_speed(s)[0]) < 1e-9 and _speed(s)[-1] > 150.0),
    ),
    Regime(
        "start from rest within a millisecond", ramp("operation.speed", "0 rpm", "1500 rpm", "2 ms", "3 ms"), 0.01,
        lambda s: bool(abs(_speed(s)[0]) < 1e-9 and _speed(s)[-1] > 150.0),
    ),
    Regime(
        "stop", ramp("operation.speed", "500 rpm", "0 rpm", "2 ms", "15 ms"), 0.02,
        lambda s: bool(_speed(s)[0] > 50.0 and _speed(s)[-1] == 0.0),
    ),
    Regime(
        "6016 stopped in oil of -10 degC", ramp("operation.speed", "500 rpm", "0 rpm", "0 ms", "7 ms"), 0.008,
        lambda s: bool(_speed(s)[0] > 50.0 and _speed(s)[-1] == 0.0), COLD,
    ),
    Regime(
        "reversal", ramp("operation.speed", "500 rpm", "-500 rpm", "2 ms", "15 ms"), 0.02,
        lambda s: bool(_speed(s)[0] > 50.0 and _speed(s)[-1] < -50.0),
    ),
    Regime(
        "at rest under load", ("operation.speed=0 rpm", "solver.duration=0.1 s"), 0.02,
        lambda s: bool(np.all(_speed(s) == 0.0) and _creep(s) < 1e-6),
    ),
    # Two that a floor of the balance by the step, not per time, breaks: 0.4 % of milliwatts, 11 steps a microsecond.
    Regime(
        "light and slow", ("solver.duration=0.1 s",), 0.02,
        lambda s: bool(np.all(_speed(s) > 0.0) and _total(s).max() < 100.0), LIGHT,
    ),
    Regime(
        "at rest under axial load, free to tilt", ("operation.speed=0 rpm", "solver.duration=0.1 s"), 0.05,
        lambda s: bool(np.all(_speed(s) == 0.0)), "6208-axial-700",
    ),
    Regime(
        "load step down", ramp("loads.radial", "16 kN", "2 kN", "2 ms", "2.1 ms"), 0.01,
        lambda s: bool(_total(s)[-1] < 0.3 * _total(s)[0]),
    ),
    Regime(
        "load step up", ramp("loads.radial", "2 kN", "30 kN", "2 ms", "2.1 ms"), 0.01,
        lambda s: bool(_total(s)[-1] > 5.0 * _total(s)[0]),
    ),
    Regime("zero load", ("loads.radial=0 N",), 0.02, lambda s: bool(_total(s)[-1] < 1000.0)),
    Regime(
        "hardly any load", ("loads.radial=200 N",), 0.02, lambda s: bool(0.0 < _total(s)[-1] < 2000.0)
    ),
    Regime(
        "complete separation and re-contact", ramp("loads.radial", "16 kN", "-16 kN", "2 ms", "5 ms"), 0.015,
        lambda s: bool((_pressed(s) == 0).any() and _pressed(s)[-1] > 1),
    ),
    Regime(
        "axial load reversed", ("loads.radial=0 N", *ramp("loads.axial", "5 kN", "-5 kN", "2 ms", "5 ms")), 0.015,
        lambda s: bool(
            s["contact_angle"][0, :, 0].mean() * s["contact_angle"][-1, :, 0].mean() < 0.0 and (_pressed(s) == 0).any()
        ),
    ),
    Regime("50 1/min", ("operation.speed=50 rpm",), 0.1, lambda s: bool(0.0 < _film(s) < 0.2)),
    Regime(
        "20 000 1/min, axial", ("operation.speed=20000 rpm",), 0.01, lambda s: bool(_speed(s)[-1] > 2090.0), case=AXIAL
    ),
    Regime(
        "20 000 1/min, radial", ("operation.speed=20000 rpm", "loads.axial=0 N", "loads.radial=1 kN"), 0.01,
        lambda s: bool(_speed(s)[-1] > 2090.0), case=AXIAL,
    ),
    Regime("thick oil, 0 degC", ("lubricant.temperature=0 degC",), 0.01, lambda s: _film(s) > 1.2),
    Regime("thin oil, 150 degC", ("lubricant.temperature=150 degC",), 0.01, lambda s: _film(s) < 0.15),
    Regime(
        "thin oil, slow, rough surfaces", ("operation.speed=20 rpm", "surface.roughness=1 um"), 0.1,
        lambda s: bool(s["asperity_share"].max() > 0.5),
    ),
    Regime("hybrid, balls of Si3N4", ("materials.balls=Si3N4",), 0.01, _balls(9)),
    Regime("61911 without a cage, 78 1/min", (), 0.05, lambda s: bool(np.all(_speed(s) > 0.0)), SLOW),
    Regime("61816, 28 balls of 5.6 mm", (), 0.005, _balls(28), THIN),
    Regime("7 balls", ("bearing.geometry.ball_count=7",), 0.01, _balls(7)),
    Regime("25 balls", (), 0.005, _balls(25), case=THIN_SECTION),
    Regime(
        "ring tilt, moment load", ("loads.moment_y=200 N m",), 0.01,
        lambda s: bool(abs(s["body_tilt"][-1, 0]).max() > 1e-4),
    ),
    Regime(
        "combined load with tilt", ("loads.axial=8 kN", "loads.moment_z=50 N m"), 0.01,
        lambda s: bool(abs(s["body_tilt"][-1, 0]).max() > 1e-5 and abs(s["contact_angle"][-1]).max() > 0.1),
    ),
    Regime("cage off", ("depth.cage=false",), 0.03, lambda s: bool(np.all(s["pocket_force"][:, :, 0] == 0.0))),
    Regime(
        "driven by a torque from rest",
        ("bodies.inner_ring.spin=free", "operation.torque=20 N m", "operation.speed=0 rpm", "solver.duration=1 s"),
        0.01,
        lambda s: bool(abs(_speed(s)[0]) < 1e-9 and _speed(s)[-1] > 1.0),
    ),
    Regime(
        "braked by a torque until it turns back",
        ("bodies.inner_ring.spin=free", "operation.torque=-20 N m", "operation.speed=50 rpm"), 0.015,
        lambda s: bool(_speed(s)[0] > 5.0 and _speed(s)[-1] < 0.0),
    ),
    Regime(
        "unbalance", ("bodies.inner_ring.unbalance=2000 g mm", "operation.speed=6000 rpm"), 0.01,
        lambda s: bool(np.ptp(s["body_position"][:, 0, 2]) > 1e-7),
    ),
    Regime(
        "outer ring shaken along the shaft", harmonic("bodies.outer_ring.x.motion", "50 um", "200 Hz"), 0.02,
        lambda s: bool(np.ptp(s["body_position"][:, 1, 0]) > 90e-6),
    ),
    Regime(
        "outer ring shaken radially", harmonic("bodies.outer_ring.z.motion", "30 um", "500 Hz"), 0.01,
        lambda s: bool(np.ptp(s["body_position"][:, 1, 2]) > 55e-6),
    ),
    # Work that is found as m v D(v) counts the kinetic energy of a jump twice: 20 % of all that flows.
    Regime(
        "100 kg with a prescribed jump of speed",
        (
            "bodies.outer_ring.mass=100 kg", "bodies.outer_ring.z.mode=prescribed",
            *ramp("bodies.outer_ring.z.motion", "0 um", "100 um", "2 ms", "3 ms"),
        ),
        0.005, lambda s: bool(np.ptp(s["body_position"][:, 1, 2]) > 99e-6),
    ),
    Regime("10 1/min, friction by micro-slip", ("operation.speed=10 rpm",), 0.1, lambda s: bool(0.0 < _film(s) < 0.1)),
    Regime(
        "outer ring on springs and dampers",
        tuple(
            f"bodies.outer_ring.{axis}.{setting}"
            for axis in _AXES
            for setting in ("mode=free", "stiffness=1e8 N/m", "damping=2000 N s/m")
        ),
        0.01, lambda s: bool(abs(s["body_position"][-1, 1, 2]) > 1e-5),
    ),
    Regime(
        "inner ring held, no load",
        ("loads.radial=0 N", *(f"bodies.inner_ring.{axis}=locked" for axis in _AXES)), 0.02,
        lambda s: bool(np.all(s["body_position"][:, 0] == 0.0)),
    ),
    Regime("6220 shaken along the shaft", (), 0.02, lambda s: bool(np.ptp(s["body_position"][:, 1, 0]) > 1.9e-4),
           case="6220-excited"),
)  # fmt: skip

# What is refused, and the words that say why.
REFUSED: dict[str, tuple[tuple[str, ...], str]] = {
    "more balls than fit": (("bearing.geometry.ball_count=20",), "do not fit on a pitch diameter"),
    "fewer than three balls": (("bearing.geometry.ball_count=2",), "must be at least 3"),
    "more interference than a bearing survives": (("bearing.clearance=-300 um",), "more interference than a bearing"),
    "perfectly smooth surfaces": (("surface.roughness=0 um",), "must be greater than 0"),
    "rest, until the averages have converged": (("operation.speed=0 rpm",), "averages need revolutions of the cage"),
    "an outer ring that nothing holds": (
        tuple(f"bodies.outer_ring.{axis}=free" for axis in _AXES),
        "nothing holds the rings there",
    ),
}
