"""Compare a run with the catalogue methods on one axis."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.plugins import Axis, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.common import averaging, source

# Mechanisms of the simulation under the words of catalogues.
_PARTS = (
    ("rolling", ("rolling", "hysteresis")),
    ("sliding", ("sliding", "spin", "boundary")),
    ("drag", ("drag",)),
    ("cage and the rest", ("cage", "damping", "bending")),
)


def catalogues(run: RunData, options: Options) -> ViewData:
    """Show the friction torque of simulation and catalogues.

    The simulation is split into parts; SKF's and Schaeffler's models give their totals for the same point.
    """
    summary = run.summary()
    rating = summary.rating
    if summary.friction_torque_Nmm is None:
        raise NotApplicable("the run has no mean friction torque to compare")
    if rating is None:
        raise NotApplicable("neither SKF's nor Schaeffler's model answers for this case")
    others = [
        (name, value)
        for name, value in (("SKF", rating.skf_torque_Nmm), ("Schaeffler", rating.schaeffler_torque_Nmm))
        if value is not None
    ]
    if not others:
        raise NotApplicable("neither SKF's nor Schaeffler's model covers this bearing")
    places = np.arange(1.0 + len(others))
    found = summary.friction_breakdown_Nmm
    series = []
    for group, (name, mechanisms) in enumerate(_PARTS):
        values = np.full(places.size, math.nan)
        values[0] = sum(v or 0.0 for key, v in found.items() if key.split("_")[0] in mechanisms)
        shown = name.replace("cage", "neighbours") if summary.full_complement else name
        series.append(Series(shown, places, values, "bars", group=group))
    totals = np.array([math.nan, *(value for _, value in others)])
    series.append(Series("total", places, totals, "bars", "reference"))
    panel = Panel(
        "",
        Axis("", categories=("simulation", *(name for name, _ in others))),
        Axis("friction torque", "N mm", low=0.0),
        tuple(series),
        stacked=True,
    )
    notes = (
        f"simulation: mean over {averaging(run).words}; catalogues: at the loads and the speed of the start",
        "rolling: rolling resistance and hysteresis; sliding: slip, spin and asperities",
    )
    return ViewData("catalogues", "Simulation and catalogues", source(run), (panel,), 1, notes)


VIEWS = (
    View(
        "catalogues",
        "friction torque, compared with the models of SKF and Schaeffler",
        "result",
        catalogues,
        view_api=1,
    ),
)
