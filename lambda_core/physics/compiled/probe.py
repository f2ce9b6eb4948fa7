"""One raceway contact on its own, cell by cell: what a view shows of it. Compiled when it is first asked for."""

from __future__ import annotations

from lambda_core.physics.compiled.kinematics import contact_kinematics, surface_lift
from lambda_core.physics.compiled.layout import INNER, KIN, SCALARS, WRENCH, array1, bundle_t, i8
from lambda_core.physics.compiled.losses import raceway_losses

probe_sig = i8(array1, array1, i8, bundle_t, array1)


def probe(ball, ring, which, bundle, losses):
    """Run the pipeline of one contact at given states; an entry point.

    Parameters
    ----------
    ball, ring : float64[:], shapes (9,) and (12,)
    which : int
        INNER or OUTER.
    bundle : Bundle
        Cells, kinematics and scalars are left in bundle.cells[0] and bundle.scratch.
    losses : float64[:], shape (NL,)
        Power dissipated by mechanism is added here [W].

    Returns
    -------
    int
        1 when every kernel was well; 0 when one refused (scratch[FAULT]); -1 when the bodies do not touch.
    """
    scratch, system = bundle.scratch, bundle.system[0]
    kin, scalars = scratch[KIN], scratch[SCALARS]
    surface_lift(ball, ring, which, bundle, kin)
    if not contact_kinematics(ball, ring, which, system, kin) > 0.0:
        return -1
    laws = bundle.laws.inner if which == INNER else bundle.laws.outer
    ok = bundle.wrench(
        which, kin, laws, bundle.par, bundle.system, bundle.grid, bundle.cells[0], scratch, scalars, scratch[WRENCH]
    )
    if ok == 1:
        raceway_losses(which, kin, system, bundle.grid, scalars, bundle.cells[0], losses)
    return ok
