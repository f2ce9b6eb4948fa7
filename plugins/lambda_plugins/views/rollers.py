"""Draw pressure, tilt, skew and rib loads of rollers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field as Declared

from lambda_core.domain.channels import RIBS, RINGS
from lambda_core.domain.errors import CaseError, SolverError, UsageError
from lambda_core.plugins import Axis, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.azimuth import AZIMUTH, notes
from lambda_plugins.views.common import averaging, has_rollers, over_azimuth, source

if TYPE_CHECKING:
    from lambda_core.solver.drivers.line_field import LineField

_CHANNELS = ("time", "ball_azimuth", "body_tilt", "roller_lean", "load")
_ROLES = {"inner +x": "inner", "inner -x": "total", "outer +x": "outer", "outer -x": "cage"}


class Choice(Options):
    """Roller and time to show."""

    roller: int = Declared(0, ge=0, description="number of the roller, from 1; 0: the one with the largest load")
    time: float = Declared(-1.0, description="moment [s]; negative: the end of the run")


def _require_rollers(run: RunData) -> None:
    if not has_rollers(run):
        raise NotApplicable("the elements of this bearing are balls: this view is about rollers")


def line_contact(run: RunData, options: Choice) -> ViewData:
    """Show pressure and load along a roller's contacts.

    They run over the length of both contacts, spread as the law of the contact does.
    """
    _require_rollers(run)
    times = run["time"]
    if options.time > times[-1]:
        raise UsageError(f"t = {options.time:g} s is after the end of the run, {times[-1]:g} s")
    row = times.size - 1 if options.time < 0.0 else int(np.argmin(np.abs(times - options.time)))
    sample = run.sample(row, _CHANNELS)
    count = sample["load"].shape[0]
    if options.roller > count:
        raise UsageError(f"roller {options.roller} does not exist: this bearing has {count}")
    roller = options.roller - 1 if options.roller else int(np.argmax(sample["load"].max(axis=1)))
    found = _fields(run, sample, roller)
    if not found:
        raise NotApplicable(f"roller {roller + 1} touches no raceway at t = {1e3 * float(sample['time']):.4g} ms")
    along = Axis("place, towards +x", "mm")
    pressure, load = (
        tuple(Series(f"{ring} ring", 1e3 * one.place, scale * getattr(one, name), "line", ring)
              for ring, one in found.items())
        for name, scale in (("pressure", 1e-9), ("line_load", 1e-3))
    )  # fmt: skip
    panels = (
        Panel("", along, Axis("maximum pressure", "GPa", low=0.0), pressure),
        Panel("", along, Axis("load over length", "N/mm", low=0.0), load),
    )
    loads = ", ".join(f"{ring} {sample['load'][roller, RINGS.index(ring)]:.5g} N" for ring in found)
    leans = ", ".join(f"{ring} {1e3 * one.lean:.3g} mrad" for ring, one in found.items())
    told = (
        f"roller {roller + 1}, azimuth {math.degrees(sample['ball_azimuth'][roller]) % 360.0:.1f} deg, "
        f"t = {1e3 * float(sample['time']):.5g} ms (sample {row}); loads: {loads}; tilt against the ring: {leans}",
        "the load of the sample, spread over the slices by law, profile and tilt",
    )
    return ViewData("line-contact", "Along the contacts of one roller", source(run), panels, 1, told)


def _fields(run: Any, sample: dict[str, Any], roller: int) -> dict[str, LineField]:
    """Return the contacts of a roller that carry, by ring."""
    from lambda_core.analysis.rotor.bearing_alone import bearing_of_run
    from lambda_core.solver.drivers.line_field import lean_of, line_field

    try:
        model = bearing_of_run(run)
        loads = dict(zip(RINGS, sample["load"][roller].tolist(), strict=True))
        return {
            ring: line_field(model, ring, load, lean_of(sample, roller, ring))
            for ring, load in loads.items()
            if load > 0.0
        }
    except (CaseError, SolverError) as error:
        raise NotApplicable(f"the contact cannot be computed again: {error}") from None


def lean(run: RunData, options: Options) -> ViewData:
    """Show tilt and skew of the rollers.

    It shows them over azimuth, and of all rollers over time.
    """
    _require_rollers(run)
    span, time, angles = averaging(run), run["time"], 1e3 * run["roller_lean"]
    panels = []
    for number, name in enumerate(("tilt", "skew")):
        values = angles[:, :, number]
        axis = Axis(name, "mrad", least=0.01)
        series = tuple(over_azimuth(run, span, values, np.ones(values.shape, bool), "rollers", "ball"))
        panels.append(Panel(f"{name} over azimuth", AZIMUTH, axis, series, (Mark("", 0.0),)))
        lines = (
            Series("largest", 1e3 * time, values.max(axis=1), "line", "inner"),
            Series("mean", 1e3 * time, values.mean(axis=1), "line", "total"),
            Series("smallest", 1e3 * time, values.min(axis=1), "line", "outer"),
        )
        panels.append(Panel(f"{name} over time", Axis("time", "ms"), axis, lines))
    told = (
        *notes(span),
        "tilt: in the plane of the bearing's axis, outwards at +x; skew: the end at +x ahead along the orbit",
    )
    return ViewData("roller-lean", "Tilt and skew of the rollers", source(run), tuple(panels), 2, told)


def rib_load(run: RunData, options: Options) -> ViewData:
    """Show the loads of the ribs on the rollers.

    It shows them over azimuth, and their sums over time.
    """
    _require_rollers(run)
    span, time, loads = averaging(run), run["time"], run["rib_load"]
    touched = [k for k in range(len(RIBS)) if loads[:, :, k].any()]
    if not touched:
        raise NotApplicable("no roller touches a rib in this run")
    flat: list[Series] = []
    for k in touched:
        values = loads[:, :, k]
        flat += over_azimuth(run, span, values, np.ones(values.shape, bool), RIBS[k], _ROLES[RIBS[k]])
    sums = tuple(Series(RIBS[k], 1e3 * time, loads[:, :, k].sum(axis=1), "line", _ROLES[RIBS[k]]) for k in touched)
    panels = (
        Panel("over azimuth", AZIMUTH, Axis("load of a rib", "N", low=0.0), tuple(flat)),
        Panel("sum over all rollers", Axis("time", "ms"), Axis("load of a rib", "N", low=0.0), sums),
    )
    told = (*notes(span), "ribs are named by their ring and the end of the rollers that they touch")
    return ViewData("rib-load", "Loads of the ribs", source(run), panels, 2, told)


VIEWS = (
    View(
        "line-contact", "pressure and load along both contacts of one roller", "result", line_contact, Choice,
        offered=has_rollers, view_api=1,
    ),
    View(
        "roller-lean", "tilt and skew of the rollers over azimuth and time", "result", lean,
        offered=has_rollers, view_api=1,
    ),
    View(
        "rib-load", "loads of ribs on rollers over azimuth and time", "result", rib_load,
        offered=has_rollers, view_api=1,
    ),
)  # fmt: skip
