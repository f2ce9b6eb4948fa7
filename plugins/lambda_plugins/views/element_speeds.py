"""Draw orbital speed, spin and skidding of rolling elements."""

from __future__ import annotations

import numpy as np

from lambda_core.plugins import Axis, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.azimuth import AZIMUTH
from lambda_plugins.views.common import averaging, has_rollers, of_ring, over_azimuth, source, speeds


def element_speeds(run: RunData, options: Options) -> ViewData:
    """Show speeds and sliding of rolling elements over azimuth.

    It shows orbital and spinning speeds over the kinematic ones, and sliding at both rings.
    """
    span = averaging(run)
    known = speeds(run, span)
    geometry = run.model["geometry"]
    lever = 0.5 * geometry["ball_diameter"] * np.cos(known.contact_angle)
    pitch = 0.5 * geometry["pitch_diameter"]
    # An element that rolls without sliding: the difference of the raceways' speeds over its diameter.
    kinematic = abs(known.outer * (pitch + lever) - known.inner * (pitch - lever)) / geometry["ball_diameter"]
    if kinematic == 0.0 or known.cage == 0.0:
        raise NotApplicable("the rings stand still: there are no kinematic speeds to compare with")
    orbit = run["ball_velocity"][:, :, 2] / run["ball_radius"] / known.cage
    spin = np.linalg.norm(run["ball_spin"], axis=2) / kinematic
    every = np.ones(orbit.shape, bool)
    slip: list[Series] = []
    for ring in ("inner", "outer"):
        loaded = of_ring(run, "load", ring) > 0.0
        slip += over_azimuth(run, span, of_ring(run, "slip", ring), loaded, f"{ring} ring", ring)
    name = "rollers" if has_rollers(run) else "balls"
    one = (Mark("no slip", 1.0),)
    panels = (
        Panel(
            "orbital speed",
            AZIMUTH,
            Axis("over kinematic speed"),
            tuple(over_azimuth(run, span, orbit, every, name, "ball")),
            one,
        ),
        Panel(
            "spinning speed",
            AZIMUTH,
            Axis("over kinematic speed"),
            tuple(over_azimuth(run, span, spin, every, name, "ball")),
            one,
        ),
        Panel("skidding", AZIMUTH, Axis("sliding velocity", "m/s"), tuple(slip), (Mark("", 0.0),)),
    )
    notes = (
        f"mean over {span.words}, band: smallest to largest; points: end state",
        "spinning speed: size of the angular velocity; sliding: element over ring at the contact's centre, "
        "loaded contacts only",
    )
    return ViewData("element-speeds", f"Speeds of the {name}", source(run), panels, 2, notes)


VIEWS = (
    View(
        "element-speeds",
        "orbital speed, spin and skidding of balls or rollers over azimuth",
        "result",
        element_speeds,
        view_api=1,
    ),
)
