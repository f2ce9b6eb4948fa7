"""How it is modelled and computed: the sections models, parameters, forces, depth, solver, output."""

from __future__ import annotations

from typing import Any

from lambda_core.schema.option import Section, option
from lambda_core.schema.units import Time

Parameters = dict[str, dict[str, Any]]  # role -> parameter -> value


class Models(Section):
    """Model by role, for every force element that has the role; absent: the built-in default."""

    normal_contact: str | None = option(None, "load and contact ellipse from penetration")
    damping: str | None = option(None, "normal force opposing the penetration velocity")
    rheology: str | None = option(None, 'viscosity and density of the oil; "auto": the law it has data for')
    film_thickness: str | None = option(None, "isothermal, fully flooded film")
    thermal_correction: str | None = option(None, "factor on the film for heating in the inlet")
    contact_temperature: str | None = option(None, "temperature of the film in each cell")
    traction: str | None = option(None, "shear stress of the film")
    rolling_resistance: str | None = option(None, "hydrodynamic force of the inlet")
    elastic_hysteresis: str | None = option(None, "couple by losses in the solids")
    asperity_load: str | None = option(None, "share of the load carried by asperities")
    boundary_friction: str | None = option(None, "friction of touching asperities")
    cage_contact: str | None = option(None, "force between the cage and a ball or a ring")
    fluid_drag: str | None = option(None, "drag and churning of the oil on each ball")
    permittivity: str | None = option(None, "relative permittivity of the oil")
    capacitance: str | None = option(None, "whole capacitance of a contact from its Hertzian area")
    surface: str | None = option(None, "waviness or a defect of a raceway")


class ForceElement(Section):
    """Models and parameters of one force element, before those of the whole bearing."""

    models: Models = option({}, "models by role")
    parameters: Parameters = option({}, "parameters by role")


class Forces(Section):
    """Force elements between the bodies."""

    ball_inner: ForceElement = option({}, "balls and inner raceway")
    ball_outer: ForceElement = option({}, "balls and outer raceway")
    ball_cage: ForceElement = option({}, "balls and cage pockets")
    ball_ball: ForceElement = option({}, "neighbouring balls, where there is no cage")
    cage_inner: ForceElement = option({}, "cage and inner ring's land")
    cage_outer: ForceElement = option({}, "cage and outer ring's land")
    fluid_drag: ForceElement = option({}, "oil on the balls")


class Depth(Section):
    """Modelling depth: which parts move, and how finely a contact is divided."""

    cage: bool = option(True, "the cage is a body; off: neighbouring balls touch each other instead")
    strips: int = option(31, "strips across the contact ellipse, along its major axis", ge=3, le=201)
    rows: int = option(1, "cells along rolling in each strip; 1 is the slice model", ge=1, le=201)


class Solver(Section):
    """Integrator and averages."""

    tolerance: float = option(1e-3, "error tolerance per step, on the absolute scales of the states", gt=0.0, le=0.1)
    duration: Time | None = option(None, "simulated time; absent: until converged", gt=0.0)
    max_duration: Time | None = option(None, "longest simulated time; absent: 30 turns of the cage", gt=0.0)
    discard_revolutions: float = option(1.0, "cage revolutions before averaging starts", ge=0.0)
    average_revolutions: float = option(4.0, "cage revolutions that are averaged at least", gt=0.0)
    max_step: Time | None = option(
        None, "longest step; by default 1/20 of an excitation at most; absent: 1/400 of a cage turn", gt=0.0
    )
    max_wall: Time | None = option(
        None, "wall time after which a run stops with what it has, resume goes on without it; absent: none", gt=0.0
    )


class Output(Section):
    """What is written."""

    interval: Time | None = option(None, "simulated time between samples; absent: 1/100 of a cage turn", gt=0.0)
    checkpoint_interval: Time = option("10 s", "wall time between checkpoints", gt=0.0)
