"""Compute the Stribeck curve of a bearing.

It has the friction torque over speed with its parts, and SKF's catalogue model.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from lambda_core.analysis.thermal.temperatures import ready_model
from lambda_core.case.case_io import is_machine, refuse_bearing
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.errors import EquilibriumError, SolverError, UsageError
from lambda_core.domain.lists import listed
from lambda_core.domain.number_text import rounded
from lambda_core.domain.time_limit import check_time
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.formulas.loading import CARRYING
from lambda_core.results.answer import Answer, answers
from lambda_core.results.band_text import ends
from lambda_core.results.record import INTERFACE
from lambda_core.views.chart import Axis, Mark, Panel, Series, ViewData

if TYPE_CHECKING:
    from lambda_core.analysis.static_point import BearingPoint
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.model_band import MachineBand
    from lambda_core.solver.drivers.compiled_laws import Kernels

_RPM = np.pi / 30.0
# Mechanisms of losses under the names that the picture shows.
_PARTS = {
    "sliding": "sliding of the film",
    "spin": "sliding of the film",
    "boundary": "sliding on asperities",
    "rolling": "rolling of the film",
    "hysteresis": "hysteresis",
    "drag": "drag",
}
# Positions of the balls over half a pitch and their weights: the other half mirrors it under a radial load.
_PHASES = {0.0: 0.25, 0.25: 0.5, 0.5: 0.25}
_LOOKS = {"sliding of the film": 1, "sliding on asperities": 2, "rolling of the film": 3, "hysteresis": 4, "drag": 5}
SLOWEST = 1.0  # [1/min]
_STRIDE = 4.0  # ratio of the speeds at which rollers are followed from the fastest
_LEAST_STEP = 0.9  # ratio of speeds between which the way to an equilibrium is not halved again
FASTEST_FACTOR = 5e5  # n d_m, the usual limit of the catalogues [mm/min]


class SpeedCurve(Answer):
    """Friction torque over speed, quasi-static, without cage."""

    interface: int = INTERFACE
    case: str
    title: str
    speeds_rpm: list[float]
    torque_Nmm: list[float]
    parts_Nmm: dict[str, list[float]] = Field(description="what the torque is made of")
    torque_Nmm_band: list[list[float]] = Field(
        description="ends of the 90 % model band at each speed; empty without one", default=[]
    )
    band_notes: list[str] = Field(description="where and why the torque lies at the end of its band", default=[])
    skf_Nmm: list[float | None] = Field(description="SKF's catalogue model with drag; null where it does not apply")
    film_parameter: list[float] = Field(description="smallest Lambda under load")
    note: str

    def text(self, units: UnitSystem = SI) -> str:
        """Return a table for people."""
        unit, names = "N mm", list(self.parts_Nmm)
        bands: list[tuple[str, ...]] = [(ends(one, unit, units),) for one in self.torque_Nmm_band]
        bands = bands or [()] * len(self.speeds_rpm)
        head = ("1/min", "torque", *(("90 % model band",) if self.torque_Nmm_band else ()), *names, "SKF", "Lambda")
        rows = [
            (f"{n:.4g}", self._torque(i, units), *bands[i],
             *(units.number(self.parts_Nmm[k][i], unit) for k in names),
             units.number(self.skf_Nmm[i], unit), f"{self.film_parameter[i]:.2f}")
            for i, n in enumerate(self.speeds_rpm)
        ]  # fmt: skip
        widths = [max(len(row[i]) for row in (head, *rows)) for i in range(len(head))]
        lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in (head, *rows)]
        return "\n".join(
            [self.title, f"friction torque over speed [{units.unit(unit)}]", *lines, *self.band_notes, self.note]
        )

    def _torque(self, point: int, units: UnitSystem) -> str:
        """Write the torque, rounded to its band."""
        if not self.torque_Nmm_band:
            return units.number(self.torque_Nmm[point], "N mm")
        low, high, torque = (units.value(one, "N mm") for one in (*self.torque_Nmm_band[point], self.torque_Nmm[point]))
        return rounded(torque, 0.5 * abs(high - low))


@answers
@one_blas_thread()
def stribeck(
    source: Source | MachineModel,
    overrides: Iterable[str] = (),
    *,
    bearing: str | None = None,
    speeds_rpm: Sequence[float] = (),
    points: int = 16,
    band: bool = False,
    announce: Callable[[str], None] | None = None,
) -> SpeedCurve:
    """Return the friction torque over speed, the Stribeck curve.

    Parameters
    ----------
    source, overrides
        As for :func:`check`; the case's own speed counts for nothing.
    bearing : str, optional
        Which one of a machine: under the constant load that it carries there at t = 0.
    speeds_rpm : sequence of float
        Speeds [1/min]; from 1 1/min to n d_m = 500 000 mm/min, evenly by their logarithm, when empty.
    points : int
        Number of these speeds.
    band : bool
        Also compute the 90 % model band of the torque: in full at up to 8 speeds, interpolated between them.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    SpeedCurve
        Parts of the torque, and SKF's model; quasi-static, the mean over positions of the balls, without cage.

    Raises
    ------
    UsageError
        For speeds that are not above zero, or fewer than two of them.
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium at a speed.
    """
    from lambda_core.solver.drivers.compiled_laws import Kernels

    given, changes = list(speeds_rpm), tuple(listed(overrides, "overrides"))
    if any(not speed > 0.0 for speed in given):
        raise UsageError("speeds of a Stribeck curve must be above zero: the axis is logarithmic")
    if (len(given) or points) < 2:
        raise UsageError("a Stribeck curve needs two speeds or more")
    model_at, of_load, own = _models(source, changes, bearing, announce)
    model = model_at(given[0] if given else SLOWEST)
    fastest = FASTEST_FACTOR / (500.0 * (model.geometry.bore_diameter + model.geometry.outside_diameter))
    given = given or np.geomspace(SLOWEST, fastest, points).tolist()
    kernels = Kernels(model)
    found, rolling = _points(model_at, given, fastest, kernels)
    torques = [sum(parts.values()) for parts, _, _ in found]
    names, (bands, notes) = dict.fromkeys(_PARTS.values()), _bands(model_at, given, torques) if band else ([], [])
    return SpeedCurve(
        case=model.name,
        title=model.title,
        speeds_rpm=given,
        torque_Nmm=torques,
        torque_Nmm_band=bands,
        band_notes=notes,
        parts_Nmm={name: [parts[name] for parts, _, _ in found] for name in names},
        skf_Nmm=[skf for _, skf, _ in found] if own.rollers is None else _skf_of_rollers(own, given),
        film_parameter=[film for _, _, film in found],
        note=f"quasi-static, mean over the positions of the {model.elements}, "
        + ("neighbours left out" if model.full_complement else "without cage")
        + of_load
        + ("" if model.rollers is None else _of_rollers(fastest, given, rolling)),
    )


def _of_rollers(fastest: float, speeds: Sequence[float], rolling: Sequence[float]) -> str:
    """Say which equilibria of rollers a curve has."""
    followed = "" if len(rolling) == len(speeds) else f"; the equilibrium that continues the one at {fastest:.0f} 1/min"
    rolled = f"; at {_span(rolling)} 1/min rollers roll: no steady motion with friction was found" if rolling else ""
    return followed + rolled


def _models(
    source: Any, changes: tuple[str, ...], bearing: str | None, announce: Callable[[str], None] | None
) -> tuple[Callable[[float], BearingModel], str, BearingPoint]:
    """Return a function from speed to model.

    The speed is that of the bearing [1/min]. Also return a note about its load: in a machine it stays as it is at the
    speed of the case, where the loads of a bearing alone are those of its case; and the bearing at its point.
    """
    from lambda_core.analysis.rotor.bearing_alone import at_speed, bearing_number
    from lambda_core.analysis.static_point import static_point

    if is_machine(source):
        from lambda_core.analysis.thermal.temperatures import ready

        model = ready(source, changes, announce)
        own = list(static_point(model, announce).bearings.values())[bearing_number(model, bearing)]
        alone = own.alone
        return (lambda speed: at_speed(alone, speed * _RPM)), ", load of the machine at t = 0", own
    refuse_bearing(bearing)

    def at(speed: float) -> BearingModel:
        return ready_model(source, (*changes, f"operation.speed={speed!r} rpm"), announce)

    return at, "", static_point(at(SLOWEST), announce).bearing("")


def _bands(
    model_at: Callable[[float], BearingModel], speeds: Sequence[float], torques: Sequence[float]
) -> tuple[list[list[float]], list[str]]:
    """Return both ends of the torque's model band, and notes.

    Each speed has a pair of ends, none where the bearing has no band; the notes tell where the torque is near an end.
    """
    from lambda_core.analysis.band.neighbours import places_of
    from lambda_core.analysis.band.over_points import bands_over

    near: dict[str, list[float]] = {}

    def hear(row: int, found: MachineBand) -> None:
        for band in (one for own in found.bearings.values() for one in own.bands if one.quantity == "friction torque"):
            near.setdefault(band.at_end(), []).append(speeds[row])

    shares = bands_over(lambda row: model_at(speeds[row]), places_of([speeds]), hear=hear).get("friction_torque_Nmm")
    if shares is None:
        return [], []
    notes = [f"at {_span(at)} 1/min {sentence}" for sentence, at in near.items() if sentence]
    return (shares * np.array(torques)[:, None]).tolist(), notes


def _span(speeds: Sequence[float]) -> str:
    low, high = (f"{speed:.4g}" for speed in (min(speeds), max(speeds)))
    return low if low == high else f"{low} to {high}"


def _points(
    model_at: Callable[[float], BearingModel], speeds: Sequence[float], fastest: float, kernels: Kernels
) -> tuple[list[tuple[dict[str, float], float | None, float]], list[float]]:
    """Return torque and Lambda at every speed.

    Also return the speeds at which rollers roll without skew: from the first one on, downwards, where no steady motion
    of them is found, and beyond the fastest where none is.

    A slow, skewed roller leans on a rib or runs free between both: rollers come from the fastest speed, where films
    leave one equilibrium, by fixed speeds, so that no point depends on which others are asked for. Balls, and rollers
    beyond that speed, start anew.
    """
    solved, slower = {}, sorted({speed for speed in speeds if speed < fastest}, reverse=True)
    has_rollers = model_at(speeds[0]).rollers is not None
    if not has_rollers:
        slower = []
    for speed in set(speeds).difference(slower):
        try:
            solved[speed] = _anew(model_at, speed, kernels)
        except EquilibriumError:
            if not has_rollers:
                raise
    try:
        if slower:
            near, at = _start(model_at, fastest, slower[0], kernels)
        for speed in slower:
            while at / _STRIDE >= speed:
                near, at = _all_follow(model_at, kernels, near, at, at / _STRIDE), at / _STRIDE
            solved[speed] = _all_follow(model_at, kernels, near, at, speed)
    except EquilibriumError:
        check_time("the Stribeck curve")
    rolling = [speed for speed in speeds if speed not in solved]
    solved |= {speed: _rolling(model_at, speed, kernels) for speed in rolling}
    return [_point(solved[speed]) for speed in speeds], rolling


def _anew(model_at: Callable[[float], BearingModel], speed: float, kernels: Kernels) -> dict[float, Any]:
    """Return the equilibria at a speed by phase.

    Where no motion of rollers is found there is another answer, so that no way leads through warmer oil.
    """
    from lambda_core.solver.drivers.equilibrium import solve

    model = model_at(speed)
    return {phase: solve(model, kernels, by_warmer_oil=model.rollers is None, phase=phase) for phase in _PHASES}


def _rolling(model_at: Callable[[float], BearingModel], speed: float, kernels: Kernels) -> dict[float, Any]:
    """Return the equilibria of rolling by phase."""
    from lambda_core.solver.drivers.equilibrium import solve

    model = model_at(speed)
    return {phase: solve(model, kernels, with_friction=False, phase=phase) for phase in _PHASES}


def _start(
    model_at: Callable[[float], BearingModel], fastest: float, first: float, kernels: Kernels
) -> tuple[dict[float, Any], float]:
    """Return equilibria to start from, and their speed.

    It is the fastest, or the next one that has any: above the first speed asked for, or that itself.
    """
    at = fastest
    while True:
        try:
            return _anew(model_at, at, kernels), at
        except SolverError:
            if at == first:
                raise
            at = max(at / _STRIDE, first)


def _all_follow(
    model_at: Callable[[float], BearingModel], kernels: Kernels, near: Mapping[float, Any], faster: float, speed: float
) -> dict[float, Any]:
    """Follow equilibria to a slower speed."""
    return {phase: _follow(model_at, kernels, start, faster, speed) for phase, start in near.items()}


def _follow(model_at: Callable[[float], BearingModel], kernels: Kernels, near: Any, faster: float, speed: float) -> Any:
    """Return the equilibrium at a speed, from a faster one.

    Where none is found the way is halved; what is not found in steps of a tenth starts anew.
    """
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.solver.drivers.near_equilibrium import continue_at_speed

    model = model_at(speed)
    try:
        return continue_at_speed(model, near, kernels)
    except SolverError:
        if speed > _LEAST_STEP * faster:
            return solve(model, kernels, by_warmer_oil=model.rollers is None, phase=near.phase)
    middle = math.sqrt(faster * speed)
    near = _follow(model_at, kernels, near, faster, middle)
    return _follow(model_at, kernels, near, middle, speed)


def _point(solved: Mapping[float, Any]) -> tuple[dict[str, float], float | None, float]:
    """Return the torque and Lambda at one speed.

    Return the parts [N mm], SKF's torque [N mm] and the smallest Lambda, of the equilibria by phase.
    """
    parts = dict.fromkeys(_PARTS.values(), 0.0)
    film = np.inf
    for phase, weight in _PHASES.items():
        found = solved[phase]
        torque = 1e3 * found.losses / found.relative_speed
        for name, value in zip(LOSSES, torque.tolist(), strict=True):
            mechanism = name.split("_")[0]
            if mechanism in _PARTS:
                parts[_PARTS[mechanism]] += weight * value
        film = min(film, _smallest_film(found))
    return parts, _skf(found), film


def _smallest_film(found: Any) -> float:
    from lambda_core.solver.records import CONTACT_CHANNELS

    load, film = (found.contacts[:, :, CONTACT_CHANNELS.index(name)] for name in ("load", "film_parameter"))
    return float(film[load > CARRYING * load.max()].min())


def _skf(found: Any) -> float | None:
    """Return SKF's torque.

    None where the model is not installed or does not apply.
    """
    from lambda_core.analysis.rating.engineering import rating_of
    from lambda_core.discovery.api import registry

    if found.context.model.rollers is not None:
        return None  # theirs follows from their loads alone
    return rating_of(
        found, {name: method for name, method in registry().methods.items() if name == "skf"}
    ).skf_torque_Nmm


def _skf_of_rollers(own: BearingPoint, speeds: Sequence[float]) -> list[float | None]:
    """Return SKF's torque of rollers at every speed [N mm].

    Their loads are those of the point.
    """
    from lambda_core.discovery.api import registry
    from lambda_core.results.roller_catalogues import catalogue_torques, roller_inputs

    model, state = own.rollers, own.solved_rollers.state
    assert model is not None
    turning = [replace(model, speeds=(speed * _RPM, model.speeds[1])) for speed in speeds]
    found = [catalogue_torques(roller_inputs(one, state, None), registry().methods) for one in turning]
    return [one["skf_torque_Nmm"] for one in found]


def stribeck_picture(found: SpeedCurve) -> ViewData:
    """Return the curve for :func:`draw`.

    Torque with its parts over a logarithmic speed, SKF's points, Lambda below.

    Parameters
    ----------
    found : SpeedCurve
        From :func:`stribeck`.

    Returns
    -------
    ViewData
        Two panels.
    """
    speed = np.array(found.speeds_rpm)
    parts = tuple(
        Series(name, speed, np.array(values), "line", group=_LOOKS[name]) for name, values in found.parts_Nmm.items()
    )
    skf = np.array([np.nan if value is None else value for value in found.skf_Nmm])
    low, high = np.array(found.torque_Nmm_band).T if found.torque_Nmm_band else (None, None)
    words = "90 % model band" if found.torque_Nmm_band else ""
    total = Series("total", speed, np.array(found.torque_Nmm), "line", "total", low, high, words)
    catalogue = (Series("SKF", speed, skf, "points", "reference"),) if np.isfinite(skf).any() else ()
    axis = Axis("speed", "1/min", log=True)
    film = Series("smallest under load", speed, np.array(found.film_parameter), "line", "inner")
    panels = (
        Panel("friction torque", axis, Axis("friction torque", "N mm", low=0.0), (total, *parts, *catalogue)),
        Panel("film parameter", axis, Axis("Lambda", log=True), (film,), (Mark("full film", 3.0),)),
    )
    return ViewData("stribeck", "Friction torque over speed", found.title, panels, 1, (found.note,))
