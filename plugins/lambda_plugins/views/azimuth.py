"""Show load, angle, pressure and film over azimuth."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.channels import RINGS
from lambda_core.plugins import Axis, FloatArray, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.common import Span, averaging, of_ring, over_azimuth, source

AZIMUTH = Axis("azimuth", "deg", low=0.0, high=360.0, ticks=(0.0, 90.0, 180.0, 270.0, 360.0))
_FRAME = "azimuth from the horizontal +y towards the vertical +z, seen with x pointing at the reader"


def _series(run: RunData, span: Span, channel: str, scale: float, loaded: bool = True) -> list[Series]:
    """Return one channel at both rings over azimuth, times `scale`."""
    found = []
    for ring in RINGS:
        values: FloatArray = scale * of_ring(run, channel, ring)
        keep = of_ring(run, "load", ring) > 0.0 if loaded else np.ones(values.shape, bool)
        found += over_azimuth(run, span, values, keep, f"{ring} ring", ring)
    if not any(np.isfinite(series.y).any() for series in found):
        raise NotApplicable("no ball touches a ring in this run")
    return found


def notes(span: Span) -> tuple[str, ...]:
    """Return what lines, bands and azimuths mean."""
    return (f"lines: mean over {span.words}, band: smallest to largest; points: end state", _FRAME)


def load_distribution(run: RunData, options: Options) -> ViewData:
    """Draw the load of every ball on both rings.

    It has a polar panel and one over azimuth.
    """
    span = averaging(run)
    series = tuple(_series(run, span, "load", 1e-3, loaded=False))
    polar = Panel("around the bearing", AZIMUTH, Axis("load", "kN", low=0.0), series, shape="polar")
    flat = Panel("over azimuth", AZIMUTH, Axis("load", "kN", low=0.0), series)
    return ViewData("load-distribution", "Load distribution", source(run), (polar, flat), 2, notes(span))


def contact_angle(run: RunData, options: Options) -> ViewData:
    """Show contact angles of the loaded contacts over azimuth."""
    span = averaging(run)
    series = tuple(_series(run, span, "contact_angle", 180.0 / np.pi))
    panel = Panel("", AZIMUTH, Axis("contact angle", "deg", least=1.0), series)
    told = (*notes(span), "positive when the ball pushes the outer ring towards +x; loaded contacts only")
    return ViewData("contact-angle", "Contact angle", source(run), (panel,), 1, told)


def pressure(run: RunData, options: Options) -> ViewData:
    """Show the maximum Hertzian pressure over azimuth."""
    span = averaging(run)
    panel = Panel(
        "", AZIMUTH, Axis("maximum pressure", "GPa", low=0.0), tuple(_series(run, span, "max_pressure", 1e-9))
    )
    return ViewData("pressure", "Contact pressure", source(run), (panel,), 1, notes(span))


def film(run: RunData, options: Options) -> ViewData:
    """Show film thickness and film parameter over azimuth.

    It shows the central film of the loaded contacts.
    """
    span = averaging(run)
    thickness = _series(run, span, "film_central", 1e6)
    lambdas = _series(run, span, "film_parameter", 1.0)
    lowest = min(float(np.nanmin(series.y)) for series in lambdas)
    marks = tuple(Mark(f"Lambda = {limit:g}", limit) for limit in (1.0, 3.0) if lowest < 1.5 * limit)
    panels = (
        Panel("", AZIMUTH, Axis("central film", "um", low=0.0), tuple(thickness)),
        Panel("", AZIMUTH, Axis("film parameter Lambda", low=0.0), tuple(lambdas), marks),
    )
    sigma = 1e6 * float(run.model["roughness"])
    told = (*notes(span), f"Lambda = central film over the composite roughness {sigma:.3g} um; loaded contacts only")
    return ViewData("film", "Lubricant film", source(run), panels, 2, told)


VIEWS = (
    View("load-distribution", "load of every element around the bearing", "result", load_distribution, view_api=1),
    View("contact-angle", "contact angles over azimuth", "result", contact_angle, view_api=1),
    View("pressure", "maximum contact pressure over azimuth", "result", pressure, view_api=1),
    View("film", "film thickness and Lambda over azimuth", "result", film, view_api=1),
)
