"""Draw the largest over the mean ball load.

The view compares it with Stribeck's number.
"""

import numpy as np
from pydantic import Field

from lambda_core.plugins import Axis, Mark, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from northwind_bearings.method import NO_CLEARANCE


class ShareOptions(Options):
    """Options of the view."""

    after: float = Field(0.0, ge=0.0, description="leave out what lies before this time [s]")


def load_share(run: RunData, options: ShareOptions) -> ViewData:
    """Show the relative largest ball load.

    Times the number of balls over the radial load that the balls carry.

    The radial load is the sum of the contact forces at the inner ring in the plane of the balls.
    """
    keep = run["time"] >= options.after
    if not keep.any():
        raise NotApplicable(f"the run ends before {options.after:g} s")
    load = run["load"][keep][:, :, 0] * np.cos(run["contact_angle"][keep][:, :, 0])  # (time, ball) in N
    azimuth = run["ball_azimuth"][keep]
    carried = np.hypot((load * np.cos(azimuth)).sum(axis=1), (load * np.sin(azimuth)).sum(axis=1))
    if not np.all(carried > 0.01 * load.sum(axis=1)):
        raise NotApplicable("the balls carry no radial load")
    share = load.max(axis=1) * load.shape[1] / carried
    panel = Panel(
        "Load share",
        Axis("time", "ms"),
        Axis("largest ball load x balls / radial load"),
        (Series("simulation", run["time"][keep] * 1e3, share, role="inner"),),
        (Mark("Stribeck, no clearance", NO_CLEARANCE),),
    )
    return ViewData("load-share", "Load share of the most loaded ball", run.title, (panel,))


LOAD_SHARE = View(
    "load-share",
    "Load share of the most loaded ball over time",
    "result",
    load_share,
    ShareOptions,
    reference="Stribeck 1907, Trans. ASME 29, 420",
    view_api=1,
)
