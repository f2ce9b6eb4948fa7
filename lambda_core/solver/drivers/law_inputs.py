"""Assign force elements and oils to the solver's tables."""

from __future__ import annotations

from lambda_core.domain.elements import RIBS
from lambda_core.laws.context import Oil
from lambda_core.model.bearing_model import ELEMENT_PREFIX, TIME_PREFIX, BearingModel

RACEWAYS = ("ball_inner", "ball_outer")  # in the order of the table of raceways
Oils = tuple[Oil, Oil]  # the oil as the rheology of each of these contacts has it


def oil_of(oils: Oils, element: str) -> Oil:
    """Return the oil of a force element.

    It is that of its ring, or that of the inner one where it has no ring.
    """
    for names in (RACEWAYS, tuple(RIBS)):
        if element in names:
            return oils[names.index(element)]
    return oils[0]


def contacts_of(model: BearingModel) -> tuple[str, ...]:
    """Return the ring contacts' elements in order.

    The order is the solver's: raceways come before ribs of rollers.
    """
    return (*RACEWAYS, *(element for element in RIBS if element in model.laws))


def links(model: BearingModel) -> tuple[str, ...]:
    """Return the elements between bodies in order.

    The solver's order, as the laws of a model name them.
    """
    return tuple(element for element in model.laws if element.startswith(ELEMENT_PREFIX))


def times(model: BearingModel) -> tuple[str, ...]:
    """Return the time laws in order.

    Loads and motions in the solver's order, as the laws of a model name them.
    """
    return tuple(element for element in model.laws if element.startswith(TIME_PREFIX))


def guides(model: BearingModel) -> tuple[str, str, str]:
    """Return the guides' force elements.

    They take the solver's places of pocket, inner and outer land.
    """
    return ("ball_cage" if model.depth.cage else "ball_ball", "cage_inner", "cage_outer")
