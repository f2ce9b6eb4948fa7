"""Show one raceway contact cell by cell.

Compiled at first use.
"""

from __future__ import annotations

from lambda_core.solver import records as R
from lambda_core.solver.contact.contact_kinematics import contact_wrench, touch
from lambda_core.solver.contact.dissipation import raceway_losses
from lambda_core.solver.layout import array1, bundle_t, cells_of, grid_of, i8, losses_of, table_t

probe_sig = i8(table_t(R.BALL), table_t(R.BODY_STATE), i8, bundle_t, array1)


def probe(balls, rings, k, bundle, losses):
    """Run the pipeline of one contact.

    The states are given; this is an entry point.

    Parameters
    ----------
    balls, rings : records.BALL, records.BODY_STATE, each shape (1,)
    k : int
        Row of the table of raceways.
    bundle : Bundle
        Cells, kinematics and scalars are left in bundle.cells and bundle.scratch.
    losses : float64[:], shape (6 raceways,)
        Power dissipated by mechanism is added here [W].

    Returns
    -------
    int
        1 when every kernel was well; 0 when one refused (scratch.fault); -1 when the bodies do not touch.
    """
    scratch, system, raceway = bundle.scratch[0], bundle.system[0], bundle.raceways[k]
    kin, contact, ball, ring = scratch.kinematics[0], scratch.contact[0], balls[0], rings[0]
    if not touch(ball, ring, raceway, bundle, kin) > 0.0:
        return -1
    ok = contact_wrench(raceway, 0, bundle)
    if ok == 1:
        cells, grid = cells_of(bundle.cells, 0, 1, bundle.grid.shape[1]), grid_of(bundle.grid)
        named = losses_of(losses, bundle.raceways.size)
        raceway_losses(raceway, kin, system, grid, contact, cells, named)
    return ok
