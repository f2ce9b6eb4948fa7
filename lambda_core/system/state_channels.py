"""The states that the contacts of a resolved model keep."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lambda_core.domain.elements import RACEWAYS
from lambda_core.laws.state import ROLE, State

if TYPE_CHECKING:
    from lambda_core.domain.channels import Channel
    from lambda_core.system.bearing import BearingModel


def states_of(model: BearingModel, element: str) -> tuple[State, ...]:
    """Return what every contact of one raceway keeps, in the order of its law."""
    return model.laws[element][ROLE].model.states


def state_channels(model: BearingModel) -> tuple[Channel, ...]:
    """Return one channel for each state, of both raceways together."""
    found = {state.name: state.channel for element in RACEWAYS for state in states_of(model, element)}
    return tuple(found.values())
