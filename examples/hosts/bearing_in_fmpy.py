"""Simulate an FMU of a bearing by force in FMPy.

``python bearing_in_fmpy.py FMU``: at two oil temperatures.

The FMU: ``lambda-bearing export fmu 6208-axial-1300 --vary "lubricant.temperature=20..90 degC"``.
"""

from __future__ import annotations

import sys
from typing import Any

from fmpy import simulate_fmu

WATCHED = ["inner_ring.x", "bearing.friction_torque", "bearing.film_minimum"]


def at(file: str, temperature: float, end: float = 0.02) -> Any:
    """Return the outputs over time at an oil temperature [K]."""
    values = {"lubricant.temperature": temperature}
    return simulate_fmu(file, stop_time=end, step_size=1e-4, output_interval=1e-4, start_values=values, output=WATCHED)


def main() -> None:
    """Print the last values."""
    for celsius in (40.0, 55.0):
        last = at(sys.argv[1], celsius + 273.15)[-1]
        print(f"{celsius:.0f} degC", *(f"{name} {last[name]:.6g}" for name in WATCHED), sep="  ")


if __name__ == "__main__":
    main()
