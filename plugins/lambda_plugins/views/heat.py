"""Draw the heat flows of one run.

The thermal network of its case carries the averaged losses.
"""

from __future__ import annotations

from dataclasses import replace

from lambda_core.domain.errors import LambdaError
from lambda_core.plugins import NotApplicable, Options, RunData, View, ViewData
from lambda_plugins.views.common import source


def heat(run: RunData, options: Options) -> ViewData:
    """Show losses, heat flows and temperatures.

    Losses by mechanism, the nodes that get them, the flows to the surroundings, and the temperatures that follow.
    """
    from lambda_core import api

    try:
        (found,) = api.thermal_pictures(api.thermal(run.path))
    except LambdaError as error:
        raise NotApplicable(f"the temperatures cannot be computed: {error}") from None
    return replace(found, view="heat", source=source(run))


VIEWS = (View("heat", "where the heat of a run goes, and the temperatures that follow", "result", heat, view_api=1),)
