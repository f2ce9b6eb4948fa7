"""Define the report that a refusing kernel leaves behind."""

from __future__ import annotations

from lambda_core.solver.layout import helper


@helper
def report(fault, role, status, place, i0, i1, i2, i3):
    """Record the first fault of an evaluation.

    It records role, the kernel's status, raceway or land, and inputs.
    """
    if fault.role < 0:
        fault.role = role
        fault.status = status
        fault.place = place
        fault.inputs[0], fault.inputs[1], fault.inputs[2], fault.inputs[3] = i0, i1, i2, i3
    return 0
