"""End a run when the cage leaves the middle.

The limit is a share of its clearance in the pockets.
"""

import numpy as np

from lambda_core.plugins import Event, Parameters, ReportTable, Section, hookimpl, parameter


class Whirl(Parameters):
    share: float = parameter(
        1.0, "distance of the cage's centre over half its pocket clearance", status="assumed", gt=0.0
    )


def whirls(samples, parameters, model):
    """Mark the samples of cage whirl.

    The cage's centre is farther from the inner ring's axis than it may be.
    """
    inner, cage = samples["body_position"][:, 0, 1:], samples["body_position"][:, 2, 1:]
    limit = 0.5 * parameters.share * model["cage"]["pocket_clearance"]
    return np.hypot(*(cage - inner).T) > limit


@hookimpl
def lambda_events(register):
    register(Event("cage-whirl", "the cage has left the middle", whirls, "own work", Whirl, event_api=1))


def whirl_section(run):
    """Return how far the cage's centre went."""
    inner, cage = run["body_position"][:, 0, 1:], run["body_position"][:, 2, 1:]
    farthest = 1e6 * np.hypot(*(cage - inner).T).max()
    return ["Distance of cage and inner ring.", ReportTable("", ("", "um"), (("farthest", f"{farthest:.3g}"),))]


@hookimpl
def lambda_sections(register):
    register(Section("cage-whirl", "Cage whirl", whirl_section, "own work", section_api=1))
