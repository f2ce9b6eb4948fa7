"""Mount roller bearings: seats and temperatures take clearance."""

from __future__ import annotations

from lambda_core.case.case import Case
from lambda_core.catalogue.protocol import Catalogue
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.model.bodies.resolve_materials import resolve_material
from lambda_core.model.geometry.resolve_clearance import clearance_in_operation, resolve_mounting
from lambda_core.model.geometry.resolve_geometry import resolve_geometry
from lambda_core.model.geometry.roller_limits import check_roller_clearance
from lambda_core.model.ledger import Ledger


def in_operation(case: Case, rollers: RollerBearing, catalogue: Catalogue, ledger: Ledger) -> RollerBearing:
    """Return rollers with their clearance mounted and warm.

    It is that of motion. Without fits and temperatures the clearance counts as that in operation.
    """
    from lambda_core.model.rollers_in_motion import as_balls, with_clearance  # which resolves rollers at rest itself

    if case.bearing.fits is None and case.bearing.temperatures is None:
        return rollers
    balls, apart = as_balls(case, rollers), Ledger()
    inner, roller = (resolve_material(part, case, catalogue, apart).solid for part in ("inner", "balls"))
    found = resolve_geometry(balls.bearing, None, catalogue, apart)
    if found is None or apart.problems:
        return rollers  # the check of the case says what is wrong
    geometry, bought = found
    mounting = resolve_mounting(balls, geometry, bought, inner, roller, ledger)
    if mounting is None:
        return rollers
    mounted = with_clearance(rollers, clearance_in_operation(balls, geometry, mounting, ledger))
    check_roller_clearance(mounted, ledger)
    return mounted
