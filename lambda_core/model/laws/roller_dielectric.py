"""Resolve what the capacitance of rollers needs.

The quasi-static answer has one law for both raceways and one for all ribs, in plain Python.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import RIBS
from lambda_core.domain.errors import SolverError
from lambda_core.domain.roles import DEFAULT_LINE_MODELS, DEFAULT_MODELS
from lambda_core.elements.roller.roller_capacitance import Dielectric
from lambda_core.laws.par import flat_kernel
from lambda_core.laws.probe import trial_context
from lambda_core.model.bearing_model import ChosenLaw
from lambda_core.model.laws.law_context import build_context, prepare
from lambda_core.model.laws.law_packages import law_called
from lambda_core.model.laws.resolve_laws import LawResolver
from lambda_core.model.laws.roller_laws import law_of_rollers, written_parameters

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.catalogue.protocol import LubricantRow
    from lambda_core.elements.roller.roller_bearing import RollerBearing
    from lambda_core.laws.context import Context, Oil
    from lambda_core.laws.law import Law
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.laws.law_context import ContactFrame
    from lambda_core.model.laws.resolve_laws import ModelSource
    from lambda_core.model.ledger import Ledger

_ELEMENT, _ROLE = "ball_inner", "capacitance"
_Density = Callable[[FloatArray], FloatArray]  # over pressure [Pa], at the bulk temperature


def dielectric_of_case(
    case: Case,
    row: LubricantRow,
    oil: Oil,
    density: _Density,
    rollers: RollerBearing,
    registry: ModelSource,
    ledger: Ledger,
) -> Dielectric | None:
    """Return a case's oil and contacts.

    None follows a problem.

    Parameters
    ----------
    row, oil
        The lubricant and its oil at the bulk temperature.
    density : callable
        Density of the oil [kg/m3] over pressure [Pa].
    rollers : RollerBearing
        Geometry, for the set-up of laws that ask for it.
    """
    permittivity = LawResolver(case, registry, row, "", ledger).law(_ELEMENT, "permittivity")
    line = _line(case, registry, ledger)
    if permittivity is None or line is None:
        return None
    point = law_called(registry, _ROLE, DEFAULT_MODELS[_ROLE], given=False)
    context = replace(
        trial_context(_ELEMENT),
        oil=oil,
        ball_count=rollers.count,
        ball_diameter=rollers.diameter,
        pitch_diameter=rollers.pitch_diameter,
        bore_diameter=rollers.bore,
        outside_diameter=rollers.outside,
        width=rollers.width,
        series="",
        contact_angle=rollers.angles.inner,
        radius_x=rollers.radius("inner"),
        radius_y=rollers.effective_length,
    )
    return _dielectric(permittivity, line, ChosenLaw(point, point.parameters(), {}), context, density)


def dielectric_of_model(model: BearingModel, frame: ContactFrame, oil: Oil) -> Dielectric:
    """Return the oil and contacts of rollers in motion.

    Parameters
    ----------
    frame, oil
        Of the inner raceway.
    """
    laws = model.laws[_ELEMENT]
    context = build_context(model, _ELEMENT, frame, oil)
    rheology = laws["rheology"]
    kernel, par = flat_kernel(rheology.model), prepare(rheology, context)

    def density(pressure: FloatArray) -> FloatArray:
        ln_eta, rho = np.full(pressure.size, np.nan), np.full(pressure.size, np.nan)
        _check(rheology.model, kernel(pressure, np.full(pressure.size, oil.temperature), par, ln_eta, rho))
        return rho

    ribs = next((model.laws[rib] for rib in RIBS if rib in model.laws), laws)
    return _dielectric(laws["permittivity"], laws[_ROLE], ribs[_ROLE], context, density)


def _line(case: Case, registry: ModelSource, ledger: Ledger) -> ChosenLaw | None:
    """Return the law of the capacitance at raceways."""
    role, given = _ROLE, case.models.capacitance

    def called(role: str, name: str) -> Law:
        return law_called(registry, role, name, given=given is not None)

    law = law_of_rollers(called, role, given or DEFAULT_LINE_MODELS[role], ledger)
    values = written_parameters(law, role, case.parameters.get(role, {}), ledger) if law is not None else None
    return ChosenLaw(law, values, {}) if law is not None and values is not None else None


def _dielectric(
    permittivity: ChosenLaw, line: ChosenLaw, point: ChosenLaw, context: Context, density: _Density
) -> Dielectric:
    oil_kernel, oil_par = flat_kernel(permittivity.model), prepare(permittivity, context)

    def over_pressure(pressure: FloatArray) -> FloatArray:
        found = np.full(pressure.size, np.nan)
        temperature = np.full(pressure.size, context.oil.temperature)
        _check(permittivity.model, oil_kernel(pressure, temperature, density(pressure), oil_par, found), found)
        return found

    return Dielectric(over_pressure, _of_contacts(line, context), _of_contacts(point, context))


def _of_contacts(law: ChosenLaw, context: Context) -> Callable[..., float]:
    kernel, par = flat_kernel(law.model), prepare(law, context)

    def found(*numbers: float) -> float:
        out = np.full(1, np.nan)
        _check(law.model, kernel(*numbers, par, out), out)
        return float(out[0])

    return found


def _check(law: Law, status: int, found: FloatArray | None = None) -> None:
    """Refuse what a law reports, and no number."""
    if status != 1 or (found is not None and not np.isfinite(found).all()):
        sentence = law.errors.get(status, "no finite number")
        raise SolverError(f"{law.label} at the contacts of rollers: {sentence}")
