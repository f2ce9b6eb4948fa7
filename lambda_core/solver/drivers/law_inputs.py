"""Assign force elements and oils to the solver's tables."""

from __future__ import annotations

from lambda_core.domain.elements import RIBS
from lambda_core.laws.context import Oil
from lambda_core.model.bearing_model import ELEMENT_PREFIX, TIME_PREFIX, BearingModel

RACEWAYS = ("ball_inner", "ball_outer")  # in the order of the table of raceways
Oils = tuple[Oil, Oil]  # the oil as the rheology of each of these contacts has it


def oil_of(oils: Oils, element: str) -> Oil:
    """Return the oil that a force element takes: that of its ring, the inner one's where there is none."""
    for names in (RACEWAYS, tuple(RIBS)):
        if element in names:
            return oils[names.index(element)]
    return oils[0]


def contacts_of(model: BearingModel) -> tuple[str, ...]:
    """Return the force elements of contacts with rings in the solver's order: raceways, then ribs of rollers."""
    return (*RACEWAYS, *(element for element in RIBS if element in model.laws))


def links(model: BearingModel) -> tuple[str, ...]:
    """Return the force elements between bodies in the solver's order, as the laws of a model name them."""
    return tuple(element for element in model.laws if element.startswith(ELEMENT_PREFIX))


def times(model: BearingModel) -> tuple[str, ...]:
    """Return the loads and motions that a law gives, in the solver's order, as the laws of a model name them."""
    return tuple(element for element in model.laws if element.startswith(TIME_PREFIX))


def guides(model: BearingModel) -> tuple[str, str, str]:
    """Return the force elements that take the solver's places of pocket, inner and outer land."""
    return ("ball_cage" if model.depth.cage else "ball_ball", "cage_inner", "cage_outer")
