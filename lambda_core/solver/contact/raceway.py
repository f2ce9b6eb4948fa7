"""The contact pipeline of one ball-raceway contact: from its kinematics to the wrench on the ball.

Stages, each a kernel of the model: normal force, damping, film with thermal correction, asperity
share, shear in every cell (rheology, traction, temperature), rolling resistance, hysteresis.
"""

from __future__ import annotations

from lambda_core.solver.contact.resultant import sum_wrench
from lambda_core.solver.contact.scalar_stages import film_stage, normal_stage
from lambda_core.solver.contact.shear import shear_stage, slip_field
from lambda_core.solver.layout import cells_of, grid_of, helper
from lambda_core.solver.vec import clear


@helper
def pipeline(raceway, kin, laws, par, system, grid, cells, scratch, contact, wrench):
    """Run the whole pipeline of one contact, or of a film that nothing presses yet; see raceway_wrench."""
    out, fault = scratch.out[:], scratch.fault
    contact.wet = 0
    if normal_stage(raceway, kin, laws, par, system, contact, out, fault) != 1:
        return 0
    if system.friction_on == 0 or kin.penetration <= 0.0:
        clear(wrench)
        wrench.force[2] = -(contact.load + contact.damping_force)
        return 1
    if film_stage(raceway, kin, laws, par, contact, out, fault) != 1:
        return 0
    slip_field(raceway, kin, system, grid, contact, cells)
    if shear_stage(raceway, laws, par, grid, contact, cells, fault) != 1:
        return 0
    sum_wrench(raceway, kin, system, grid, contact, cells, wrench)
    return 1


def raceway_wrench(raceway, kin, laws, par, system, grid, cells, scratch, contact, wrench):
    """Run the whole pipeline of one contact; an entry point of its own, called by pointer.

    Parameters
    ----------
    raceway : records.RACEWAY
    kin : records.KINEMATICS
    laws : layout.RacewayLaws
    par, system, grid, cells, scratch
        See layout.Bundle; `cells` is one of its two blocks.
    contact : records.CONTACT
        Result: scalars of the contact.
    wrench : records.WRENCH
        Result: force and couple on the ball at the contact's centre, axes t, s, n.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch.fault says which was not.
    """
    return pipeline(raceway, kin, laws, par, system, grid_of(grid), cells_of(cells), scratch, contact, wrench)
