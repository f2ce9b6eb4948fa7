"""Solve a roller bearing at its operating point."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from lambda_core.discovery.api import registry
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, Problem, SolverError
from lambda_core.domain.lubrication import Lubrication
from lambda_core.domain.units import show
from lambda_core.elements.roller.axial_limit import AxialLimit, axial_limit
from lambda_core.elements.roller.roller_bearing import RollerBearing, kind_words
from lambda_core.elements.roller.roller_capacitance import RollerCapacitance, capacitance
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium, amplitudes, waves_by_ring
from lambda_core.elements.roller.roller_friction import RollerFriction, friction
from lambda_core.elements.roller.roller_life import lamina_life, modified_lamina_life, roller_basic_life
from lambda_core.elements.roller.roller_motion import RollerMotion, rolling_motion
from lambda_core.elements.roller.roller_positions import PLACES, mean_friction, over_a_pitch
from lambda_core.elements.roller.roller_ratings import (
    HIGHEST_ROLLER_PRESSURE,
    lamina_ratings,
    roller_equivalent_load,
    roller_static_load,
)
from lambda_core.formulas.life import (
    LEAST_KAPPA,
    RADIAL_ROLLER,
    life_hours,
    life_modification_factor,
    reference_viscosity,
)
from lambda_core.formulas.loading import CARRYING, Ring, carries
from lambda_core.model.bodies.resolve_elastic import waves_of_rings
from lambda_core.model.checks.loose_rings import loose_sentence
from lambda_core.model.checks.operating_limits import operating_warnings, tilt_warning, unbacked
from lambda_core.model.settings.contamination import known_contamination
from lambda_core.results.averages import finite
from lambda_core.results.bearing_summary import Contact
from lambda_core.results.quasistatic import QuasiStatic, RollerLoad, RollerStatics
from lambda_core.results.rating import Rating, rated_verdict
from lambda_core.results.ring_shape import ring_shape
from lambda_core.results.roller_catalogues import catalogue_torques, roller_inputs
from lambda_core.results.summary import capacitance_note
from lambda_core.results.verdict import Limits, limits_of

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.roller_case import RollerModel

_RPM = 30.0 / math.pi
_SLOPE = 1e-5  # [rad] of a ring below which rollers hardly lean on ribs
_ASSUMED = (
    "rollers roll without sliding; the cage is left out",
    "torque and capacitance are means over four places of the rollers in one pitch; loads, pressures and films are the "
    "extremes of these; lives and loads of single rollers belong to the place with a roller where the load presses",
)


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
    electric : tuple of RollerCapacitance
        Over the states; empty where nothing turns, or the oil is not known as a dielectric.
    """

    states: tuple[RollerEquilibrium, ...]
    motion: RollerMotion
    friction: RollerFriction | None
    electric: tuple[RollerCapacitance, ...] = ()

    @property
    def state(self) -> RollerEquilibrium:
        """The first: a roller stands where the load presses."""
        return self.states[0]


def solve_rollers(model: RollerModel, places: Sequence[float] = PLACES) -> SolvedRollers:
    """Find a roller bearing's equilibria over one pitch, and friction."""
    if model.loose:
        raise SolverError(loose_sentence(model.name, model.loose[0]))
    motion = rolling_motion(model.bearing, *model.speeds)
    try:
        states = over_a_pitch(
            model.bearing,
            model.loads,
            held=model.held,
            displacement=model.displacement,
            inertial=motion.inertial(model.bearing),
            support=model.drawing,
            slices=model.slices,
            places=places,
        )
    except ValueError as error:
        raise CaseError(model.name, [Problem("loads", str(error))]) from None
    except ArithmeticError as error:
        raise SolverError(f"{model.name}: {error}") from error
    return with_friction(model, SolvedRollers(states, motion, None))


def with_friction(model: RollerModel, solved: SolvedRollers) -> SolvedRollers:
    """Return equilibria with friction and capacitance."""
    motion, dielectric = solved.motion, model.dielectric
    if motion.relative == 0.0:
        return replace(solved, friction=None, electric=())
    parts = [friction(model.bearing, state, motion, model.oil, model.friction) for state in solved.states]
    found = replace(solved, friction=mean_friction(parts), electric=())
    if dielectric is None:
        return found
    electric = [
        capacitance(model.bearing, state, motion, model.oil, model.friction, dielectric) for state in solved.states
    ]
    return replace(found, electric=tuple(electric))


def roller_quasistatic(model: RollerModel, moving: BearingModel | None = None) -> QuasiStatic:
    """Solve a roller bearing that is alone.

    The answer has the units of the interface; it is what a run of `moving` starts from in words. The errors are those
    of :func:`solve_rollers`.

    Parameters
    ----------
    moving : BearingModel, optional
        Its model in motion, which knows limits.
    """
    return roller_answer(model, solve_rollers(model), moving)


def roller_answer(model: RollerModel, solved: SolvedRollers, moving: BearingModel | None = None) -> QuasiStatic:
    """Put a solution of a bearing alone into interface units."""
    state, bearing = solved.state, model.bearing
    x, y, z, tilt_y, tilt_z = (state.ring + model.outer_displacement(state.loads)).tolist()
    return QuasiStatic(
        **roller_statics(model, solved, moving),
        case=model.name,
        headline=headline_of(model, state),
        inner_ring_displacement_um=[1e6 * x, 1e6 * y, 1e6 * z],
        axial_play_um=0.0 if bearing.is_conical else 1e6 * bearing.end_play,
        inner_ring_tilt_mrad=[1e3 * tilt_y, 1e3 * tilt_z],
        iterations=state.steps,
        assumptions=[*model.assumptions, *_ASSUMED],
    ).of_model(model)


def roller_statics(
    model: RollerModel, solved: SolvedRollers, moving: BearingModel | None = None, *, on_shaft: bool = False
) -> dict[str, Any]:
    """Return the fields of :class:`BearingStatics` of rollers.

    The verdict needs limits, which the model `moving` in time has.
    """
    bearing, state, motion, turning = model.bearing, solved.state, solved.motion, solved.friction is not None
    found = solved.friction or RollerFriction()
    carried = np.maximum(state.inner.sum(axis=1), state.outer.sum(axis=1))
    loads = {"inner": state.inner, "outer": state.outer}
    films = _carried(found.contact_film, state)
    carrying = np.concatenate(films) if turning else np.zeros(0)
    radial, axial = state.carried
    limit = _limit(bearing, model.lubrication, radial, motion.relative)
    least = finite(min(found.film_parameter.values(), default=math.nan))
    inner, outer = (float(load.sum(axis=1).max()) for load in loads.values())
    pressure = 1e-9 * max(largest_pressure(bearing, one) for one in solved.states)
    rating = roller_rating(bearing, state, (radial, axial), motion.relative, model.oil.kinematic, model.contamination)
    told = [*_warnings(model, state, axial, limit), *_shortened(bearing, rating)]
    if moving is not None:
        limits = limits_of_rollers(moving, bearing, (radial, axial), motion.relative)
        asked = roller_inputs(model, state, solved.friction, rating.contamination or 0.0)
        rating = rating.model_copy(update={"limits": limits, **catalogue_torques(asked, registry().methods)})
        told = list(dict.fromkeys([*told, *operating_warnings(moving, on_shaft=on_shaft)]))
    return {
        "title": model.title,
        "loaded_elements": int(np.sum(state.inner.sum(axis=1) > CARRYING * carried.max())),
        "max_load_N": max(_largest(one) for one in solved.states),
        "max_load_ring": "inner" if inner > outer else "outer",
        "max_pressure_GPa": pressure,
        "contact_angle_deg": [math.degrees(bearing.angles.inner), math.degrees(bearing.angles.outer)],
        "rating": rating,
        "verdict": rated_verdict(
            rating, pressure, [] if least is None else [least], 1e3 * float(np.hypot(*state.ring[3:]))
        ),
        "friction_torque_Nmm": 1e3 * found.total if turning else None,
        "friction_breakdown_Nmm": _parts(found) if turning else {},
        "power_loss_W": found.total * abs(motion.relative) if turning else None,
        "orbit_speed_ratio": motion.cage / motion.inner if motion.inner != 0.0 else None,
        "film_um": [1e6 * float(carrying.min()), 1e6 * float(carrying.max())] if carrying.size else [],
        "film_parameter": [] if least is None else [least],
        "ring_shapes": [
            ring_shape(ring, waves.counts, amplitudes(bearing, state)[ring]) for ring, waves in waves_by_ring(bearing)
        ],
        "bearing_capacitance_nF": _between_rings(solved),
        "capacitance_note": _note(bearing, solved),
        "shoulders": [],
        "contacts": _contacts(bearing, solved),
        "rollers": _of_rollers(bearing, solved, found, limit),
        "warnings": told,
    }


def _carried(films: Mapping[str, FloatArray], state: RollerEquilibrium) -> list[FloatArray]:
    """Return the films of contacts that carry load, by ring."""
    return [film[carries(getattr(state, ring).sum(axis=1))] for ring, film in films.items()]


def _of_rollers(
    bearing: RollerBearing, solved: SolvedRollers, found: RollerFriction, limit: AxialLimit | None
) -> RollerStatics:
    """Return what balls do not have."""
    turning, state, total = solved.friction is not None, solved.state, found.total
    return RollerStatics(
        kind=bearing.kind,
        full_complement=bearing.full_complement,
        raceway_share=found.raceways / total if turning and total > 0.0 else None,
        rib_share=found.rib / total if turning and total > 0.0 else None,
        heat_factor=found.heat_factor if turning else None,
        supply_factor=found.supply_factor if turning else None,
        min_film_um=finite(
            1e6 * min((float(film.min()) for film in _carried(found.minimum_film, state)), default=math.nan)
        ),
        rib_load_N=max(float(one.ribs.max(initial=0.0)) for one in solved.states),
        rib_pressure_GPa=1e-9 * found.rib_pressure,
        rib_film_um=finite(1e6 * found.rib_film),
        rib_friction=finite(found.rib_friction),
        inner_ring_moment_Nm=[-float(state.loads[3]), -float(state.loads[4])],
        axial_limit_N=limit.continuous if limit else None,
        loads=_rollers(bearing, state),
    )


def _contacts(bearing: RollerBearing, solved: SolvedRollers) -> list[Contact]:
    """Return every contact of a roller with a raceway."""
    state, found, angles = solved.state, solved.friction, bearing.angles
    loads = {"inner": state.inner, "outer": state.outer}
    leans = {"inner": angles.inner, "outer": angles.outer}
    return [
        Contact(
            element=j + 1,
            ring=ring,
            azimuth_deg=math.degrees(float(azimuth)) % 360.0,
            load_N=float(loads[ring][j].sum()),
            contact_angle_deg=math.degrees(bearing.faces * leans[ring]),
            film_um=None if found is None else finite(1e6 * float(found.contact_film[ring][j])),
            capacitance_pF=finite(1e12 * float(solved.electric[0].contacts[j, k])) if solved.electric else None,
        )
        for j, azimuth in enumerate(state.azimuths)
        for k, ring in enumerate(get_args(Ring))
    ]


def _between_rings(solved: SolvedRollers) -> float | None:
    """Return the mean capacitance of the bearing [nF].

    None where asperities short a roller at both rings.
    """
    each = [1e9 * one.bearing for one in solved.electric]
    return finite(sum(each) / len(each)) if each else None


def _note(bearing: RollerBearing, solved: SolvedRollers) -> str:
    """Explain what the capacitance lacks.

    A tilted raceway pushes cylinders along their axes by its slope times their load, a force of second order, which
    the equilibrium does not have; with friction and in motion they lean on a rib, which adds its film.
    """
    if not solved.electric:
        return ""
    state = solved.state
    loads = np.column_stack([state.inner.sum(axis=1), state.outer.sum(axis=1)])
    told = [capacitance_note(loads, solved.electric[0].contacts, "roller")]
    if not bearing.is_conical and bearing.ribs and float(np.hypot(*state.ring[3:])) > _SLOPE:
        told.append("a tilted ring makes rollers lean on ribs: electric and run count these films, too")
    return "; ".join(filter(None, told))


def headline_of(model: RollerModel, state: RollerEquilibrium) -> str:
    """Return the headline of a bearing.

    The two lines give its name and its operating point; thrust against x has a minus.
    """
    bearing, carried = model.bearing, [float(f"{load:.4g}") for load in state.carried]  # what the balance rounds off
    radial, axial = carried[0], math.copysign(carried[1], bearing.faces * state.loads[0]) if carried[1] > 0.0 else 0.0
    inner, outer = (f"{speed * _RPM:.5g} rpm" for speed in model.speeds)
    speeds = f"inner ring {inner}, outer ring {outer}" if model.speeds[1] else inner
    return (
        f"{model.name}: {model.title}, {kind_words(bearing.kind)} roller bearing, {bearing.count} rollers of "
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


def largest_pressure(bearing: RollerBearing, state: RollerEquilibrium) -> float:
    """Return the largest raceway pressure [Pa], also at rest."""
    from lambda_core.elements.roller.line_contact import peak_pressure

    width = bearing.effective_length / state.inner.shape[1]
    loads: tuple[tuple[Ring, FloatArray], ...] = (("inner", state.inner), ("outer", state.outer))
    return max(
        float(peak_pressure(load.max() / width, bearing.radius(ring), bearing.modulus(ring))) for ring, load in loads
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


def _limit(bearing: RollerBearing, lubrication: Lubrication, radial: float, speed: float) -> AxialLimit | None:
    """Return the permissible axial loads of rollers.

    Only cylindrical rollers between ribs have them; other kinds, and rollers at rest, have none.
    """
    if not bearing.passes_thrust or speed == 0.0:
        return None
    return axial_limit(
        radial,
        speed,
        bore=bearing.bore,
        outside=bearing.outside,
        width=bearing.width,
        static_rating=bearing.static_rating,
        light_series=bearing.series == "2",
        complement="full" if bearing.full_complement else "cage",
        oil=lubrication != "grease",
    )


def limits_of_rollers(model: BearingModel, bearing: RollerBearing, load: tuple[float, float], speed: float) -> Limits:
    """Return what a roller bearing has to keep to.

    Parameters
    ----------
    load : tuple of float
        Radial and axial [N].
    speed : float
        Of the inner ring against the outer [rad/s].
    """
    radial, axial = load
    limit = _limit(bearing, model.lubrication, radial, speed)
    if limit is None or axial == 0.0:
        return limits_of(model)
    return limits_of(model).model_copy(update={"axial_load_N": axial, "largest_axial_load_N": limit.continuous})


def _rollers(bearing: RollerBearing, state: RollerEquilibrium) -> list[RollerLoad]:
    """Return the loads of every roller."""
    width = bearing.effective_length / state.inner.shape[1]
    inner, outer = state.inner.sum(axis=1), state.outer.sum(axis=1)
    ribs: FloatArray = state.ribs.max(axis=1, initial=0.0)
    most = np.maximum(state.inner.max(axis=1), state.outer.max(axis=1)) / width
    return [
        RollerLoad(
            roller=j + 1,
            azimuth_deg=math.degrees(float(state.azimuths[j])),
            inner_N=float(inner[j]),
            outer_N=float(outer[j]),
            rib_N=float(ribs[j]),
            tilt_mrad=1e3 * float(state.rollers[j, 2]) if inner[j] > 0.0 else 0.0,
            max_line_load_N_mm=1e-3 * float(most[j]),
        )
        for j in range(bearing.count)
    ]


def _shortened(bearing: RollerBearing, rating: Rating) -> list[str]:
    """Warn of a life far below that of ISO 281.

    That standard knows neither the clearance nor a tilt. Below half of it the distribution of the load decides.
    """
    basic, reference = rating.basic_life_h, rating.reference_life_h
    if bearing.is_conical or basic is None or reference is None or reference >= 0.5 * basic:
        return []
    share, shown = 100.0 * reference / basic, show(bearing.clearance, "small_length", 4)
    return [
        f"L_10rh is {share:.2g} % of L_10h: ISO 281 assumes half of the raceway loaded, evenly along the rollers; here "
        f"clearance ({shown}), tilt or thrust load them otherwise"
    ]


def _warnings(model: RollerModel, state: RollerEquilibrium, axial: float, limit: AxialLimit | None) -> list[str]:
    """Return what is beyond a limit."""
    found = model.warnings
    pressure = largest_pressure(model.bearing, state)
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
    return found + tilt_warning(tilt, None, on_shaft=True)
