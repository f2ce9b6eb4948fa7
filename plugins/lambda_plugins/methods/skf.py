"""Compute the friction torque of SKF's catalogue.

It is M = M_rr + M_sl + M_drag + M_seal.

Source: SKF, Rolling bearings, catalogue PUB BU/P1 17000 EN (2018), chapter "Friction". Public functions
take SI; the catalogue's formulas are in mm, N, 1/min, mm2/s and give N mm, converted inside.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from lambda_core.domain.errors import unknown_name
from lambda_core.domain.lubrication import Lubrication
from lambda_core.views.method import Method, MethodInputs, MethodRow, MethodTable, NotApplicable
from lambda_plugins.methods import skf_angular
from lambda_plugins.methods.skf_chart import UNCERTAINTY, drag_loss_factor
from lambda_plugins.methods.skf_drag import K_Z, drag_torque, drag_torque_2008
from lambda_plugins.methods.skf_seals import seal_torque, seals_of

MU_BOUNDARY = 0.12  # mu_bl while running
MU_BOUNDARY_STARTING = 0.15  # mu_bl at rest
STARVATION = {"oil bath": 3e-8, "oil jet": 3e-8, "oil-air": 6e-8, "grease": 6e-8}  # K_rs
# Axial load below this share of the radial one counts as none: the catalogue has separate formulas for F_a = 0, and
# the axial load of a computed equilibrium is never exactly zero.
NEGLIGIBLE_AXIAL_SHARE = 1e-3


@dataclass(frozen=True)
class SeriesConstants:
    """Constants of one dimension series in mm and N.

    G_rr and G_sl are in N mm.
    """

    r1: float
    r2: float
    s1: float
    s2: float


SERIES: dict[str, SeriesConstants] = {
    "60": SeriesConstants(4.1e-7, 1.7, 3.73e-3, 14.6),
    "62": SeriesConstants(3.9e-7, 1.7, 3.23e-3, 36.5),
    "63": SeriesConstants(3.7e-7, 1.7, 2.84e-3, 92.8),
    "64": SeriesConstants(3.6e-7, 1.7, 2.43e-3, 198.0),
    "618": SeriesConstants(4.7e-7, 1.7, 6.50e-3, 0.78),
    "619": SeriesConstants(4.3e-7, 1.7, 4.75e-3, 3.6),
}


@dataclass(frozen=True)
class SkfFriction:
    """Parts of SKF's friction torque [N m] and factors."""

    rolling: float  # M_rr
    sliding: float  # M_sl
    drag_volume: float  # first part of M_drag, proportional to V_M
    drag_churning: float  # second part of M_drag, independent of V_M; 0 in the older edition
    inlet_heating: float  # phi_ish
    replenishment: float  # phi_rs
    boundary_share: float  # phi_bl
    friction_coefficient: float  # mu_sl

    @property
    def drag(self) -> float:
        """M_drag [N m]."""
        return self.drag_volume + self.drag_churning

    @property
    def total(self) -> float:
        """M [N m]."""
        return self.rolling + self.sliding + self.drag


def series_constants(series: str) -> SeriesConstants:
    """Return the constants of a series.

    Raises
    ------
    NotApplicable
        For a series that the table does not have.
    """
    try:
        return SERIES[series]
    except KeyError:
        raise NotApplicable(
            unknown_name("series of the SKF friction table", series, [*SERIES, *skf_angular.SERIES])
        ) from None


def operating_contact_angle(axial_load: float, static_rating: float) -> float:
    """Return alpha_F = 24.6 (F_a/C_0)^0.24 of SKF's model.

    The formula is in degrees; the result is in rad.
    """
    return math.radians(24.6 * (axial_load / static_rating) ** 0.24)


def load_variables(
    constants: SeriesConstants,
    mean_diameter: float,
    radial_load: float,
    axial_load: float = 0.0,
    static_rating: float | None = None,
) -> tuple[float, float]:
    """Return the load and geometry variables G_rr and G_sl.

    They are in the catalogue's units (torque in N mm).

    F_a = 0 (below 0.1 % of F_r): G_rr = R1 d_m^1.96 F_r^0.54, G_sl = S1 d_m^-0.26 F_r^(5/3); else G_rr = R1 d_m^1.96
    (F_r + R2 F_a/sin alpha_F)^0.54, G_sl = S1 d_m^-0.145 (F_r^5 + S2 d_m^1.5 F_a^4/sin alpha_F)^(1/3). The
    catalogue's G_sl jumps by d_m^0.115 where F_a leaves zero (a factor 1.6 to 1.8), kept as printed;
    :func:`continuous_sliding` has no step.

    Parameters
    ----------
    mean_diameter : float
        (d + D)/2 [m].
    static_rating : float, optional
        C_0 [N]; needed with an axial load.
    """
    diameter = mean_diameter * 1e3
    if axial_load <= NEGLIGIBLE_AXIAL_SHARE * radial_load:
        rolling = constants.r1 * diameter**1.96 * radial_load**0.54
        return rolling, constants.s1 * diameter**-0.26 * radial_load ** (5.0 / 3.0)
    if static_rating is None:
        raise NotApplicable("the SKF model with an axial load needs the static load rating C_0 of the bearing")
    sine = math.sin(operating_contact_angle(axial_load, static_rating))
    rolling = constants.r1 * diameter**1.96 * (radial_load + constants.r2 * axial_load / sine) ** 0.54
    combined = radial_load**5 + constants.s2 * diameter**1.5 / sine * axial_load**4
    return rolling, constants.s1 * diameter**-0.145 * combined ** (1.0 / 3.0)


def continuous_sliding(
    constants: SeriesConstants, mean_diameter: float, radial_load: float, axial_load: float, static_rating: float
) -> float:
    """Return G_sl without the step at zero axial load.

    The step of the print is where the axial load leaves zero [N mm over mu_sl].

    G_sl = S1 ((d_m^-0.26)^3 F_r^5 + (d_m^-0.145)^3 S2 d_m^1.5 F_a^4/sin alpha_F)^(1/3): each load keeps the power of
    d_m that the catalogue prints for it alone, so that both pure loads have the printed value. Own work; under combined
    load it lies below the print by at most d_m^0.115.
    """
    diameter = mean_diameter * 1e3
    radial = (diameter**-0.26) ** 3 * radial_load**5
    if axial_load <= 0.0:
        return float(constants.s1 * radial ** (1.0 / 3.0))
    sine = math.sin(operating_contact_angle(axial_load, static_rating))
    axial = (diameter**-0.145) ** 3 * constants.s2 * diameter**1.5 / sine * axial_load**4
    return float(constants.s1 * (radial + axial) ** (1.0 / 3.0))


def inlet_heating_factor(speed_rpm: float, mean_diameter: float, viscosity: float) -> float:
    """Return the inlet heating factor phi_ish.

    It is 1/(1 + 1.84e-9 (n d_m)^1.28 nu^0.64) (n in 1/min, d_m in mm, nu in mm2/s).
    """
    return float(1.0 / (1.0 + 1.84e-9 * (speed_rpm * mean_diameter) ** 1.28 * viscosity**0.64))


def boundary_share(speed_rpm: float, viscosity: float, mean_diameter: float) -> float:
    """Return the share of boundary lubrication phi_bl.

    It is exp(-2.6e-8 (n nu)^1.4 d_m) (1/min, mm2/s, mm).
    """
    return math.exp(-2.6e-8 * (speed_rpm * viscosity) ** 1.4 * mean_diameter)


def sliding_coefficient(boundary: float, full_film: float) -> float:
    """Return mu_sl = phi_bl mu_bl + (1 - phi_bl) mu_EHL."""
    return boundary * MU_BOUNDARY + (1.0 - boundary) * full_film


def replenishment_factor(
    speed_rpm: float, bore: float, outside: float, viscosity: float, lubrication: Lubrication, k_z: float = K_Z
) -> float:
    """Return the replenishment factor phi_rs.

    It is exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))) (mm, 1/min, mm2/s), with K_rs 3e-8 for a bath and 6e-8 for
    grease.
    """
    geometry = (bore + outside) * math.sqrt(k_z / (2.0 * (outside - bore)))
    return math.exp(-STARVATION[lubrication] * viscosity * speed_rpm * geometry)


def skf_friction(
    series: str,
    bore_diameter: float,
    outside_diameter: float,
    radial_load: float,
    axial_load: float,
    speed: float,
    kinematic_viscosity: float,
    *,
    static_rating: float | None = None,
    lubrication: Lubrication = "oil bath",
    full_film_coefficient: float = 0.05,
    oil_height: float = 0.0,
    volume_factor: float = 0.0,
    edition: Literal["2008", "2018"] = "2018",
) -> SkfFriction:
    """Return the friction torque of a ball bearing by SKF.

    The bearing is an open deep groove or angular contact bearing; the module names the source.

    M_rr = phi_ish phi_rs G_rr (nu n)^0.6; M_sl = G_sl mu_sl, mu_sl = phi_bl mu_bl + (1 - phi_bl) mu_EHL,
    phi_bl = exp(-2.6e-8 (n nu)^1.4 d_m). Valid for steady running at normal operating clearance.

    Parameters
    ----------
    speed : float
        Relative speed of the rings, >= 0 [rad/s]. At rest only the sliding part with mu_bl = 0.15 is left.
    full_film_coefficient : float
        mu_EHL: 0.05 mineral oils, 0.04 synthetic oils, 0.1 transmission fluids.
    oil_height : float
        H above the lowest point of the outer raceway [m]; 0 means no bath (edition 2018 only).
    edition : {"2008", "2018"}
        Formula of the drag loss; V_M belongs to it.
    """
    mean_diameter = 0.5 * (bore_diameter + outside_diameter)
    k_z = K_Z
    if series in skf_angular.SERIES:
        load_rolling, load_sliding = skf_angular.angular_variables(
            mean_diameter, radial_load, axial_load, speed, series
        )
        k_z = skf_angular.K_Z[series]
    else:
        constants = series_constants(series)
        load_rolling, load_sliding = load_variables(constants, mean_diameter, radial_load, axial_load, static_rating)
    rpm, nu, diameter = speed * 30.0 / math.pi, kinematic_viscosity * 1e6, mean_diameter * 1e3
    if rpm == 0.0:
        return SkfFriction(
            0.0, load_sliding * MU_BOUNDARY_STARTING * 1e-3, 0.0, 0.0, 1.0, 1.0, 1.0, MU_BOUNDARY_STARTING
        )
    heating = inlet_heating_factor(rpm, diameter, nu)
    replenishment = replenishment_factor(rpm, bore_diameter * 1e3, outside_diameter * 1e3, nu, lubrication, k_z)
    boundary = boundary_share(rpm, nu, diameter)
    coefficient = sliding_coefficient(boundary, full_film_coefficient)
    volume_part, churning = 0.0, 0.0
    if lubrication in ("oil bath", "oil jet") and edition == "2008":
        volume_part, churning = drag_torque_2008(bore_diameter, outside_diameter, speed, volume_factor, k_z)
    elif lubrication in ("oil bath", "oil jet"):
        volume_part, churning = drag_torque(
            bore_diameter,
            outside_diameter,
            speed,
            kinematic_viscosity,
            oil_height,
            volume_factor,
            oil_jet=lubrication == "oil jet",
            k_z=k_z,
        )
    return SkfFriction(
        heating * replenishment * load_rolling * (nu * rpm) ** 0.6 * 1e-3,
        load_sliding * coefficient * 1e-3,
        volume_part,
        churning,
        heating,
        replenishment,
        boundary,
        coefficient,
    )


def full_film_coefficient(base_type: str) -> float:
    """Return mu_EHL by the oil's base type.

    0.05 mineral, 0.04 synthetic (every oil that is not called mineral).
    """
    return 0.05 if "mineral" in base_type.lower() else 0.04


def evaluate(inputs: MethodInputs) -> MethodTable:
    """Answer a case with the SKF model."""
    if inputs.lubrication not in STARVATION:
        raise NotApplicable(f"SKF's model does not cover {inputs.lubrication} lubrication")
    seals, about_seals = _seals(inputs)
    assumptions = [f"lubrication: {inputs.lubrication}", about_seals]
    height = 0.0
    if inputs.oil_level is not None:
        height = max(inputs.oil_level + 0.5 * inputs.ball_diameter, 0.0)
    elif inputs.lubrication == "oil bath":
        assumptions.append("oil level not given: no drag loss")
    volume_factor = inputs.drag_volume_factor
    if volume_factor is None and height > 0.0:
        mean_diameter = 0.5 * (inputs.bore_diameter + inputs.outside_diameter)
        volume_factor = drag_loss_factor(height / mean_diameter, inputs.drag_edition)
        how = f"from SKF's chart, read within {UNCERTAINTY:.0%}" if inputs.drag_edition == "2018" else "assumed"
        assumptions.append(f"V_M = {volume_factor:.3g} in the drag formula of {inputs.drag_edition}, {how}")
    elif volume_factor is not None:
        assumptions.append(f"V_M = {volume_factor:g} in the drag formula of {inputs.drag_edition}")
    result = skf_friction(
        inputs.series,
        inputs.bore_diameter,
        inputs.outside_diameter,
        inputs.radial_load,
        inputs.axial_load,
        inputs.relative_speed,
        inputs.kinematic_viscosity,
        static_rating=inputs.static_rating,
        lubrication=inputs.lubrication,
        full_film_coefficient=full_film_coefficient(inputs.oil.base_type),
        oil_height=height,
        volume_factor=volume_factor or 0.0,
        edition=inputs.drag_edition,
    )
    torque = [
        ("total", result.total + seals, "M"),
        ("rolling", result.rolling, "M_rr"),
        ("sliding", result.sliding, "M_sl"),
        ("drag", result.drag, "M_drag"),
        *([("seals", seals, "M_seal")] if seals else []),
    ]
    factors = [
        ("inlet heating factor", result.inlet_heating, "phi_ish"),
        ("replenishment factor", result.replenishment, "phi_rs"),
        ("boundary share", result.boundary_share, "phi_bl"),
        ("sliding coefficient", result.friction_coefficient, "mu_sl"),
    ]
    rows = [MethodRow("friction", name, value * 1e3, "N mm", meaning) for name, value, meaning in torque]
    rows += [MethodRow("friction", name, value, "-", meaning) for name, value, meaning in factors]
    sliding = _without_step(inputs, result)
    if sliding is not None:
        words = "own continuous form of G_sl: the printed one steps where the axial load leaves zero"
        rows.append(MethodRow("friction", "sliding, continuous", sliding * 1e3, "N mm", f"M_sl, {words}"))
        total = result.total + seals - result.sliding + sliding
        rows.append(MethodRow("friction", "total, continuous", total * 1e3, "N mm", f"M, {words}"))
    return MethodTable(tuple(rows), tuple(assumptions))


def _without_step(inputs: MethodInputs, result: SkfFriction) -> float | None:
    """Return M_sl of the continuous form [N m].

    None where the print has no step: other series, a pure load.
    """
    if inputs.series in skf_angular.SERIES or inputs.static_rating is None or not inputs.radial_load > 0.0:
        return None
    if inputs.axial_load <= NEGLIGIBLE_AXIAL_SHARE * inputs.radial_load:
        return None
    mean_diameter = 0.5 * (inputs.bore_diameter + inputs.outside_diameter)
    loads = (inputs.radial_load, inputs.axial_load, inputs.static_rating)
    variable = continuous_sliding(series_constants(inputs.series), mean_diameter, *loads)
    return variable * result.friction_coefficient * 1e-3


def _seals(inputs: MethodInputs) -> tuple[float, str]:
    """Return the seals' friction torque [N m] and a sentence."""
    kind, sides = seals_of(inputs.designation)
    if not kind:
        return 0.0, "open bearing without contact seals"
    if inputs.shoulder_diameter_inner is None:
        return 0.0, f"friction of the {kind} seals left out: the shoulder of the inner ring is not known"
    torque = seal_torque(kind, inputs.outside_diameter, inputs.shoulder_diameter_inner, sides)
    if torque is None:
        return 0.0, f"friction of the {kind} seals left out: SKF's table has none for this outside diameter"
    what = f"{sides} {kind} seals" if sides == 2 else f"one {kind} seal, half of what two have"
    return torque, f"{what} on the shoulder of the inner ring, at most: the recess of a sealed bearing is smaller"


SKF = Method(
    name="skf",
    title="SKF catalogue friction model",
    reference="SKF, Rolling bearings, catalogue 17000 EN (2018), chapter Friction; seals after 6000 (2008), table 4",
    evaluate=evaluate,
    validity="series 60, 62, 63, 64, 618, 619, 70, 72, 73, 32, 33, QJ2, QJ3, 12, 13, 22, 23; seals RZ, RSL, RSH, RS1; "
    "steady running; normal clearance",
    method_api=1,
)
