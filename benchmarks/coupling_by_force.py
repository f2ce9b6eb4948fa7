"""Couple a bearing that owns its ring to a host.

``python -m benchmarks.coupling_by_force``: a spring of the host holds the ring.

The host knows the stiffness of a support and puts its force on the ring (``couple="force"``), one number per step.
Reference is the bearing with the same support of its own. A push of the case of ``benchmarks.coupling``.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from benchmarks.coupling import CASE, COMMON, PUSH, PUSHED_AT
from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.runs.stepping import Stepping

END = 3.84e-3  # [s]
STEPS = (160e-6, 80e-6, 40e-6, 20e-6, 8e-6, 4e-6)  # [s]
STIFFNESSES = (1e6, 1e7, 1e8, 1e9)  # [N/m]; the bearing has some 1e8


def changes(stiffness: float = 0.0) -> tuple[str, ...]:
    """Return the changes of the case.

    A rotor of 2 kg that moves along z alone, on a support of its own or none.
    """
    return (
        f"solver.duration={END} s",
        "solver.accuracy=vibration",
        "solver.tolerance=1e-4",
        "bodies.inner_ring.shaft_mass=2 kg",
        "bodies.inner_ring.tilt_y.mode=locked",
        "bodies.inner_ring.tilt_z.mode=locked",
        "gravity.z=0 m/s2",
        f"bodies.inner_ring.z.stiffness={stiffness} N/m",
    )


def force(scheme: str, stiffness: float, bearing: Stepping, pushed: float, step: float, z: float, v: float) -> float:
    """Return the host's force on the ring [N].

    In a step, where it stands at z [m] with the speed v [m/s].
    """
    if scheme == "held":
        return pushed - stiffness * z
    if scheme == "ahead":
        return pushed - stiffness * (z + 0.5 * step * v)
    begin, end = bearing.state(), z + step * v
    for _ in range(4):  # repeated: with the mean of both ends
        mean = pushed - 0.5 * stiffness * (z + end)
        bearing.give("inner_ring.force_z", mean)
        end = float(bearing.step_to(bearing.time_s + step)["body_position"][0, 2])
        bearing.restore(begin)
    return mean


def path(step: float, host: Callable[..., float], stiffness: float = 0.0) -> FloatArray:
    """Return heights of the ring at the communication points [m]."""
    bearing = api.iterate(CASE, changes(stiffness), exact=True)
    z, speed, found = 0.0, 0.0, []
    for k in range(round(END / step)):
        pushed = PUSH[2] if k * step >= PUSHED_AT - 1e-12 else 0.0
        bearing.give("inner_ring.force_z", host(bearing, pushed, step, z, speed))
        at = bearing.step_to((k + 1) * step)
        z, speed = float(at["body_position"][0, 2]), float(at["body_velocity"][0, 2])
        if abs(z) > 1e-3:
            raise SolverError("the ring leaves the bearing")
        found.append(z)
    return np.array(found)


def study(
    stiffnesses: Sequence[float] = STIFFNESSES, steps: Sequence[float] = STEPS
) -> Iterator[tuple[str, float, float, float]]:
    """Yield (scheme, stiffness [N/m], step [s], error).

    The error is over the largest way [-]; where it breaks down, infinite.
    """
    for stiffness in stiffnesses:
        reference = path(COMMON, lambda bearing, pushed, *_: pushed, stiffness)
        way = np.abs(reference).max()
        for scheme in ("held", "ahead", "repeated"):
            for step in steps:
                host = partial(force, scheme, stiffness)
                every = round(step / COMMON)
                try:
                    off = np.abs(path(step, host) - reference[every - 1 :: every]).max() / way
                except SolverError:
                    off = math.inf
                yield scheme, stiffness, step, float(off)


def main() -> int:
    """Print the study; returns the exit code."""
    print("| stiffness [N/um] | force | step [us] | displacement, off by [%] |")
    print("|---|---|---|---|")
    for scheme, stiffness, step, off in study():
        print(f"| {1e-6 * stiffness:g} | {scheme} | {1e6 * step:g} | {100.0 * off:.3g} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
