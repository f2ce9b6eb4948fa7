"""Print the results of the circuit as text lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lambda_core.results.text import line

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lambda_core.electric.current_limits import Limit
    from lambda_core.electric.outcome import Outcome
    from lambda_core.electric.risk_map import RiskMap, RiskPoint


def outcome_text(found: Outcome) -> str:
    """Return what one bearing in its circuit says, a line per subject."""
    least, middle, most = found.bearing_capacitance_pF
    low, high = found.bearing_voltage_V
    lines = [
        line("source", found.source),
        line("films", found.films, f"{found.simulated_s:.4g} s", f"{found.speed_rpm:.5g} 1/min"),
        line(
            "capacitance",
            f"bearing {least:.1f} .. {middle:.1f} .. {most:.1f} pF",
            f"unloaded balls {100 * found.unloaded_share:.1f} %",
            f"rings {found.rings_capacitance_pF:.1f} pF",
        ),
        line("impedance", *(f"{name} {value:.3g} kOhm" for name, value in found.impedance_kOhm.items())),
        line("bearing voltage", f"{low:.1f} .. {high:.1f} V", f"BVR {100 * found.bearing_voltage_ratio:.2f} %"),
        line(
            "discharges",
            f"{found.discharges_per_s:.4g} 1/s through the bearing",
            f"{found.partial_discharges / found.simulated_s:.4g} 1/s through one film",
            f"metal {100 * found.shorted_share:.2g} %",
        ),
        line("  voltage", _three(found.breakdown_voltage_V, "V")),
        line("  peak current", _three(found.peak_current_A, "A")),
        line("  energy", _three(found.energy_nJ, "nJ"), f"{found.arc_power_mW:.3g} mW in arcs"),
        line(
            "density",
            f"J_b {_one(found.current_density_A_per_mm2)} A/mm2",
            f"S_b {_one(found.power_density_VA_per_mm2)} VA/mm2",
            f"Hertzian area {found.hertz_area_mm2:.3g} mm2",
        ),
        line("worst sectors", _worst("inner", found.sector_share_inner), _worst("outer", found.sector_share_outer)),
        line("balance", f"energy {found.energy_residual:.1e}", f"charge {found.charge_residual:.1e}"),
        line("wall time", f"{found.wall_per_simulated_second:.2g} s per simulated second"),
        *(line("limits" if i == 0 else "", _limit(limit)) for i, limit in enumerate(found.limits)),
        *(line("assumed" if i == 0 else "", text) for i, text in enumerate(found.assumptions)),
    ]
    return "\n".join(lines)


def _limit(limit: Limit) -> str:
    mark = "" if limit.read_in_the_original else "; not read in the original"
    return f"{limit.quantity}: {limit.value} ({limit.source}{mark})"


def _three(values: Sequence[float] | None, unit: str) -> str:
    if values is None:
        return "-"
    return f"{values[0]:.3g} / {values[1]:.3g} / {values[2]:.3g} {unit} (10/50/90 %)"


def _one(value: float | None) -> str:
    return "-" if value is None else f"{value:.3g}"


def _worst(ring: str, shares: Sequence[float]) -> str:
    most = max(shares)
    if most == 0.0:
        return f"{ring} -"
    width = 360.0 / len(shares)
    at = shares.index(most) * width
    return f"{ring} {100 * most:.0f} % at {at:.0f}..{at + width:.0f} deg"


def map_text(found: RiskMap) -> str:
    """Return the discharges per second over speed and temperature, a row per speed."""
    columns = found.temperatures_degC
    cells = [_rate(point) for point in found.points]
    rows = [f"{'1/min':>9}" + "".join(f"{f'{value:.4g} degC':>10}" for value in columns)]
    for k, speed in enumerate(found.speeds_rpm):
        row = cells[k * len(columns) : (k + 1) * len(columns)]
        rows.append(f"{speed:9.5g}" + "".join(f"{cell:>10}" for cell in row))
    return "\n".join(
        [
            line("source", found.source),
            line("map", f"{len(found.points)} points", f"{found.span} each", f"{found.wall_s:.3g} s in all"),
            "",
            "discharges through the bearing per second (metal: asperities short it; -: no equilibrium)",
            *rows,
            "",
            *(line("assumed" if i == 0 else "", text) for i, text in enumerate(found.assumptions)),
        ]
    )


def _rate(point: RiskPoint) -> str:
    value = point.discharges_per_s
    if value is None:
        return "-"
    if point.quiet_because == "metal":
        return "metal"
    return f"{value:.3g}" if value < 1000.0 else f"{1e-3 * value:.3g}k"
