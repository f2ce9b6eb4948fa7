"""Compute rating lives by ISO 281 and ISO/TS 16281."""

from __future__ import annotations

import math
from typing import Any

from lambda_core.formulas.life import (
    basic_rating_life,
    contamination_range,
    dynamic_equivalent_load,
    life_hours,
    life_modification_factor,
    reference_rating_life,
    reference_viscosity,
    static_equivalent_load,
)
from lambda_core.formulas.ratings import dynamic_rating, fatigue_load_limit, static_factor, static_rating
from lambda_core.plugins import Method, MethodInputs, MethodRow, MethodTable, NotApplicable


def _ratings(inputs: MethodInputs, assumptions: list[str]) -> tuple[float, float, float]:
    """Return C, C_0 and C_u.

    They come from the catalogue where it has them, otherwise from the geometry, as `assumptions` reports.
    """
    of_kind: dict[str, Any] = {
        "contact_angle": inputs.contact_angle,
        "rows": inputs.rated_rows,
        "on_sphere": inputs.on_sphere,
    }
    geometry = (inputs.ball_count, inputs.ball_diameter, inputs.pitch_diameter)
    dynamic, static, fatigue = inputs.dynamic_rating, inputs.static_rating, inputs.fatigue_limit
    if dynamic is None:
        dynamic = dynamic_rating(*geometry, **of_kind)
        assumptions.append(f"C = {dynamic * 1e-3:.1f} kN from the inner geometry (ISO 281)")
    if static is None:
        static = static_rating(*geometry, **of_kind)
        assumptions.append(f"C_0 = {static * 1e-3:.1f} kN from the inner geometry (ISO 76)")
    if fatigue is None:
        fatigue = fatigue_load_limit(static, inputs.pitch_diameter)
        assumptions.append(f"C_u = {fatigue * 1e-3:.2f} kN from C_0 (ISO 281, simplified)")
    return dynamic, static, fatigue


def _life_rows(name: str, life: float, inputs: MethodInputs, meaning: str) -> list[MethodRow]:
    rows = [MethodRow("life", name, life, "1e6 rev", meaning)]
    if inputs.relative_speed > 0.0:
        rows.append(MethodRow("life", f"{name}, hours", life_hours(life, inputs.relative_speed), "h", f"{meaning}h"))
    return rows


def _gamma(inputs: MethodInputs) -> float:
    return inputs.ball_diameter * math.cos(inputs.contact_angle) / inputs.pitch_diameter


def evaluate_iso281(inputs: MethodInputs) -> MethodTable:
    """Compute rating lives and static safety from loads.

    The lives are basic and modified, from radial and axial load.
    """
    assumptions: list[str] = []
    dynamic, static, fatigue = _ratings(inputs, assumptions)
    loads, kind = (inputs.radial_load, inputs.axial_load), (inputs.contact_angle, inputs.rated_rows)
    on_sphere = inputs.on_sphere
    factor = static_factor(_gamma(inputs), on_sphere=on_sphere)
    equivalent = dynamic_equivalent_load(*loads, static, factor, *kind, on_sphere=on_sphere)
    basic = basic_rating_life(dynamic, equivalent.load)
    rows = _life_rows("basic rating life", basic, inputs, "L_10")
    meaning = f"P = {equivalent.radial_factor:.3g} F_r + {equivalent.axial_factor:.3g} F_a"
    rows.append(MethodRow("life", "equivalent load", equivalent.load, "N", meaning))
    rows += _modified_rows("", basic, equivalent.load, fatigue, inputs, assumptions)
    static_load = static_equivalent_load(*loads, *kind, on_sphere=on_sphere)
    rows.append(MethodRow("rating", "static equivalent load", static_load, "N", "P_0"))
    if static_load > 0.0:
        rows.append(MethodRow("rating", "static safety", static / static_load, "-", "C_0/P_0 (ISO 76)"))
    return MethodTable(tuple(rows), tuple(assumptions))


def _modified_rows(
    prefix: str, life: float, load: float, fatigue: float, inputs: MethodInputs, assumptions: list[str]
) -> list[MethodRow]:
    """Return kappa, a_ISO and the modified life.

    The assumptions give the reason where they are absent.
    """
    if inputs.relative_speed == 0.0:
        return []
    ratio = inputs.kinematic_viscosity / reference_viscosity(inputs.relative_speed, inputs.pitch_diameter)
    rows = [] if prefix else [MethodRow("life", "viscosity ratio", ratio, "-", "kappa = nu/nu_1")]
    if inputs.contamination is None:
        low, high = contamination_range("normal cleanliness", inputs.pitch_diameter)
        note = f"no contamination factor e_C given: no modified life (normal cleanliness: e_C {low:g} to {high:g})"
        if note not in assumptions:
            assumptions.append(note)
        return rows
    if ratio < 0.1:
        assumptions.append(f"kappa = {ratio:.2g} is below 0.1: ISO 281 gives no modified life")
        return rows
    factor = life_modification_factor(ratio, inputs.contamination, fatigue, load)
    rows.append(MethodRow("life", f"{prefix}life modification factor", factor, "-", "a_ISO"))
    return rows + _life_rows(f"{prefix}modified rating life", factor * life, inputs, "a_ISO L_10")


def evaluate_ts16281(inputs: MethodInputs) -> MethodTable:
    """Compute the reference rating life.

    It follows from the quasi-static load of every ball.
    """
    if inputs.state is None:
        raise NotApplicable("the loads of the contacts are needed: no quasi-static equilibrium was found")
    assumptions: list[str] = ["the load stands still relative to the outer ring"]
    dynamic, _, fatigue = _ratings(inputs, assumptions)
    contacts = inputs.state.contacts
    result = reference_rating_life(
        [contact.load_inner for contact in contacts],
        [contact.load_outer for contact in contacts],
        dynamic_rating=dynamic,
        gamma=_gamma(inputs),
        inner_conformity=inputs.groove_radius_inner / inputs.ball_diameter,
        outer_conformity=inputs.groove_radius_outer / inputs.ball_diameter,
        inner_rotates=inputs.inner_speed != 0.0 or inputs.outer_speed == 0.0,
        nominal_angle=inputs.contact_angle,
        rows=inputs.rated_rows,
    )
    rows = _life_rows("reference rating life", result.life, inputs, "L_10r")
    rows.append(MethodRow("life", "reference equivalent load", result.equivalent_load, "N", "P_ref,r"))
    rows += _modified_rows("reference ", result.life, result.equivalent_load, fatigue, inputs, assumptions)
    return MethodTable(tuple(rows), tuple(assumptions))


ISO_281 = Method(
    name="iso-281",
    title="Basic and modified rating life, static safety",
    reference="ISO 281:2007; ISO 76:2006",
    evaluate=evaluate_iso281,
    validity="rigid rings, no tilt, normal clearance, inner ring rotating",
    method_api=1,
)

ISO_TS_16281 = Method(
    name="iso-ts-16281",
    title="Reference rating life from the load of every ball",
    reference="ISO/TS 16281:2008, eq. 19-29",
    evaluate=evaluate_ts16281,
    validity="loads of the project's own quasi-static equilibrium",
    method_api=1,
)
