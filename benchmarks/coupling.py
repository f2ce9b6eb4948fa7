"""``python -m benchmarks.coupling``: a rigid rotor in a host on one bearing, against the same mass inside the bearing.

The host knows mass and load of the rotor and leads the inner ring (``couple="motion"``); the bearing answers with its
reaction. A push begins after about a millisecond and stays. Reference is the bearing that owns the ring, with the same
mass.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

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
_COMMON = 4e-6  # [s] between points of the reference
_AXES = "xyz"


def changes(tolerance: float) -> list[str]:
    """Return what the case is changed to: a free rotor without tilt, in no field of gravity."""
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
    """Where the rotor was.

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
    """What a host does in a step h with the rotor's speed v, its acceleration a at the beginning and b at the end.

    Attributes
    ----------
    lead : function
        (v, a, h) -> speed and acceleration that the ring is led with.
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


def hosted(scheme: Scheme, step: float, tolerance: float) -> Path:
    """Return the path of the rotor that a host owns."""
    bearing = api.iterate(CASE, changes(tolerance), exact=True, couple="motion")
    ring = bearing.model.inner_ring
    axial = sum(term.values[0] for term in ring.force[0].terms)  # the load of the case [N]
    rest, mass = np.array([axial, 0.0, 0.0]), ring.mass
    x = np.array([ring.dofs[axis].motion.terms[0].values[0] for axis in _AXES])
    v, reaction = np.zeros(3), -rest
    places, worked, flow, leak = [x], 0.0, 0.0, 0.0
    for k in range(round(END / step)):
        pushed = rest + load(k * step)
        a = (reaction + pushed) / mass
        led, slope = scheme.lead(v, a, step)
        for i, axis in enumerate(_AXES):
            bearing.give(f"inner_ring.{axis}", x[i], led[i], slope[i])
        before, reaction = reaction, bearing.step_to((k + 1) * step).reactions["inner_ring"][:3]
        moved = step * (led + 0.5 * step * slope)
        x, v = x + moved, scheme.speed(v, a, (reaction + pushed) / mass, step)
        places.append(x)
        through = float((0.5 * (before + reaction) + rest) @ moved)
        worked += through + float(load(k * step) @ moved)
        flow += abs(through)
        leak = max(leak, abs(0.5 * mass * float(v @ v) - worked))
    return Path(np.array(places), leak / flow)


def error(path: Path, reference: Path, step: float, finest: float) -> float:
    """Return the largest distance of two paths over the largest way of the reference [-]."""
    every = round(step / finest)
    ahead = reference.places[every::every]
    way = np.linalg.norm(ahead - ahead[0], axis=1).max()
    return float(np.linalg.norm(path.places[1:] - ahead, axis=1).max() / way)


def study(steps: Sequence[float] = STEPS, tolerance: float = 1e-4) -> Iterator[tuple[str, float, float, float]]:
    """Yield (scheme, step [s], error, leak) of every step; where the coupling breaks down, infinite."""
    reference = inside(_COMMON, tolerance)
    for name, scheme in SCHEMES.items():
        for step in steps:
            try:
                path = hosted(scheme, step, tolerance)
            except SolverError:
                yield name, step, math.inf, math.inf
                continue
            yield name, step, error(path, reference, step, _COMMON), path.leak


def main() -> int:
    """Print the study; returns the exit code."""
    print("| host | communication step [us] | displacement, off by [%] | energy of the coupling, off by |")
    print("|---|---|---|---|")
    for name, step, off, leak in study():
        print(f"| {name} | {1e6 * step:g} | {100.0 * off:.3g} | {leak:.2g} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
