"""Compare a coupled rotor with its mass inside the bearing.

``python -m benchmarks.coupling [--fmu]``.

The host knows mass and load of the rotor and leads the inner ring (``couple="motion"``); the bearing answers with its
reaction. A push begins after about a millisecond and stays. Reference is the bearing that owns the ring, with the same
mass. With ``--fmu`` the driven bearing is an exported FMU, driven by FMPy; the reference stays the program's.
"""

from __future__ import annotations

import math
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path as File
from typing import Any, Protocol

import numpy as np

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError

CASE = "6208-axial-1300"
SHAFT = 2.0  # [kg]
PUSH = (0.0, 0.0, -500.0)  # [N]
PUSHED_AT = 0.96e-3  # [s]
END = 7.68e-3  # [s]
STEPS = (480e-6, 320e-6, 160e-6, 80e-6, 40e-6, 20e-6, 8e-6, 4e-6)  # [s]
COMMON = 4e-6  # [s] between points of the reference
_AXES = "xyz"


def changes(tolerance: float) -> list[str]:
    """Return the changes of the case.

    A free rotor without tilt, in no field of gravity.
    """
    return [
        f"solver.duration={END} s",
        f"solver.tolerance={tolerance}",
        "solver.accuracy=vibration",
        f"bodies.inner_ring.shaft_mass={SHAFT} kg",
        "bodies.inner_ring.tilt_y.mode=locked",
        "bodies.inner_ring.tilt_z.mode=locked",
        "gravity.z=0 m/s2",
    ]


@dataclass(frozen=True)
class Path:
    """Path of the rotor.

    Attributes
    ----------
    places : float64[:, 3]
        At the communication points [m].
    leak : float
        Energy that rotor, load and bearing do not agree on, over what went through the ring [-].
    """

    places: FloatArray
    leak: float = 0.0


def load(time: float) -> FloatArray:
    """Return the push at a time [N]."""
    return np.array(PUSH) if time >= PUSHED_AT - 1e-12 else np.zeros(3)


def inside(step: float, tolerance: float) -> Path:
    """Return the path of the rotor that the bearing owns."""
    bearing = api.iterate(CASE, changes(tolerance), exact=True)
    places = [np.full(3, np.nan)]
    for k in range(round(END / step)):
        bearing.push(tuple(load(k * step)))
        places.append(bearing.step_to((k + 1) * step)["body_position"][0].copy())
    return Path(np.array(places))


@dataclass(frozen=True)
class Scheme:
    """Step h of a host.

    With the rotor's speed v, its acceleration a at the beginning and b at the end.

    Attributes
    ----------
    lead : function
        (v, a, h) -> speed and acceleration prescribed to the ring.
    speed : function
        (v, a, b, h) -> speed at the end.
    """

    lead: Callable[..., tuple[FloatArray, FloatArray]]
    speed: Callable[..., FloatArray]


SCHEMES = {
    "Verlet": Scheme(lambda v, a, h: (v, a), lambda v, a, b, h: v + 0.5 * h * (a + b)),
    "speed first": Scheme(lambda v, a, h: (v + h * a, 0.0 * a), lambda v, a, b, h: v + h * a),
    "place first": Scheme(lambda v, a, h: (v, 0.0 * a), lambda v, a, b, h: v + h * a),
}


class PrescribedBearing(Protocol):
    """A bearing whose inner ring the host leads."""

    def begin(self) -> FloatArray:
        """Go to the start; returns where the ring stands [m]."""

    def step(self, until: float, place: FloatArray, speed: FloatArray, slope: FloatArray) -> FloatArray:
        """Move the ring until a time [s].

        Return the force of the bearing on it [N].
        """


class FromProgram:
    """The bearing of ``api.iterate``."""

    def __init__(self, tolerance: float) -> None:
        self._changes = changes(tolerance)

    def begin(self) -> FloatArray:
        """Go to the start."""
        self._bearing = api.iterate(CASE, self._changes, exact=True, couple="motion")
        dofs = self._bearing.model.inner_ring.dofs
        return np.array([dofs[axis].motion.terms[0].values[0] for axis in _AXES])

    def step(self, until: float, place: FloatArray, speed: FloatArray, slope: FloatArray) -> FloatArray:
        """Lead the ring."""
        for i, axis in enumerate(_AXES):
            self._bearing.give(f"inner_ring.{axis}", place[i], speed[i], slope[i])
        found: FloatArray = self._bearing.step_to(until).reactions["inner_ring"][:3]
        return found


class FromUnit:
    """Bearing of an exported FMU.

    Through FMPy: `named` are value references by name.
    """

    def __init__(self, tolerance: float, folder: str) -> None:
        from fmpy import extract, read_model_description
        from fmpy.fmi2 import FMU2Slave

        file = File(folder) / "prescribed.fmu"
        api.export_fmu(CASE, changes(tolerance), out=file, couple="motion", processor="native")
        about = read_model_description(str(file))
        named = {variable.name: variable.valueReference for variable in about.modelVariables}
        self.named = named
        self._given = [named[f"inner_ring.{axis}{more}"] for more in ("", "_rate", "_acceleration") for axis in _AXES]
        self._answer = [named[f"inner_ring.reaction_force_{axis}"] for axis in _AXES]
        self._unit: Any = FMU2Slave(
            guid=about.guid,
            unzipDirectory=extract(str(file)),
            modelIdentifier=about.coSimulation.modelIdentifier,
            instanceName="prescribed",
        )
        self._unit.instantiate()

    def begin(self) -> FloatArray:
        """Go to the start."""
        self._time = 0.0
        self._unit.reset()
        self._unit.setupExperiment(startTime=0.0)
        self._unit.enterInitializationMode()
        self._unit.exitInitializationMode()
        return np.array(self._unit.getReal(self._given[:3]))

    def step(self, until: float, place: FloatArray, speed: FloatArray, slope: FloatArray) -> FloatArray:
        """Lead the ring."""
        self._unit.setReal(self._given, [*place, *speed, *slope])
        try:
            self._unit.doStep(self._time, until - self._time)
        except Exception as error:  # FMPy has one kind for all
            raise SolverError(str(error)) from None
        self._time = until
        return np.array(self._unit.getReal(self._answer))


def hosted(scheme: Scheme, step: float, bearing: PrescribedBearing, tolerance: float) -> Path:
    """Return the path of the rotor that a host owns."""
    ring = api.check(CASE, changes(tolerance)).inner_ring
    axial = sum(term.values[0] for term in ring.force[0].terms)  # the load of the case [N]
    rest, mass = np.array([axial, 0.0, 0.0]), ring.mass
    x = bearing.begin()
    v, reaction = np.zeros(3), -rest
    places, worked, flow, leak = [x], 0.0, 0.0, 0.0
    for k in range(round(END / step)):
        pushed = rest + load(k * step)
        a = (reaction + pushed) / mass
        velocity, slope = scheme.lead(v, a, step)
        before, reaction = reaction, bearing.step((k + 1) * step, x, velocity, slope)
        moved = step * (velocity + 0.5 * step * slope)
        x, v = x + moved, scheme.speed(v, a, (reaction + pushed) / mass, step)
        places.append(x)
        through = float((0.5 * (before + reaction) + rest) @ moved)
        worked += through + float(load(k * step) @ moved)
        flow += abs(through)
        leak = max(leak, abs(0.5 * mass * float(v @ v) - worked))
    return Path(np.array(places), leak / flow)


def error(path: Path, reference: Path, step: float, finest: float) -> float:
    """Return the relative distance of two paths [-].

    Largest distance over the largest way of the reference.
    """
    every = round(step / finest)
    ahead = reference.places[every::every]
    way = np.linalg.norm(ahead - ahead[0], axis=1).max()
    return float(np.linalg.norm(path.places[1:] - ahead, axis=1).max() / way)


def study(
    steps: Sequence[float] = STEPS, tolerance: float = 1e-4, bearing: PrescribedBearing | None = None
) -> Iterator[tuple[str, float, float, float]]:
    """Yield (scheme, step [s], error, leak).

    Of every step; where the coupling breaks down, infinite.
    """
    reference, bearing = inside(COMMON, tolerance), bearing or FromProgram(tolerance)
    for name, scheme in SCHEMES.items():
        for step in steps:
            try:
                path = hosted(scheme, step, bearing, tolerance)
            except SolverError:
                yield name, step, math.inf, math.inf
                continue
            yield name, step, error(path, reference, step, COMMON), path.leak


def main(tolerance: float = 1e-4) -> int:
    """Print the study; returns the exit code."""
    folder = tempfile.TemporaryDirectory(prefix="lambda-bearing-")
    bearing = FromUnit(tolerance, folder.name) if "--fmu" in sys.argv else FromProgram(tolerance)
    print("| host | communication step [us] | displacement, off by [%] | energy of the coupling, off by |")
    print("|---|---|---|---|")
    for name, step, off, leak in study(tolerance=tolerance, bearing=bearing):
        print(f"| {name} | {1e6 * step:g} | {100.0 * off:.3g} | {leak:.2g} |", flush=True)
    folder.cleanup()
    return 0


if __name__ == "__main__":
    sys.exit(main())
