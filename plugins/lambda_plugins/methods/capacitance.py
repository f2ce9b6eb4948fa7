"""Compute contact capacitances by Syla et al. 2026, section 4.3.

Entrainment speed from geometry alone, isothermal film of Chittenden, area of the Hertzian ellipse (eq. 2-3), plate
capacitor C = eps_0 eps_r A/h_cen (eq. 32) with the permittivity at the maximum Hertzian pressure, and the factor of
Schneider et al. for the surroundings (eq. 34). No slip, no heating, no inlet starvation: what the simulation adds is
seen by comparing. The laws are the project's own kernels, called with plain numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY
from lambda_core.formulas.hertz import ball_raceway_radii, reduced_modulus
from lambda_core.formulas.kinematics import entrainment_speed
from lambda_core.plugins import Method, MethodInputs, MethodRow, MethodTable, NotApplicable


@dataclass(frozen=True)
class PlateContact:
    """One lubricated contact as a plate capacitor, SI."""

    area: float  # of the Hertzian ellipse [m2]
    film: float  # h_cen [m]
    p_max: float  # [Pa]
    relative_permittivity: float  # at p_max
    hertz: float  # C_Hertz [F]
    corrected: float  # C_Con = k_c C_Hertz [F]


def plate_contact(inputs: MethodInputs, load: float, contact_angle: float, *, inner: bool) -> PlateContact:
    """Return the plate capacitance of one contact.

    The contact carries `load` [N] at `contact_angle` [rad].

    Raises
    ------
    NotApplicable
        At rest (no film) or when the oil has no permittivity.
    """
    import numpy as np

    from lambda_plugins.capacitance import Ball, schneider
    from lambda_plugins.film_thickness import FilmFloors, chittenden
    from lambda_plugins.normal_contact import fitted, hamrock_brewe, known

    if inputs.permittivity is None:
        raise NotApplicable(f"the oil {inputs.oil.name} has no permittivity")
    if inputs.relative_speed == 0.0:
        raise NotApplicable("at rest there is no film and no plate capacitor")
    ring = inputs.inner_ring if inner else inputs.outer_ring
    groove = inputs.groove_radius_inner if inner else inputs.groove_radius_outer
    e_eff = reduced_modulus(
        inputs.ball.youngs_modulus, inputs.ball.poisson_ratio, ring.youngs_modulus, ring.poisson_ratio
    )
    radius_x, radius_y = ball_raceway_radii(
        inputs.ball_diameter, inputs.pitch_diameter, groove, contact_angle, inner=inner
    )
    speed = entrainment_speed(
        inputs.inner_speed, inputs.outer_speed, inputs.ball_diameter, inputs.pitch_diameter, contact_angle
    )
    ellipse, film, corrected = np.empty(4), np.empty(2), np.empty(1)
    hamrock_brewe(1e-6, radius_x, radius_y, e_eff, known((radius_x, radius_y), fitted), ellipse)
    growth = (load / float(ellipse[0])) ** (1.0 / 3.0)  # semi-axes and pressure grow with Q^(1/3)
    semi_a, semi_b = float(ellipse[1]) * growth, float(ellipse[2]) * growth
    p_max, oil, floors = float(ellipse[3]) * growth, inputs.oil, FilmFloors(0.0, 0.0, 0.0, 0.0)
    chittenden(speed, 1.0, load, radius_x, radius_y, e_eff, oil.viscosity, oil.alpha_p, floors, film)
    central, area, permittivity = float(film[0]), math.pi * semi_a * semi_b, inputs.permittivity(p_max)
    hertz = VACUUM_PERMITTIVITY * permittivity * area / central
    parameters = (
        oil.viscosity * speed / (e_eff * radius_x),
        oil.alpha_p * e_eff,
        load / (e_eff * radius_x**2),
        inputs.permittivity(0.0),
    )
    schneider(
        hertz, central, semi_a, semi_b, radius_x, radius_y, *parameters, Ball(0.5 * inputs.ball_diameter), corrected
    )
    return PlateContact(area, central, p_max, permittivity, hertz, float(corrected[0]))


def _series(first: float, second: float) -> float:
    return first * second / (first + second)


def _rows(inner: PlateContact, outer: PlateContact) -> list[MethodRow]:
    rows = []
    for ring, plate in (("inner", inner), ("outer", outer)):
        rows += [
            MethodRow("capacitance", f"{ring} Hertzian area", plate.hertz * 1e12, "pF", "C_Hertz of one contact"),
            MethodRow("capacitance", f"{ring} contact", plate.corrected * 1e12, "pF", "C_Con = k_c C_Hertz"),
            MethodRow("capacitance", f"{ring} factor", plate.corrected / plate.hertz, "-", "k_c"),
            MethodRow("capacitance", f"{ring} film", plate.film * 1e6, "um", "h_cen"),
            MethodRow("capacitance", f"{ring} area", plate.area * 1e6, "mm2", "pi a b"),
            MethodRow("capacitance", f"{ring} maximum pressure", plate.p_max * 1e-9, "GPa", "p_0"),
            MethodRow("capacitance", f"{ring} permittivity", plate.relative_permittivity, "-", "eps_r at p_0"),
        ]
    return rows


def evaluate(inputs: MethodInputs) -> MethodTable:
    """Compute the capacitance of the loaded contacts.

    It is that of the most heavily loaded ball's contacts, and of all loaded balls together.

    A ball's two contacts are in series, the balls in parallel; balls without load are left out.
    """
    if inputs.state is None:
        raise NotApplicable("the loads of the contacts are needed: no quasi-static equilibrium was found")
    loaded = [contact for contact in inputs.state.contacts if contact.load_inner > 0.0 and contact.load_outer > 0.0]
    if not loaded:
        raise NotApplicable("no ball touches both rings")
    plates = [
        (
            plate_contact(inputs, contact.load_inner, contact.angle_inner, inner=True),
            plate_contact(inputs, contact.load_outer, contact.angle_outer, inner=False),
        )
        for contact in loaded
    ]
    most = max(range(len(loaded)), key=lambda index: loaded[index].load_inner)
    rows = _rows(*plates[most])
    meaning = f"{len(loaded)} of {len(inputs.state.contacts)} balls loaded, the others left out"
    hertz = sum(_series(inner.hertz, outer.hertz) for inner, outer in plates)
    corrected = sum(_series(inner.corrected, outer.corrected) for inner, outer in plates)
    rows.append(MethodRow("capacitance", "bearing, Hertzian areas", hertz * 1e12, "pF", meaning))
    rows.append(MethodRow("capacitance", "bearing", corrected * 1e12, "pF", meaning))
    return MethodTable(tuple(rows), ("speeds from geometry without slip", "isothermal film", "fully flooded inlet"))


ANALYTICAL_CAPACITANCE = Method(
    name="analytical-capacitance",
    title="Plate capacitor over the Hertzian area, isothermal film",
    reference="Syla et al. 2026, Lubricants 14, 154, section 4.3, eq. 2-3, 25, 32, 34",
    evaluate=evaluate,
    validity="full film, no slip, no heating",
    method_api=1,
)
