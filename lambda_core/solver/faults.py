"""What a kernel that refuses leaves behind."""

from __future__ import annotations

from lambda_core.solver.layout import helper
from lambda_core.solver.records import RACEWAY_ROLES

# Roles as a fault names them.
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


@helper
def report(fault, role, status, place, i0, i1, i2, i3):
    """Record the first fault of an evaluation: role, the kernel's status, raceway or land, inputs."""
    if fault.role < 0:
        fault.role = role
        fault.status = status
        fault.place = place
        fault.inputs[0], fault.inputs[1], fault.inputs[2], fault.inputs[3] = i0, i1, i2, i3
    return 0
