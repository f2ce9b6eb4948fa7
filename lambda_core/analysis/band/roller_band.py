"""Compute the model band of quasi-static roller bearings."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.band.effects import SEEN_STEPS, Effect, range_effect
from lambda_core.analysis.band.graded import CLEARANCE, Exchange, Graded, exchanges, graded_parameters
from lambda_core.case.fitted import finished_fit
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError
from lambda_core.domain.roles import ROLLER_CHOICES, ROLLER_FRICTION
from lambda_core.domain.written_values import Scale
from lambda_core.elements.roller.roller_positions import PLACES
from lambda_core.model.roller_case import roller_model
from lambda_core.results.model_band import LAW_OF
from lambda_core.results.quasistatic import QuasiStatic
from lambda_core.results.roller_quasistatic import roller_answer, solve_rollers, with_friction

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.roller_case import RollerModel

_TEMPERATURE, _RIB_ROUGHNESS = "lubricant.temperature", "bearing.rollers.rib_roughness"
_ELECTRIC = ("parameters.permittivity.", "parameters.capacitance.")
_RIBS = ("asperity_load",)  # roles whose published range is that of raceways: the answer has asperities at ribs alone
_CLASS = "limits of the clearance class (ISO 5753-1)"
_KEPT = "laws of ribs, losses in the solids and capacitance are not exchanged"


class RollerEffects:
    """Effects of each range on a roller bearing.

    See :class:`~.effects.Effects`.

    The ranges are those of balls: of temperature, clearance, roughness of ribs, and of the parameters of laws that the
    answer knows, and so are the exchanged laws. Each is changed at one place of the rollers.

    Parameters
    ----------
    model : BearingModel
        The bearing with the ranges of its laws.
    base : RollerModel
        The bearing at its operating point, alone or taken out of a machine.
    quantities : sequence of str
        Results; those that the answer does not have are left out.
    without : collection of str
        Paths of parameters that are not varied.
    """

    def __init__(
        self, model: BearingModel, base: RollerModel, quantities: Sequence[str], without: Iterable[str] = ()
    ) -> None:
        fit = finished_fit(model.case.fit)
        fitted = [row.path for row in fit.parameters] if fit is not None else []
        self._model, self._base, self.case = model, base, base.name
        self._without = {*without, *fitted}
        self._kept = {path.split(".")[1] for path in fitted if path.startswith("parameters.")}  # laws of fitted values
        self._solved = solve_rollers(base, PLACES[:1])
        answer = roller_answer(base, self._solved)
        self.names = tuple(name for name in quantities if _exists(_read(answer, name, base)))
        self._values = np.array([_read(answer, name, base) for name in self.names])
        self.left_out = [_KEPT, *(f"{path} is left out: it is fitted" for path in fitted)]

    def values_at_all_positions(self) -> FloatArray:
        """Return the results, averaged over all positions."""
        answer = roller_answer(self._base, solve_rollers(self._base))
        return np.array([_read(answer, name, self._base) for name in self.names])

    def by_seen(self) -> FloatArray:
        """Return slopes of the logarithms, shape (2, n).

        The slopes are by the temperature of the oil [1/K] and by the clearance [1/m].
        """
        case, base = self._model.case, self._base
        warmer = roller_model(case, (f"{_TEMPERATURE}={base.temperature + SEEN_STEPS[0]!r} K",))
        assert warmer is not None
        wider = replace(base.bearing, clearance=base.bearing.clearance + SEEN_STEPS[1])
        moved = (replace(base, oil=warmer.oil, dielectric=warmer.dielectric), replace(base, bearing=wider))
        changes = np.array([self._logarithms(one) for one in moved])
        return np.asarray(changes / np.array(SEEN_STEPS)[:, np.newaxis])

    def all(self) -> Iterator[Effect]:
        """Yield the effects of all parameters.

        Changes without a solution are left out and named.
        """
        for graded, ends in _changed(self._model, self._base, self.left_out):
            if graded.path in self._without:
                continue

            def rows(ends: tuple[RollerModel, ...] = ends) -> list[FloatArray]:
                return [self._logarithms(one) for one in ends]

            yield from range_effect(graded, rows, self.left_out)
        for exchange in exchanges(self._model):
            if exchange.role in ROLLER_CHOICES and exchange.role not in self._kept:
                found = [np.zeros(len(self.names)), *self._exchanged(exchange)]
                yield Effect(f"{LAW_OF}{exchange.role}", exchange.source, np.array(found), is_range=False)

    def _exchanged(self, exchange: Exchange) -> Iterator[FloatArray]:
        for law in exchange.laws:
            yield self._logarithms(_with_friction(self._base, ROLLER_CHOICES[exchange.role], law))

    def _logarithms(self, changed: RollerModel) -> FloatArray:
        """Return ln of relative results at one place.

        They are results of a changed model over those of the base, for one place of the rollers.
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
    case = model.case
    written = roller_model(case)
    values = written.values if written is not None else ()
    for graded in graded_parameters(replace(model, values=(*model.values, *values))):
        if not graded.low < graded.high:
            continue
        low, high = graded.si(graded.low), graded.si(graded.high)
        field = _field(graded)
        if field:
            yield graded, tuple(_with_friction(base, field, end) for end in (low, high))
        elif graded.path == _TEMPERATURE:
            try:
                oils = [roller_model(case, graded.changes(end)) for end in (graded.low, graded.high)]
            except CaseError as error:
                left_out.append(f"{graded.short} is left out: {error}")
                continue
            yield (
                graded,
                tuple(replace(base, oil=one.oil, dielectric=one.dielectric) for one in oils if one is not None),
            )
        elif graded.path.startswith(_ELECTRIC):
            moved = [roller_model(case, graded.changes(end)) for end in (graded.low, graded.high)]
            yield graded, tuple(replace(base, dielectric=one.dielectric) for one in moved if one is not None)
    if written is not None:
        yield from _of_class(case, written, base)


def _with_friction(base: RollerModel, field: str, value: float | str) -> RollerModel:
    changed: dict[str, Any] = {field: value}
    return replace(base, friction=replace(base.friction, **changed))


def _of_class(case: Case, written: RollerModel, base: RollerModel) -> Iterator[tuple[Graded, tuple[RollerModel, ...]]]:
    """Yield the clearance with the limits of its class.

    It applies only where the case leaves the clearance to the class.
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
    laws, fields = ROLLER_FRICTION.get(role, ((), {}))
    return fields.get(name, "") if graded.law in laws and role not in _RIBS else ""


def _exists(value: float) -> bool:
    return math.isfinite(value) and value != 0.0


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def _read(answer: QuasiStatic, name: str, model: RollerModel) -> float:
    """Return a result in the unit of its name.

    NaN where there is none.
    """
    torque = _or_nan(answer.friction_torque_Nmm)
    life = None if answer.rating is None else answer.rating.reference_life_h
    return {
        "friction torque": torque,
        "power loss": 1e-3 * torque * abs(model.speeds[0] - model.speeds[1]),
        "minimum film": _or_nan(answer.rollers.min_film_um if answer.rollers else None),
        "maximum pressure": answer.max_pressure_GPa,
        "capacitance": _or_nan(answer.bearing_capacitance_nF),
        "rating life": _or_nan(life),
    }.get(name, math.nan)
