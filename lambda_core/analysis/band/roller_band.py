"""Compute the model band of quasi-static roller bearings."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.band.graded import CLEARANCE, Graded, graded_parameters
from lambda_core.analysis.band.model_band import Effect, band_around
from lambda_core.analysis.band.readings import UNITS_OF
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, SolverError
from lambda_core.domain.roles import ROLLER_FRICTION
from lambda_core.domain.written_values import Scale
from lambda_core.elements.roller.roller_positions import PLACES
from lambda_core.model.roller_case import roller_model
from lambda_core.results.model_band import COVERAGE, QUANTITIES, ModelBand
from lambda_core.results.roller_quasistatic import (
    RollerQuasiStatic,
    roller_answer,
    solve_rollers,
    with_friction,
)

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.roller_case import RollerModel

_TEMPERATURE, _RIB_ROUGHNESS = "lubricant.temperature", "bearing.rollers.rib_roughness"
_RIBS = ("asperity_load",)  # roles whose published range is that of raceways: the answer has asperities at ribs alone
_CLASS = "limits of the clearance class (ISO 5753-1)"
_KEPT = "laws of rollers are not exchanged"


def roller_band(model: BearingModel, base: RollerModel, quantities: Sequence[str] = QUANTITIES) -> ModelBand:
    """Return the 90 % band of a roller bearing.

    It is the band of its quasi-static answer.

    As :func:`model_band` for balls, with the same ranges: of temperature, clearance, roughness of ribs, and of the
    parameters of laws that the answer knows. Each is changed at one place of the rollers; laws are not exchanged.

    Parameters
    ----------
    model : BearingModel
        The bearing with the ranges of its laws.
    base : RollerModel
        The bearing at its operating point, alone or taken out of a machine.
    quantities : sequence of str
        As for :func:`model_band`; a capacitance is left out.
    """
    from lambda_core.case.case_io import parse_case

    fit = parse_case(model.case_toml, model.name).fit
    fitted = [row.path for row in fit.parameters] if fit is not None else []
    found = RollerEffects(model, base, quantities, without=fitted)
    found.left_out += [f"{path} is left out: it is fitted" for path in fitted]
    effects, answer = list(found.all()), roller_answer(base, solve_rollers(base))
    bands = [
        band_around(name, UNITS_OF[name], i, _read(answer, name, base), effects) for i, name in enumerate(found.names)
    ]
    return ModelBand(case=base.name, coverage=COVERAGE, bands=bands, left_out=found.left_out)


class RollerEffects:
    """Effects of each range on a roller bearing.

    See :class:`Effects`.

    Parameters
    ----------
    model, base, quantities
        As for :func:`roller_band`; results that the answer does not have are left out.
    without : collection of str
        Paths of parameters that are not varied.
    """

    def __init__(
        self, model: BearingModel, base: RollerModel, quantities: Sequence[str], without: Iterable[str] = ()
    ) -> None:
        self._model, self._base, self._without = model, base, set(without)
        self._solved = solve_rollers(base, PLACES[:1])
        answer = roller_answer(base, self._solved)
        self.names = tuple(name for name in quantities if _exists(_read(answer, name, base)))
        self._values = np.array([_read(answer, name, base) for name in self.names])
        self.left_out = [_KEPT]

    def all(self) -> Iterator[Effect]:
        """Yield the effects of all parameters.

        Changes without a solution are left out and named.
        """
        for graded, ends in _changed(self._model, self._base, self.left_out):
            if graded.path in self._without:
                continue
            try:
                alternatives = np.array([self._logarithms(one) for one in ends])
            except SolverError as error:
                self.left_out.append(f"{graded.short} is left out: {error}")
                continue
            yield Effect(graded.short, graded.source, alternatives, is_range=True)

    def _logarithms(self, changed: RollerModel) -> FloatArray:
        """Return ln of relative results at one place.

        Results of a changed model over those of the base, for one place of the rollers.
        """
        is_moved = changed.bearing != self._base.bearing
        solved = solve_rollers(changed, PLACES[:1]) if is_moved else with_friction(changed, self._solved)
        answer = roller_answer(changed, solved)
        return np.asarray(np.log(np.array([_read(answer, name, changed) for name in self.names]) / self._values))


def _changed(
    model: BearingModel, base: RollerModel, left_out: list[str]
) -> Iterator[tuple[Graded, tuple[RollerModel, ...]]]:
    """Yield every parameter and its models at the ends.

    The answer depends on the parameter; the ends are those of its range.
    """
    from lambda_core.case.case_io import parse_case

    case = parse_case(model.case_toml, model.name)
    written = roller_model(case)
    values = written.values if written is not None else ()
    for graded in graded_parameters(replace(model, values=(*model.values, *values))):
        if not graded.low < graded.high:
            continue
        low, high = graded.si(graded.low), graded.si(graded.high)
        field = _field(graded)
        if field:
            yield graded, tuple(replace(base, friction=replace(base.friction, **{field: end})) for end in (low, high))
        elif graded.path == _TEMPERATURE:
            try:
                oils = [roller_model(case, graded.changes(end)) for end in (graded.low, graded.high)]
            except CaseError as error:
                left_out.append(f"{graded.short} is left out: {error}")
                continue
            yield graded, tuple(replace(base, oil=one.oil) for one in oils if one is not None)
    if written is not None:
        yield from _of_class(case, written, base)


def _of_class(case: Case, written: RollerModel, base: RollerModel) -> Iterator[tuple[Graded, tuple[RollerModel, ...]]]:
    """Yield the clearance with the limits of its class.

    Only where the case leaves it to the class.
    """
    found = [roller_model(case, (f"bearing.clearance_pick={pick}",)) for pick in ("minimum", "maximum")]
    low, high = (one.bearing.clearance for one in found if one is not None)
    if not low < high or "clearance_pick" in case.bearing.model_fields_set:
        return
    own, bearing = written.bearing.clearance, base.bearing
    ends = (replace(bearing, clearance=bearing.clearance + end - own) for end in (low, high))
    graded = Graded(CLEARANCE, 1e6 * own, 1e6 * low, 1e6 * high, Scale("um"), _CLASS, "published")
    yield graded, tuple(replace(base, bearing=one) for one in ends)


def _field(graded: Graded) -> str:
    """Return the name in FrictionParameters of a parameter.

    It is "" where the answer does not have it.
    """
    if graded.path == _RIB_ROUGHNESS:
        return "rib_roughness"
    if not graded.law:
        return ""
    _, role, name = graded.path.split(".")
    law, fields = ROLLER_FRICTION.get(role, ("", {}))
    return fields.get(name, "") if graded.law == law and role not in _RIBS else ""


def _exists(value: float) -> bool:
    return math.isfinite(value) and value != 0.0


def _read(answer: RollerQuasiStatic, name: str, model: RollerModel) -> float:
    """Return a result in the unit of its name.

    NaN where there is none.
    """
    torque = math.nan if answer.friction_torque_Nmm is None else answer.friction_torque_Nmm
    life = answer.reference_life_h
    return {
        "friction torque": torque,
        "power loss": 1e-3 * torque * abs(model.speeds[0] - model.speeds[1]),
        "minimum film": answer.film_um[0] if answer.film_um else math.nan,
        "maximum pressure": answer.max_pressure_GPa,
        "rating life": math.nan if life is None else life,
    }.get(name, math.nan)
