"""Simulate a rigid rotor on two bearings in Exudyn.

The bearings are its force elements.

``python rotor_in_exudyn.py [FMU]``: with bearings from Python, or from an FMU of the same case. For Exudyn 1.13
or later.

The FMU: ``lambda-bearing export fmu 6208-axial-1300 --couple motion --set loads.axial="0 N" --set loads.radial="98.1 N"
--set gravity.z="0 m/s2" --set solver.duration="1 s" --set solver.accuracy=vibration --set solver.tolerance=1e-4``.
One of another case begins elsewhere, and the rotor falls into its bearings.

Exudyn's trapezoidal rule moves a body in a step by the mean of its speeds at both ends, which is a motion at constant
acceleration. The ring has this motion as a prescribed one, and ends at the position and speed of Exudyn's shaft. As
often as the rule looks for the force at the end of a step, the bearing takes that step from its saved state anew.

The rotor does not spin in Exudyn: the bearings know the speed, gyroscopic moments are left out.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from prescribed_bearing import FromPython, FromUnit

MASS, LENGTH = 20.0, 0.3  # [kg], [m] between the bearings
CASE = "6208-axial-1300"
CHANGES = (
    "loads.axial=0 N",
    f"loads.radial={0.5 * MASS * 9.81} N",
    "gravity.z=0 m/s2",
    "solver.duration=1 s",
    "solver.accuracy=vibration",
    "solver.tolerance=1e-4",
)
STEP, END = 2e-5, 4e-3  # [s]
PUSH, PUSHED_AT, PUSHED_IN = -400.0, 1e-3, 0.2e-3  # [N], [s]: it grows to its full size


def push(time: float) -> float:
    """Return the vertical push on the rotor [N].

    Its weight is not included.
    """
    return PUSH * min(max((time - PUSHED_AT) / PUSHED_IN, 0.0), 1.0)


class Element:
    """Bearing as a force element.

    The force at the end of a step, as often as it is asked for.
    """

    def __init__(self, bearing: Any) -> None:
        self._bearing, self._state = bearing, bearing.save()
        self.pose, self._rate = np.array(bearing.pose), np.zeros(5)
        self._begin = bearing.time
        self.reaction = self.force(self._begin + 1e-9, self._rate)

    def force(self, time: float, rate: Any) -> Any:
        """Return force [N] and moment [N m].

        On the shaft at a time, where it has the rate.
        """
        step = time - self._begin
        if step > 0.0:
            self._bearing.back_to(self._state)
            self.reaction = self._bearing.step(time, self.pose, self._rate, (rate - self._rate) / step)
        return self.reaction

    def accept(self, time: float, pose: Any, rate: Any) -> None:
        """End a step at this pose and rate.

        They are those of the shaft.
        """
        self.force(time, rate)
        self._bearing.forget(self._state)
        self.pose, self._rate, self._begin, self._state = pose, rate, time, self._bearing.save()


@dataclass(frozen=True)
class Path:
    """Path of the rotor at step ends.

    Attributes
    ----------
    time : float64[:]
        [s]
    places, speeds : float64[:, :], shape (n, 3)
        Of its centre [m], [m/s].
    reactions : float64[:, :, :], shape (n, 2, 6)
        Force [N] and moment [N m] of the bearings on it.
    """

    time: Any
    places: Any
    speeds: Any
    reactions: Any


def rotor(make: Callable[[], Any], end: float = END, step: float = STEP) -> Path:
    """Return the path of a pushed rotor.

    The push is half-way down its shaft; `make` gives a bearing.
    """
    import exudyn as exu
    import exudyn.itemInterface as items

    container = exu.SystemContainer()
    mbs = container.AddSystem()
    bearings = [make(), make()]
    elements = [Element(bearing) for bearing in bearings]
    start = bearings[0].pose
    across = MASS * LENGTH**2 / 12.0
    node = mbs.AddNode(items.NodeRigidBodyRotVecLG(referenceCoordinates=[*start[:3], 0, 0, 0]))
    inertia = [1e-3 * MASS, across, across, 0, 0, 0]
    body = mbs.AddObject(items.ObjectRigidBody(mass=MASS, inertia=inertia, nodeNumber=node))
    ground = mbs.AddObject(items.ObjectGround())
    places = ([-0.5 * LENGTH, 0, 0], [0.5 * LENGTH, 0, 0])
    for element, place in zip(elements, places, strict=True):
        ends = [(ground, [place[0] + start[0], 0, 0]), (body, place)]
        markers = [mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=b, localPosition=list(p))) for b, p in ends]
        mbs.AddObject(items.ObjectConnectorRigidBodySpringDamper(
            markerNumbers=markers, useIntrinsicFormulation=False, springForceTorqueUserFunction=answer(element),
        ))  # fmt: skip
    middle = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, 0]))
    weight = -MASS * 9.81
    mbs.AddLoad(items.LoadForceVector(
        markerNumber=middle,
        loadVectorUserFunction=lambda mbs, time, load: [0.0, 0.0, weight + push(time)],
    ))  # fmt: skip
    mbs.Assemble()
    kind, path = exu.OutputVariableType, []

    def look(time: float) -> None:
        where, speed = (mbs.GetObjectOutputBody(body, each, [0, 0, 0]) for each in (kind.Position, kind.Velocity))
        path.append((time, where, speed, [element.reaction for element in elements]))

    def accept(mbs: Any, time: float) -> bool:
        """Move the bearings to the step's end.

        The shaft is there.
        """
        for element, place in zip(elements, places, strict=True):
            where, turned = (mbs.GetObjectOutputBody(body, each, place) for each in (kind.Position, kind.Rotation))
            speed = mbs.GetObjectOutputBody(body, kind.Velocity, place)
            turning = mbs.GetObjectOutputBody(body, kind.AngularVelocity, place)
            element.accept(time, np.array([*(where - [place[0], 0, 0]), *turned[1:]]), np.array([*speed, *turning[1:]]))
        look(time)
        return True

    mbs.SetPostStepUserFunction(accept)  # it is called at the start, too
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps, settings.timeIntegration.endTime = round(end / step), end
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.TrapezoidalIndex2)
    return Path(*map(np.array, zip(*path, strict=True)))


def answer(element: Element) -> Callable[..., list[float]]:
    """Return Exudyn's function of a connector.

    Its force pulls its ends together.
    """

    def force(mbs: Any, time: float, item: int, *seen: Any) -> list[float]:
        _, _, speed, turning, *_ = seen  # behind displacement and rotation
        found: list[float] = (-element.force(time, np.array([*speed, *turning[1:]]))).tolist()
        return [*found[:3], 0.0, *found[4:]]

    return force


def main() -> None:
    """Print where the rotor is."""
    file = sys.argv[1] if len(sys.argv) > 1 else ""
    path = rotor(lambda: FromUnit(file) if file else FromPython(CASE, CHANGES))
    for time, place in zip(path.time[::10], path.places[::10], strict=True):
        print(f"{1e3 * time:7.3f} ms {1e6 * place[2]:9.4f} um")


if __name__ == "__main__":
    main()
