"""Simulate an FMU of a bearing in OMSimulator 3.

``python bearing_in_omsimulator.py FMU``: by force, with an external push.
"""

from __future__ import annotations

import sys

from OMSimulator import SSP, CRef, Settings


def push(file: str, force: float, end: float = 0.01) -> float:
    """Return the inner ring's place [m].

    After a push along z.
    """
    Settings.suppressPath = True
    model = SSP()
    model.addResource(file, new_name="resources/bearing.fmu")
    model.addComponent(CRef("default", "bearing"), "resources/bearing.fmu")
    model.setValue(CRef("default", "bearing", "inner_ring.force_z"), force)
    running = model.instantiate()
    running.setStopTime(end)
    running.initialize()
    running.simulate()
    found = float(running.getValue(CRef("default", "bearing", "inner_ring.z")))
    running.terminate()
    running.delete()
    return found


if __name__ == "__main__":
    print(push(sys.argv[1], -250.0))
