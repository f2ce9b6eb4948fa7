"""Name roles in the fault of a kernel."""

from __future__ import annotations

from lambda_core.solver.records import RACEWAY_ROLES

ROLES = (*RACEWAY_ROLES, "cage_contact", "fluid_drag", "force_element", "time_function")
(
    NORMAL_CONTACT,
    DAMPING,
    RHEOLOGY,
    FILM_THICKNESS,
    THERMAL_CORRECTION,
    SUPPLY,
    CONTACT_TEMPERATURE,
    TRACTION,
    ROLLING_RESISTANCE,
    ELASTIC_HYSTERESIS,
    ASPERITY_LOAD,
    BOUNDARY_FRICTION,
    MIXING,
    CONTACT_STATE,
    PERMITTIVITY,
    CAPACITANCE,
    SURFACE,
    CAGE_CONTACT,
    FLUID_DRAG,
    FORCE_ELEMENT,
    TIME_FUNCTION,
) = range(len(ROLES))

OUTSIDE = -1  # status of a law that wrote behind the end of its output: kernels have none below zero
