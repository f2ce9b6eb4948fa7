"""The contact pipeline of one ball-raceway contact: from kinematics q to the wrench on the ball.

Stages, each a kernel of the model: normal force, damping, film with thermal correction, asperity
share, shear in every cell (rheology, traction, temperature), rolling resistance, hysteresis.
"""

from __future__ import annotations

from lambda_core.physics.compiled.layout import C_DAMP, C_LOAD, FAULT, NW, OUT, helper
from lambda_core.physics.compiled.resultant import sum_wrench
from lambda_core.physics.compiled.scalar_stages import film_stage, normal_stage
from lambda_core.physics.compiled.shear import shear_stage, slip_field


def raceway_wrench(which, q, laws, par, systems, grid, cells, scratch, scalars, wrench):
    """Run the whole pipeline of one contact; an entry point of its own, called by pointer.

    Parameters
    ----------
    which : int
        INNER or OUTER.
    q : float64[:], at least (9,)
        Kinematics of the contact.
    laws, par, systems, grid, cells, scratch
        See layout.Bundle; `cells` is one of its two blocks.
    scalars : float64[:]
        Result: scalars of the contact (layout.C_LOAD ...).
    wrench : float64[:]
        Result: force and couple on the ball at the contact's centre, axes t, s, n.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch[FAULT] says which was not.
    """
    system, out, fault = systems[0], scratch[OUT], scratch[FAULT]
    if normal_stage(which, q, laws, par, system, scalars, out, fault) != 1:
        return 0
    if system.friction_on == 0:
        wrench[:NW] = 0.0
        wrench[2] = -(scalars[C_LOAD] + scalars[C_DAMP])
        return 1
    if film_stage(which, q, laws, par, system, scalars, out, fault) != 1:
        return 0
    slip_field(which, q, system, grid, scalars, cells)
    if shear_stage(which, laws, par, system, grid, scalars, cells, fault) != 1:
        return 0
    sum_wrench(which, q, system, grid, scalars, cells, wrench)
    return 1


pipeline = helper(raceway_wrench)
