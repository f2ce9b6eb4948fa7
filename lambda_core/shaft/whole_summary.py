"""Summarise a shaft run.

The summary covers every bearing, the orbit of the shaft and the balance of energy.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

import numpy as np
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.number_text import NONE, plus_minus
from lambda_core.domain.wrapping import HEAD, wrapped
from lambda_core.results.averages import finite
from lambda_core.results.convergence import shortfalls_together, torque_together, window_of
from lambda_core.results.followed import Followed
from lambda_core.results.record import INTERFACE, Record
from lambda_core.results.summary import Summary, summarise

if TYPE_CHECKING:
    from lambda_core.results.reader import Result
    from lambda_core.shaft.whole_file import WholeFile

_HEAD, _COLUMN = 24, 14


class BearingInMotion(Record):
    """One bearing over the cage revolutions that its averages are taken over."""

    name: str
    title: str
    file: str = Field(description="its own result, for show, view and every other command")
    converged: bool = Field(description="whether its averages are known as well as the whole needs them")
    friction_torque_Nmm: float | None
    friction_torque_ci_Nmm: float | None = Field(description="95 % confidence half-width")
    power_loss_W: float | None
    cage_speed_ratio: float | None = Field(description="mean cage speed over inner ring speed")
    cage_speed_over_epicyclic: float | None
    min_film_um: float | None = Field(description="smallest minimum film under load")
    max_pressure_GPa: float | None
    force_N: list[float] = Field(description="mean force of the bearing on the shaft: x, y, z")
    force_swing_N: list[float] = Field(description="half of what lies between its smallest and largest value: x, y, z")
    moment_Nm: list[float] = Field(description="mean moment of the bearing on the shaft about y and z")
    warnings: list[str]


class OrbitOfShaft(Record):
    """The motion of the shaft at one place."""

    position_mm: float
    mean_um: list[float] = Field(description="mean displacement x, y, z")
    swing_um: list[float] = Field(description="half of what lies between the smallest and largest value: x, y, z")


class PlaceInMotion(Record):
    """The motion of a body beside the shaft, or of a named place."""

    mean_um: list[float] = Field(description="mean displacement x, y, z")
    swing_um: list[float] = Field(description="half of what lies between the smallest and largest value: x, y, z")


class WholeSummary(Record):
    """A run of a shaft in its bearings."""

    interface: int = INTERFACE
    case: str = Field(description="name of the case")
    folder: str = Field(description="of the run")
    state: Literal["running", "finished", "stopped", "interrupted", "failed"] = Field(description="how the run ended")
    converged: bool = Field(description="whether the averages of every bearing are known")
    reasons: list[str] = Field(description="why the run is not converged; empty when it is")
    speed_rpm: float = Field(description="of the shaft at t = 0")
    bearings: list[BearingInMotion] = Field(description="from left to right")
    friction_torque_Nmm: float | None = Field(description="of all bearings")
    power_loss_W: float | None = Field(description="of all bearings")
    drive_torque_Nm: float | None = Field(
        description="of the coupling on the shaft, with friction; null where torques change"
    )
    orbit: list[OrbitOfShaft] = Field(description="at every lump of the shaft")
    bodies: dict[str, PlaceInMotion] = Field(default={}, description="bodies other than the shaft")
    markers: dict[str, PlaceInMotion] = Field(default={}, description="named places")
    energy_residual: float | None = Field(description="(input - dissipated - stored) over integral of |input power|")
    simulated_s: float = Field(description="simulated time")
    wall_s: float = Field(description="wall time of the integration")
    wall_per_simulated_second: float | None = Field(description="wall time over simulated time")
    solver_statistics: dict[str, float] = Field(description="counters of the integrator")
    vibrations: Followed | None = Field(default=None, description="how far vibrations can be believed")
    warnings: list[str] = Field(default=[], description="what cannot stand on the shaft as it is drawn")

    def text(self, width: int | None = None) -> str:
        """Return the lines for people, none longer than `width` where one is given."""
        return _text(self, width)


def summarise_whole(found: WholeFile) -> WholeSummary:
    """Compute the summary of a run from its folder."""
    status, results = found.status(), found.results()
    windows = [window_of(result) for result in results.values()]
    each = {name: summarise(result, torque_together(windows)) for name, result in results.items()}
    start = max(_from(result, each[name]) for name, result in results.items())
    channels = found.channels(start)
    bearings = [_bearing(name, i, each[name], channels) for i, name in enumerate(found.bearings)]
    own = [f"{name}: {reason}" for name, one in each.items() for reason in one.reasons]
    reasons = [*shortfalls_together(windows), *_shared(own, len(each))]
    torques = [one.friction_torque_Nmm for one in each.values()]
    friction = None if None in torques else sum(t for t in torques if t is not None)
    losses = [one.power_loss_W for one in each.values()]
    first = next(iter(each.values()))
    turn = math.copysign(1.0, found.speed)
    return WholeSummary(
        case=found.case,
        folder=str(found.folder),
        state=status.state,
        converged=not reasons,
        reasons=reasons,
        speed_rpm=30.0 / math.pi * found.speed,
        bearings=bearings,
        friction_torque_Nmm=friction,
        power_loss_W=None if None in losses else sum(p for p in losses if p is not None),
        drive_torque_Nm=None if friction is None else finite(found.drive_torque + turn * 1e-3 * friction),
        orbit=_orbit(found.lump_positions, channels["shaft_position"]),
        bodies=_places(found.bodies, channels.get("body_position")),
        markers=_places(found.markers, channels.get("marker_position")),
        energy_residual=first.energy_residual,
        simulated_s=first.simulated_s,
        wall_s=status.wall,
        wall_per_simulated_second=finite(status.wall / first.simulated_s) if first.simulated_s > 0.0 else None,
        solver_statistics=first.solver_statistics,
        vibrations=first.vibrations,
        warnings=found.warnings,
    )


def _from(result: Result, summary: Summary) -> float:
    """Return the time from which on a bearing is averaged [s]."""
    return float(result.revolutions()[summary.revolutions_discarded][0]) if summary.revolutions_averaged else 0.0


def _shared(reasons: list[str], count: int) -> list[str]:
    """Say once what holds for every bearing."""
    plain = [reason.split(": ", 1)[1] for reason in reasons]
    return list(dict.fromkeys(
        text if plain.count(text) == count else reason for text, reason in zip(plain, reasons, strict=True)
    ))  # fmt: skip


def _places(names: list[str], moved: FloatArray | None) -> dict[str, PlaceInMotion]:
    """Return means and swings of displacements of shape (n, names, 3)."""
    if moved is None:
        return {}
    each = {name: 1e6 * moved[:, i] for i, name in enumerate(names)}
    return {name: PlaceInMotion(mean_um=one.mean(axis=0).tolist(), swing_um=_swing(one)) for name, one in each.items()}


def _swing(values: FloatArray) -> list[float]:
    return (0.5 * np.ptp(values, axis=0)).tolist() if len(values) else []


def _bearing(name: str, i: int, summary: Summary, channels: dict[str, FloatArray]) -> BearingInMotion:
    force, moment = channels["reaction_force"][:, i], channels["reaction_moment"][:, i]
    return BearingInMotion(
        name=name,
        title=summary.title,
        file=summary.file,
        converged=summary.converged,
        friction_torque_Nmm=summary.friction_torque_Nmm,
        friction_torque_ci_Nmm=summary.friction_torque_ci_Nmm,
        power_loss_W=summary.power_loss_W,
        cage_speed_ratio=summary.cage_speed_ratio,
        cage_speed_over_epicyclic=summary.cage_speed_over_epicyclic,
        min_film_um=summary.min_film_um,
        max_pressure_GPa=summary.max_pressure_GPa,
        force_N=force.mean(axis=0).tolist(),
        force_swing_N=_swing(force),
        moment_Nm=moment.mean(axis=0)[1:].tolist(),
        warnings=list(summary.warnings),
    )


def _orbit(places: FloatArray, positions: FloatArray) -> list[OrbitOfShaft]:
    return [
        OrbitOfShaft(
            position_mm=1e3 * float(place),
            mean_um=(1e6 * positions[:, i].mean(axis=0)).tolist(),
            swing_um=[1e6 * value for value in _swing(positions[:, i])],
        )
        for i, place in enumerate(places)
    ]


def _swung(one: PlaceInMotion, axis: int) -> str:
    return f"{_number(one.mean_um[axis], 3)} ± {_number(one.swing_um[axis], 2)}"


def _number(value: float | None, digits: int = 4) -> str:
    return NONE if value is None else f"{0.0 if abs(value) < 5e-5 else value:.{digits}g}"


def _text(found: WholeSummary, width: int | None) -> str:
    bearings = found.bearings
    wide = max(_COLUMN, *(1 + len(b.name) for b in bearings))
    rows = [
        ("bearing", [b.title.split(" (")[0] for b in bearings]),
        ("friction torque N mm", [plus_minus(b.friction_torque_Nmm, b.friction_torque_ci_Nmm) for b in bearings]),
        ("power loss W", [_number(b.power_loss_W, 3) for b in bearings]),
        ("cage over inner ring", [_number(b.cage_speed_ratio) for b in bearings]),
        ("  over epicyclic", [_number(b.cage_speed_over_epicyclic) for b in bearings]),
        ("smallest film um", [_number(b.min_film_um, 2) for b in bearings]),
        ("p_max GPa", [_number(b.max_pressure_GPa, 3) for b in bearings]),
        *(
            (f"{'force on shaft' if axis == 'x' else ' '} {axis} N",
             [f"{_number(b.force_N[k])} ± {_number(b.force_swing_N[k], 2)}" for b in bearings])
            for k, axis in enumerate("xyz")
        ),
    ]  # fmt: skip
    wide = max(wide, *(1 + len(cell) for _, cells in rows for cell in cells))
    lines = [
        f"{found.case}, {found.speed_rpm:.5g} 1/min",
        "",
        f"{'':<{_HEAD}}" + "".join(f"{b.name:>{wide}}" for b in bearings),
        *(f"{head:<{_HEAD}}" + "".join(f"{cell:>{wide}}" for cell in cells) for head, cells in rows),
        "",
    ]
    largest = max(found.orbit, key=lambda one: math.hypot(*one.swing_um[1:]))
    state = "converged" if found.converged else "NOT CONVERGED"
    residual = NONE if found.energy_residual is None else f"{found.energy_residual:.1e}"
    rest = [
        f"{'friction torque':<{HEAD}}{_number(found.friction_torque_Nmm)} N mm of all bearings   {state}",
        *(f"{'':<{HEAD}}{reason}" for reason in found.reasons),
        f"{'drive torque':<{HEAD}}{_number(found.drive_torque_Nm)} N m",
        f"{'largest orbit':<{HEAD}}y ± {largest.swing_um[1]:.3g}  z ± {largest.swing_um[2]:.3g} um "
        f"at {largest.position_mm:.4g} mm",
        *(
            f"{name:<{HEAD}}x {_swung(one, 0)}   y {_swung(one, 1)}   z {_swung(one, 2)} um"
            for name, one in (*found.bodies.items(), *found.markers.items())
        ),
        f"{'energy residual':<{HEAD}}{residual} of input",
        *([f"{'vibrations':<{HEAD}}{found.vibrations.sentence()}"] if found.vibrations else []),
        f"{'wall time':<{HEAD}}{found.wall_s:.2f} s for {found.simulated_s:.4g} s",
        *(f"{'WARNING':<{HEAD}}{warning}" for warning in found.warnings),
        *(f"{'WARNING':<{HEAD}}{b.name}: {warning}" for b in bearings for warning in b.warnings),
        f"{'result':<{HEAD}}{found.folder}; of a bearing: lambda-bearing show {bearings[0].file}",
    ]
    return "\n".join([*lines, *wrapped(rest, width)])
