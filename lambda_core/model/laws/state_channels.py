"""List the channels that not every run has.

These are states of contacts, arcs and waves of elastic rings.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from lambda_core.domain.channels import ARC_CHANNELS, CHANNELS, ROLLER_CHANNELS, SECOND_CAGE_CHANNELS, Channel
from lambda_core.domain.elements import BODIES, RACEWAYS
from lambda_core.laws.state import ROLE, State

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel


def states_of(model: BearingModel, element: str) -> tuple[State, ...]:
    """Return the states of each contact of one raceway.

    They are in the order of its law.
    """
    return model.laws[element][ROLE].model.states


def state_channels(model: BearingModel) -> tuple[Channel, ...]:
    """Return one channel for each state, of all raceways together."""
    found = {state.name: state.channel for element in RACEWAYS for state in states_of(model, element)}
    if model.geometry.kind.arcs == 2:
        return tuple(replace(channel, dims=("ball", "arc")) for channel in found.values())
    return tuple(found.values())


def arc_channels(model: BearingModel) -> tuple[Channel, ...]:
    """Return the channels of arcs, where a ring has two."""
    return ARC_CHANNELS if model.geometry.kind.arcs == 2 else ()


def wave_channels(model: BearingModel) -> tuple[Channel, ...]:
    """Return the channels of waves.

    Each elastic body has one for each number of waves, then one for its ovality.
    """
    found = []
    for body, waves in model.elastic.items():
        name = BODIES[body].split(" with")[0]
        found += [
            Channel(
                f"{body}_waves_{order}", ("wave",), "m", f"amplitudes of {order} waves round the {name}, outwards, "
                "in its frame",
            )
            for order in waves.counts
        ]  # fmt: skip
        found.append(Channel(f"{body}_ovality", (), "m", f"largest less smallest diameter of the bent {name}"))
    return tuple(found)


def cage_channels(model: BearingModel) -> tuple[Channel, ...]:
    """Return the channels of the second row's cage, if any."""
    return SECOND_CAGE_CHANNELS if model.cage.per_row else ()


def element_channels(dim: str, what: str) -> tuple[Channel, ...]:
    """Return the channels of force elements.

    Named by `dim`, the dimension that counts them; `what` is for texts.
    """
    return (
        Channel(f"{dim}_force", (dim, "axis"), "N", f"force of every {what} on the second of its bodies"),
        Channel(f"{dim}_moment", (dim, "axis"), "N m", f"couple of every {what} on the second of its bodies"),
        Channel(f"{dim}_power", (dim,), "W", f"power that every {what} puts into its bodies, negative: takes out"),
    )


def result_channels(model: BearingModel) -> tuple[Channel, ...]:
    """Return the channels of a run's samples.

    Every sample of a run of the model carries them.
    """
    own = arc_channels(model) if model.rollers is None else ROLLER_CHANNELS
    return (*CHANNELS, *own, *state_channels(model), *wave_channels(model), *cage_channels(model), *_of_elements(model))


def _of_elements(model: BearingModel) -> tuple[Channel, ...]:
    return element_channels("element", "force element") if model.links else ()
