"""A rigid rotor on two bearings in Exudyn; the bearings are force elements, led by the rotor.

``python rotor_in_exudyn.py [FMU]``: with bearings from Python, or from an FMU exported with ``--couple motion``.

In a step the rings move on with the rotor's speed and its acceleration in the step before; the rotor then takes the
mean of the reactions at both ends. The rotor does not spin in Exudyn: the bearings know the speed, gyroscopic moments
are left out.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
from led_bearing import FromPython, FromUnit

MASS, LENGTH = 20.0, 0.3  # [kg], [m] between the bearings
CASE = "6208-axial-1300"
CHANGES = ("loads.axial=0 N", f"loads.radial={0.5 * MASS * 9.81} N", "solver.duration=1 s", "gravity.z=0 m/s2")
STEP, END, PUSHED_AT, PUSH = 1e-5, 4e-3, 1e-3, -400.0  # [s, s, s, N]


def rotor(make: Callable[[], Any], end: float = END, step: float = STEP) -> Any:
    """Return times [s] and heights of the rotor's centre [m], shape (n, 2); half-way down the shaft it is pushed."""
    import exudyn as exu
    from exudyn.itemInterface import (
        LoadForceVector,
        LoadTorqueVector,
        MarkerBodyRigid,
        NodeRigidBodyRotVecLG,
        ObjectRigidBody,
    )

    bearings = [make(), make()]
    start = bearings[0].pose
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    across = MASS * LENGTH**2 / 12.0
    node = mbs.AddNode(NodeRigidBodyRotVecLG(referenceCoordinates=[*start[:3], 0, 0, 0]))
    inertia = [1e-3 * MASS, across, across, 0, 0, 0]
    body = mbs.AddObject(ObjectRigidBody(physicsMass=MASS, physicsInertia=inertia, nodeNumber=node))
    places = ([-0.5 * LENGTH, 0, 0], [0.5 * LENGTH, 0, 0])
    markers = [mbs.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=place)) for place in (*places, [0, 0, 0])]
    forces = [mbs.AddLoad(LoadForceVector(markerNumber=marker)) for marker in markers]
    moments = [mbs.AddLoad(LoadTorqueVector(markerNumber=marker)) for marker in markers[:2]]
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = 1
    settings.timeIntegration.generalizedAlpha.computeInitialAccelerations = True
    settings.timeIntegration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    kind = exu.OutputVariableType

    def at(place: list[float]) -> tuple[Any, Any]:
        """Return pose and rates of the shaft at a place."""
        found = [mbs.GetObjectOutputBody(body, each, place) for each in (kind.Position, kind.Rotation)]
        rates = [mbs.GetObjectOutputBody(body, each, place) for each in (kind.Velocity, kind.AngularVelocity)]
        where = found[0] - np.array([place[0], 0.0, 0.0])
        return np.array([*where, *found[1][1:]]), np.array([*rates[0], *rates[1][1:]])

    before = [at(place)[1] for place in places]
    reaction = [np.array([0.0, 0.0, 0.5 * MASS * 9.81, 0.0, 0.0, 0.0])] * 2
    path = [(0.0, float(at([0, 0, 0])[0][2]))]
    for k in range(round(end / step)):
        time = k * step
        for i, place in enumerate(places):
            pose, rate = at(place)
            found = bearings[i].step(time + step, pose, rate, (rate - before[i]) / step)
            mean, before[i], reaction[i] = 0.5 * (reaction[i] + found), rate, found
            mbs.SetLoadParameter(forces[i], "loadVector", mean[:3].tolist())
            mbs.SetLoadParameter(moments[i], "loadVector", mean[3:].tolist())
        pushed = PUSH if time >= PUSHED_AT - 1e-12 else 0.0
        mbs.SetLoadParameter(forces[2], "loadVector", [0.0, 0.0, pushed - MASS * 9.81])
        settings.timeIntegration.startTime, settings.timeIntegration.endTime = time, time + step
        mbs.SolveDynamic(settings, updateInitialValues=True)
        path.append((time + step, float(at([0, 0, 0])[0][2])))
    return np.array(path)


def main() -> None:
    """Print where the rotor is."""
    file = sys.argv[1] if len(sys.argv) > 1 else ""
    path = rotor(lambda: FromUnit(file) if file else FromPython(CASE, CHANGES))
    for time, height in path[::20]:
        print(f"{1e3 * time:7.3f} ms {1e6 * height:9.4f} um")


if __name__ == "__main__":
    main()
