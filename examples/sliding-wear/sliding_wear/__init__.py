"""Compute wear of the raceway contacts after Archard.

A rate and its time integral for each contact, and a picture of them.
"""

import numpy as np

from lambda_core.plugins import (
    Axis,
    Channel,
    Integral,
    NotApplicable,
    Number,
    Observer,
    Panel,
    Parameters,
    Series,
    View,
    ViewData,
    hookimpl,
    parameter,
)  # fmt: skip


class Archard(Parameters):
    coefficient: float = parameter(1e-8, "wear coefficient K of Archard's law", status="assumed", gt=0.0)
    hardness: float = parameter(7.5e9, "hardness of the softer surface [Pa]", status="assumed", gt=0.0)


def wear(samples, parameters, model):
    """Return the wear rate.

    dV/dt = K W |v|/H with the load W that asperities carry and the slip v at the contact's centre.
    """
    touching = samples["asperity_share"] * samples["load"]
    return {"wear_rate": parameters.coefficient * touching * np.abs(samples["slip"]) / parameters.hardness}


RATE = Channel("wear_rate", ("ball", "ring"), "m3/s", "volume worn off in each raceway contact per second")
VOLUME = Integral("wear_volume", of="wear_rate", unit="m3", meaning="volume worn off in each raceway contact")
LARGEST = Number("worst", "wear_volume", "largest", "largest volume worn off in one contact")


def worn(run, options):
    if "wear_volume" not in [channel.name for channel in run.channels]:
        raise NotApplicable("the run had no observer sliding-wear")
    volume = run.sample(-1, ("wear_volume",))["wear_volume"]
    balls = np.arange(1.0, len(volume) + 1)
    bars = tuple(Series(ring, balls, 1e18 * volume[:, i], "bars", ring) for i, ring in enumerate(("inner", "outer")))
    panel = Panel("worn off", Axis("ball"), Axis("volume", "um3"), bars)
    return ViewData("sliding-wear", "wear of the raceway contacts", run.title, (panel,))


@hookimpl
def lambda_observers(register):
    reference = "Archard 1953, J. Appl. Phys. 24, 981: contact and rubbing of flat surfaces"
    register(Observer("sliding-wear", "wear of the raceway contacts", (RATE,), wear, reference, Archard,
                      integrals=(VOLUME,), numbers=(LARGEST,), observer_api=1))  # fmt: skip


@hookimpl
def lambda_views(register):
    register(View("sliding-wear", "wear of the raceway contacts", "result", worn, view_api=1))
