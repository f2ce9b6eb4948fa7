"""Draw the four contacts of a four-point contact bearing."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.channels import ARCS, RINGS
from lambda_core.plugins import Axis, FloatArray, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.azimuth import AZIMUTH, notes
from lambda_plugins.views.common import Span, averaging, over_azimuth, source


def _of_arcs(run: RunData, span: Span, ring: str, channel: str, scale: float, *, loaded: bool) -> tuple[Series, ...]:
    """Return a channel of both arcs, times `scale`."""
    found: list[Series] = []
    for number, arc in enumerate(ARCS):
        if not arc.startswith(ring):
            continue
        values: FloatArray = scale * run[f"arc_{channel}"][:, :, number]
        carries = run["arc_load"][:, :, number] > 0.0
        role = "inner" if arc.endswith("+x") else "outer"
        found += over_azimuth(run, span, values, carries | (not loaded), f"arc {arc}", role)
    return tuple(found)


def arcs(run: RunData, options: Options) -> ViewData:
    """Show loads and contact angles of all four contacts."""
    if not _has_arcs(run):
        raise NotApplicable("the rings of this bearing have one groove for each row: arcs are of four-point contact")
    span = averaging(run)
    panels = [
        Panel(f"{ring} ring", AZIMUTH, axis, _of_arcs(run, span, ring, channel, scale, loaded=loaded))
        for channel, axis, scale, loaded in (
            ("load", Axis("load", "kN", low=0.0), 1e-3, False),
            ("contact_angle", Axis("contact angle", "deg", least=1.0), 180.0 / np.pi, True),
        )
        for ring in RINGS
    ]
    about = "each arc is named by its ring and the thrust of the shaft that it takes; angles where it carries"
    return ViewData("arcs", "Arcs of four-point contact", source(run), tuple(panels), 2, (*notes(span), about))


def _has_arcs(run: RunData) -> bool:
    """Tell whether the rings of a run have arcs.

    Each ring has two.
    """
    return any(channel.name == "arc_load" for channel in run.channels)


VIEWS = (
    View(
        "arcs", "loads and angles of both arcs of each ring, four-point contact", "result", arcs,
        offered=_has_arcs, view_api=1,
    ),
)  # fmt: skip
