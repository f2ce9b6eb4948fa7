"""Print a fit as text."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from lambda_core.domain.number_text import percent, plus_minus
from lambda_core.domain.unit_systems import UnitSystem
from lambda_core.domain.wrapping import wrapped

if TYPE_CHECKING:
    from lambda_core.fitting.report import FitReport, FittedParameter

_CORRELATED = 0.8  # from which two parameters are named
_MOST_POINTS = 30


def report_text(report: FitReport, width: int | None, units: UnitSystem) -> str:
    """Return the text of a fit.

    It has the sentence, the table of parameters, and notes on them.
    """
    lines = [report.title, report.sentence, *report.warnings, ""]
    lines += _table([_HEAD, *(_row(parameter) for parameter in report.parameters)])
    lines += _correlations(report)
    lines += _quality(report)
    lines += [f"pattern of residuals: {t.name}, p = {t.adjusted_p_value:.2g}" for t in report.tests if t.is_significant]
    lines += _outliers(report)
    lines += ["", *_points(report, units)]
    lines += _predictions(report, units)
    lines += _samples(report)
    lines += _next(report, units)
    return "\n".join(wrapped(lines, width))


_HEAD = ("parameter", "value", "95 % interval", "range", "")


def _row(parameter: FittedParameter) -> tuple[str, ...]:
    unit = f" {parameter.unit}" if parameter.unit else ""
    span = f"{parameter.low:.4g}..{parameter.high:.4g}"
    if parameter.standard_error is None:
        return (parameter.name, f"{parameter.value:.4g}{unit}", "-", span, "held: not determined by the data")
    low, high = parameter.interval_95
    state = "at the end of its range" if parameter.state == "at limit" else ""
    value = f"{compact(parameter.value, parameter.standard_error)}{unit}"
    return (parameter.name, value, f"{low:.4g}..{high:.4g}", span, state)


def compact(value: float, error: float) -> str:
    """Write a value with its standard error.

    It has two digits of the error; small values have a power of ten.
    """
    if not error > 0.0 or not math.isfinite(error):
        return f"{value:.4g}"
    power = math.floor(math.log10(max(abs(value), error)))
    if -4 < power < 6:
        digits = max(0, 1 - math.floor(math.log10(error)))
        return f"{value:.{digits}f} ± {error:.{digits}f}"
    return f"({plus_minus(value / 10.0**power, error / 10.0**power)})e{power}"


def _correlations(report: FitReport) -> list[str]:
    names = [parameter.name for parameter in report.parameters if parameter.state != "held"]
    found = []
    for i, row in enumerate(report.correlation):
        found += [
            f"correlation of {names[j]} and {names[i]}: {row[j]:+.2f}" for j in range(i) if abs(row[j]) >= _CORRELATED
        ]
    weak = [c for c in report.combinations if not c.is_determined]
    for combination in weak:
        terms = " ".join(f"{weight:+.2f} {name}" for name, weight in combination.weights.items())
        found.append(f"not determined by the data: {terms} (in units of their ranges)")
    return found


def _quality(report: FitReport) -> list[str]:
    if report.scatter_pct is not None:
        scatter = f"scatter {percent(report.scatter_pct)} (from the residuals)"
    else:
        ratio = report.chi_square_per_degree
        scatter = f"chi-square per degree of freedom {ratio:.2g}" if ratio is not None else "no degree of freedom left"
    others = f"of each point predicted from all others {percent(report.left_out_rms_error_pct)}"
    return [f"error of the fit {percent(report.rms_error_pct)}, {others}", scatter]


def _outliers(report: FitReport) -> list[str]:
    wrong = [p for p in report.points if p.is_outlier]
    sizes = [max(p.standardised_residual, p.independent_residual, key=abs) for p in wrong]
    lines = [f"line {p.line} ({size:+.1f} errors)" for p, size in zip(wrong, sizes, strict=True)]
    return [f"outliers, which count little: {', '.join(lines)}"] if lines else []


def _points(report: FitReport, units: UnitSystem) -> list[str]:
    shown = report.points[:_MOST_POINTS]
    head = ("line", "quantity", "measured", "predicted", "95 % band", "residual/error")
    rows = [
        (
            str(p.line),
            f"{p.quantity} [{units.unit(p.unit)}]",
            f"{units.value(p.measured, p.unit):.4g}",
            f"{units.value(p.predicted, p.unit):.4g}",
            "..".join(f"{units.value(end, p.unit):.4g}" for end in p.band),
            f"{p.standardised_residual:+.1f}",
        )
        for p in shown
    ]
    rest = len(report.points) - len(shown)
    return [*_table([head, *rows]), *([f"and {rest} more points (--json has all)"] if rest else []), ""]


def _predictions(report: FitReport, units: UnitSystem) -> list[str]:
    """Return the points that the fit has not seen."""
    if not report.predictions:
        return []
    head = ("line", "quantity", "measured", "predicted", "95 % band with errors of laws", "")
    rows = [
        (
            str(p.line),
            f"{p.quantity} [{units.unit(p.unit)}]",
            f"{units.value(p.measured, p.unit):.4g}",
            f"{units.value(p.predicted, p.unit):.4g}",
            "..".join(f"{units.value(end, p.unit):.4g}" for end in p.band),
            "inside" if p.is_inside else "OUTSIDE",
        )
        for p in report.predictions
    ]
    inside = sum(p.is_inside for p in report.predictions)
    title = f"points that the fit has not seen: {inside} of {len(rows)} inside the band"
    return [title, *_table([head, *rows]), ""]


def _samples(report: FitReport) -> list[str]:
    """Return what samples of the posterior say about each parameter."""
    drawn = report.posterior
    if drawn is None:
        return []
    rows = [
        (one.name, f"{one.median:.4g} {one.unit}".rstrip(), f"{one.interval_95[0]:.4g}..{one.interval_95[1]:.4g}")
        for one in drawn.parameters
    ]
    count = len(drawn.parameters[0].samples)
    title = (
        f"posterior, {count} samples worth {drawn.effective:.0f} independent ones; predictions interpolated within "
        f"{drawn.interpolation_error:.2g} of an error"
    )
    return [title, *_table([("parameter", "median", "95 % interval"), *rows]), ""]


def _next(report: FitReport, units: UnitSystem) -> list[str]:
    point = report.next_point
    if point is None:
        return []
    where = ", ".join(f"{name} {units.sentence(value)}" for name, value in point.conditions.items())
    names = " and ".join(point.combination)
    before, after = (f"{spread:.2f}" for spread in (point.spread_before, point.spread_after))
    end = f"{after} of that before the fit"
    if after == before:
        return [f"next point to measure: the best one, {where}, leaves the uncertainty of {names} at {end}"]
    return [f"next point to measure: {where}; it reduces the uncertainty of {names} from {before} to {end}"]


def _table(rows: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
