"""Declare the quasi-static answer of a roller bearing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, Problem, SolverError
from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.units import show
from lambda_core.domain.wrapping import wrapped
from lambda_core.elements.roller.axial_limit import AxialLimit, axial_limit
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium, amplitudes, waves_by_ring
from lambda_core.elements.roller.roller_friction import RollerFriction, friction
from lambda_core.elements.roller.roller_life import lamina_life, modified_lamina_life, roller_basic_life
from lambda_core.elements.roller.roller_motion import RollerMotion, rolling_motion
from lambda_core.elements.roller.roller_positions import PLACES, mean_friction, over_a_pitch
from lambda_core.elements.roller.roller_ratings import lamina_ratings, roller_equivalent_load, roller_static_load
from lambda_core.formulas.life import (
    LEAST_KAPPA,
    RADIAL_ROLLER,
    life_hours,
    life_modification_factor,
    reference_viscosity,
)
from lambda_core.formulas.loading import CARRYING, carries
from lambda_core.model.bodies.resolve_elastic import waves_of_rings
from lambda_core.model.checks.operating_limits import unbacked
from lambda_core.model.settings.contamination import known_contamination
from lambda_core.results.answer import Answer
from lambda_core.results.averages import finite
from lambda_core.results.band_text import banded
from lambda_core.results.limits import HIGHEST_ROLLER_PRESSURE, ROLLER_TILT
from lambda_core.results.model_band import Banded
from lambda_core.results.rating import Rating
from lambda_core.results.record import INTERFACE, Record
from lambda_core.results.ring_shape import RingShape, ring_shape
from lambda_core.results.text import band_lines, bent_lines, life_factor_text, line, place_with_play, warning_lines

if TYPE_CHECKING:
    from lambda_core.model.roller_case import RollerModel

_RPM = 30.0 / math.pi
_ASSUMED = (
    "rollers roll without sliding; the cage is left out",
    "torque is the mean over four places of the rollers in one pitch; loads, pressures and films are the extremes of "
    "these; lives and loads of single rollers belong to the place with a roller where the load presses",
)


class RollerLoad(Record):
    """Loads of one roller."""

    roller: int
    azimuth_deg: float
    inner_N: float
    outer_N: float
    rib_N: float = Field(description="largest load of a rib")
    tilt_mrad: float = Field(description="of the roller in its plane")
    max_line_load_N_mm: float = Field(description="largest load per length of a slice")


class RollerQuasiStatic(Answer, Banded):
    """Quasi-static solution of a roller bearing.

    Loads, films, friction torque, lives and safety without time; the cage is left out.
    """

    interface: int = INTERFACE
    case: str
    title: str
    headline: str
    kind: str
    loaded_rollers: int = Field(description="rollers that carry more than a thousandth of the largest load")
    max_load_N: float = Field(description="largest load of a roller on a raceway")
    max_pressure_GPa: float
    friction_torque_Nmm: float | None = Field(description="dissipated power over the relative speed of the rings")
    friction_breakdown_Nmm: dict[str, float] = Field(description="rolling, hysteresis, sliding by ring; rib; drag")
    raceway_share: float | None = Field(description="of the raceways in the torque")
    rib_share: float | None = Field(description="of the ribs in the torque")
    heat_factor: float | None = Field(description="of inlet heating on the rolling resistance")
    supply_factor: float | None = Field(description="of replenishment on the rolling resistance")
    cage_speed_ratio: float | None = Field(description="of rollers that do not slide, over the inner ring's speed")
    film_um: list[float] = Field(
        description="smallest and largest central film, of slices with more than 1 % of the largest load"
    )
    film_parameter: float | None = Field(description="smallest film over roughness of the raceways")
    rib_load_N: float = Field(description="largest load of a rib")
    rib_pressure_GPa: float
    rib_film_um: float | None
    rib_friction: float | None = Field(description="coefficient of friction of the most loaded rib")
    inner_ring_displacement_um: list[float]
    axial_play_um: float = Field(
        description="from the middle to first contact without load: part of displacement x", default=0.0
    )
    inner_ring_tilt_mrad: list[float]
    ring_shapes: list[RingShape] = Field(description="how elastic rings bend; empty where all are rigid", default=[])
    inner_ring_moment_Nm: list[float] = Field(description="about y and z, that the rollers put on the shaft")
    rating: Rating = Field(description="lives of every lamina (ISO 16281) and of ISO 281, safety; no catalogues")
    axial_limit_N: float | None = Field(description="permissible constant axial load of ribs of cylindrical rollers")
    rollers: list[RollerLoad]
    warnings: list[str]
    iterations: int
    assumptions: list[str]

    def text(self, width: int | None = None, units: UnitSystem = SI) -> str:
        """Return the lines of text in some units.

        None is longer than `width` where one is given.
        """
        return _text(self, width, units)

    def __repr__(self) -> str:
        """Return case, largest load and friction torque."""
        return f"<RollerQuasiStatic {self.case}, {self.max_load_N:.5g} N, {number(self.friction_torque_Nmm, 1)} N mm>"


@dataclass(frozen=True)
class SolvedRollers:
    """A roller bearing in equilibrium.

    Attributes
    ----------
    states : tuple of RollerEquilibrium
        Over one pitch, see :func:`over_a_pitch`.
    motion : RollerMotion
        Kinematics.
    friction : RollerFriction or None
        Mean over the states, see :func:`mean_friction`; None where nothing turns.
    """

    states: tuple[RollerEquilibrium, ...]
    motion: RollerMotion
    friction: RollerFriction | None

    @property
    def state(self) -> RollerEquilibrium:
        """The first: a roller stands where the load presses."""
        return self.states[0]


def solve_rollers(model: RollerModel, places: Sequence[float] = PLACES) -> SolvedRollers:
    """Find a roller bearing's equilibria over one pitch, and friction."""
    if model.loose:
        along = model.loose[0]
        raise SolverError(
            f"{model.name}: no quasi-static equilibrium: a load acts along {along} and nothing holds the rings there: "
            f"lock bodies.outer_ring.{along} or give it a support"
        )
    motion = rolling_motion(model.bearing, *model.speeds)
    try:
        states = over_a_pitch(
            model.bearing,
            model.loads,
            held=model.held,
            displacement=model.displacement,
            inertial=motion.inertial(model.bearing),
            slices=model.slices,
            places=places,
        )
    except ValueError as error:
        raise CaseError(model.name, [Problem("loads", str(error))]) from None
    except ArithmeticError as error:
        raise SolverError(f"{model.name}: {error}") from error
    return with_friction(model, SolvedRollers(states, motion, None))


def with_friction(model: RollerModel, solved: SolvedRollers) -> SolvedRollers:
    """Return solved equilibria with the friction of the same loads."""
    motion = solved.motion
    if motion.relative == 0.0:
        return replace(solved, friction=None)
    parts = [friction(model.bearing, state, motion, model.oil, model.friction) for state in solved.states]
    return replace(solved, friction=mean_friction(parts))


def roller_quasistatic(model: RollerModel) -> RollerQuasiStatic:
    """Solve a roller bearing.

    The answer has the units of the interface. The errors are those of :func:`solve_rollers`.
    """
    return roller_answer(model, solve_rollers(model))


def roller_answer(model: RollerModel, solved: SolvedRollers) -> RollerQuasiStatic:
    """Put a solved roller bearing into interface units."""
    bearing = model.bearing
    state, motion, turning = solved.state, solved.motion, solved.friction is not None
    found = solved.friction or RollerFriction()
    carried = np.maximum(state.inner.sum(axis=1), state.outer.sum(axis=1))
    loads = {"inner": state.inner, "outer": state.outer}  # of every slice; light ones at the ends float on thick films
    films = [film[np.isfinite(film) & carries(loads[ring])] for ring, film in found.film.items()]
    carrying = np.concatenate(films) if turning else np.zeros(0)
    radial, axial = state.carried
    limit = _limit(model, radial, motion)
    x, y, z, tilt_y, tilt_z = (float(value) for value in state.ring)
    total = found.total
    return RollerQuasiStatic(
        case=model.name,
        title=model.title,
        headline=headline_of(model, radial, axial),
        kind=bearing.kind,
        loaded_rollers=int(np.sum(state.inner.sum(axis=1) > CARRYING * carried.max())),
        max_load_N=max(_largest(one) for one in solved.states),
        max_pressure_GPa=1e-9 * max(_pressure(bearing, one, model) for one in solved.states),
        friction_torque_Nmm=1e3 * total if turning else None,
        friction_breakdown_Nmm=_parts(found) if turning else {},
        raceway_share=found.raceways / total if turning and total > 0.0 else None,
        rib_share=found.rib / total if turning and total > 0.0 else None,
        heat_factor=found.heat_factor if turning else None,
        supply_factor=found.supply_factor if turning else None,
        cage_speed_ratio=motion.cage / motion.inner if motion.inner != 0.0 else None,
        film_um=[1e6 * float(carrying.min()), 1e6 * float(carrying.max())] if carrying.size else [],
        film_parameter=finite(min(found.film_parameter.values(), default=math.nan)),
        rib_load_N=max(float(one.ribs.max(initial=0.0)) for one in solved.states),
        rib_pressure_GPa=1e-9 * found.rib_pressure,
        rib_film_um=finite(1e6 * found.rib_film),
        rib_friction=finite(found.rib_friction),
        inner_ring_displacement_um=[1e6 * x, 1e6 * y, 1e6 * z],
        axial_play_um=0.0 if bearing.kind == "tapered" else 1e6 * bearing.end_play,
        inner_ring_tilt_mrad=[1e3 * tilt_y, 1e3 * tilt_z],
        ring_shapes=[
            ring_shape(ring, waves.counts, amplitudes(bearing, state)[ring]) for ring, waves in waves_by_ring(bearing)
        ],
        inner_ring_moment_Nm=[-float(state.loads[3]), -float(state.loads[4])],
        rating=roller_rating(
            bearing, state, (radial, axial), motion.relative, model.oil.kinematic, model.contamination
        ),
        axial_limit_N=limit.continuous if limit else None,
        rollers=_rollers(bearing, state),
        warnings=_warnings(model, state, axial, limit),
        iterations=state.steps,
        assumptions=[*model.assumptions, *_ASSUMED],
    )


def headline_of(model: RollerModel, radial: float, axial: float) -> str:
    """Return the headline of a bearing.

    The two lines give its name and its operating point.
    """
    bearing = model.bearing
    kind = {"tapered": "tapered", "needle": "needle"}.get(bearing.kind, f"cylindrical {bearing.kind}")
    inner, outer = (f"{speed * _RPM:.5g} rpm" for speed in model.speeds)
    speeds = f"inner ring {inner}, outer ring {outer}" if model.speeds[1] else inner
    return (
        f"{model.name}: {model.title}, {kind} roller bearing, {bearing.count} rollers of "
        f"{show(bearing.diameter, 'length', 4)} x {show(bearing.length, 'length', 4)}\n"
        f"radial {show(radial, 'force', 4)}, axial {show(axial, 'force', 4)}, {speeds}, "
        f"{model.lubricant} at {show(model.temperature, 'temperature', 4)} ({model.lubrication})"
    )


def _parts(found: RollerFriction) -> dict[str, float]:
    """Return the parts of the torque [N mm] by name."""
    by_ring = (("rolling", found.rolling), ("hysteresis", found.hysteresis), ("sliding", found.sliding))
    parts = {f"{name}_{ring}": 1e3 * value for name, values in by_ring for ring, value in values.items()}
    return {**parts, "rib": 1e3 * found.rib, "drag": 1e3 * found.drag}


def _largest(state: RollerEquilibrium) -> float:
    """Return the largest roller load on a raceway [N]."""
    return float(max(state.inner.sum(axis=1).max(), state.outer.sum(axis=1).max()))


def _pressure(bearing: RollerBearing, state: RollerEquilibrium, model: RollerModel) -> float:
    """Return the largest raceway pressure [Pa], also at rest."""
    from lambda_core.elements.roller.line_contact import peak_pressure

    width = bearing.effective_length / model.slices
    loads = (("inner", state.inner), ("outer", state.outer))
    return max(
        float(peak_pressure(load.max() / width, bearing.radius(ring), model.friction.e_eff))  # type: ignore[arg-type]
        for ring, load in loads
    )


def roller_rating(
    bearing: RollerBearing,
    state: RollerEquilibrium,
    load: tuple[float, float],
    speed: float,
    viscosity: float,
    contamination: float | None,
) -> Rating:
    """Return lives, static safety and viscosity ratio.

    None where a standard gives none.

    Lives with a_ISO have the factor of ISO 281 for the equivalent load, and that of every lamina (ISO 16281).

    Parameters
    ----------
    bearing, state
        Geometry, and loads of every lamina.
    load : tuple of float
        Radial and axial [N].
    speed : float
        Of the inner ring against the outer [rad/s].
    viscosity : float
        Kinematic, of the oil [m2/s].
    contamination : float or None
        e_C; None: not given, normal cleanliness counts.
    """
    radial, axial = load
    clean = known_contamination(contamination, bearing.pitch_diameter)
    speed = abs(speed)
    angle, gamma = bearing.contact_angle, bearing.diameter * math.cos(bearing.contact_angle) / bearing.pitch_diameter
    equivalent = _equivalent_load(bearing, radial, axial)
    static = roller_static_load(radial, axial if angle > 0.0 else 0.0, angle)
    ratings = lamina_ratings(bearing.dynamic_rating, bearing.count, gamma, state.inner.shape[1], contact_angle=angle)
    mean = 0.5 * (state.inner + state.outer)
    reference = lamina_life(mean, ratings, bearing.dynamic_rating)
    basic = roller_basic_life(bearing.dynamic_rating, equivalent)
    kappa = viscosity / reference_viscosity(speed, bearing.pitch_diameter) if speed > 0.0 else math.nan
    factor = modified = math.nan
    if kappa >= LEAST_KAPPA:
        factor = life_modification_factor(kappa, clean, bearing.fatigue_limit, equivalent, RADIAL_ROLLER)
        modified = modified_lamina_life(reference, bearing.dynamic_rating, kappa, clean, bearing.fatigue_limit)
    return Rating(
        equivalent_load_N=equivalent,
        basic_life_h=finite(life_hours(basic, speed)),
        reference_life_h=finite(life_hours(reference.life, speed)),
        modified_life_h=finite(life_hours(factor * basic, speed)),
        modified_reference_life_h=finite(life_hours(modified, speed)),
        life_factor=finite(factor),
        contamination=clean,
        contamination_given=contamination is not None,
        static_safety=finite(bearing.static_rating / static) if static > 0.0 else None,
        viscosity_ratio=finite(kappa),
    )


def _equivalent_load(bearing: RollerBearing, radial: float, axial: float) -> float:
    """Return P of ISO 281 [N], without thrust on ribs."""
    thrust = axial if bearing.contact_angle > 0.0 else 0.0
    return roller_equivalent_load(radial, thrust, bearing.contact_angle).load


def _limit(model: RollerModel, radial: float, motion: RollerMotion) -> AxialLimit | None:
    """Return the permissible axial loads of rollers.

    Only cylindrical rollers between ribs have them; other kinds, and rollers at rest, have none.
    """
    bearing = model.bearing
    if bearing.kind not in ("NJ", "NUP", "NCF") or motion.relative == 0.0:
        return None
    return axial_limit(
        radial,
        motion.relative,
        bore=bearing.bore,
        outside=bearing.outside,
        width=bearing.width,
        static_rating=bearing.static_rating,
        light_series=bearing.series == "2",
        complement="full" if bearing.full_complement else "cage",
        oil=model.lubrication != "grease",
    )


def _rollers(bearing: RollerBearing, state: RollerEquilibrium) -> list[RollerLoad]:
    """Return the loads of every roller."""
    width = bearing.effective_length / state.inner.shape[1]
    inner, outer = state.inner.sum(axis=1), state.outer.sum(axis=1)
    ribs: FloatArray = state.ribs.max(axis=1, initial=0.0)
    most = np.maximum(state.inner.max(axis=1), state.outer.max(axis=1)) / width
    return [
        RollerLoad(
            roller=j,
            azimuth_deg=math.degrees(float(state.azimuths[j])),
            inner_N=float(inner[j]),
            outer_N=float(outer[j]),
            rib_N=float(ribs[j]),
            tilt_mrad=1e3 * float(state.rollers[j, 2]) if inner[j] > 0.0 else 0.0,
            max_line_load_N_mm=1e-3 * float(most[j]),
        )
        for j in range(bearing.count)
    ]


def _warnings(model: RollerModel, state: RollerEquilibrium, axial: float, limit: AxialLimit | None) -> list[str]:
    """Return what is beyond a limit."""
    found = model.warnings
    pressure = _pressure(model.bearing, state, model)
    if pressure > HIGHEST_ROLLER_PRESSURE:
        found.append(f"contact pressure {1e-9 * pressure:.3g} GPa is above the 4 GPa of the static rating (ISO 76)")
    if limit is not None and axial > limit.continuous:
        names = {limit.thermal: "heat", limit.mechanical: "strength of the ribs", limit.guidance: "guidance of rollers"}
        found.append(
            f"axial load {axial:.0f} N is above the permissible {limit.continuous:.0f} N "
            f"({names[limit.continuous]}; SKF, Rolling bearings, 2018)"
        )
    for name, moment, held in zip(("tilt_y", "tilt_z"), model.loads[3:], model.held[3:], strict=True):
        if held and moment != 0.0:
            found.append(
                f'{name} is locked: the moment goes into the shaft; bodies.inner_ring.{name} = "free" takes it'
            )
    equivalent = _equivalent_load(model.bearing, state.carried[0], axial)
    found += unbacked(waves_of_rings(model.bearing), equivalent, model.bearing.dynamic_rating)
    tilt = float(np.hypot(state.ring[3], state.ring[4]))
    if tilt > ROLLER_TILT:
        found.append(f"tilt of the rings {1e3 * tilt:.2f} mrad is above the 4 minutes of arc of rollers (SKF, 2018)")
    return found


def _text(found: RollerQuasiStatic, width: int | None, units: UnitSystem) -> str:
    """Return the answer's lines and table of rollers."""
    parts, rating = found.friction_breakdown_Nmm, found.rating
    tilt_y, tilt_z = found.inner_ring_tilt_mrad
    pressure = units.text(found.max_pressure_GPa, "GPa", 3)
    lines = [
        units.sentence(found.headline),
        line(
            "equilibrium",
            f"{found.loaded_rollers} rollers loaded",
            f"Q_max {units.text(found.max_load_N, 'N', 0)}",
            f"p_max {banded(found.max_pressure_GPa, found.max_pressure_GPa_band, 'GPa', pressure, units)}",
        ),
        line(
            "inner ring",
            *place_with_play(found.inner_ring_displacement_um, found.axial_play_um, units),
            f"tilt y {tilt_y:.4f}  z {tilt_z:.4f} mrad",
        ),
        *bent_lines(found.ring_shapes, units),
    ]
    if found.friction_torque_Nmm is not None:
        torque = units.text(found.friction_torque_Nmm, "N mm")
        shares = f"raceways {100 * (found.raceway_share or 0.0):.0f} %, ribs {100 * (found.rib_share or 0.0):.0f} %"
        lines += [
            line(
                "friction torque",
                banded(found.friction_torque_Nmm, found.friction_torque_Nmm_band, "N mm", torque, units),
                "(without cage)",
                shares,
            ),
            *(_ring_line(ring, parts, units) for ring in ("inner", "outer")),
            f"          rib {units.number(parts['rib'], 'N mm')}  drag {units.number(parts['drag'], 'N mm')}",
            line("rolling factors", f"heat {number(found.heat_factor, 3)}", f"supply {number(found.supply_factor, 3)}"),
            line("cage speed", f"{number(found.cage_speed_ratio, 4)} of inner ring"),
            line("film", units.interval(found.film_um, "um", 2), f"Lambda {number(found.film_parameter, 1)}"),
        ]
    if found.rib_load_N > 0.0:
        film = "" if found.rib_film_um is None else f"film {units.text(found.rib_film_um, 'um', 2)}"
        friction = "" if found.rib_friction is None else f"friction {number(found.rib_friction, 4)}"
        lines.append(line("rib", f"load {units.text(found.rib_load_N, 'N', 0)}", film, friction))
    lines += [
        *_life_lines(rating),
        line(
            "safety",
            f"static C0/P0 {number(rating.static_safety)}" if rating.static_safety is not None else "",
            f"viscosity ratio kappa {number(rating.viscosity_ratio, 1)}" if rating.viscosity_ratio is not None else "",
            f"axial limit {units.text(found.axial_limit_N, 'N', 0)}" if found.axial_limit_N is not None else "",
        ),
        *_table(found, units),
        *band_lines(found.model_band, units),
        *warning_lines([units.sentence(warning) for warning in found.warnings], width),
        line("assumed", f"{len(found.assumptions)} things: --json lists them"),
    ]
    return "\n".join(wrapped(lines, width))


def _life_lines(rating: Rating) -> list[str]:
    """Return basic lives and those with a_ISO."""
    rows = (
        ("rating life", rating.reference_life_h, rating.basic_life_h),
        ("with a_ISO", rating.modified_reference_life_h, rating.modified_life_h),
    )
    lines, modified = [], (rating.life_factor, rating.contamination, rating.contamination_given)
    for words, *lives in rows:
        named = zip(lives, ("ISO 16281", "ISO 281"), strict=True)
        texts = [f"{hours(life)} ({standard})" for life, standard in named if life is not None]
        lines += [line(words, *texts)] if texts else []
    return [*lines, line("", life_factor_text(*modified))] if rating.life_factor is not None else lines


def _ring_line(ring: str, parts: dict[str, float], units: UnitSystem) -> str:
    names = ("rolling", "hysteresis", "sliding")
    return f"  {ring:<6}" + "".join(f"  {name} {units.number(parts[f'{name}_{ring}'], 'N mm')}" for name in names)


def _table(found: RollerQuasiStatic, units: UnitSystem) -> list[str]:
    """Return a row per roller."""
    force = units.unit("N")
    heads = (f"inner {force}", f"outer {force}", f"rib {force}", "tilt mrad", "N/mm")
    table = [f"{'roller':>8}{'azimuth':>10}" + "".join(f"{head:>12}" for head in heads)]
    for one in found.rollers:
        loads = "".join(f"{units.value(load, 'N'):>12.1f}" for load in (one.inner_N, one.outer_N, one.rib_N))
        row = f"{one.roller:>8}{one.azimuth_deg:>10.1f}{loads}{one.tilt_mrad:>12.4f}{one.max_line_load_N_mm:>12.1f}"
        table.append(row)
    return table
