"""Define comparison methods for roller bearings.

They are Palmgren's torque, Houpert's rolling resistance, lives and kinematics.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.errors import unknown_name
from lambda_core.elements.roller.roller_life import lamina_life, modified_lamina_life, roller_basic_life
from lambda_core.elements.roller.roller_motion import rolling_motion
from lambda_core.elements.roller.roller_ratings import (
    lamina_ratings,
    roller_dynamic_rating,
    roller_equivalent_load,
    roller_static_load,
)
from lambda_core.elements.roller.rolling import rolling_force
from lambda_core.formulas.life import RADIAL_ROLLER, life_hours, life_modification_factor, reference_viscosity
from lambda_core.plugins import Method, MethodRow, MethodTable, NotApplicable, RollerMethodInputs
from lambda_core.views.method import rollers_only
from lambda_plugins.methods.schaeffler import SeriesFactors, idle_torque

# f_0 of an oil bath and of grease, f_1: Schaeffler, Rolling Bearings HR 1 (2019), "Friction", as remembered.
_CYLINDRICAL = {
    "10": SeriesFactors(2.0, 1.3, 0.0002),
    "2": SeriesFactors(2.0, 1.3, 0.0003),
    "3": SeriesFactors(2.0, 1.3, 0.00035),
    "22": SeriesFactors(3.0, 2.0, 0.0004),
    "23": SeriesFactors(4.0, 2.7, 0.0004),
}
_TAPERED = {
    **dict.fromkeys(("302", "303", "320", "329", "330"), SeriesFactors(3.0, 2.0, 0.0004)),
    **dict.fromkeys(("313", "322", "323", "331", "332"), SeriesFactors(4.5, 3.0, 0.0004)),
}
_BY_SERIES = {"tapered": _TAPERED, "cylindrical": _CYLINDRICAL}
_ANY_SERIES = {"needle": SeriesFactors(5.0, 3.0, 0.0005)}
_FULL_COMPLEMENT = SeriesFactors(5.0, 3.0, 0.00055)


def factors_of(inputs: RollerMethodInputs) -> SeriesFactors:
    """Return f_0 and f_1 of a bearing.

    Raises
    ------
    NotApplicable
        For a series that the table does not have.
    """
    bearing = inputs.bearing
    if bearing.full_complement:
        return _FULL_COMPLEMENT
    if bearing.family in _ANY_SERIES:
        return _ANY_SERIES[bearing.family]
    table = _BY_SERIES[bearing.family]
    if bearing.series not in table:
        raise NotApplicable(unknown_name("series of the Schaeffler table of rollers", bearing.series, table))
    return table[bearing.series]


def evaluate_schaeffler(inputs: RollerMethodInputs) -> MethodTable:
    """Compute M_0 + M_1 of Palmgren for a roller bearing.

    The formula is that of Schaeffler's catalogue.

    M_1 = f_1 P_1 d_m, P_1 = F_r of cylindrical and needle rollers, the larger of F_r and 2 Y F_a of tapered ones.
    """
    bearing, factors = inputs.bearing, factors_of(inputs)
    if inputs.lubrication in ("oil jet", "under-race"):
        raise NotApplicable(f"the Schaeffler table has no factor f_0 for {inputs.lubrication} lubrication")
    f0 = factors.f0_bath if inputs.lubrication == "oil bath" else factors.f0_grease
    speed = inputs.relative_speed
    idle = idle_torque(f0, bearing.mean_diameter, speed, inputs.oil.kinematic) if speed > 0.0 else 0.0
    thrust = 0.8 / math.tan(bearing.contact_angle) * inputs.axial_load if bearing.contact_angle > 0.0 else 0.0
    deciding = max(inputs.radial_load, thrust)
    load = factors.f1 * deciding * bearing.mean_diameter
    rows = (
        MethodRow("friction", "total", (idle + load) * 1e3, "N mm", "M_0 + M_1"),
        MethodRow("friction", "speed dependent", idle * 1e3, "N mm", "M_0: drag, churning and rolling resistance"),
        MethodRow("friction", "load dependent", load * 1e3, "N mm", f"M_1 with P_1 = {deciding:.0f} N"),
    )
    said = [f"f_0 = {f0:g} ({inputs.lubrication}), f_1 = {factors.f1:g}"]
    if bearing.contact_angle == 0.0 and inputs.axial_load > 0.0:
        said.append("M_2 of the thrust on the ribs left out")
    return MethodTable(rows, tuple(said))


def houpert_torque(inputs: RollerMethodInputs) -> float:
    """Return the torque of hydrodynamic rolling resistance alone [N m].

    Every roller's load spread evenly over its length, flooded and isothermal: Biboulet and Houpert 2010, part 1, with
    the power 2 F u of each contact; the hand method behind Houpert 2002, Tribol. Trans. 45, 415.

    Raises
    ------
    NotApplicable
        At rest.
    """
    bearing, speed = inputs.bearing, inputs.relative_speed
    if speed == 0.0:
        raise NotApplicable("nothing turns")
    motion, length = rolling_motion(bearing, inputs.inner_speed, inputs.outer_speed), bearing.effective_length
    total = 0.0
    for ring, slices in (("inner", inputs.state.inner), ("outer", inputs.state.outer)):
        loads = slices.sum(axis=1)
        force = rolling_force(
            loads[loads > 0.0] / length,
            bearing.radius(ring),  # type: ignore[arg-type]
            motion.entrainment,
            inputs.oil.viscosity,
            226e9,
        )
        total += 2.0 * float(np.sum(force)) * length * motion.entrainment / speed
    return total


def evaluate_houpert(inputs: RollerMethodInputs) -> MethodTable:
    """Answer a roller bearing with hydrodynamic rolling resistance."""
    torque = 1e3 * houpert_torque(inputs)
    rows = (
        MethodRow("friction", "total", torque, "N mm", "rolling resistance of the inlets alone"),
        MethodRow("friction", "rolling", torque, "N mm", "Biboulet and Houpert 2010"),
    )
    return MethodTable(rows, ("rollers without profile, flooded and isothermal inlets; no ribs, no bath",))


HOUPERT = Method(
    name="houpert",
    title="Hydrodynamic rolling resistance of rollers",
    reference="Biboulet and Houpert 2010, Proc. IMechE J 224, Part 1; Houpert 2002, Tribol. Trans. 45, 415",
    evaluate=rollers_only,
    validity="roller bearings; flooded, isothermal, without profile",
    method_api=1,
)


def evaluate_quasistatic(inputs: RollerMethodInputs) -> MethodTable:
    """Show the program's own quasi-static answer."""
    rows = [
        MethodRow("load", f"largest contact load, {ring}", float(loads.sum(axis=1).max()), "N")
        for ring, loads in (("inner", inputs.state.inner), ("outer", inputs.state.outer))
    ]
    rows.append(MethodRow("load", "largest rib load", float(inputs.state.ribs.max(initial=0.0)), "N"))
    found = inputs.friction
    if found is not None:
        parts = {
            "total": found.total,
            "rolling": sum(found.rolling.values()) + sum(found.hysteresis.values()),
            "sliding": sum(found.sliding.values()) + found.rib,
            "drag": found.drag,
            "rib": found.rib,
        }
        rows += [MethodRow("friction", name, 1e3 * value, "N mm") for name, value in parts.items()]
    return MethodTable(tuple(rows))


def evaluate_iso281(inputs: RollerMethodInputs) -> MethodTable:
    """Compute basic and modified rating life and static safety.

    The exponent of the life is 10/3.
    """
    bearing, speed = inputs.bearing, inputs.relative_speed
    thrust = inputs.axial_load if bearing.contact_angle > 0.0 else 0.0
    load = roller_equivalent_load(inputs.radial_load, thrust, bearing.contact_angle)
    static = roller_static_load(inputs.radial_load, thrust, bearing.contact_angle)
    own = roller_dynamic_rating(
        bearing.count,
        bearing.diameter,
        bearing.effective_length,
        bearing.pitch_diameter,
        contact_angle=bearing.contact_angle,
    )
    basic = roller_basic_life(bearing.dynamic_rating, load.load)
    rows = [
        MethodRow("life", "equivalent load", load.load, "N", "P"),
        *_life_rows("basic rating life", basic, speed),
        MethodRow("rating", "dynamic rating", bearing.dynamic_rating, "N", "C of the catalogue"),
        MethodRow("rating", "dynamic rating of the geometry", own, "N", "C_r by ISO 281"),
    ]
    if static > 0.0:
        rows.append(MethodRow("rating", "static safety", bearing.static_rating / static, "-", "C_0/P_0"))
    if speed > 0.0:
        kappa = inputs.oil.kinematic / reference_viscosity(speed, bearing.pitch_diameter)
        rows.append(MethodRow("life", "viscosity ratio", kappa, "-", "kappa"))
        if inputs.contamination is not None and kappa >= 0.1:
            factor = life_modification_factor(
                kappa, inputs.contamination, bearing.fatigue_limit, load.load, RADIAL_ROLLER
            )
            rows += [
                MethodRow("life", "life modification factor", factor, "-", "a_ISO"),
                *_life_rows("modified rating life", factor * basic, speed),
            ]
    return MethodTable(tuple(rows))


def evaluate_iso16281(inputs: RollerMethodInputs) -> MethodTable:
    """Compute the reference rating life by laminae.

    It follows from the load of every lamina.
    """
    bearing, state = inputs.bearing, inputs.state
    gamma = bearing.diameter * math.cos(bearing.contact_angle) / bearing.pitch_diameter
    ratings = lamina_ratings(
        bearing.dynamic_rating, bearing.count, gamma, state.inner.shape[1], contact_angle=bearing.contact_angle
    )
    life = lamina_life(0.5 * (state.inner + state.outer), ratings, bearing.dynamic_rating)
    rows = [*_life_rows("reference rating life", life.life, inputs.relative_speed)]
    rows.append(MethodRow("life", "reference equivalent load", life.equivalent_load, "N", "P_ref"))
    if inputs.contamination is not None and inputs.relative_speed > 0.0:
        kappa = inputs.oil.kinematic / reference_viscosity(inputs.relative_speed, bearing.pitch_diameter)
        if kappa >= 0.1:
            modified = modified_lamina_life(
                life, bearing.dynamic_rating, kappa, inputs.contamination, bearing.fatigue_limit
            )
            rows += _life_rows("modified reference rating life", modified, inputs.relative_speed)
    return MethodTable(tuple(rows), (f"{state.inner.shape[1]} laminae, inner ring turns against the load",))


def evaluate_kinematics(inputs: RollerMethodInputs) -> MethodTable:
    """Compute speeds without sliding and defect frequencies.

    They are those of cage and rollers.
    """
    bearing = inputs.bearing
    if inputs.relative_speed == 0.0:
        raise NotApplicable("nothing turns")
    motion, full = rolling_motion(bearing, inputs.inner_speed, inputs.outer_speed), bearing.full_complement
    turn = 2.0 * math.pi
    passes = {
        "rollers go round the outer ring" if full else "cage turns past the outer ring": abs(motion.cage - motion.outer)
        / turn,
        "outer ring pass": bearing.count * abs(motion.cage - motion.outer) / turn,
        "inner ring pass": bearing.count * abs(motion.inner - motion.cage) / turn,
        "roller turns": motion.spin / turn,
    }
    rows = [MethodRow("kinematics", "roller orbit" if full else "cage speed", motion.cage * 30.0 / math.pi, "rpm")]
    rows += [MethodRow("kinematics", name, value, "Hz") for name, value in passes.items()]
    return MethodTable(tuple(rows))


def _life_rows(name: str, life: float, speed: float) -> list[MethodRow]:
    rows = [MethodRow("life", name, life, "1e6 rev")]
    return [*rows, MethodRow("life", f"{name}, hours", life_hours(life, speed), "h")] if speed > 0.0 else rows
