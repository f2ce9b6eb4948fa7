"""Warn of operating limits before anything is solved.

The limits are those of the bearing, its oil and the laws.

Every sentence here follows from the resolved case alone;
:mod:`lambda_core.results.limits` reports what needs a solution (pressures, shoulders, tilt).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from lambda_core.domain.elements import BodyName
from lambda_core.domain.units import show
from lambda_core.elements.ball.kinds import kinds
from lambda_core.elements.roller.roller_motion import rolling_motion
from lambda_core.elements.roller.roller_ratings import roller_equivalent_load, roller_static_load
from lambda_core.elements.roller.roller_thrust import least_thrust, scarce_thrust
from lambda_core.formulas.elastic.ring import RingWaves
from lambda_core.formulas.life import dynamic_equivalent_load, static_equivalent_load
from lambda_core.formulas.ratings import dynamic_rating, static_factor, static_rating
from lambda_core.laws.par import flat_kernel
from lambda_core.model.bearing_model import BearingModel, Body
from lambda_core.model.geometry.proportions import proportion_warnings
from lambda_core.model.laws.time_functions import initial, peak

# What laws of viscosity were fitted to, at the most: oils are measured from 0 to 120 degC, charts go a little further.
OIL_TEMPERATURES = (-40.0, 200.0)  # [degC]
_ZERO_CELSIUS = 273.15
# "minimum loads corresponding to 0,02 C should be imposed on roller bearings and minimum loads corresponding to 0,01 C
# on ball bearings": SKF, the same, requisite minimum load.
MINIMUM_LOAD = 0.01  # of balls, over the dynamic rating
MINIMUM_ROLLER_LOAD = 0.02  # over the dynamic rating
# Loads above 0.1 C are heavy or very heavy in the tables of seats: SKF, the same, magnitude of the load.
HEAVY_LOAD = 0.1  # over the dynamic rating
# ISO 281:2007, 5.1: the life equations hold up to P = 0.5 C.
LARGEST_LIFE_LOAD = 0.5  # over the dynamic rating
# Raceways and balls are ground and honed to 0.01 to 0.1 um, worn ones reach a few tenths (Harris and Kotzalas, Advanced
# Concepts of Bearing Technology, 5th ed., table 5.1); ten times that is no rolling surface.
ROUGHEST = 1e-6  # composite rms roughness [m]
# Factors of inlet heating are corrections to an isothermal film: below one half they are the larger part of the answer.
SMALLEST_HEATING_FACTOR = 0.5


def operating_warnings(model: BearingModel, *, on_shaft: bool = False) -> list[str]:
    """Return warnings of exceeded limits.

    A sentence for everything in a case beyond the limits of bearing, oil and laws.

    Parameters
    ----------
    model : BearingModel
        Any resolved case; nothing is solved.
    on_shaft : bool
        Whether it is one of several bearings on a shaft: what it carries and how it tilts is known after solving.

    Returns
    -------
    list of str
        Empty where nothing is beyond a limit; the limits and their sources stand at the head of this module.
    """
    return [
        *model.contradictions,
        *(proportion_warnings(model.geometry) if model.rollers is None else ()),
        *_speed(model),
        *(() if on_shaft else _load(model)),
        *(() if on_shaft else _tilt(model)),
        *_oil(model),
        *_heating(model),
        *_surface(model),
    ]


ROLLER_TILT = 1.2e-3  # [rad] of series 2: SKF, Rolling bearings, PUB BU/P1 17000 EN (2018)
_OF_ROLLERS = "roller bearings take up to 1.2 mrad (4 minutes of arc; SKF, 2018)"


def permissible_tilt(kind: str) -> float:
    """Return the permissible tilt of a kind [rad].

    It is the angle between the rings.
    """
    return kinds()[kind].tilt


def tilt_warning(
    tilt: float, kind: str | None, what: str = "the inner ring tilts by", *, on_shaft: bool = False
) -> list[str]:
    """Return a warning of too much tilt.

    The angle between the rings [rad] is above what bearings of a kind take; the kind is None of rollers.
    """
    most, words = (ROLLER_TILT, _OF_ROLLERS) if kind is None else (kinds()[kind].tilt, kinds()[kind].tilt_words)
    if tilt <= most:
        return []
    if on_shaft:
        return [f"{what} {1e3 * tilt:.2g} mrad: {words}"]
    return [
        f"{what} {1e3 * tilt:.2g} mrad: {words}; a shaft on two bearings hardly tilts like this "
        "(bodies.inner_ring.tilt_y and tilt_z: free, locked, or with a stiffness)"
    ]


def known_value(model: BearingModel, path: str) -> float | None:
    """Return a resolved number by path, SI.

    None where there is none.
    """
    return next((v.value for v in model.values if v.path == path and isinstance(v.value, float)), None)


def relative_speed(model: BearingModel) -> float:
    """Return the upper bound of relative speed [rad/s].

    Where both rings turn, they may turn against each other.
    """
    return peak(model.inner_ring.dofs["spin"].motion) + peak(model.outer_ring.dofs["spin"].motion)


def _speed(model: BearingModel) -> Iterator[str]:
    yield from speed_warning(relative_speed(model), known_value(model, "bearing.limiting_speed"))


def speed_warning(speed: float, limit: float | None) -> Iterator[str]:
    """Warn of a speed above the limiting one.

    It is that of the catalogue [rad/s].
    """
    if limit is not None and speed > limit:
        rpm, most = (f"{value * 30.0 / math.pi:.0f} rpm" for value in (speed, limit))
        yield f"{rpm} is above the limiting speed of the bearing in the catalogue, {most}"


def applied_load(model: BearingModel) -> tuple[float, float] | None:
    """Return the largest applied load [N].

    The radial and axial loads act on the inner ring; the result is None where its place decides them.

    The weight of inner ring and shaft counts, as far as gravity is across or along the axis.
    """
    inner, outer = model.inner_ring, model.outer_ring
    moves = any(_mode(outer, dof) != "locked" for dof in "xyz")
    if moves or _mode(inner, "x") == "prescribed" or any(_mode(inner, dof) != "free" for dof in "yz"):
        return None
    x, y, z = (peak(force) + inner.mass * abs(g) for force, g in zip(inner.force, model.gravity, strict=True))
    return math.hypot(y, z), x


def operating_point(model: BearingModel) -> str:
    """Name a bearing with its speed, loads and oil temperature."""
    loads = applied_load(model)
    parts = [f"{model.title} at {show(relative_speed(model), 'rotational_speed', 4)}"]
    if loads is not None:
        parts += [f"{_force(load)} {way}" for load, way in zip(loads, ("radial", "axial"), strict=True) if load > 0.0]
    return ", ".join([*parts, f"oil at {show(model.oil.temperature, 'temperature', 3)}"])


def _mode(body: Body, dof: str) -> str:
    return body.dofs[dof].mode


def ratings(model: BearingModel) -> tuple[float, float]:
    """Return C and C_0 [N].

    They are the catalogue's, or follow from the geometry (ISO 281, ISO 76).
    """
    g = model.geometry
    size, angle = (g.ball_count, g.ball_diameter, g.pitch_diameter), g.contact_angle
    dynamic, static = known_value(model, "bearing.dynamic_rating"), known_value(model, "bearing.static_rating")
    return (
        dynamic or dynamic_rating(*size, contact_angle=angle, rows=g.rated_rows, on_sphere=g.kind.on_sphere),
        static or static_rating(*size, contact_angle=angle, rows=g.rated_rows, on_sphere=g.kind.on_sphere),
    )


def is_preloaded(model: BearingModel) -> bool:
    """Tell whether the bearing is preloaded.

    A negative clearance presses every ball, which then needs no load to roll.
    """
    return model.geometry.clearance < 0.0


def minimum_load(model: BearingModel) -> float:
    """Return the least load of balls or rollers over C."""
    return MINIMUM_LOAD if model.rollers is None else MINIMUM_ROLLER_LOAD


def unbacked(elastic: Mapping[BodyName, RingWaves], load: float, rating: float) -> Iterator[str]:
    """Warn of a heavily loaded ring without support."""
    if load <= HEAVY_LOAD * rating:
        return
    for body, waves in elastic.items():
        if body != "cage" and waves.ring.bedding == 0.0:
            yield (
                f"nothing backs the {body.replace('_', ' ')} (elastic.{body}.housing_stiffness = 0 N/m) under "
                f"P = {_force(load)}, {load / rating:.2g} C: its housing carries nothing, and stretching, seat and "
                "yielding of the ring are left out"
            )


def _load(model: BearingModel) -> list[str]:
    loads = applied_load(model)
    return [] if loads is None else [*_scarce_thrust(model, *loads), *load_warnings(model, *loads)]


def _scarce_thrust(model: BearingModel, radial: float, axial: float) -> Iterator[str]:
    """Warn of thrust that leaves cone and cup apart."""
    along = model.inner_ring.dofs["x"]
    if model.rollers is None or along.mode != "free" or along.stiffness > 0.0:
        return
    speeds = (initial(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))
    centrifugal = float(rolling_motion(model.rollers, *speeds).inertial(model.rollers)[1])
    least = least_thrust(model.rollers, radial, centrifugal)
    if axial <= least and least > 0.0:
        yield scarce_thrust(radial, axial, least)


def load_warnings(model: BearingModel, radial: float, axial: float) -> Iterator[str]:
    """Warn of loads beyond ratings and limits.

    The bearing carries them, radially and axially [N].
    """
    dynamic, static = ratings(model)
    kind = model.geometry.kind
    equivalent, resting = _equivalent_loads(model, static, radial, axial)
    turns, least = relative_speed(model) > 0.0, minimum_load(model)
    if axial < kind.least_thrust * radial:
        yield f"the axial load of {_force(axial)} is below {kind.least_thrust:g} of the radial one: {kind.thrust_words}"
    yield from unbacked(model.elastic, equivalent, dynamic)
    if turns and not is_preloaded(model) and equivalent < least * dynamic:
        element = "ball" if model.rollers is None else "roller"
        yield (
            f"the load P = {_force(equivalent)} is below the minimum load of {element} bearings, {least:g} C = "
            f"{_force(least * dynamic)}: {element}s may skid"
        )
    if resting > static:
        yield (
            f"the static load P0 = {_force(resting)} is above the static load rating C0 = {_force(static)}: the "
            "rolling elements leave dents (ISO 76)"
        )
    if turns and equivalent > LARGEST_LIFE_LOAD * dynamic:
        yield f"the load P = {_force(equivalent)} is above C/2 = {_force(0.5 * dynamic)}: ISO 281 gives no life there"


def _equivalent_loads(model: BearingModel, static: float, radial: float, axial: float) -> tuple[float, float]:
    """Return P (ISO 281) and P_0 (ISO 76) [N].

    Thrust on ribs of cylindrical rollers does not count.
    """
    rollers = model.rollers
    if rollers is not None:
        angle = rollers.contact_angle
        thrust = axial if angle > 0.0 else 0.0
        return roller_equivalent_load(radial, thrust, angle).load, roller_static_load(radial, thrust, angle)
    g = model.geometry
    gamma, kind = g.ball_diameter * math.cos(g.contact_angle) / g.pitch_diameter, (g.contact_angle, g.rated_rows)
    factor = static_factor(gamma, on_sphere=g.kind.on_sphere)
    equivalent = dynamic_equivalent_load(radial, axial, static, factor, *kind, on_sphere=g.kind.on_sphere).load
    return equivalent, static_equivalent_load(radial, axial, *kind, on_sphere=g.kind.on_sphere)


def _force(newton: float) -> str:
    return show(newton, "force", 3)


def _tilt(model: BearingModel) -> list[str]:
    """Judge tilts that the case prescribes.

    Tilts that follow from the loads are known only after solving.
    """
    states = [body.dofs[dof] for body in (model.inner_ring, model.outer_ring) for dof in ("tilt_y", "tilt_z")]
    prescribed = [peak(state.motion) if state.mode == "prescribed" else 0.0 for state in states]
    about_y, about_z = prescribed[0] + prescribed[2], prescribed[1] + prescribed[3]
    tilt = math.hypot(about_y, about_z)
    kind = model.geometry.kind.name if model.rollers is None else None
    return tilt_warning(tilt, kind, "the case tilts the rings against each other by")


def _oil(model: BearingModel) -> Iterator[str]:
    celsius = model.oil.temperature - _ZERO_CELSIUS
    low, high = OIL_TEMPERATURES
    if not low <= celsius <= high:
        yield f"the oil at {celsius:.6g} degC is outside {low:g} to {high:g} degC, where laws of viscosity hold at best"
    coldest, hottest = (known_value(model, f"lubricant.{end}_temperature") for end in ("lowest", "highest"))
    if coldest is not None and hottest is not None and not coldest <= model.oil.temperature <= hottest:
        yield (
            f"the grease {model.oil.name} at {celsius:.6g} degC is outside what its maker gives it for, "
            f"{coldest - _ZERO_CELSIUS:.6g} to {hottest - _ZERO_CELSIUS:.6g} degC"
        )


def _surface(model: BearingModel) -> Iterator[str]:
    if model.roughness > ROUGHEST:
        sigma, most = show(model.roughness, "small_length", 3), show(ROUGHEST, "small_length", 3)
        yield f"the roughness sigma = {sigma} is above {most}: no ground raceway is that rough"


def _heating(model: BearingModel) -> Iterator[str]:
    found = heating_factor(model)
    if found is not None and found < SMALLEST_HEATING_FACTOR:
        law = model.laws["ball_inner"]["thermal_correction"].model.name
        yield (
            f"the oil is so thick at this speed that heating in the inlet leaves {found:.2g} of the film (law {law}), "
            f"below {SMALLEST_HEATING_FACTOR:g}: the law is extrapolated there, friction may fall where colder oil "
            "should raise it"
        )


def heating_factor(model: BearingModel) -> float | None:
    """Return the factor of inlet heating.

    It reduces the film at the inner ring; it is None where the laws give none.

    The chosen law is asked at epicyclic rolling, u = D_w/4 (d_m/D_w) (1 - gamma^2) |Omega_i - Omega_o| with
    gamma = D_w/d_m (the mean of both surfaces where they roll without slip; Harris and Kotzalas, Rolling Bearing
    Analysis, 5th ed., ch. 10), without slip, and at the pressure of Stribeck's largest ball load 5 P_0/Z.
    """
    from lambda_core.formulas.hertz import hertz_contact
    from lambda_core.model.laws.law_context import ContactFrame, build_context, prepare

    law, rheology = (model.laws["ball_inner"][role] for role in ("thermal_correction", "rheology"))
    speed = relative_speed(model)
    if speed == 0.0 or law.model.name == "none":
        return None
    context = build_context(model, "ball_inner", ContactFrame((0.0, 0.0), (0.0, 0.0)), model.oil)
    temperatures = model.oil.temperature + np.array([0.0, -0.5, 0.5])
    ln_eta, rho = np.full(3, np.nan), np.full(3, np.nan)
    out = np.full(1, np.nan)
    g = model.geometry
    rolling = 0.25 * g.pitch_diameter * (1.0 - (g.ball_diameter / g.pitch_diameter) ** 2) * speed
    load = 5.0 * static_equivalent_load(*(applied_load(model) or (0.0, 0.0))) / g.balls
    pressure = hertz_contact(load, context.radius_x, context.radius_y, context.e_eff).p_max
    try:
        flat_kernel(rheology.model)(np.zeros(3), temperatures, prepare(rheology, context), ln_eta, rho)
        beta, viscosity = float(ln_eta[1] - ln_eta[2]), math.exp(float(ln_eta[0]))
        conductivity, par = model.oil.thermal_conductivity, prepare(law, context)
        flat_kernel(law.model)(rolling, 0.0, pressure, context.e_eff, viscosity, beta, conductivity, par, out)
    except (ArithmeticError, ValueError):
        return None  # a law that does not reach this far says so where it is solved
    return float(out[0]) if math.isfinite(out[0]) else None
