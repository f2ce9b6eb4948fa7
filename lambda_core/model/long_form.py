"""Write one bearing of the catalogue as a machine."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from lambda_core.case.case_io import Source, bearing_case
from lambda_core.case.machine import MachineCase
from lambda_core.case.short_form import LongForm, expand
from lambda_core.case.written import validate
from lambda_core.domain.elements import POSE
from lambda_core.elements.roller.roller_thrust import takes_one_side
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.bodies.resolve_bodies import shaft_inertia
from lambda_core.model.checking import resolve
from lambda_core.model.geometry.axial_play import axial_play, bought_clearance
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.ledger import Ledger


def long_form(source: Source, overrides: Iterable[str] = ()) -> LongForm:
    """Write the case of one bearing as a machine.

    This bearing is on a rigid shaft, to go on from.

    Parameters
    ----------
    source : str, Path, mapping or Case
        File, built-in name, plain tables, or a case.
    overrides : iterable of str
        Changes ``path=value``.

    Returns
    -------
    LongForm
        Plain tables, which :func:`lambda_core.api.check` takes, and what the machine has otherwise.

    Raises
    ------
    UsageError, CaseError
        When there is no such case, or it has mistakes.
    """
    case = bearing_case(source, overrides)
    model = resolve(case, is_static=True)
    g = model.geometry
    shaft = shaft_inertia(case.bodies.inner_ring, g, model.inner_material.density, Ledger())
    held = [dof for dof in POSE if model.inner_ring.dofs[dof].mode == "locked"]
    takes = _takes(model)
    play = axial_play(model, bought_clearance(case.bearing, model)) if takes else 0.0
    return expand(case, bar=(shaft.polar, shaft.transverse), held=held, takes=takes, play=play)


def as_machine(source: Source | BearingModel, overrides: Iterable[str] = ()) -> MachineCase:
    """Return one bearing as the case of a machine.

    The parameters are those of :func:`long_form`, or a resolved bearing.
    """
    case = bearing_case(source.case if isinstance(source, BearingModel) else source, overrides)
    return validate(MachineCase, long_form(case).tables, case.name, case.folder)


def _takes(model: BearingModel) -> Literal["+x", "-x"] | None:
    """Return the thrust that a bearing takes.

    A bearing of one direction takes the axial force on the shaft that has its axial load's direction.
    """
    is_angular = bool(model.geometry.contact_angle) and model.geometry.rated_rows == 1
    if not (is_angular if model.rollers is None else takes_one_side(model.rollers)):
        return None
    return "-x" if initial(model.inner_ring.force[0]) < 0.0 else "+x"
