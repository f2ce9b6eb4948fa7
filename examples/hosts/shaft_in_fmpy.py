"""Push an FMU of a shaft in FMPy.

``python shaft_in_fmpy.py FMU`` draws shaft-fmu.png.

It needs FMPy and Matplotlib: ``pip install fmpy matplotlib``.
The FMU: ``lambda-bearing init box --template geared-shaft``, then ``lambda-bearing export fmu box.toml``.
"""

from __future__ import annotations

import sys
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from fmpy import simulate_fmu

STEP, END, PUSH = 1e-4, 0.03, (0.005, 0.02)  # [s]
FORCE = -2000.0  # at the gear, vertical [N]
WATCHED = [
    "gears.wheel.z", "bearings.left.reaction_force_z", "bearings.right.reaction_force_z",
    "bearings.left.film_minimum", "bearings.right.film_minimum", "machine.friction_torque",
]  # fmt: skip


def pushed(file: str, end: float = END) -> Any:
    """Return the outputs after a push.

    Over time, at the gear between two times.
    """
    times = np.arange(0.0, end + STEP, STEP)
    pushes = np.where((times >= PUSH[0]) & (times < PUSH[1]), FORCE, 0.0)
    given = np.array(list(zip(times, pushes, strict=True)), dtype=[("time", "f8"), ("gears.wheel.force_z", "f8")])
    return simulate_fmu(file, stop_time=end, step_size=STEP, output_interval=STEP, input=given, output=WATCHED)


def draw(found: Any, file: str) -> None:
    """Draw forces, gear and films over time."""
    figure, axes = plt.subplots(3, 1, figsize=(8.0, 7.0), sharex=True, layout="constrained")
    time = 1e3 * found["time"]
    for name, colour in (("left", "tab:blue"), ("right", "tab:orange")):
        axes[0].plot(time, 1e-3 * found[f"bearings.{name}.reaction_force_z"], color=colour, label=name)
        axes[2].plot(time, 1e6 * found[f"bearings.{name}.film_minimum"], color=colour, label=name)
    axes[1].plot(time, 1e6 * found["gears.wheel.z"], color="black")
    axes[0].set_ylabel("force on shaft, vertical [kN]")
    axes[1].set_ylabel("gear, vertical [um]")
    axes[2].set_ylabel("smallest film [um]")
    axes[2].set_xlabel("time [ms]")
    for axis in axes:
        axis.axvspan(1e3 * PUSH[0], 1e3 * PUSH[1], color="0.92")
        axis.grid(visible=True, color="0.85", linewidth=0.5)
    axes[0].legend(title="bearing")
    figure.savefig(file, dpi=110)


def main() -> None:
    """Simulate, draw and print the last values."""
    found = pushed(sys.argv[1])
    draw(found, "shaft-fmu.png")
    print(*(f"{name} {found[-1][name]:.6g}" for name in WATCHED), sep="\n")


if __name__ == "__main__":
    main()
