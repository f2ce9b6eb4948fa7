"""Write the page of a run.

A page has a section for each bearing; that of a machine begins with its shaft and its sums.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from lambda_core.domain.number_text import NONE, swinging
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.wrapping import lines_under, wrapped
from lambda_core.results.band_text import banded, in_digits_of
from lambda_core.results.bearing_summary import BearingSummary
from lambda_core.results.machine_numbers import said_once
from lambda_core.results.quantity import quantities, quantity_of, shown
from lambda_core.results.text import (
    PLACED,
    assumption_lines,
    band_lines,
    breakdown_lines,
    headed,
    life_line,
    line,
    named,
    other_lines,
    rating_lines,
    shoulder_lines,
    vector,
    verdict_line,
    verdict_lines,
    warning_lines,
)

if TYPE_CHECKING:
    from lambda_core.results.currents import Currents
    from lambda_core.results.machine_numbers import Swing
    from lambda_core.results.ring_deformation import RingDeformation
    from lambda_core.results.summary import Summary

_FACTS = quantities(BearingSummary)


def summary_text(summary: Summary, width: int | None = None, units: UnitSystem = SI) -> str:
    """Return the text of one run.

    Each subject has a line: the answer first, then where it may be wrong, then the rest.

    Parameters
    ----------
    width : int, optional
        Longer lines go on below; without it lines are as long as they are.
    units : UnitSystem
        In which numbers are shown.
    """
    if not summary.orbit:
        (alone,) = summary.bearings.values()
        lines = [*bearing_lines(alone, width, units, summary), *_end_lines(summary, units)]
        return "\n".join(wrapped(lines, width))
    lines = [*_machine_lines(summary, width, units), *_end_lines(summary, units)]
    for name, one in summary.bearings.items():
        lines += ["", f"{name}: {one.title}", *bearing_lines(one, width, units)]
    return "\n".join(wrapped(lines, width))


def bearing_lines(one: BearingSummary, width: int | None, units: UnitSystem, alone: Summary | None = None) -> list[str]:
    """Return what a page says of one bearing.

    Parameters
    ----------
    alone : Summary, optional
        The run, where the page is about this bearing alone: its end and force elements are those of the bearing.
    """
    converged = one.converged if alone is None else alone.converged
    turns = "roller orbits" if one.full_complement else "cage revolutions"
    window = f"(95 %, {one.revolutions_averaged} {turns})" if one.revolutions_averaged else "(whole run)"
    return [
        *verdict_lines(one.verdict, units),
        *_torque_lines(one, window, converged, units),
        *breakdown_lines(one.friction_breakdown_Nmm, units, full_complement=one.full_complement),
        headed(one, "power_loss_W", units),
        *rating_lines(one.rating, units, one.reference_life_h_band),
        line(
            "film",
            f"minimum {shown(one, 'min_film_um', units)}",
            f"central {shown(one, 'film_um', units)}",
            f"{named(one, 'film_parameter')} (central)",
        ),
        *warning_lines([units.sentence(warning) for warning in one.warnings], width),
        *([_input_line(one, units)] if one.input_torque_Nmm is not None else []),
        line(
            "roller orbit" if one.full_complement else "cage speed",
            f"{shown(one, 'cage_speed_ratio')} of inner ring",
            *_cages(one),
        ),
        line(
            "inner ring",
            f"{vector(one, 'inner_ring_displacement_um', units)} (mean)",
            f"tilt {vector(one, 'inner_ring_tilt_mrad', units)}",
        ),
        *([_force_line(one, units)] if alone is not None and one.force_N else []),
        *lines_under("ovality", [_oval(bent, units) for bent in one.bent]),
        line("pressure", named(one, "max_pressure_GPa", units)),
        *_capacitance(one),
        *_currents(one.currents),
        *([headed(one, "support_power_W", units)] if one.support_power_W is not None else []),
        *other_lines(one, units),
        *(_element_lines(alone, units) if alone is not None else []),
        *_watched_lines(one),
        *lines_under("failed", alone.plugin_faults if alone is not None else []),
        *shoulder_lines(one.shoulders, units),
        *band_lines(one.model_band, units),
    ]


def _machine_lines(found: Summary, width: int | None, units: UnitSystem) -> list[str]:
    """Return what holds for all bearings and for the shaft."""
    largest = max(found.orbit, key=lambda one: math.hypot(*one.swing_um[1:]))
    places = (*found.bodies.items(), *found.markers.items())
    of_bearings = said_once({name: one.warnings for name, one in found.bearings.items()})
    own = [units.sentence(warning) for warning in found.warnings if warning not in of_bearings]
    return [
        f"{found.case}, {found.speed_rpm:.5g} 1/min",
        *verdict_line({name: one.verdict for name, one in found.bearings.items()}),
        *(_force_line(one, units, name) for name, one in found.bearings.items()),
        headed(found, "drive_torque_Nm", units),
        *_torque_lines(found, "(95 %)", found.converged, units, "of all bearings"),
        line(_FACTS["power_loss_W"].column, shown(found, "power_loss_W", units), "of all bearings"),
        *life_line(found.system_life_h),
        line(
            "largest orbit", f"y ± {_length(largest.swing_um[1], units)}", f"z ± {_length(largest.swing_um[2], units)}",
            f"at {units.text(largest.position_mm, 'mm', 2)}",
        ),
        *(line(name, *(f"{axis} {_swung(one, k, units)}" for k, axis in enumerate("xyz"))) for name, one in places),
        *_element_lines(found, units),
        *lines_under("failed", found.plugin_faults),
        *warning_lines(own, width),
    ]  # fmt: skip


def _end_lines(summary: Summary, units: UnitSystem) -> list[str]:
    """Return a run's trust and place."""
    residual = quantity_of(summary, "energy_residual")
    return [
        *other_lines(summary, units, PLACED | BearingSummary.model_fields.keys()),
        line(residual.column, f"{shown(summary, residual.name)} of input", _iteration(summary)),
        *([line("vibrations", summary.vibrations.sentence())] if summary.vibrations else []),
        line("wall time", *_wall(summary)),
        *assumption_lines(summary.assumptions, summary.file),
        line("result", summary.file),
        *lines_under("not converged", summary.reasons),
    ]


def _input_line(one: BearingSummary, units: UnitSystem) -> str:
    """Return the torque of the drive in the friction's digits."""
    fact, plain = _FACTS["input_torque_Nmm"], shown(one, "input_torque_Nmm", units)
    text = in_digits_of(one.input_torque_Nmm, one.friction_torque_Nmm_band, fact.unit, plain, units)
    return line(fact.label, text)


def _torque_lines(
    found: Summary | BearingSummary, window: str, converged: bool, units: UnitSystem, whose: str = ""
) -> list[str]:
    """Return the torque with its uncertainty.

    The scatter of its average and a model band are separate.
    """
    verdict = "converged" if converged else "NOT CONVERGED"
    head, unit = _FACTS["friction_torque_Nmm"].column, _FACTS["friction_torque_Nmm"].unit
    mean = units.plus_minus(found.friction_torque_Nmm, found.friction_torque_ci_Nmm, unit)
    band = found.friction_torque_Nmm_band
    if not band:
        return [line(head, mean, window, whose, verdict)]
    width = found.friction_torque_ci_Nmm
    scatter = "" if width is None else f"± {units.value(width, unit):.2g} {units.unit(unit)}"
    return [
        line(head, banded(found.friction_torque_Nmm, band, unit, mean, units), whose, verdict),
        line("  scatter", scatter or NONE, window),
    ]


def _force_line(one: BearingSummary, units: UnitSystem, name: str = "") -> str:
    """Return the mean force on the shaft and its swing."""
    each = zip("xyz", one.force_N, one.force_swing_N, strict=True)
    texts = (f"{axis} {_pair(mean, swing, 'N', units)}" for axis, mean, swing in each)
    return line("force on shaft", *texts, f"of {name}" if name else "")


def _capacitance(one: BearingSummary) -> list[str]:
    """Return the capacitances, and why some are missing."""
    known = (("contacts", "contact_capacitance_pF"), ("bearing", "bearing_capacitance_nF"))
    found = "   ".join(f"{what} {shown(one, name)}" for what, name in known if getattr(one, name))
    return lines_under("capacitance", [text for text in (found, one.capacitance_note) if text])


def _iteration(summary: Summary) -> str:
    """Return the work of Newton's early ends.

    Put in or taken, where it is known.
    """
    found = summary.iteration_residual
    return "" if found is None else f"ends of iterations {shown(summary, 'iteration_residual')}"


def _currents(found: Currents | None) -> list[str]:
    """Return what the circuit did, where there is one."""
    if found is None:
        return []
    low, high = found.bearing_voltage_V
    volts, amperes = found.breakdown_voltage_V, found.peak_current_A
    lines = [
        line("bearing voltage", f"{low:.1f} .. {high:.1f} V", f"{found.discharges_per_s:.4g} discharges per second")
    ]
    if volts and amperes:
        arcs = f"{found.arc_power_mW:.3g} mW in arcs"
        lines.append(line("  discharges", f"at {volts[1]:.3g} V", f"{amperes[1]:.3g} A", arcs))
    return lines


def _watched_lines(one: BearingSummary) -> list[str]:
    """Return the numbers of observers, and the events."""
    observed = [f"{each.observer} {each.name} {_four(each.value)} {each.unit}" for each in one.observed]
    said = [
        f"began {event.count} times, first at {_four(event.first_s)} s" if event.count else "did not happen"
        for event in one.events
    ]
    events = [f"{event.event} {words}" for event, words in zip(one.events, said, strict=True)]
    return [*lines_under("observed", observed), *lines_under("events", events)]


def _element_lines(found: Summary, units: UnitSystem) -> list[str]:
    """Return mean force and power of every force element."""
    return [
        line(
            f"element {name}",
            f"force x, y, z {', '.join(units.number(value, 'N', 1) for value in one.force_N)} {units.unit('N')}",
            f"power {one.power_W:.3g} W into its bodies",
        )
        for name, one in found.elements.items()
    ]


def _four(value: float | None) -> str:
    return NONE if value is None else f"{value:.4g}"


def _oval(found: RingDeformation, units: UnitSystem) -> str:
    """Say how oval an elastic part was."""
    mean, most = (units.text(value, "um", 2) for value in (found.mean_ovality_um, found.largest_ovality_um))
    return f"{found.part} {mean} on average, {most} at most"


def _cages(one: BearingSummary) -> list[str]:
    """Return the cage's slip and the second cage's speed."""
    ratio = one.cage_speed_over_epicyclic
    words = f"epicyclic {shown(one, 'epicyclic_ratio')}, slip"
    slip = "" if ratio is None else f"({words} {100.0 * (1.0 - ratio):.2f} %)"
    if one.second_cage_speed_ratio is None:
        return [slip]
    return [slip, f"second row {shown(one, 'second_cage_speed_ratio')}"]


def _wall(summary: Summary) -> list[str]:
    per_second = summary.wall_per_simulated_second
    per_turn = [one.wall_per_revolution_s for one in summary.bearings.values()] if len(summary.bearings) == 1 else []
    parts = [f"{summary.wall_s:.2f} s for {summary.simulated_s:.4g} s"]
    if per_second is not None:
        parts.append(f"{per_second:.2f} s per simulated second")
    return parts + [f"{1e3 * spent:.3g} ms per revolution" for spent in per_turn if spent is not None]


def _pair(value: float, width: float, unit: str, units: UnitSystem) -> str:
    """Write a number with its swing and unit."""
    mean, swing = (units.value(number, unit) for number in (value, width))
    return f"{swinging(mean, swing)} {units.unit(unit)}"


def _length(value: float, units: UnitSystem) -> str:
    return f"{units.value(value, 'um'):.3g} {units.unit('um')}"


def _swung(one: Swing, axis: int, units: UnitSystem) -> str:
    mean, swing = (units.value(values[axis], "um") for values in (one.mean_um, one.swing_um))
    return f"{swinging(mean, swing)} {units.unit('um')}"
