"""Compare several runs side by side."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from lambda_core.plugins import Axis, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.azimuth import AZIMUTH
from lambda_plugins.views.common import BINS, averaging, of_ring, profile
from lambda_plugins.views.friction import PER_RING, REST

_MOST = 12
_TOLD = 8  # differing inputs, at most


def comparison(runs: Sequence[RunData], options: Options) -> ViewData:
    """Compare friction, slip, films, pressures and loads of runs.

    Friction by mechanism and load distributions.
    """
    # Here: every command imports the views, and few of them compare.
    from lambda_core.results.side_by_side import differing_inputs, run_names

    if len(runs) < 2:
        raise NotApplicable("a comparison needs at least two results")
    if len(runs) > _MOST:
        raise NotApplicable(f"{len(runs)} results are too many to compare: at most {_MOST}; a study shows more")
    names = run_names(runs)
    summaries = [run.summary() for run in runs]
    places = np.arange(len(runs), dtype=float)
    which = Axis("", categories=names)

    def column(values: Sequence[float | None]) -> np.ndarray:
        return np.array([np.nan if value is None else value for value in values], dtype=float)

    def bars(title: str, label: str, unit: str, values: Sequence[float | None]) -> Panel:
        series = Series(label, places, column(values), "bars", "inner", unlisted=True)
        return Panel(title, which, Axis(label, unit), (series,))

    stacks = []
    for group, name in enumerate((*PER_RING, *REST)):
        keys = [f"{name}_inner", f"{name}_outer"] if name in PER_RING else [name]
        values = [sum(s.friction_breakdown_Nmm[key] or 0.0 for key in keys) for s in summaries]
        stacks.append(Series(name, places, column(values), "bars", group=group))
    slip = [
        None if s.cage_speed_over_epicyclic is None else 100.0 * (1.0 - s.cage_speed_over_epicyclic) for s in summaries
    ]
    lives = [getattr(s.rating, "reference_life_h", None) for s in summaries]
    panels = (
        Panel("friction torque", which, Axis("friction torque", "N mm", low=0.0), tuple(stacks), stacked=True),
        Panel(
            "simulation and catalogues",
            which,
            Axis("friction torque", "N mm", low=0.0),
            tuple(
                Series(name, places, column(values), "bars", group=group)
                for group, (name, values) in enumerate(_side_by_side(summaries))
            ),
        ),
        Panel("load on the inner ring", AZIMUTH, Axis("load", "kN", low=0.0), _loads(runs, names)),
        bars("largest pressure", "pressure", "GPa", [s.max_pressure_GPa for s in summaries]),
        bars("smallest film", "minimum film", "um", [s.min_film_um for s in summaries]),
        bars("cage", "slip of the cage", "%", slip),
        bars("capacitance at the end", "bearing capacitance", "nF", [s.bearing_capacitance_nF for s in summaries]),
        bars("rating life", "L10rh, ISO/TS 16281", "h", lives),
    )
    open_ends = [name for name, s in zip(names, summaries, strict=True) if not s.converged]
    notes = ["means over whole cage revolutions of each run"]
    inputs = differing_inputs(runs)
    notes += [f"{row.option}: {', '.join('-' if v is None else v for v in row.values)}" for row in inputs[:_TOLD]]
    if len(inputs) > _TOLD:
        notes.append(f"and {len(inputs) - _TOLD} more inputs differ: lambda-bearing show with these results lists them")
    if open_ends:
        notes.append(f"not converged: {', '.join(open_ends)}")
    return ViewData("comparison", "Comparison of results", ", ".join(names), panels, 2, tuple(notes))


def _side_by_side(summaries: Sequence[Any]) -> Iterator[tuple[str, list[float | None]]]:
    """Yield the friction torques of simulations and catalogues.

    The catalogues answer for the same cases.
    """
    yield "simulation", [s.friction_torque_Nmm for s in summaries]
    for name, field in (("SKF", "skf_torque_Nmm"), ("Schaeffler", "schaeffler_torque_Nmm")):
        yield name, [getattr(s.rating, field, None) for s in summaries]


def _loads(runs: Sequence[RunData], names: Sequence[str]) -> tuple[Series, ...]:
    found = []
    for run, name in zip(runs, names, strict=True):
        rows = averaging(run).rows(run["time"])
        load = 1e-3 * of_ring(run, "load", "inner")[rows]
        mean = profile(run["ball_azimuth"][rows], load, np.ones(load.shape, bool), BINS)
        found.append(Series(name, mean.azimuth, mean.mean, "line"))
    return tuple(found)


VIEWS = (View("comparison", "several results side by side", "results", comparison, view_api=1),)
