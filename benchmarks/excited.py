"""Run the 6220 through its transition under growing excitation.

The speed is constant; ball speeds by azimuth before and after.

``python -m benchmarks.excited [--write]`` prints or writes the page and its figure; tests/syla2026/test_excited.py
looks at the same run.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from lambda_syla2026.boundary import CASE
from lambda_syla2026.stability import static_zone
from numpy.typing import NDArray

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.kinematics import cage_speed
from lambda_core.results.reader import Result

DOCS = Path(__file__).parents[1] / "docs"
PAGE, FIGURE = DOCS / "excitation.md", DOCS / "images" / "excited-6220.svg"
FREQUENCY, PEAK = 44.0, 40.0  # of the excitation [Hz], its largest acceleration [m/s2]
REST, GROWTH = 0.5, 1.6  # [s]: five cage turns without excitation, then it grows in proportion to time
DISCARDED, WINDOW = 0.1, 0.4  # at the start, for averages [s]: one cage turn, four
_PER_PERIOD = 32  # points of the tabulated motion
SECTOR = 30  # [deg]


@dataclass(frozen=True)
class Window:
    """Ball speeds in one stretch of the run."""

    begin: float  # [s]
    acceleration: float  # mean amplitude of the excitation [m/s2]
    by_azimuth: FloatArray  # mean of orbital over kinematic speed, less 1, in sectors from +y towards +z
    outside: float  # its mean outside the static load zone
    inside: float  # and inside
    pressed: float  # share of time in which the inner ring presses balls outside the static load zone


def changes() -> tuple[str, ...]:
    """Return the changes of the case.

    The outer ring's motion is a table, still at first, then growing.
    """
    omega = 2.0 * math.pi * FREQUENCY
    time = np.arange(round((REST + GROWTH) * FREQUENCY * _PER_PERIOD) + 1) / (FREQUENCY * _PER_PERIOD)
    share = np.clip((time - REST) / GROWTH, 0.0, 1.0)
    place = 1e6 * share * PEAK / omega**2 * np.sin(omega * (time - REST))
    points = ", ".join(f'["{t:.6f} s", "{x:.4f} um"]' for t, x in zip(time, place, strict=True))
    motion = f'{{ kind = "table", interpolation = "spline", points = [{points}] }}'  # a sine: its acceleration counts
    return (
        f'bodies.outer_ring.x={{ mode = "prescribed", motion = {motion} }}',
        f"solver.duration={REST + GROWTH} s",
    )


def windows(result: Result) -> list[Window]:
    """Return the ball speeds in stretches.

    Before the excitation, and while it grows.
    """
    starts = [DISCARDED, *np.arange(REST, REST + GROWTH - 0.9 * WINDOW, WINDOW)]
    return [_window(result, float(start)) for start in starts]


def _window(result: Result, begin: float) -> Window:
    time = result["time"]
    rows = (time >= begin) & (time < begin + WINDOW)
    azimuth, load = result["ball_azimuth"][rows], result["load"][rows][:, :, 0]
    ratio = _over_kinematic(result, rows) - 1.0
    outside = static_zone(result).outside(azimuth)
    sector = (np.degrees(azimuth) % 360.0 // SECTOR).astype(int)
    means = np.array([ratio[sector == k].mean() for k in range(360 // SECTOR)])
    growth = np.clip((time[rows] - REST) / GROWTH, 0.0, 1.0).mean()
    return Window(
        begin, PEAK * float(growth), means, float(ratio[outside].mean()), float(ratio[~outside].mean()),
        float((load[outside] > 0.0).mean()),
    )  # fmt: skip


def _over_kinematic(result: Result, rows: NDArray[np.bool_]) -> FloatArray:
    """Return orbital speed over that without slip.

    At no contact angle, shape (time, ball).
    """
    geometry = result.model["geometry"]
    gamma = geometry["ball_diameter"] / geometry["pitch_diameter"]
    spin = result["body_spin"][rows]
    kinematic = cage_speed(float(spin[:, 0].mean()), float(spin[:, 1].mean()), gamma)
    ratio: FloatArray = result["ball_velocity"][rows][:, :, 2] / result["ball_radius"][rows] / kinematic
    return ratio


_TEXT = f"""# Axial excitation of a 6220

This page is an example of [motions over time](run.md#loads-and-speeds-over-time), for readers of the paper. Above a
limit of axial excitation the balls outside the load zone leave the speed that they have without it (Syla et al. 2026,
Fig. 5 and 6). Here one run goes through it: the built-in case `{CASE}`, 5 kN radial, 1500 1/min throughout,
the outer ring still for {REST} s, then shaken at {FREQUENCY:g} Hz with an amplitude that grows to {PEAK:g} m/s2 within
{GROWTH} s. Written by `python -m benchmarks.excited --write`.

![Ball speed over azimuth before and after](images/{FIGURE.name})

Mean of orbital over kinematic speed, less 1, in sectors of {SECTOR} degrees; the load acts at 270 degrees.

"""
_AFTER = """
Before, balls outside the load zone touch the outer ring alone and are up to 1.3 % faster than they roll inside it.
While the excitation grows, the inner ring presses them part of the time and drives them near kinematic speed: the
profile becomes flat. Inside the load zone hardly anything changes. The paper's criteria, and the boundary over
frequency and load, are on [the page on validation](validation.md#fig-5-altered-running-of-the-6220).

The shaft does not tilt in this case: the paper's rig has a shaft in a bearing system, which cannot rock about the
loaded balls of one bearing as a lone ring would.
"""


def table(found: Sequence[Window]) -> str:
    """Return the table of the page."""
    head = [f"{k * SECTOR}..{(k + 1) * SECTOR}" for k in range(360 // SECTOR)]
    lines = [
        "| from | excitation | outside the zone | inside | pressed outside | " + " | ".join(head) + " |",
        "|" + "---|" * (5 + len(head)),
    ]
    for one in found:
        cells = " | ".join(f"{100.0 * value:+.2f}" for value in one.by_azimuth)
        lines.append(
            f"| {one.begin:.1f} s | {one.acceleration:.0f} m/s2 | {100.0 * one.outside:+.2f} % | "
            f"{100.0 * one.inside:+.2f} % | {100.0 * one.pressed:.1f} % of time | {cells} |"
        )
    return "\n".join(lines) + "\n"


def draw(found: Sequence[Window], path: Path) -> None:
    """Draw the profiles before and after."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "lambda-bearing"
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 3.4), layout="constrained")
    axes = figure.add_subplot()
    middle = SECTOR * (np.arange(360 // SECTOR) + 0.5)
    for one, style in ((found[0], "o-"), (found[len(found) // 2], "^--"), (found[-1], "s-")):
        label = f"{one.acceleration:.0f} m/s²" if one.acceleration else "not shaken"
        axes.plot(middle, 100.0 * one.by_azimuth, style, label=label)
    axes.set_xlabel("azimuth (degrees)")
    axes.set_ylabel("orbital over kinematic speed − 1 (%)")
    axes.set_xticks(range(0, 361, 90))
    axes.grid(alpha=0.3)
    axes.legend(title="axial excitation")
    figure.savefig(path, metadata={"Date": None})


def main(arguments: Sequence[str] | None = None) -> int:
    """Run, then print the table or write page and figure."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.excited", description=__doc__)
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.name} and its figure")
    wanted = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        found = windows(api.run(CASE, changes(), out=Path(folder) / "r.h5"))
    if wanted.write:
        PAGE.write_text(_TEXT + table(found) + _AFTER, encoding="utf-8")
        draw(found, FIGURE)
    else:
        print(table(found), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
