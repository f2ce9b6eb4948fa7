"""Lock tilts that a bearing cannot hold.

It does so where a case says nothing of them.
"""

from __future__ import annotations

from lambda_core.case.case import Case
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.model.ledger import Ledger

TILTS = ("tilt_y", "tilt_z")


def hold_tilts(case: Case, geometry: Geometry, ledger: Ledger) -> Case:
    """Return the case with locked tilts.

    It locks those of a self-aligning bearing's inner ring where the case has no option for them.

    The sphere turns under the balls without resistance: nothing in the bearing decides its misalignment.
    """
    inner = case.bodies.inner_ring
    if not geometry.kind.on_sphere:
        return case
    for dof in TILTS:
        state = getattr(inner, dof)
        if dof in inner.model_fields_set and state.mode == "free" and not state.stiffness:
            ledger.problem(
                f"bodies.inner_ring.{dof}",
                "is free, and a self-aligning bearing holds no tilt: locked, prescribed (the misalignment), or with a "
                "stiffness",
            )
    silent = [dof for dof in TILTS if dof not in inner.model_fields_set]
    if not silent:
        return case
    ledger.assume(
        f"the inner ring does not tilt ({' and '.join(silent)}): a self-aligning bearing"
        " takes any misalignment without resistance, so that the shaft decides it; another one: "
        'tilt_y = { mode = "prescribed", motion = "10 mrad" }'
    )
    locked = {dof: type(getattr(inner, dof))(mode="locked") for dof in silent}
    bodies = case.bodies.model_copy(update={"inner_ring": inner.model_copy(update=locked)})
    return case.model_copy(update={"bodies": bodies})
