"""Compute the friction torque of Schaeffler's catalogue.

It is M = M_0 (speed, oil) + M_1 (load), the model of Palmgren.

Source: Schaeffler, Rolling Bearings HR 1 (2019), "Friction and increases in temperature"; M_0 is printed as eq.
(38)-(39) of Syla et al. 2026. M_0 holds churning, drag and rolling resistance together: it must not be added to a
simulation whose contacts carry rolling resistance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from lambda_core.domain.errors import unknown_name
from lambda_core.plugins import Method, MethodInputs, MethodRow, MethodTable, NotApplicable


@dataclass(frozen=True)
class SeriesFactors:
    """Factors f_0 and f_1 of a series [-].

    The factor f_0 is for an oil bath to the middle of the lowest ball, for grease and for oil-air.
    """

    f0_bath: float
    f0_grease: float
    f1: float


# Recalled catalogue values, in common use; the original table was not at hand when this was written.
SERIES: dict[str, SeriesFactors] = {
    "60": SeriesFactors(1.7, 1.1, 0.0007),
    "62": SeriesFactors(2.0, 1.3, 0.0009),
    "63": SeriesFactors(2.3, 1.5, 0.0009),
    "64": SeriesFactors(2.3, 1.5, 0.0009),
    "618": SeriesFactors(1.7, 1.1, 0.0005),
}

MIXED_LIMIT = 2000.0  # nu n below which M_0 does not depend on speed [mm2/s 1/min]


def series_factors(series: str) -> SeriesFactors:
    """Return the factors of a series.

    Raises
    ------
    NotApplicable
        For a series that the table does not have.
    """
    try:
        return SERIES[series]
    except KeyError:
        raise NotApplicable(unknown_name("series of the Schaeffler friction table", series, SERIES)) from None


def idle_torque(f0: float, mean_diameter: float, speed: float, kinematic_viscosity: float) -> float:
    """Return the idle torque M_0 [N m].

    It is f_0 1e-7 d_m^3 (nu n)^(2/3), or 160e-7 f_0 d_m^3 below nu n = 2000 (Syla et al. 2026, eq. 38-39).

    (mm, mm2/s, 1/min; N mm.) The two branches meet within 0.8 % at nu n = 2000.

    Parameters
    ----------
    mean_diameter : float
        (d + D)/2 [m].
    speed : float
        Relative speed of the rings [rad/s].
    """
    product = kinematic_viscosity * 1e6 * speed * 30.0 / math.pi
    cubed = (mean_diameter * 1e3) ** 3
    if product < MIXED_LIMIT:
        return 160e-7 * f0 * cubed * 1e-3
    return float(f0 * 1e-7 * cubed * product ** (2.0 / 3.0) * 1e-3)


def load_torque(
    f1: float, mean_diameter: float, radial_load: float, axial_load: float, static_rating: float
) -> tuple[float, float]:
    """Return M_1 [N m] and its decisive load P_1 [N].

    It is M_1 = f_1 sqrt(P_0/C_0) P_1 d_m, with P_1 = max(F_r, 3.3 F_a - 0.1 F_r) and the static equivalent load P_0.
    """
    deciding = max(radial_load, 3.3 * axial_load - 0.1 * radial_load)
    static_load = max(0.6 * radial_load + 0.5 * axial_load, radial_load)
    return f1 * math.sqrt(static_load / static_rating) * deciding * mean_diameter, deciding


def evaluate(inputs: MethodInputs) -> MethodTable:
    """Answer a case with M_0 + M_1."""
    if inputs.static_rating is None:
        raise NotApplicable("the Schaeffler model needs the static load rating C_0 of the bearing")
    factors = series_factors(inputs.series)
    wet = inputs.lubrication == "oil bath"
    if inputs.lubrication in ("oil jet", "under-race"):
        raise NotApplicable(f"the Schaeffler table has no factor f_0 for {inputs.lubrication} lubrication")
    f0 = factors.f0_bath if wet else factors.f0_grease
    idle = 0.0
    if inputs.relative_speed > 0.0:
        idle = idle_torque(f0, inputs.mean_diameter, inputs.relative_speed, inputs.kinematic_viscosity)
    load, deciding = load_torque(
        factors.f1, inputs.mean_diameter, inputs.radial_load, inputs.axial_load, inputs.static_rating
    )
    rows = (
        MethodRow("friction", "total", (idle + load) * 1e3, "N mm", "M_0 + M_1"),
        MethodRow("friction", "speed dependent", idle * 1e3, "N mm", "M_0: drag, churning and rolling resistance"),
        MethodRow("friction", "load dependent", load * 1e3, "N mm", f"M_1 with P_1 = {deciding:.0f} N"),
    )
    assumptions = [f"f_0 = {f0:g} ({inputs.lubrication}), f_1 = {factors.f1:g} (series {inputs.series})"]
    if wet:
        assumptions.append("f_0 is tabled for oil to the middle of the lowest ball")
    return MethodTable(rows, tuple(assumptions))


SCHAEFFLER = Method(
    name="schaeffler",
    title="Schaeffler catalogue friction torque, M0 + M1",
    reference="Schaeffler, Rolling Bearings HR 1 (2019); Syla et al. 2026, eq. 38-39",
    evaluate=evaluate,
    validity="series 60, 62, 63, 64, 618; steady running",
    method_api=1,
)
