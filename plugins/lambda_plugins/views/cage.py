"""Draw orbit, whirl and pocket forces of the cage."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.plugins import Axis, FloatArray, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_core.results.rolling import ROLLING, rolling_of
from lambda_plugins.views.azimuth import AZIMUTH
from lambda_plugins.views.common import BODY, Span, averaging, number, over_azimuth, require_cage, source, speeds, trace

_SMALL = 0.5  # of the clearance: an orbit below is shown once more, enlarged
_WHIRL_WINDOW = 0.1  # cage revolutions over which the whirl speed is averaged


def _guide(run: RunData) -> tuple[int, float, str]:
    """Return the guide of the cage and its clearance.

    The body, the free radius [m] (NaN if unknown) and its name.
    """
    cage = run.model["cage"]
    if cage["guidance"] == "ball":
        return BODY["outer"], 0.5 * number(cage["pocket_clearance"]), "pocket clearance"
    ring = "inner" if cage["guidance"] == "inner ring" else "outer"
    return BODY[ring], 0.5 * number(cage["land_clearance"]), f"clearance at the {ring} land"


def _circle(radius: float) -> tuple[FloatArray, FloatArray]:
    angle = np.linspace(0.0, 2.0 * math.pi, 181)
    return radius * np.cos(angle), radius * np.sin(angle)


def cage_orbit(run: RunData, options: Options) -> ViewData:
    """Show path, whirl and speed of the cage.

    The whirl speed is over the cage speed, and the cage speed over that of rolling.
    """
    require_cage(run)
    span = averaging(run)
    rows = span.rows(run["time"])
    time, spin = run["time"][rows], run["body_spin"][rows, BODY["cage"]]
    body, radius, name = _guide(run)
    position = run["body_position"][rows]
    away = 1e6 * (position[:, BODY["cage"], 1:] - position[:, body, 1:])
    path = trace("centre of the cage", away[:, 0], away[:, 1], "cage")
    end = Series("end state", away[-1:, 0], away[-1:, 1], "points", "total")
    series = [path, end]
    close = _close_up(path, end, 1e6 * radius)
    if math.isfinite(radius):
        series.append(Series(name, *_circle(1e6 * radius), "line", "reference"))
    kinematic = _rolling(run, span)
    if kinematic == 0.0:
        raise NotApplicable("the rings stand still: the cage has no speed to compare with")
    ratio = trace("cage speed", 1e3 * time, spin / kinematic, "cage")
    whirl = _whirl(time, away, spin)
    panels = (
        Panel("orbit of the centre", Axis("y", "um"), Axis("z", "um"), tuple(series), shape="plane"),
        *close,
        Panel("whirl", Axis("time", "ms"), Axis("whirl speed over cage speed"), whirl, (Mark("in step", 1.0),)),
        Panel("cage speed", Axis("time", "ms"), Axis("over speed of rolling"), (ratio,), (Mark("no slip", 1.0),)),
    )
    notes = (
        f"over {span.words}; relative to the {'inner' if body == 0 else 'outer'} ring",
        f"whirl: angular speed of the cage's centre round the axis, means over {_WHIRL_WINDOW:g} cage revolutions",
        f"cage speed of rolling {kinematic * 30.0 / math.pi:.5g} rpm",
    )
    return ViewData("cage-orbit", "Orbit and whirl of the cage", source(run), panels, 2, notes)


def _rolling(run: RunData, span: Span) -> float:
    """Return the cage speed at which loaded elements roll [rad/s].

    Without load it is the kinematic one.
    """
    rows, mean = span.rows(run["time"]), speeds(run, span)
    samples = {name: run[name][rows] for name in ROLLING}
    ratio = rolling_of(samples, run.model["geometry"], are_rollers=run.model.get("rollers") is not None)
    return mean.outer + ratio * (mean.inner - mean.outer) if math.isfinite(ratio) else mean.cage


def _close_up(path: Series, end: Series, radius: float) -> tuple[Panel, ...]:
    """Return the orbit alone where it is small.

    It counts as small relative to the circle [um] of the clearance.
    """
    size = max(float(np.ptp(path.x)), float(np.ptp(path.y)))
    if not math.isfinite(radius) or size > _SMALL * 2.0 * radius:
        return ()
    return (
        Panel("orbit, close up", Axis("y", "um", least=0.01), Axis("z", "um", least=0.01), (path, end), shape="plane"),
    )


def _whirl(time: FloatArray, away: FloatArray, spin: FloatArray) -> tuple[Series, ...]:
    """Return the relative whirl speed of the cage.

    It is relative to the cage's own speed and averaged over a tenth of a revolution.
    """
    angle = np.unwrap(np.arctan2(away[:, 1], away[:, 0]))
    turned = np.abs(np.concatenate([[0.0], np.cumsum(0.5 * (spin[1:] + spin[:-1]) * np.diff(time))])) / (2.0 * math.pi)
    edges = np.arange(0.0, turned[-1], _WHIRL_WINDOW)
    if edges.size < 3:
        raise NotApplicable("the run is too short for the whirl of the cage: simulate longer")
    at = np.interp(edges, turned, time)
    orbit, cage = np.diff(np.interp(at, time, angle)), 2.0 * math.pi * np.diff(edges)
    return (
        Series("whirl of the cage", 0.5e3 * (at[1:] + at[:-1]), orbit / cage * np.sign(spin.mean()), "line", "cage"),
    )


def pocket_forces(run: RunData, options: Options) -> ViewData:
    """Show forces on the cage over azimuth and time.

    They are the forces of the balls and of the lands.
    """
    require_cage(run)
    span = averaging(run)
    rows = span.rows(run["time"])
    force = run["pocket_force"]
    along, size = force[:, :, 2], np.linalg.norm(force, axis=2)
    touching = size > 0.0
    if not touching[rows].any():
        raise NotApplicable("no ball touches the cage in the averaging window")
    always = np.ones(along.shape, bool)
    time = 1e3 * run["time"][rows]
    biggest = size[rows].max(axis=1)
    series = [trace("largest of all pockets", time, biggest, "ball")]
    lands = np.linalg.norm(run["land_force"][rows], axis=2)
    for ring, values in zip(("inner", "outer"), lands.T, strict=True):
        if values.any():
            series.append(trace(f"{ring} land", time, values, ring))
    share = float(touching[rows].mean())
    panels = (
        Panel(
            "along the orbit",
            AZIMUTH,
            Axis("tangential force", "N"),
            tuple(over_azimuth(run, span, along, always, "mean", "ball", end=False)),
            (Mark("", 0.0),),
        ),
        Panel("over time", Axis("time", "ms"), Axis("force", "N", low=0.0), tuple(series)),
    )
    notes = (
        f"over {span.words}; band: smallest to largest; pockets touch {100.0 * share:.3g} % of the time",
        "positive: the cage drives the ball forward",
    )
    return ViewData("pocket-forces", "Forces of the cage", source(run), panels, 2, notes)


VIEWS = (
    View("cage-orbit", "orbit of the cage, whirl, cage speed over kinematics", "result", cage_orbit, view_api=1),
    View("pocket-forces", "forces in the pockets and at the lands", "result", pocket_forces, view_api=1),
)
