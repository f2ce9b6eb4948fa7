"""Compute wrenches of raceway contacts from kinematics.

Each stage is a kernel of the model: normal force, damping, film with thermal correction, asperity share, shear in every
cell (rheology, traction, temperature), rolling resistance, hysteresis.
"""

from __future__ import annotations

from lambda_core.solver.contact.resultant import sum_wrench
from lambda_core.solver.contact.scalar_stages import film_stage, normal_stage, rolling_stage
from lambda_core.solver.contact.shear import shear_stage, slip_field
from lambda_core.solver.layout import cells_of, grid_of, helper
from lambda_core.solver.vec import clear

ENLARGED = 1e-5  # by how much of itself the slip of the last contact is enlarged, for derivatives; laws are smooth


@helper
def pipeline(raceway, first, count, enlarged, laws, par, system, grid_table, block, scratch):
    """Run the pipeline of contacts or films.

    Films are those that nothing presses yet; see raceway_wrenches.

    With `enlarged` = 1 the slip in every cell of the last contact is larger by ENLARGED of itself.
    """
    if normal_stage(raceway, first, count, laws, par, system, scratch) != 1:
        return 0
    if system.friction_on == 0 or scratch.kinematics[first].penetration <= 0.0:
        for k in range(first, first + count):
            clear(scratch.wrench[k])
            scratch.wrench[k].force[2] = -(scratch.contact[k].load + scratch.contact[k].damping_force)
        return 1
    if film_stage(raceway, first, count, laws, par, scratch) != 1:
        return 0
    if rolling_stage(raceway, first, count, laws, par, scratch) != 1:
        return 0
    grid, width = grid_of(grid_table), grid_table.shape[1]
    for k in range(count):
        slip_field(
            raceway, scratch.kinematics[first + k], system, grid, scratch.contact[first + k],
            cells_of(block, k, 1, width),
        )  # fmt: skip
    if enlarged == 1:
        slip = cells_of(block, count - 1, 1, width).slip
        for i in range(width):
            slip[i] *= 1.0 + ENLARGED
    if shear_stage(raceway, first, count, laws, par, grid, block, scratch) != 1:
        return 0
    for k in range(count):
        sum_wrench(
            raceway, scratch.kinematics[first + k], system, grid, scratch.contact[first + k],
            cells_of(block, k, 1, width), scratch.wrench[first + k],
        )  # fmt: skip
    return 1


def raceway_wrenches(raceway, first, count, laws, par, system, grid, cells, scratch):
    """Run the pipeline of one raceway's contacts.

    A separate entry point, called by pointer.

    Parameters
    ----------
    raceway : records.RACEWAY
    first, count : int
        Places of the contacts in scratch, where their kinematics are. Either all of them carry load or none does.
    laws : layout.RacewayLaws
    par, system, grid, cells, scratch
        See layout.Bundle; contact `first` has the first cells. Scalars of the contacts are left in scratch.contact,
        force and couple on the balls at the centres of the contacts in scratch.wrench, axes t, s, n.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch.fault says which was not, with what it takes of the first.
    """
    return pipeline(raceway, first, count, 0, laws, par, system, grid, cells, scratch)
