"""The machine interface in lines for people."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lambda_core.simulate.limits import Shoulder
    from lambda_core.simulate.quasistatic import QuasiStatic
    from lambda_core.simulate.summary import Summary

_PER_RING = ("sliding", "spin", "rolling", "hysteresis", "boundary", "damping")
_REST = ("cage", "drag", "support")
_NONE = "-"
_WIDTH = 100
_SHORT = 48  # characters


def summary_text(summary: Summary) -> str:
    """Return what one run says, a line per subject."""
    verdict = "converged" if summary.converged else "NOT CONVERGED"
    window = (
        f"(95 %, {summary.revolutions_averaged} cage revolutions)" if summary.revolutions_averaged else "(whole run)"
    )
    mean = plus_minus(summary.friction_torque_Nmm, summary.friction_torque_ci_Nmm)
    lines = [
        line("friction torque", f"{mean} N mm", window, verdict),
        *breakdown_lines(summary.friction_breakdown_Nmm),
        line("input torque", f"{number(summary.input_torque_Nmm)} N mm"),
        line("cage speed", f"{number(summary.cage_speed_ratio, 4)} of inner ring", _slip(summary)),
        line("inner ring", f"x {_at(summary, 0)}  y {_at(summary, 1)}  z {_at(summary, 2)} um (mean)"),
        line(
            "contacts",
            f"p_max {number(summary.max_pressure_GPa, 3)} GPa",
            f"film {interval(summary.film_um, 2)} um",
            f"Lambda {interval(summary.film_parameter, 1)}",
        ),
        line(
            "capacitance",
            f"contacts {interval(summary.contact_capacitance_pF, 0)} pF",
            f"bearing {number(summary.bearing_capacitance_nF, 3)} nF",
        ),
        line("shoulders", *map(_margin, summary.shoulders)),
        line("energy residual", f"{_small(summary.energy_residual)} of input"),
        line("wall time", *_wall(summary)),
        *warning_lines(summary.warnings),
        *assumption_lines(summary.assumptions, summary.file),
        line("result", summary.file),
        *(line("not converged" if index == 0 else "", reason) for index, reason in enumerate(summary.reasons)),
    ]
    return "\n".join(lines)


def quasistatic_text(found: QuasiStatic) -> str:
    """Return what an equilibrium says, a line per subject and a table of contacts."""
    x, y, z = found.inner_ring_displacement_um
    tilt_y, tilt_z = found.inner_ring_tilt_mrad
    table = [f"{'ball':>6}{'azimuth':>10}{'ring':>8}{'load N':>10}{'angle deg':>11}{'film um':>10}{'C pF':>9}"]
    for contact in found.contacts:
        table.append(
            f"{contact.ball:>6}{contact.azimuth_deg:>10.1f}{contact.ring:>8}{contact.load_N:>10.1f}"
            f"{contact.contact_angle_deg:>11.2f}{number(contact.film_um, 3):>10}{number(contact.capacitance_pF, 1):>9}"
        )
    return "\n".join(
        [
            found.headline,
            line(
                "equilibrium",
                f"{found.loaded_balls} balls loaded",
                f"Q_max {number(found.max_load_N)} N",
                f"p_max {number(found.max_pressure_GPa, 3)} GPa",
            ),
            line("inner ring", f"x {x:.2f}  y {y:.2f}  z {z:.2f} um", f"tilt y {tilt_y:.4f}  z {tilt_z:.4f} mrad"),
            line("friction torque", f"{number(found.friction_torque_Nmm)} N mm", "(without cage)"),
            *breakdown_lines(found.friction_breakdown_Nmm),
            line("ball orbit", f"{number(found.orbit_speed_ratio, 4)} of inner ring"),
            line("film", f"{interval(found.film_um, 2)} um", f"Lambda {interval(found.film_parameter, 1)}"),
            line("shoulders", *map(_margin, found.shoulders)),
            *table,
            *warning_lines(found.warnings),
            *assumption_lines(found.assumptions),
        ]
    )


def line(head: str, *parts: str) -> str:
    """Return one line: what it is about, then its parts."""
    return f"{head:<17}{'   '.join(part for part in parts if part)}".rstrip()


def breakdown_lines(parts: Mapping[str, float | None]) -> list[str]:
    """Return the parts of the friction torque: one line per ring, one for the rest [N mm]."""
    width = max((len(number(value)) for value in parts.values()), default=1)
    rings = [
        f"  {ring:<6}" + "".join(f"  {name} {number(parts[f'{name}_{ring}']):>{width}}" for name in _PER_RING)
        for ring in ("inner", "outer")
    ]
    return [*rings, f"  {'':<6}" + "".join(f"  {name} {number(parts[name])}" for name in _REST)]


def warning_lines(warnings: Sequence[str]) -> list[str]:
    """Return where the laws were left, a paragraph each."""
    return [
        line("WARNING" if i == 0 else "", part)
        for warning in warnings
        for i, part in enumerate(textwrap.wrap(warning, _WIDTH, break_on_hyphens=False))
    ]


def _margin(edge: Shoulder) -> str:
    where = "clear of" if edge.margin_um >= 0.0 else "OVER"
    return f"{edge.ring} {number(abs(edge.margin_um), 0)} um {where} the edge"


def assumption_lines(assumptions: Sequence[str], file: str = "") -> list[str]:
    """Return what was assumed in a few words each, and where the reasons stand."""
    if not assumptions:
        return []
    text = "; ".join(dict.fromkeys(map(_gist, assumptions)))
    if file:
        text += f" (with reasons: lambda-bearing show {file} --assumptions)"
    return [
        line("assumed" if i == 0 else "", part)
        for i, part in enumerate(textwrap.wrap(text, _WIDTH, break_on_hyphens=False))
    ]


def _gist(assumption: str) -> str:
    """Return an assumption without remarks in brackets and long reasons."""
    head, colon, reason = assumption.split(" (")[0].partition(": ")
    return f"{head}{colon}{reason}" if len(reason) <= _SHORT else head


def number(value: float | None, digits: int = 1) -> str:
    """Write a number with `digits` decimals and groups of three; a dash for none."""
    if value is None or not math.isfinite(value):
        return _NONE
    return f"{round(value, digits) + 0.0:,.{digits}f}".replace(",", " ")  # + 0.0 turns -0.0 into 0.0


def plus_minus(value: float | None, half_width: float | None) -> str:
    """Write a mean with its confidence, to two digits of the latter."""
    if value is None or half_width is None or half_width <= 0.0:
        return number(value)
    digits = max(0, 1 - math.floor(math.log10(half_width)))
    return f"{number(value, digits)} ± {number(half_width, digits)}"


def interval(values: Sequence[float], digits: int) -> str:
    """Write a smallest and a largest number as 0.51..0.74."""
    if not values:
        return _NONE
    return f"{number(values[0], digits)}..{number(values[1], digits)}"


def _small(value: float | None) -> str:
    return _NONE if value is None else f"{value:.1e}"


def _at(summary: Summary, axis: int) -> str:
    return number(summary.inner_ring_displacement_um[axis], 2)


def _slip(summary: Summary) -> str:
    ratio = summary.cage_speed_over_epicyclic
    if ratio is None:
        return ""
    return f"(epicyclic {number(summary.epicyclic_ratio, 4)}, slip {100.0 * (1.0 - ratio):.2f} %)"


def _wall(summary: Summary) -> list[str]:
    per_second, per_turn = summary.wall_per_simulated_second, summary.wall_per_revolution_s
    parts = [f"{summary.wall_s:.2f} s for {summary.simulated_s:.4g} s"]
    if per_second is not None:
        parts.append(f"{per_second:.2f} s per simulated second")
    if per_turn is not None:
        parts.append(f"{1e3 * per_turn:.3g} ms per revolution")
    return parts
