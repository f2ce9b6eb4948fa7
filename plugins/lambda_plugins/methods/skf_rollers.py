"""Compute SKF's friction torque of roller bearings.

It is M = M_rr + M_sl + M_drag.

Source: SKF, Rolling bearings, catalogue PUB BU/P1 17000 EN (2018), chapter "Friction". The constants were read in the
table of a public tool that implements the catalogue, those of needle bearings are not in it.
"""

from __future__ import annotations

import math

from lambda_core.domain.errors import unknown_name
from lambda_core.elements.roller.roller_bearing import is_conical
from lambda_core.elements.roller.roller_drag import bath_drag
from lambda_core.elements.roller.roller_friction import SKF_CONSTANTS, skf_kind
from lambda_core.plugins import MethodRow, MethodTable, NotApplicable, RollerMethodInputs
from lambda_plugins.methods.skf import (
    STARVATION,
    SkfFriction,
    boundary_share,
    inlet_heating_factor,
    sliding_coefficient,
)

# R1 [1e-6] of cylindrical rollers by dimension series; S1 = 0.16 (series 10: 0.17), S2 = 0.0015.
_CYLINDRICAL = {"2": 1.09, "3": 1.09, "4": 1.00, "10": 1.12, "12": 1.23, "20": 1.23, "22": 1.40, "23": 1.48}
_FULL_COMPLEMENT, _S1, _S1_10, _S2 = 2.13, 0.16, 0.17, 0.0015
# R1 [1e-6] and S1 of tapered rollers; R2 = 10.9 (330: 11.3), S2 = 2.
_TAPERED = {
    "302": (1.76, 0.017),
    "303": (1.69, 0.017),
    "313": (1.84, 0.048),
    "320": (2.38, 0.014),
    "322": (2.27, 0.018),
    "323": (2.38, 0.019),
    "329": (2.31, 0.009),
    "330": (2.71, 0.010),
    "331": (2.71, 0.015),
    "332": (2.71, 0.018),
    "LL": (1.72, 0.0057),
    "L": (2.19, 0.0093),
    "LM": (2.25, 0.011),
    "M": (2.48, 0.015),
    "HM": (2.60, 0.020),
    "H": (2.66, 0.025),
    "HH": (2.51, 0.027),
}
_R2, _R2_330, _TAPERED_S2 = 10.9, 11.3, 2.0
_FULL_FILM = {"cylindrical": 0.02, "full complement": 0.02, "tapered": 0.002}  # mu_EHL


def roller_load_variables(
    kind: str, series: str, mean_diameter: float, radial_load: float, axial_load: float, axial_factor: float = 0.0
) -> tuple[float, float]:
    """Return G_rr and G_sl of a roller bearing.

    They are in the catalogue's units (torque in N mm).

    Cylindrical: G_rr = R1 d_m^2.41 F_r^0.31, G_sl = S1 d_m^0.9 F_a + S2 d_m F_r. Tapered: G_rr = R1 d_m^2.38 (F_r +
    R2 Y F_a)^0.31, G_sl = S1 d_m^0.82 (F_r + S2 Y F_a).

    Parameters
    ----------
    kind : {"cylindrical", "full complement", "tapered"}
        Which formula.
    series : str
        Dimension series.
    mean_diameter : float
        (d + D)/2 [m].
    radial_load, axial_load : float
        F_r and F_a [N].
    axial_factor : float
        Y of tapered bearings.

    Raises
    ------
    NotApplicable
        For a series that the table does not have.
    """
    diameter = 1e3 * mean_diameter
    if is_conical(kind):
        if series not in _TAPERED:
            raise NotApplicable(unknown_name("series of SKF's table of tapered rollers", series, _TAPERED))
        r1, s1 = _TAPERED[series]
        r2 = _R2_330 if series == "330" else _R2
        rolling = 1e-6 * r1 * diameter**2.38 * (radial_load + r2 * axial_factor * axial_load) ** 0.31
        return rolling, s1 * diameter**0.82 * (radial_load + _TAPERED_S2 * axial_factor * axial_load)
    if kind == "full complement":
        r1 = _FULL_COMPLEMENT
    elif series in _CYLINDRICAL:
        r1 = _CYLINDRICAL[series]
    else:
        raise NotApplicable(unknown_name("series of SKF's table of cylindrical rollers", series, _CYLINDRICAL))
    s1 = _S1_10 if series == "10" else _S1
    return (
        1e-6 * r1 * diameter**2.41 * radial_load**0.31,
        s1 * diameter**0.9 * axial_load + _S2 * diameter * radial_load,
    )


def skf_roller_friction(inputs: RollerMethodInputs) -> SkfFriction:
    """Return the parts of the torque [N m].

    M_rr = phi_ish phi_rs G_rr (nu n)^0.6, M_sl = G_sl mu_sl, mu_sl = phi_bl 0.12 + (1 - phi_bl) mu_EHL, mu_EHL 0.02 of
    cylindrical and 0.002 of tapered rollers; drag of :func:`bath_drag`.

    Raises
    ------
    NotApplicable
        At rest, for needle bearings, and for a series or a lubrication that the catalogue does not have.
    """
    bearing, kind = inputs.bearing, skf_kind(inputs.bearing)
    if kind not in _FULL_FILM:
        raise NotApplicable("the program does not have SKF's table of needle roller bearings")
    if inputs.lubrication not in STARVATION:
        raise NotApplicable(f"SKF's model does not cover {inputs.lubrication} lubrication")
    speed = inputs.relative_speed
    if speed == 0.0:
        raise NotApplicable("nothing turns")
    factor = 0.4 / math.tan(bearing.contact_angle) if bearing.contact_angle > 0.0 else 0.0
    rolling, sliding = roller_load_variables(
        kind, bearing.series, bearing.mean_diameter, inputs.radial_load, inputs.axial_load, factor
    )
    rpm, nu = speed * 30.0 / math.pi, 1e6 * inputs.oil.kinematic
    diameter = 1e3 * bearing.mean_diameter
    d, D = 1e3 * bearing.bore, 1e3 * bearing.outside
    constants = SKF_CONSTANTS[kind]
    heating = inlet_heating_factor(rpm, diameter, nu)
    starved = math.exp(-STARVATION[inputs.lubrication] * nu * rpm * (d + D) * math.sqrt(constants[1] / (2.0 * (D - d))))
    boundary = boundary_share(rpm, nu, diameter)
    coefficient = sliding_coefficient(boundary, _FULL_FILM[kind])
    return SkfFriction(
        heating * starved * rolling * (nu * rpm) ** 0.6 * 1e-3,
        sliding * coefficient * 1e-3,
        bath_drag(bearing, speed, inputs.oil.kinematic, inputs.oil_height, constants),
        0.0,
        heating,
        starved,
        boundary,
        coefficient,
    )


def evaluate_rollers(inputs: RollerMethodInputs) -> MethodTable:
    """Answer a roller bearing with the SKF model."""
    found = skf_roller_friction(inputs)
    torque = [
        ("total", found.total, "M"),
        ("rolling", found.rolling, "M_rr"),
        ("sliding", found.sliding, "M_sl"),
        ("drag", found.drag, "M_drag"),
    ]
    factors = [
        ("inlet heating factor", found.inlet_heating, "phi_ish"),
        ("replenishment factor", found.replenishment, "phi_rs"),
        ("boundary share", found.boundary_share, "phi_bl"),
        ("sliding coefficient", found.friction_coefficient, "mu_sl"),
    ]
    rows = [MethodRow("friction", name, value * 1e3, "N mm", meaning) for name, value, meaning in torque]
    rows += [MethodRow("friction", name, value, "-", meaning) for name, value, meaning in factors]
    return MethodTable(tuple(rows), (f"lubrication: {inputs.lubrication}", "open bearing without contact seals"))
