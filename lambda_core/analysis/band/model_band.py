"""Compute the 90 % model band of results."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.band.effects import Effect, Effects
from lambda_core.analysis.band.readings import READ, UNITS_OF
from lambda_core.analysis.band.temperature_effects import GIVEN, LOSS, BearingEffects, following, in_time
from lambda_core.analysis.static_point import LoadedBearing, StaticPoint, static_point
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import SolverError, UsageError, unknown_name
from lambda_core.results.model_band import (
    COVERAGE,
    QUANTITIES,
    TEMPERATURES,
    Band,
    Contributor,
    MachineBand,
    ModelBand,
    temperature_of,
)

if TYPE_CHECKING:
    from lambda_core.analysis.thermal.found_temperatures import FoundTemperatures
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel

_NORMAL = 1.6448536269514722  # standard deviations of a normal distribution within which 90 % lie
_LEAST_SHARE = 0.02  # of the variance of a contributor that is named
_ZERO_CELSIUS = 273.15


@one_blas_thread()
def model_band(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    quantities: Sequence[str] = QUANTITIES,
    bearing: str | None = None,
    announce: Callable[[str], None] | None = None,
) -> ModelBand | MachineBand:
    """Return the 90 % band of quasi-static results.

    Each parameter is taken as uniformly distributed over its range, each law of a role as equally likely, all
    independent of each other; their effects on the logarithm of a result are added (first order). The values of a
    fitted case have the errors and correlations of the fit in place of their ranges, and their laws are kept.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    quantities : sequence of str
        Results: "friction torque", "power loss", "minimum film", "maximum pressure", "capacitance", "rating life".
    bearing : str, optional
        One of a machine's; by default all of them, each under its loads in the machine.
    announce : callable, optional
        Called with a sentence before something takes longer.

    Returns
    -------
    ModelBand or MachineBand
        Of one bearing, or of all of a machine. ``text()`` has a line per result.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case.
    UsageError
        For a quantity that has no band.

    References
    ----------
    First-order propagation with uniform distributions: JCGM 100:2008, sections 4.3.7 and 5.1.2.
    """
    from lambda_core.analysis.rotor.bearing_alone import bearing_number
    from lambda_core.analysis.thermal.temperatures import ready

    for name in quantities:
        if name not in READ:
            raise UsageError(unknown_name("quantity of the model band", name, READ))
    if announce is not None:
        announce("computing the model band from the ranges of parameters and laws")
    model = ready(source, overrides, announce, is_static=True)
    number = None if bearing is None else bearing_number(model, bearing)
    bands = bands_of(model, static_point(model, announce).loaded, quantities, number)
    return bands.bearings.get(bearing or "", bands)  # a bearing alone has the empty name


def bands_or_reason(point: StaticPoint) -> MachineBand:
    """Return the bands of all bearings or their absence."""
    model = point.model
    try:
        return bands_of(model, point.loaded)
    except SolverError as error:
        absent = ModelBand(case=model.name, coverage=COVERAGE, bands=[], left_out=[f"no model band: {error}"])
        return MachineBand(case=model.name, bearings=dict.fromkeys(model.bearing_models, absent))


def bands_of(
    model: BearingModel | MachineModel,
    loaded: Mapping[str, LoadedBearing],
    quantities: Sequence[str] = QUANTITIES,
    number: int | None = None,
) -> MachineBand:
    """Return the bands of a model's bearings.

    They may also be the band of one of the bearings.

    The loads that shaft and gears put on a bearing count as known.
    """
    found, names = model.found_temperatures, list(loaded)
    # computed temperatures join the bearings
    chosen = names if number is None or found is not None else [names[number]]
    each = [effects_of(loaded[name], quantities, found) for name in chosen]
    bands = dict(zip(chosen, _bands(each, quantities, found, names), strict=True))
    return MachineBand(case=model.name, bearings=bands if number is None else {names[number]: bands[names[number]]})


def temperature_band(model: BearingModel | MachineModel) -> ModelBand:
    """Return the bands of all computed temperatures [degC]."""
    loaded, found = static_point(model).loaded, model.found_temperatures
    each = [effects_of(one, (), found) for one in loaded.values()]
    _, warmer = _effects(each, found, list(loaded))
    bands = list(node_bands(found, warmer).values()) if warmer else []
    left_out = list(dict.fromkeys(sentence for one in each for sentence in one.left_out))
    return ModelBand(case=model.name, coverage=COVERAGE, bands=bands, left_out=left_out)


def effects_of(
    bearing: LoadedBearing,
    quantities: Sequence[str],
    found: FoundTemperatures | None = None,
    without: Iterable[str] = (),
) -> BearingEffects:
    """Return the effects on the results asked for.

    Computed temperatures need the loss, and no range of a given temperature.
    """
    names = [name for name in quantities if name not in TEMPERATURES]
    if found is not None:
        names, without = [*names, *([] if LOSS in names else [LOSS])], (*without, *GIVEN)
    if bearing.rollers is None:
        return Effects(bearing.model, names, without)
    from lambda_core.analysis.band.roller_band import RollerEffects

    return RollerEffects(bearing.model, bearing.rollers, names, without)


def deviations(
    one: BearingEffects, quantities: Sequence[str], found: FoundTemperatures | None = None
) -> dict[str, float]:
    """Return each result's relative standard deviation.

    It covers results that ranges and laws move; that of a temperature is relative to its value in degC.
    """
    (effects,), warmer = _effects([one], found, ("",))
    sizes = {name: _size(effects, i) for i, name in enumerate(one.names) if name in quantities}
    if found is None or not warmer:
        return sizes
    for name in (name for name in quantities if name in TEMPERATURES):
        index = [temperature_of(node) for node in found.names].index(name)
        sizes[name] = _size(warmer, index) / abs(float(found.steady.temperatures[index]) - _ZERO_CELSIUS)
    return sizes


def _size(effects: Sequence[Effect], index: int) -> float:
    return math.sqrt(sum(float(effect.variance[index]) for effect in effects))


def _bands(
    each: Sequence[BearingEffects],
    quantities: Sequence[str],
    found: FoundTemperatures | None,
    labels: Sequence[str] = ("",),
) -> list[ModelBand]:
    """Return the bands of bearings and computed temperatures."""
    values_of_each = [one.values_at_all_positions().tolist() for one in each]  # first: one may have no solution
    rows, warmer = _effects(each, found, labels)
    bands = []
    for one, effects, label, values in zip(each, rows, labels, values_of_each, strict=False):
        known = [
            band_around(name, UNITS_OF[name], i, values[i], effects)
            for i, name in enumerate(one.names)
            if name in quantities
        ]
        if warmer and found is not None:
            known += _temperatures(found, warmer, label, quantities)
        without = [band.quantity for band in known if math.isfinite(band.value) and math.isnan(band.high)]
        known = [band for band in known if band.quantity not in without]
        left_out = [*one.left_out, *(f"{name} has no band: at an end of a range there is no value" for name in without)]
        bands.append(ModelBand(case=one.case, coverage=COVERAGE, bands=known, left_out=left_out))
    return bands


def _effects(
    each: Sequence[BearingEffects], found: FoundTemperatures | None, labels: Sequence[str]
) -> tuple[list[list[Effect]], list[Effect]]:
    """Return the effects on results and computed temperatures.

    At rest there is no loss, and temperatures have no band.
    """
    if found is None or any(LOSS not in one.names for one in each):
        return [list(in_time(one)) for one in each], []
    return following(found, each, labels)


def _temperatures(found: FoundTemperatures, effects: Sequence[Effect], label: str, names: Sequence[str]) -> list[Band]:
    """Return the bands of a bearing's oil and rings."""
    bands = node_bands(found, effects)
    nodes = {temperature_of(node): node for node in ("oil", "inner_ring", "outer_ring")}
    own = {name: f"{label}.{node}" if label else node for name, node in nodes.items()}
    return [bands[node].model_copy(update={"quantity": name}) for name, node in own.items() if name in names]


def node_bands(found: FoundTemperatures, effects: Sequence[Effect]) -> dict[str, Band]:
    """Return the bands of temperatures that are found [degC]."""
    bands = {}
    for i, (name, held) in enumerate(zip(found.names, found.loop.nodes.held.tolist(), strict=True)):
        if math.isnan(held):
            value = float(found.steady.temperatures[i]) - _ZERO_CELSIUS
            bands[name] = band_around(temperature_of(name), "degC", i, value, effects, added)
    return bands


def scaled(value: float, logarithm: float) -> float:
    """Return a value with its logarithm moved."""
    return value * math.exp(logarithm)


def added(value: float, change: float) -> float:
    """Return a temperature that is moved."""
    return value + change


def band_around(
    name: str,
    unit: str,
    index: int,
    value: float,
    effects: Sequence[Effect],
    moved: Callable[[float, float], float] = scaled,
) -> Band:
    """Return the band of a printed value.

    The band includes the value, because the value is no correction.

    Alternatives that lie mostly on one side shift the band, and the case keeps its value. The band of a value that is
    not corrected for a known shift ends at the value where it would otherwise leave it out; it then holds at least the
    coverage (Phillips, Eberhardt and Parry 1997, J. Res. NIST 102, 577).
    """
    means = np.array([effect.mean[index] for effect in effects])
    variances = np.array([effect.variance[index] for effect in effects])
    total, shift = float(variances.sum()), float(means.sum())
    half = _NORMAL * math.sqrt(total)
    order = np.argsort(-variances)
    contributors = [
        Contributor(
            name=effects[i].name,
            share=float(variances[i]) / total,
            low=moved(value, float(effects[i].alternatives[:, index].min())),
            high=moved(value, float(effects[i].alternatives[:, index].max())),
            source=effects[i].source,
        )
        for i in order
        if total > 0.0 and variances[i] >= _LEAST_SHARE * total
    ]
    return Band(
        quantity=name,
        unit=unit,
        value=value,
        low=moved(value, min(shift - half, 0.0)),
        high=moved(value, max(shift + half, 0.0)),
        contributors=contributors,
    )
