"""Show the energy balance of one run."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.channels import LOSSES
from lambda_core.plugins import Axis, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_core.results.averages import COLUMNS
from lambda_core.results.convergence import ENERGY_TOLERANCE
from lambda_plugins.views.common import source

_LOSS = [COLUMNS.index(f"loss.{name}") for name in LOSSES]


def energy_balance(run: RunData, options: Options) -> ViewData:
    """Work, dissipated and stored energy over time.

    It also shows the difference between them.
    """
    rows = run.integrals()
    if rows.shape[0] < 2:
        raise NotApplicable("no energies are recorded yet")
    column = {name: rows[:, COLUMNS.index(name)] for name in ("time", "input", "input_abs", "stored", "support")}
    time, dissipated = 1e3 * column["time"], rows[:, _LOSS].sum(axis=1) + column["support"]
    missing = column["input"] - dissipated - column["stored"]
    with np.errstate(divide="ignore", invalid="ignore"):
        residual = missing / column["input_abs"]
    flow = (
        Series("put in", time, column["input"], "line", "total"),
        Series("dissipated", time, dissipated, "line", "outer"),
        Series("stored, against the start", time, column["stored"], "line", "cage"),
    )
    tolerance = 1e3 * ENERGY_TOLERANCE
    panels = (
        Panel("energies from the start", Axis("time", "ms"), Axis("energy", "J"), flow),
        Panel(
            "what is missing",
            Axis("time", "ms"),
            Axis("residual", "1e-3 of input"),
            (Series("put in - dissipated - stored", time[1:], 1e3 * residual[1:], "line", "inner"),),
            (Mark("allowed at the end", tolerance), Mark("", -tolerance)),
        ),
    )
    notes = (
        "put in: drives, loads, gravity and prescribed motions; residual: missing over the integral of |power put in|",
        f"at the end {residual[-1]:.2e}",
    )
    return ViewData("energy-balance", "Energy balance", source(run), panels, 2, notes)


VIEWS = (
    View("energy-balance", "energy put in, dissipated and stored over time", "result", energy_balance, view_api=1),
)
